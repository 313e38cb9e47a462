#include "stability/robust_oracle.hpp"

#include <algorithm>
#include <cassert>

#include "stability/given.hpp"
#include "stability/line_test.hpp"
#include "stability/point_test.hpp"

namespace surefoot::stability {

using Eigen::Vector2d;

std::string Critical::name() const {
  switch (kind) {
    case Kind::none: return "none";
    case Kind::equilibrium: return "equilibrium";
    case Kind::mode: return mode.name();
  }
  return "none";
}

namespace {

std::span<const Contact> sound(std::span<const Contact> contacts, double radius_of_gyration) {
  require_contacts(contacts);
  require_radius_of_gyration(radius_of_gyration);
  return contacts;
}

}  // namespace

RobustOracle::RobustOracle(std::span<const Contact> contacts, double radius_of_gyration, DisturbanceBox box)
    : posture_(sound(contacts, radius_of_gyration), radius_of_gyration), box_(box) {
  require_box(box);
}

bool robust(std::span<const Contact> contacts, double radius_of_gyration, const DisturbanceBox& box,
            const Vector2d& com) {
  assert(not_negative(box.kappa) && not_negative(box.nu));
  Posture posture(contacts, radius_of_gyration, Posture::Modes::deferred);
  PointQuery query(posture, com, box);
  if (!query.equilibrium()) return false;
  posture.list_modes();
  return !query.any_feasible();
}

bool RobustOracle::equilibrium(const Vector2d& com) const { return PointQuery(posture_, com, box_).equilibrium(); }

bool RobustOracle::robust(const Vector2d& com) const {
  PointQuery query(posture_, com, box_);
  return query.equilibrium() && !query.any_feasible();
}

std::vector<ContactMode> RobustOracle::feasible_modes(const Vector2d& com) const {
  PointQuery query(posture_, com, box_);
  std::vector<ContactMode> found;
  for (const ModeSpec& spec : posture_.modes())
    if (query.feasible(spec)) found.push_back(contact_mode(spec, posture_.contacts()));
  return found;
}

// ---- lines ------------------------------------------------------------------------------------------------------

bool RobustOracle::line_equilibrium(const Vector2d& from, const Vector2d& to) const {
  return equilibrium(from) && equilibrium(to);  // R_SS(W) is convex
}

LineVerdict RobustOracle::line(const Vector2d& from, const Vector2d& to) const {
  using Outcome = LineVerdict::Outcome;
  if (!equilibrium(from)) return {Outcome::unstable, 0, Critical::of_equilibrium()};
  if (!equilibrium(to)) return {Outcome::unstable, 1, Critical::of_equilibrium()};
  const auto unstable = [&](const ModeSpec& spec, double lambda) {
    return LineVerdict{Outcome::unstable, lambda, Critical::of(posture_, spec)};
  };
  const LineQuery query(posture_, from, to, box_);
  const LineScan scan = query.scan();
  if (scan.feasible_mode >= 0) return unstable(posture_.modes()[scan.feasible_mode], scan.feasible_at);
  LineVerdict verdict{Outcome::stable, 0, {}};
  for (std::size_t k = 0; k < posture_.modes().size(); ++k) {
    if (scan.excluded >> k & 1) continue;
    const ModeSpec& spec = posture_.modes()[k];
    const LineMode mode = query.feasible(spec, scan.reached[k]);
    if (mode.outcome == LineOutcome::feasible) return unstable(spec, mode.lambda);
    if (mode.outcome == LineOutcome::uncertain)
      verdict = {Outcome::uncertain, mode.lambda, Critical::of(posture_, spec)};
  }
  return verdict;
}

std::vector<ContactMode> RobustOracle::line_feasible_modes(const Vector2d& from, const Vector2d& to) const {
  const LineQuery query(posture_, from, to, box_);
  const LineScan scan = query.scan(1, false);
  std::vector<ContactMode> found;
  for (std::size_t k = 0; k < posture_.modes().size(); ++k) {
    const ModeSpec& spec = posture_.modes()[k];
    if (scan.excluded >> k & 1) continue;
    if (query.feasible(spec, scan.reached[k]).outcome == LineOutcome::excluded) continue;
    found.push_back(contact_mode(spec, posture_.contacts()));
  }
  return found;
}

// ---- R_SS(W) ----------------------------------------------------------------------------------------------------

std::vector<HalfPlane> RobustOracle::equilibrium_half_planes() const {
  std::vector<HalfPlane> planes;
  planes.reserve(2 * posture_.facets().size());
  if (posture_.flat_cone()) return {{Vector2d::Zero(), -1}};  // empty
  const Vector2d& origin = posture_.position(0);
  for (const Facet& facet : posture_.facets())
    for (const double p : {-box_.kappa, box_.kappa}) {
      // z . g = z.p p + z.one + z.q (x - p y + q), least over q
      const Row<double>& z = facet.z;
      const Vector2d normal(z.q, -z.q * p);
      planes.push_back({normal, z.p * p + z.one - std::abs(z.q) * box_.nu - normal.dot(origin)});
      if (box_.kappa == 0) break;
    }
  return planes;
}

std::vector<Vector2d> RobustOracle::equilibrium_polygon(const std::vector<Vector2d>& window) const {
  std::vector<Vector2d> polygon = window, kept;
  kept.reserve(window.size() + 8);  // a half-plane adds at most one vertex
  for (const HalfPlane& plane : equilibrium_half_planes()) {
    const auto value = [&plane](const Vector2d& at) { return plane.normal.dot(at) + plane.offset; };
    if (std::all_of(polygon.begin(), polygon.end(), [&](const Vector2d& at) { return value(at) >= 0; })) continue;
    kept.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector2d &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
      const double va = value(a), vb = value(b);
      if (va >= 0) kept.push_back(a);
      if ((va >= 0) != (vb >= 0)) kept.push_back(a + (b - a) * (va / (va - vb)));
    }
    if (kept.size() < 3) return {};
    polygon.swap(kept);
  }
  return polygon.size() < 3 ? std::vector<Vector2d>{} : polygon;
}

}  // namespace surefoot::stability
