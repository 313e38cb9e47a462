#include "tests/support/exact_cases.hpp"

#include <cmath>
#include <limits>

namespace surefoot::testing {
namespace {

using Eigen::Vector2d;
using Predicate = std::function<bool(const Vector2d&)>;

double moved(double value, int units) {
  for (; units > 0; --units) value = std::nextafter(value, std::numeric_limits<double>::infinity());
  for (; units < 0; ++units) value = std::nextafter(value, -std::numeric_limits<double>::infinity());
  return value;
}

template <class T, std::size_t n>
T pick(Sampler& sampler, const std::array<T, n>& from) {
  return from[sampler.integer(0, n - 1)];
}

Kind any_kind(Sampler& sampler) { return pick(sampler, all_kinds); }

/// Makes some postures extreme: no disturbance along an axis, no friction, other lengths, far from the origin.
void vary(SamplePosture& sample, Sampler& sampler) {
  if (sampler.chance(0.1)) sample.box.kappa = 0;
  if (sampler.chance(0.1)) sample.box.nu = 0;
  if (sampler.chance(0.1)) sample.contacts[0].friction = 0;
  if (sampler.chance(0.05)) {
    for (Contact& contact : sample.contacts) contact.friction *= 0x1p-20;
  }
  const double scale = sampler.chance(0.1) ? 0x1p30 : sampler.chance(0.1) ? 0x1p-30 : 1;
  const Vector2d shift = sampler.chance(0.1) ? Vector2d(1e6, -1e6) : Vector2d(0, 0);
  for (Contact& contact : sample.contacts) contact.position = scale * (contact.position + shift);
  sample.com = scale * (sample.com + shift);
  sample.rho *= scale;
  sample.box.nu *= scale;
}

/// Two neighbouring doubles between which the predicate changes along one axis, given two COMs where it differs.
std::optional<std::array<Vector2d, 2>> bisected(Vector2d a, Vector2d b, const Predicate& holds) {
  const bool at_a = holds(a), at_b = holds(b);
  if (at_a == at_b) return std::nullopt;
  int axis = 0;
  const Vector2d bend(b.x(), a.y());
  if (holds(bend) != at_a) {
    b = bend;
  } else {
    a = bend;
    axis = 1;
  }
  for (;;) {
    Vector2d middle = a;
    middle[axis] = 0.5 * a[axis] + 0.5 * b[axis];
    if (middle[axis] == a[axis] || middle[axis] == b[axis]) return std::array{a, b};
    (holds(middle) == at_a ? a : b) = middle;
  }
}

/// The COM, its neighbours along either axis 1, 2 and 4 units away, one of them in both.
void add_neighbours(const Vector2d& com, Sampler& sampler, std::vector<Vector2d>& coms) {
  coms.push_back(com);
  for (const int units : {-4, -2, -1, 1, 2, 4}) {
    coms.emplace_back(moved(com.x(), units), com.y());
    coms.emplace_back(com.x(), moved(com.y(), units));
  }
  coms.emplace_back(moved(com.x(), sampler.integer(-4, 4)), moved(com.y(), sampler.integer(-4, 4)));
}

SamplePosture posture_with_feet(Sampler& sampler) {
  SamplePosture sample = sampler.posture(any_kind(sampler), sampler.integer(2, 3));
  return sample;
}

/// A predicate about the COM that changes at a boundary of the kind.
Predicate boundary(PointKind kind, const ExactPosture& exact, Sampler& sampler) {
  const auto at = [&exact](const Vector2d& com) { return exact.frame(ExactCom(com)); };
  const ExactMode& mode = exact.modes()[sampler.integer(0, static_cast<int>(exact.modes().size()) - 1)];
  const bool outermost = sampler.chance(0.5);  // of R_SS(W), of R(W)
  if (kind == PointKind::denominator)
    return [&exact, &mode, at](const Vector2d& com) { return ExactPosture::denominator_sign(at(com), mode) > 0; };
  if (kind == PointKind::mode && outermost) return [&exact, at](const Vector2d& com) { return exact.robust(at(com)); };
  if (kind == PointKind::mode)
    return [&exact, &mode, at](const Vector2d& com) { return exact.feasible(at(com), mode); };
  if (outermost || exact.facet_count() == 0)
    return [&exact, at](const Vector2d& com) { return exact.equilibrium(at(com)); };
  const int facet = sampler.integer(0, exact.facet_count() - 1), corner = sampler.integer(0, 3);
  return [&exact, at, facet, corner](const Vector2d& com) { return exact.facet_sign(at(com), facet, corner) > 0; };
}

PointFamily at_boundary(PointKind kind, Sampler& sampler) {
  constexpr int tries = 12;
  PointFamily family;
  family.sample = posture_with_feet(sampler);
  const SamplePosture before = family.sample;
  vary(family.sample, sampler);
  const ExactPosture exact(family.sample);
  const double scale = family.sample.rho / before.rho;
  // COMs near the contacts of the posture as it was drawn, moved along with it.
  const Vector2d shift = family.sample.com / scale - before.com;
  const auto draw = [&] { return Vector2d(scale * (sampler.com_near(before.contacts) + shift)); };
  for (int t = 0; t < tries && family.coms.empty(); ++t) {
    const Vector2d a = t == 0 ? family.sample.com : draw(), b = draw();
    const Predicate holds = boundary(kind, exact, sampler);
    if (const auto pair = bisected(a, b, holds)) {
      add_neighbours((*pair)[0], sampler, family.coms);
      if (sampler.chance(0.3)) family.coms.push_back((*pair)[1]);
    }
  }
  return family;
}

/// Normal (0, 1) turned by a right angle or by the angle of a 3-4-5 triangle (then length 5).
Vector2d turned(Sampler& sampler) {
  constexpr std::array<std::array<double, 2>, 8> normals{
      {{0, 1}, {0, 1}, {1, 0}, {-1, 0}, {3, 4}, {-3, 4}, {4, 3}, {0, -1}}};
  const auto& n = pick(sampler, normals);
  return {n[0], n[1]};
}

/// D of the slide in direction sigma at contact 1 is zero at `com`: with r = a t + b n, |n| = L, D = rho^2 L^2 + L^4 a
/// (a + sigma mu b), which is zero for rho = L c, b = -sigma (a + c^2 / a) / mu. All numbers are dyadic and short.
SamplePosture painleve_posture(Sampler& sampler, int& sigma) {
  SamplePosture sample;
  const Vector2d n = turned(sampler), t(n.y(), -n.x());
  const double a = (sampler.chance(0.5) ? 1 : -1) * std::ldexp(1.0, sampler.integer(-3, 0));
  const double c = std::ldexp(sampler.integer(1, 5), -4), mu = std::ldexp(1.0, sampler.integer(-2, 1));
  sigma = sampler.chance(0.5) ? 1 : -1;
  const double b = -sigma * (a + c * c / a) / mu;
  sample.com = {0.125 * sampler.integer(-4, 4), 0.125 * sampler.integer(-4, 4)};
  sample.contacts = {{sample.com + a * t + b * n, n, mu}};
  sample.rho = n.norm() * c;  // |n| is 1 or 5
  for (int others = sampler.integer(0, 2); others > 0; --others) {
    const Vector2d at(0.25 * sampler.integer(-8, 8), 0.25 * sampler.integer(-8, 8));
    sample.contacts.push_back({at, sampler.chance(0.3) ? n : turned(sampler), 0.25 * sampler.integer(0, 6)});
  }
  sample.box = {std::ldexp(sampler.integer(0, 3), -sampler.integer(3, 6)),
                std::ldexp(sampler.integer(0, 3), -sampler.integer(3, 6))};
  return sample;
}

/// A second contact whose opening rate N_l . M^-1 s is zero as well: r_l x n_l = -rho^2 (n_l . C) / (r x C).
bool add_silent_contact(SamplePosture& sample, int sigma, Sampler& sampler) {
  const Contact& slide = sample.contacts[0];
  const Vector2d tangent(slide.normal.y(), -slide.normal.x());
  const Vector2d edge = slide.normal - sigma * slide.friction * tangent, r = slide.position - sample.com;
  const double moment = r.x() * edge.y() - r.y() * edge.x();
  const Vector2d n = turned(sampler), t(n.y(), -n.x());
  const double lever = -sample.rho * sample.rho * n.dot(edge) / moment / n.squaredNorm();
  if (!std::isfinite(lever) || std::abs(lever) > 8) return false;
  sample.contacts.resize(1);
  sample.contacts.push_back(
      {sample.com + lever * t + 0.25 * sampler.integer(-4, 4) * n, n, 0.25 * sampler.integer(0, 6)});
  return true;
}

PointFamily at_zero_denominator(PointKind kind, Sampler& sampler) {
  PointFamily family;
  int sigma = 1;
  family.sample = painleve_posture(sampler, sigma);
  if (kind == PointKind::both_zero && !add_silent_contact(family.sample, sigma, sampler)) return family;
  add_neighbours(family.sample.com, sampler, family.coms);
  return family;
}

SamplePosture grid_posture(Sampler& sampler) {
  SamplePosture sample;
  const int count = sampler.integer(1, 3);
  const bool level = sampler.chance(0.4), flat = level && sampler.chance(0.5);
  const double friction = 0.25 * sampler.integer(0, 4);
  for (int i = 0; i < count; ++i) {
    Contact contact;
    contact.position = {0.25 * sampler.integer(-4, 4), flat ? 0 : 0.25 * sampler.integer(-2, 2)};
    contact.normal = level ? Vector2d(0, 1) : Vector2d(sampler.integer(-2, 2), sampler.integer(0, 2));
    if (contact.normal.isZero()) contact.normal = {0, 1};
    contact.friction = sampler.chance(0.6) ? friction : 0.25 * sampler.integer(0, 4);
    sample.contacts.push_back(contact);
  }
  sample.rho = 0.125 * sampler.integer(1, 8);
  sample.box = {0.125 * sampler.integer(0, 3), 0.125 * sampler.integer(0, 3)};
  return sample;
}
Vector2d grid_com(Sampler& sampler) { return {0.125 * sampler.integer(-10, 10), 0.125 * sampler.integer(-4, 12)}; }

PointFamily on_grid(Sampler& sampler) {
  PointFamily family;
  family.sample = grid_posture(sampler);
  for (int k = 0; k < 8; ++k) family.coms.push_back(grid_com(sampler));
  const Vector2d com = family.coms.front();
  for (const int units : {-1, 1}) {
    family.coms.emplace_back(moved(com.x(), units), com.y());
    family.coms.emplace_back(com.x(), moved(com.y(), units));
  }
  return family;
}

PointFamily nearly_coincident(Sampler& sampler) {
  constexpr std::array special{Kind::flat,   Kind::stairs,     Kind::stacked, Kind::incline,
                               Kind::treads, Kind::coincident, Kind::opposed};
  PointFamily family;
  family.sample =
      sampler.chance(0.3) ? grid_posture(sampler) : sampler.posture(pick(sampler, special), sampler.integer(2, 3));
  if (sampler.chance(0.5)) vary(family.sample, sampler);
  std::vector<Contact>& contacts = family.sample.contacts;
  for (int changes = sampler.integer(1, 2); changes > 0; --changes) {
    Contact& contact = contacts[sampler.integer(0, static_cast<int>(contacts.size()) - 1)];
    const int units = sampler.chance(0.5) ? 1 : -1, axis = sampler.integer(0, 1);
    double& value = sampler.chance(0.6) ? contact.normal[axis] : contact.position[axis];
    value = value == 0 ? units * 0x1p-52 : moved(value, units);
    if (sampler.chance(0.2) && contact.friction > 0) contact.friction = moved(contact.friction, units);
  }
  family.coms.push_back(family.sample.com);
  // Straight above a contact, and a unit beside it.
  const Contact& foot = contacts[sampler.integer(0, static_cast<int>(contacts.size()) - 1)];
  for (const int units : {-1, 0, 1}) family.coms.emplace_back(moved(foot.position.x(), units), family.sample.com.y());
  for (int k = 0; k < 4; ++k) family.coms.push_back(sampler.com_near(contacts));
  return family;
}

// ---- lines ------------------------------------------------------------------------------------------------------

constexpr int tries_for_ends = 40;

/// COMs at which the posture is robust; fewer than wanted if they are hard to find.
std::vector<Vector2d> robust_coms(const ExactPosture& exact, const SamplePosture& sample, Sampler& sampler, int wanted,
                                  double stretch) {
  std::vector<Vector2d> found;
  for (int t = 0; t < tries_for_ends && static_cast<int>(found.size()) < wanted; ++t) {
    Vector2d com = sampler.com_near(sample.contacts);
    com.y() *= stretch;
    if (exact.robust(exact.frame(ExactCom(com)))) found.push_back(com);
    if (t == tries_for_ends / 4 && found.empty()) break;
  }
  return found;
}

SamplePosture slender_posture(Sampler& sampler) {
  constexpr std::array shapes{Kind::vee, Kind::ridge, Kind::walls, Kind::opposed, Kind::stacked, Kind::any};
  SamplePosture sample = sampler.posture(pick(sampler, shapes), sampler.integer(2, 3));
  sample.rho = sampler.uniform(0.01, 0.08);
  return sample;
}

LineFamily between_robust(LineKind kind, Sampler& sampler) {
  LineFamily family;
  const bool slender = kind != LineKind::stable_ends;
  family.sample = slender ? slender_posture(sampler) : posture_with_feet(sampler);
  const ExactPosture exact(family.sample);
  const auto coms = robust_coms(exact, family.sample, sampler, 4, slender ? 3 : 1);
  for (std::size_t k = 0; k + 1 < coms.size(); ++k) family.lines.push_back({coms[k], coms[k + 1]});
  return family;
}

/// From one robust COM, ends at which the line is stable and is not: where it changes, and 1, 2, 4 units beside.
LineFamily touching(Sampler& sampler) {
  LineFamily family;
  family.sample = sampler.chance(0.6) ? slender_posture(sampler) : posture_with_feet(sampler);
  const ExactPosture exact(family.sample);
  const auto coms = robust_coms(exact, family.sample, sampler, 4, 1);
  if (coms.size() < 2) return family;
  const Predicate stable = [&](const Vector2d& to) { return ExactLine(exact, coms[0], to).stable(); };
  Vector2d other = sampler.com_near(family.sample.contacts);
  for (std::size_t k = 2; k < coms.size(); ++k)  // best an end that is robust itself
    if (!stable(coms[k])) other = coms[k];
  const auto pair = bisected(coms[1], other, stable);
  if (!pair) return family;
  std::vector<Vector2d> ends;
  add_neighbours((*pair)[0], sampler, ends);
  for (const Vector2d& end : ends) family.lines.push_back({coms[0], end});
  return family;
}

LineFamily through_zero_denominator(Sampler& sampler) {
  LineFamily family;
  int sigma = 1;
  family.sample = painleve_posture(sampler, sigma);
  const Vector2d n = family.sample.contacts[0].normal, t(n.y(), -n.x()), com = family.sample.com;
  const double half = std::ldexp(sampler.integer(1, 8), -3);
  const ExactPosture exact(family.sample);
  for (int k = 0; k < 12 && family.lines.size() < 4; ++k) {
    const Vector2d step(0.125 * sampler.integer(-4, 4), 0.125 * sampler.integer(-4, 4)), from = com - half * step,
                                                                                         to = com + step;
    if (exact.robust(exact.frame(ExactCom(from))) && exact.robust(exact.frame(ExactCom(to))))
      family.lines.push_back({from, to});
  }
  if (!family.lines.empty() && sampler.chance(0.8)) return family;
  if (sampler.chance(0.8)) return {};  // few of these postures are robust near D = 0
  for (const Vector2d& along : {n, t, Vector2d(0.5, 0.25), Vector2d(0, 1)}) {
    family.lines.push_back({com - half * along, com + along});
    family.lines.push_back({com, com + half * along});
  }
  // D as a function of a along t, at fixed b, is L^2 rho^2 + L^4 (a^2 + sigma mu a b): touches zero where (mu b)^2 = 4
  // c^2.
  const double c = family.sample.rho / n.norm(), mu = family.sample.contacts[0].friction;
  const Vector2d touch = family.sample.contacts[0].position - 2 * c / mu * n;
  family.lines.push_back({touch - 2 * t, touch + 2 * t});
  family.lines.push_back({touch - half * t, touch + t});
  return family;
}

LineFamily grid_lines(Sampler& sampler) {
  LineFamily family;
  family.sample = grid_posture(sampler);
  const ExactPosture exact(family.sample);
  std::vector<Vector2d> good;
  for (int k = 0; k < 30 && good.size() < 3; ++k) {
    const Vector2d com = grid_com(sampler);
    if (exact.robust(exact.frame(ExactCom(com)))) good.push_back(com);
  }
  for (std::size_t k = 0; k + 1 < good.size(); ++k) family.lines.push_back({good[k], good[k + 1]});
  if (!good.empty()) family.lines.push_back({good[0], good[0]});
  family.lines.push_back({good.empty() ? grid_com(sampler) : good[0], grid_com(sampler)});
  return family;
}

LineFamily tied(Sampler& sampler) {
  constexpr std::array level{Kind::flat, Kind::stairs, Kind::treads, Kind::any};
  LineFamily family;
  SamplePosture& sample = family.sample;
  sample = sampler.posture(pick(sampler, level), sampler.integer(2, 3));
  if (sampler.chance(0.2)) sample.box.kappa = 0;
  if (sampler.chance(0.2)) sample.box.nu = 0;
  const int last = static_cast<int>(sample.contacts.size()) - 1;
  if (sampler.chance(0.8)) sample.contacts[sampler.integer(0, last)].friction = sample.box.kappa;
  const ExactPosture exact(sample);
  const auto coms = robust_coms(exact, sample, sampler, 3, 1);
  for (std::size_t k = 0; k + 1 < coms.size(); ++k) family.lines.push_back({coms[k], coms[k + 1]});
  if (!coms.empty()) family.lines.push_back({coms[0], sampler.com_near(sample.contacts)});
  return family;
}

}  // namespace

const char* name(PointKind kind) {
  constexpr std::array names{"random", "facet",     "mode boundary", "D changes sign",
                             "D = 0",  "two zeros", "grid",          "nearly"};
  return names[static_cast<std::size_t>(kind)];
}
const char* name(LineKind kind) {
  constexpr std::array names{"random", "robust ends", "slender", "tangential", "grid", "D on the line", "tied"};
  return names[static_cast<std::size_t>(kind)];
}

PointFamily point_family(PointKind kind, Sampler& sampler) {
  switch (kind) {
    case PointKind::random: {
      PointFamily family{sampler.posture(any_kind(sampler)), {}};
      family.coms = {family.sample.com};
      return family;
    }
    case PointKind::facet:
    case PointKind::mode:
    case PointKind::denominator: return at_boundary(kind, sampler);
    case PointKind::painleve:
    case PointKind::both_zero: return at_zero_denominator(kind, sampler);
    case PointKind::grid: return on_grid(sampler);
    case PointKind::nearly: return nearly_coincident(sampler);
  }
  return {};
}

LineFamily line_family(LineKind kind, Sampler& sampler) {
  switch (kind) {
    case LineKind::random: {
      LineFamily family{sampler.posture(any_kind(sampler)), {}};
      family.lines = {{family.sample.com, sampler.com_near(family.sample.contacts)}};
      return family;
    }
    case LineKind::stable_ends:
    case LineKind::slender: return between_robust(kind, sampler);
    case LineKind::tangential: return touching(sampler);
    case LineKind::grid: return grid_lines(sampler);
    case LineKind::painleve: return through_zero_denominator(sampler);
    case LineKind::tied: return tied(sampler);
  }
  return {};
}

}  // namespace surefoot::testing
