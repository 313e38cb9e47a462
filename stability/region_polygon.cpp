#include "stability/region_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace surefoot::stability {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

double area_of(const RegionPolygon& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d p = polygon[k] - polygon[0], q = polygon[(k + 1) % polygon.size()] - polygon[0];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

AlignedBox2d bounds_of(const RegionPolygon& polygon) {
  AlignedBox2d box;
  for (const Vector2d& corner : polygon) box.extend(corner);
  return box;
}

namespace {

LabelledPolygon window_polygon(const AlignedBox2d& window) {
  const Vector2d &a = window.min(), &b = window.max();
  return {{a, {b.x(), a.y()}, b, {a.x(), b.y()}}, {4, "window"}};
}

/// The part where the half-plane holds; the new edge gets its label.
LabelledPolygon clipped(const LabelledPolygon& polygon, const LabelledHalfPlane& half) {
  LabelledPolygon kept;
  const std::size_t n = polygon.corner.size();
  const auto value = [&half](const Vector2d& x) { return half.plane.normal.dot(x) + half.plane.offset; };
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d &a = polygon.corner[k], &b = polygon.corner[(k + 1) % n];
    const double va = value(a), vb = value(b);
    if (va >= 0) {
      kept.corner.push_back(a);
      kept.label.push_back(polygon.label[k]);
    }
    if ((va >= 0) == (vb >= 0)) continue;
    kept.corner.push_back(a + (b - a) * (va / (va - vb)));
    kept.label.push_back(va >= 0 ? half.label : polygon.label[k]);
  }
  return kept;
}

/// Corners that coincide but for rounding are one.
void merge_corners(LabelledPolygon& polygon) {
  constexpr double same = 1e-13;  // of the diagonal: rounding of an intersection
  const double near = same * bounds_of(polygon.corner).diagonal().norm();
  LabelledPolygon kept;
  const std::size_t n = polygon.corner.size();
  for (std::size_t k = 0; k < n; ++k) {
    if ((polygon.corner[(k + 1) % n] - polygon.corner[k]).norm() <= near) continue;
    kept.corner.push_back(polygon.corner[k]);
    kept.label.push_back(polygon.label[k]);
  }
  polygon = std::move(kept);
}

/// No direction along which all half-planes go on for ever.
bool bounded(const std::vector<LabelledHalfPlane>& planes) {
  constexpr double parallel = 1e-12;  // sine of an angle taken for zero
  for (const LabelledHalfPlane& one : planes)
    for (const double sign : {-1.0, 1.0}) {
      const Vector2d along = sign * Vector2d(-one.plane.normal.y(), one.plane.normal.x());
      if (along.isZero(0)) continue;
      const auto allows = [&](const LabelledHalfPlane& other) {
        return other.plane.normal.dot(along) >= -parallel * other.plane.normal.norm() * along.norm();
      };
      if (std::all_of(planes.begin(), planes.end(), allows)) return false;
    }
  return !planes.empty();
}

/// Large enough to hold the intersection of the half-planes, which is bounded: its corners are among their meeting
/// points.
AlignedBox2d around_all(const std::vector<LabelledHalfPlane>& planes, const AlignedBox2d& least) {
  AlignedBox2d box = least;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const HalfPlane &a = planes[i].plane, &b = planes[j].plane;
      const double det = a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x();
      if (std::abs(det) <= 1e-14 * a.normal.norm() * b.normal.norm()) continue;
      box.extend(Vector2d(b.offset * a.normal.y() - a.offset * b.normal.y(),
                          a.offset * b.normal.x() - b.offset * a.normal.x()) /
                 det);
    }
  const Vector2d room = 0.1 * box.diagonal();
  return {box.min() - room, box.max() + room};
}

}  // namespace

Vector2d line_direction(std::span<const Contact> contacts, const std::vector<LabelledHalfPlane>& planes) {
  std::vector<Vector2d> avoided{{0, 1}, {1, 0}};
  for (const Contact& contact : contacts) {
    const Vector2d n = contact.normal.stableNormalized();
    avoided.push_back(n);
    avoided.push_back({n.y(), -n.x()});
  }
  for (const LabelledHalfPlane& half : planes) {
    const Vector2d n = half.plane.normal.stableNormalized();
    if (!n.isZero(0)) avoided.push_back({-n.y(), n.x()});
  }
  Vector2d best = Vector2d::UnitX();
  double widest = -1;
  constexpr int tried = 24;
  for (int k = 0; k < tried; ++k) {
    const double angle =
        (k + 0.37) * std::numbers::pi / 3 / tried - std::numbers::pi / 6;  // within 30 degrees of level
    const Vector2d direction(std::cos(angle), std::sin(angle));
    double closest = 1;
    for (const Vector2d& other : avoided)
      closest = std::min(closest, std::abs(direction.x() * other.y() - direction.y() * other.x()));
    if (closest > widest) widest = closest, best = direction;
  }
  return best;
}

LabelledPolygon equilibrium_polygon(const std::vector<LabelledHalfPlane>& planes, std::span<const Contact> contacts,
                                    double rho, const RegionOptions& options, std::optional<AlignedBox2d>& used) {
  const AlignedBox2d usual = default_window(contacts, rho);
  AlignedBox2d start = usual;
  if (options.window) used = start = *options.window;
  else if (!bounded(planes)) used = usual;
  else start = around_all(planes, usual);
  LabelledPolygon polygon = window_polygon(start);
  for (const LabelledHalfPlane& half : planes) polygon = clipped(polygon, half);
  merge_corners(polygon);
  return polygon;
}

std::vector<LabelledHalfPlane> equilibrium_half_planes(const Posture& posture, const WrenchBox& box) {
  if (posture.flat_cone()) return {{{Vector2d::Zero(), -1}, "no equilibrium"}};
  std::vector<LabelledHalfPlane> planes;
  const Vector2d& origin = posture.position(0);
  const auto ray = [](int k) { return std::to_string(k / 2 + 1) + (k % 2 == edge_u ? "u" : "w"); };
  for (const Facet& facet : posture.facets()) {
    const Row<double>& z = facet.z;
    const std::string limit = facet.a / 2 == facet.b / 2
                                  ? "tips over contact " + std::to_string(facet.a / 2 + 1)
                                  : "force on cone edges " + ray(facet.a) + " and " + ray(facet.b);
    for (const double end : {-1.0, 1.0}) {
      // z . g = z.p p + z.one + z.q (x - p y + q), least over q
      const double p = box.centre.p + end * box.kappa;
      const Vector2d normal(z.q, -z.q * p);
      const double offset = z.p * p + z.one + z.q * box.centre.q - std::abs(z.q) * box.nu - normal.dot(origin);
      std::string label = "equilibrium: " + limit;
      const std::string base = box.centre.p != 0 ? "p0 " : "", base_q = box.centre.q != 0 ? "q0 " : "";
      if (box.kappa > 0) label += std::string(", p = ") + base + (end < 0 ? "-kappa" : "+kappa");
      if (box.nu > 0) label += std::string(", q = ") + base_q + (z.q > 0 ? "-nu" : "+nu");
      planes.push_back({{normal, offset}, label});
      if (box.kappa == 0) break;
    }
  }
  return planes;
}

AlignedBox2d default_window(std::span<const Contact> contacts, double radius_of_gyration) {
  AlignedBox2d window;
  for (const Contact& contact : contacts) window.extend(contact.position);
  const double grown = window_growth * std::max(window.diagonal().maxCoeff(), radius_of_gyration);
  return {window.min() - Vector2d::Constant(grown), window.max() + Vector2d::Constant(grown)};
}

}  // namespace surefoot::stability
