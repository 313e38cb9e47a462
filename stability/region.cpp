#include "stability/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stability/region_cells.hpp"
#include "stability/region_sweep.hpp"

namespace surefoot::stability {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// A convex polygon whose edge k runs from corner k to corner k + 1.
struct LabelledPolygon {
  RegionPolygon corner;
  std::vector<std::string> label;
};

LabelledPolygon window_polygon(const AlignedBox2d& window) {
  const Vector2d a = window.min(), b = window.max();
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
                          a.offset * b.normal.x() - b.offset * a.normal.x()) / det);
    }
  const Vector2d room = 0.1 * box.diagonal();
  return {box.min() - room, box.max() + room};
}

/// A direction for the lines of the sweep that is far from those of straight boundaries: normals (all contacts break),
/// tangents, and the sides of R_SS(W); nearly level, since regions are mostly tall.
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
    const double angle = (k + 0.37) * std::numbers::pi / 3 / tried - std::numbers::pi / 6;  // within 30 degrees of level
    const Vector2d direction(std::cos(angle), std::sin(angle));
    double closest = 1;
    for (const Vector2d& other : avoided)
      closest = std::min(closest, std::abs(direction.x() * other.y() - direction.y() * other.x()));
    if (closest > widest) widest = closest, best = direction;
  }
  return best;
}

Vector2d middle_of(std::span<const Contact> contacts) {
  Vector2d sum = Vector2d::Zero();
  for (const Contact& contact : contacts) sum += contact.position - contacts[0].position;
  return contacts[0].position + sum / static_cast<double>(contacts.size());
}

double core_of(std::span<const Contact> contacts, double rho) {
  double extent = 0;
  for (const Contact& contact : contacts) extent = std::max(extent, (contact.position - contacts[0].position).norm());
  return extent + rho;
}

/// Non-static modes that are feasible at x by the rows in doubles: for boxes that are not about gravity.
std::uint32_t modes_by_rows(const Posture& posture, const WrenchBox& box, const Vector2d& x) {
  const RegionModes here(posture, box, x, Vector2d::UnitX());
  std::uint32_t found = 0;
  for (std::size_t k = 0; k < here.modes().size(); ++k) {
    bool feasible = false;
    here.excluded(here.modes()[k], 0, 0, 0, 0, feasible);
    if (feasible) found |= 1u << k;
  }
  return found;
}

/// Turns the result of the sweep into a Region.
class Finish {
 public:
  Finish(Region& region, const RegionModes& modes, const WrenchBox& box) : region_(region), modes_(modes), box_(box) {}

  std::vector<ContactMode> named(std::uint32_t present) const {
    std::vector<ContactMode> list;
    for (std::size_t k = 0; k < modes_.modes().size(); ++k) {
      const ContactMode& mode = modes_.modes()[k].mode;
      if (((present >> k) & 1) && std::find(list.begin(), list.end(), mode) == list.end()) list.push_back(mode);
    }
    return list;
  }

  RegionPolygon placed(const RegionPolygon& points) const {
    RegionPolygon list;
    list.reserve(points.size());
    for (const Vector2d& p : points) list.push_back(modes_.position(p.x(), p.y()));
    return list;
  }

  void cells(const SweepCells& found) {
    for (const SweepCell& cell : found.cells) {
      RegionCell& made = region_.cells.emplace_back();
      made.modes = named(cell.modes);
      made.area = cell.area;
      made.inside = modes_.position(cell.inside.x(), cell.inside.y());
      for (const RegionPolygon& ring : cell.rings) made.rings.push_back(placed(ring));
      if (made.modes.empty()) region_.robust_area += cell.area;
      for (const ContactMode& mode : made.modes) {
        const auto known = std::find_if(region_.modes.begin(), region_.modes.end(),
                                        [&](const ModeShare& share) { return share.mode == mode; });
        (known == region_.modes.end() ? region_.modes.emplace_back(ModeShare{mode, 0}) : *known).area += cell.area;
      }
    }
    std::stable_sort(region_.cells.begin(), region_.cells.end(), [](const RegionCell& x, const RegionCell& y) {
      return x.modes.empty() != y.modes.empty() ? x.modes.empty() : x.area > y.area;
    });
    std::stable_sort(region_.modes.begin(), region_.modes.end(),
                     [](const ModeShare& x, const ModeShare& y) { return x.area > y.area; });
    region_.area_error += found.dropped;
  }

  void boundaries(const SweepCells& found, const LabelledPolygon& polygon) {
    for (std::size_t k = 0; k < polygon.corner.size(); ++k)
      region_.boundaries.push_back({polygon.label[k],
                                    {CurveId::edge, -1, static_cast<signed char>(k), -1, -1, 0},
                                    {polygon.corner[k], polygon.corner[(k + 1) % polygon.corner.size()]}});
    for (const SweepCurve& curve : found.curves)
      region_.boundaries.push_back(
          {curve_in_words(modes_.modes()[curve.curve.mode], curve.curve, box_), curve.curve, placed(curve.points)});
  }

 private:
  Region& region_;
  const RegionModes& modes_;
  const WrenchBox& box_;
};

/// Cells whose modes the oracle does not confirm count as error.
void confirm(Region& region, std::span<const Contact> contacts, double rho, const Posture& posture, const WrenchBox& box,
             const Finish& finish) {
  const auto contradicts = [&](const RegionCell& cell) {
    std::vector<ContactMode> expected;
    if (box.centred()) {
      for (const ContactMode& mode : RobustOracle(contacts, rho, {box.kappa, box.nu}).feasible_modes(cell.inside))
        if (std::find(expected.begin(), expected.end(), mode) == expected.end()) expected.push_back(mode);
    } else {
      expected = finish.named(modes_by_rows(posture, box, cell.inside));
    }
    return !std::is_permutation(expected.begin(), expected.end(), cell.modes.begin(), cell.modes.end());
  };
  double disputed = 0;
  for (const RegionCell& cell : region.cells)
    if (contradicts(cell)) disputed += cell.area;
  if (disputed == 0) return;
  region.area_error += disputed;
  region.note = "a cell's modes are in doubt: the oracle disagrees at a point inside; its area counts as error";
}

/// Clips R_SS(W) where it has to be, or is asked to be, clipped.
LabelledPolygon equilibrium_polygon(const std::vector<LabelledHalfPlane>& planes, std::span<const Contact> contacts, double rho,
                                    const RegionOptions& options, Region& region) {
  const AlignedBox2d usual = default_window(contacts, rho);
  AlignedBox2d start = usual;
  if (options.window)
    region.window = start = *options.window;
  else if (!bounded(planes))
    region.window = usual;
  else
    start = around_all(planes, usual);
  LabelledPolygon polygon = window_polygon(start);
  for (const LabelledHalfPlane& half : planes) polygon = clipped(polygon, half);
  merge_corners(polygon);
  return polygon;
}

}  // namespace

std::vector<LabelledHalfPlane> equilibrium_half_planes(const Posture& posture, const WrenchBox& box) {
  if (posture.flat_cone()) return {{{Vector2d::Zero(), -1}, "no equilibrium"}};
  std::vector<LabelledHalfPlane> planes;
  const Vector2d& origin = posture.position(0);
  const auto ray = [](int k) { return std::to_string(k / 2 + 1) + (k % 2 == edge_u ? "u" : "w"); };
  for (const Facet& facet : posture.facets()) {
    const Row<double>& z = facet.z;
    const std::string limit = facet.a / 2 == facet.b / 2 ? "tips over contact " + std::to_string(facet.a / 2 + 1)
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

Region region(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
              const RegionOptions& options) {
  Region result;
  const Posture posture(contacts, radius_of_gyration);
  const std::vector<LabelledHalfPlane> planes = equilibrium_half_planes(posture, box);
  const LabelledPolygon polygon = equilibrium_polygon(planes, contacts, radius_of_gyration, options, result);
  const double area = polygon.corner.size() < 3 ? 0 : area_of(polygon.corner);
  if (!(area > 0)) {
    result.note = "no COM can be balanced under every wrench of W";
    return result;
  }
  if (!std::isfinite(area)) {
    result.note = "the numbers of this posture overflow";
    return result;
  }
  result.equilibrium = polygon.corner;
  result.equilibrium_area = area;

  const Vector2d origin = middle_of(contacts);
  RegionModes modes(posture, box, origin, line_direction(contacts, planes));
  RegionPolygon local;
  for (const Vector2d& corner : polygon.corner) local.push_back(modes.local(corner));
  std::vector<Poly2> edges;
  for (std::size_t k = 0; k < local.size(); ++k) {
    const Vector2d a = local[k], d = local[(k + 1) % local.size()] - a;
    edges.push_back(Poly2(d.y() * a.x() - d.x() * a.y(), -d.y(), d.x()));
  }
  modes.set_edges(std::move(edges));

  Sweep sweep(modes, std::move(local), options.area_tolerance, core_of(contacts, radius_of_gyration));
  sweep.run();
  result.curve_tolerance = options.curve_tolerance * bounds_of(polygon.corner).diagonal().norm();
  const SweepCells found = collect_cells(sweep, options.curves ? result.curve_tolerance : 0);
  Finish finish(result, modes, box);
  finish.cells(found);
  if (options.curves) finish.boundaries(found, polygon);
  constexpr double rounding = 1e-14;  // of sums of products of coordinates, relative to the area
  result.area_error += sweep.error() + rounding * area;
  result.lines = sweep.lines();
  if (sweep.uncertain()) result.note = "some lines could not be followed to their end; areas may be off by more than stated";
  confirm(result, contacts, radius_of_gyration, posture, box, finish);
  return result;
}

}  // namespace surefoot::stability
