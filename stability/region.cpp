#include "stability/region.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "stability/region_cells.hpp"
#include "stability/region_setup.hpp"
#include "stability/region_subdivision.hpp"
#include "stability/region_sweep.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

constexpr double rounding = 1e-14;  // of sums of products of coordinates, relative to the area

/// Areas by a subdivision: what its rectangles prove.
struct Proof {
  double robust = 0, robust_error = 0;   ///< [m^2]
  double error = 0;                      ///< [m^2] of any sum of areas
  std::map<std::uint32_t, double> area;  ///< [m^2] by the set of modes; only if all modes were looked at
  int rectangles = 0;
};

Proof prove(const RegionSetup& setup, double tolerance, bool robust_only, int most_rectangles) {
  Subdivision subdivision(*setup.modes, setup.local, robust_only);
  subdivision.run(tolerance * setup.area, most_rectangles);
  Proof proof{subdivision.robust(),
              subdivision.robust_error() + rounding * setup.area,
              subdivision.error() + rounding * setup.area,
              {},
              subdivision.rectangles()};
  for (const Piece& piece : subdivision.pieces()) proof.area[piece.modes] += piece.area;
  return proof;
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
      if (cell.modes == 0) robust_ += cell.area;
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
  }

  double robust() const { return robust_; }  ///< [m^2] of the cells without modes

  void boundaries(const SweepCells& found, const LabelledPolygon& polygon) {
    for (std::size_t k = 0; k < polygon.corner.size(); ++k)
      region_.boundaries.push_back({polygon.label[k],
                                    {CurveId::edge, -1, static_cast<std::int8_t>(k), -1, -1, 0},
                                    {polygon.corner[k], polygon.corner[(k + 1) % polygon.corner.size()]}});
    for (const SweepCurve& curve : found.curves)
      region_.boundaries.push_back(
          {curve_in_words(modes_.modes()[curve.curve.mode], curve.curve, box_), curve.curve, placed(curve.points)});
  }

 private:
  Region& region_;
  const RegionModes& modes_;
  const WrenchBox& box_;
  double robust_ = 0;
};

/// The modes at a point: by the oracle, or for boxes that are not about gravity by rows in doubles with their error
/// bound; none where that does not decide, or the oracle finds no equilibrium (a sliver as thin as rounding).
class ModesAt {
 public:
  ModesAt(std::span<const Contact> contacts, double rho, const RegionSetup& setup, const WrenchBox& box,
          const Finish& finish)
      : setup_(setup), box_(box), finish_(finish) {
    if (box.centred()) oracle_.emplace(contacts, rho, DisturbanceBox{box.kappa, box.nu});
  }

  std::optional<std::vector<ContactMode>> operator()(const Vector2d& x) const {
    std::vector<ContactMode> list;
    if (oracle_) {
      if (!oracle_->equilibrium(x)) return std::nullopt;
      for (const ContactMode& mode : oracle_->feasible_modes(x))
        if (std::find(list.begin(), list.end(), mode) == list.end()) list.push_back(mode);
      return list;
    }
    const RegionModes here(setup_.posture, box_, x, Vector2d::UnitX());
    std::uint32_t found = 0;
    for (int k = 0; k < static_cast<int>(here.modes().size()); ++k) {
      const ModeThere there = mode_there(here, k, {});
      if (there.kind == ModePart::everywhere) found |= 1u << k;
      if (there.kind != ModePart::everywhere && there.kind != ModePart::nowhere) return std::nullopt;
    }
    return finish_.named(found);
  }

 private:
  const RegionSetup& setup_;
  const WrenchBox& box_;
  const Finish& finish_;
  std::optional<RobustOracle> oracle_;
};

/// Cells whose modes are not confirmed at a point inside: counted, and said. Small ones are remains of what the sweep
/// passed over; they are dropped.
double disputed_area(Region& region, const ModesAt& modes_at, double area) {
  constexpr double small = 1e-5;  // of R_SS(W)
  double disputed = 0;
  for (RegionCell& cell : region.cells) {
    const auto expected = modes_at(cell.inside);
    cell.confirmed =
        expected && std::is_permutation(expected->begin(), expected->end(), cell.modes.begin(), cell.modes.end());
    if (!cell.confirmed) disputed += cell.area;
  }
  std::erase_if(region.cells, [&](const RegionCell& cell) { return !cell.confirmed && cell.area < small * area; });
  if (std::any_of(region.cells.begin(), region.cells.end(), [](const RegionCell& cell) { return !cell.confirmed; }))
    region.note = "a cell's modes are not confirmed at a point inside; its area counts as error";
  return disputed;
}

/// What the cells' areas may be off by in sum, set of modes by set of modes.
double difference(const Proof& proof, const SweepCells& found) {
  std::map<std::uint32_t, double> off = proof.area;
  for (const SweepCell& cell : found.cells) off[cell.modes] -= cell.area;
  double sum = 0;
  for (const auto& [modes, area] : off) sum += std::abs(area);
  return sum;
}

/// The area of R(W) from the cells, if the proof admits it, else that of the proof.
void settle(Region& region, double from_cells, const Proof& proof) {
  region.robust_area = std::abs(from_cells - proof.robust) <= proof.robust_error ? from_cells : proof.robust;
  region.area_error =
      std::min(proof.robust_error + std::abs(region.robust_area - proof.robust), region.equilibrium_area);
  region.rectangles += proof.rectangles;
}

}  // namespace

RegionAreas region_areas(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
                         const RegionOptions& options) {
  RegionAreas areas;
  const RegionSetup setup(contacts, radius_of_gyration, box, options);
  areas.note = setup.problem;
  areas.window = setup.window;
  areas.equilibrium = setup.area;
  if (!(setup.area > 0)) return areas;
  const Proof proof = prove(setup, options.area_tolerance, true, most_rectangles);
  areas.robust = std::min(proof.robust, setup.area);
  areas.error = std::min(proof.robust_error, setup.area);
  areas.rectangles = proof.rectangles;
  return areas;
}

Region region(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
              const RegionOptions& options) {
  Region result;
  const RegionSetup setup(contacts, radius_of_gyration, box, options);
  result.note = setup.problem;
  result.window = setup.window;
  if (!(setup.area > 0)) return result;
  result.equilibrium = setup.polygon.corner;
  result.equilibrium_area = setup.area;
  Sweep sweep(*setup.modes, setup.local, options.area_tolerance, setup.core);
  sweep.run();
  result.curve_tolerance = options.curve_tolerance * bounds_of(setup.polygon.corner).diagonal().norm();
  const SweepCells found = collect_cells(sweep, options.curves ? result.curve_tolerance : 0);
  Finish finish(result, *setup.modes, box);
  finish.cells(found);
  if (options.curves) finish.boundaries(found, setup.polygon);
  result.lines = sweep.lines();
  const double disputed = disputed_area(result, {contacts, radius_of_gyration, setup, box, finish}, setup.area);

  const Proof all = prove(setup, options.area_tolerance, false, most_rectangles_for_cells);
  result.cells_error =
      std::min(difference(all, found) + all.error + disputed, 2 * setup.area);  // all in the wrong cells
  settle(result, finish.robust(), all);
  if (result.area_error > options.area_tolerance * setup.area)
    settle(result, finish.robust(), prove(setup, options.area_tolerance, true, most_rectangles));
  return result;
}

}  // namespace surefoot::stability
