// The stability regions of a stance [OR-P, Figs. 2-5]: R_SS(W) as an arrangement of cells, each with the set of
// non-static modes that are feasible there for some wrench of W. The cells without modes make up the robust stability
// region R(W); with a box of one wrench they are the strong stability region R(w).
//
// Two methods that share the rows of the modes and the certificates that exclude one from a rectangle.
//   Subdivision (region_subdivision.hpp), for proof: rectangles are halved until certificates decide every mode in
//     them, or show by the signs of which curves it is decided; these are then enclosed by polynomials. What is
//     undecided counts as error. It needs no list of curves, touching and coinciding ones included, and gives the areas
//     of R_SS(W) and R(W) with a bound (region_areas).
//   Sweep (region_sweep.hpp), for the arrangement: on straight lines the problem is solved exactly, between the places
//     where the order of curves changes the ends of all intervals are smooth and integrated by Gauss-Kronrod rules. It
//     gives cells with their rings, and areas to about ten digits, but can miss what lies between two of its lines.
// Why not something else: boundaries are quadratic up to sextic and touch or coincide on flat and symmetric ground,
// where arrangement packages need exact algebraic numbers and fail or take seconds; the paper's list of silhouette
// curves is incomplete [theory 8.7]; a quadtree without curves is as sound but its error falls only as one over its
// cost (bench/error_time/region.cpp shows all of them).
//
// Guarantee. `area_error` bounds the error of equilibrium_area and robust_area, `cells_error` the sum over all sets of
// modes of the error of the area in which just these are feasible: bounds in doubles with their rounding error, not
// estimates. Limits: rows that are opposite to within 1e-12 count as opposite. Each cell's modes are confirmed at a
// point inside by RobustOracle, exactly; for a box that is not about gravity there is no exact fallback, rows in
// doubles with their error bound confirm or leave the cell unconfirmed. Unconfirmed cells count in cells_error and are
// noted.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stability/region_rows.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::stability {

using RegionPolygon = std::vector<Eigen::Vector2d>;

struct RegionOptions {
  double area_tolerance = 1e-6;               ///< error of areas that is aimed at, relative to the area of R_SS(W)
  std::optional<Eigen::AlignedBox2d> window;  ///< [m] clip to this; otherwise only what is unbounded is clipped
  bool curves = true;                         ///< rings of cells and boundary polylines; areas alone are cheaper
  double curve_tolerance = 1e-4;              ///< of polylines, relative to the diagonal of R_SS(W)
};

struct RegionCell {
  std::vector<ContactMode> modes;                    ///< feasible for some wrench of W; empty: part of R(W)
  double area = 0;                                   ///< [m^2]
  bool confirmed = true;                             ///< its modes are those at `inside`
  Eigen::Vector2d inside = Eigen::Vector2d::Zero();  ///< a point well inside
  std::vector<RegionPolygon> rings;                  ///< the outer one first, then holes; empty without `curves`
};

struct RegionBoundary {
  std::string label;
  CurveId curve;
  RegionPolygon polyline;
};

struct ModeShare {
  ContactMode mode;
  double area = 0;  ///< [m^2] of R_SS(W) in which it is feasible
};

struct Region {
  RegionPolygon equilibrium;                     ///< R_SS(W), clipped; counter-clockwise
  double equilibrium_area = 0, robust_area = 0;  ///< [m^2]
  double area_error = 0;                         ///< [m^2] bounds the error of both
  double cells_error = 0;                        ///< [m^2] bounds that of the cells, summed over sets of modes
  std::vector<RegionCell> cells;                 ///< connected; greatest first, R(W) before the rest
  std::vector<ModeShare> modes;                  ///< those that occur, greatest first
  std::vector<RegionBoundary> boundaries;
  std::optional<Eigen::AlignedBox2d> window;  ///< where the region had to be, or was asked to be, clipped
  double curve_tolerance = 0;                 ///< [m]
  std::string note;                           ///< what a reader must know; usually empty
  int lines = 0, rectangles = 0;              ///< of the sweep and the subdivision: measures of the work

  bool empty() const { return equilibrium.empty(); }
};

/// Contacts and radius of gyration as for RobustOracle. Throws std::invalid_argument as its constructor, and for
/// numbers of box or options that are not finite, tolerances <= 0, an empty window.
Region region(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
              const RegionOptions& options = {});

/// The areas alone, at a fraction of the cost: typically 100 to 500 rectangles of 1 to 3 us.
struct RegionAreas {
  double equilibrium = 0, robust = 0;  ///< [m^2] of R_SS(W), clipped, and of R(W)
  double error = 0;                    ///< [m^2] bounds the error of both
  std::optional<Eigen::AlignedBox2d> window;
  std::string note;
  int rectangles = 0;
};
RegionAreas region_areas(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
                         const RegionOptions& options = {});

/// The work is bounded: what is undecided after this many rectangles counts as error. Typical: 100 to 500.
constexpr int most_rectangles = 3000, most_rectangles_for_cells = 2000;

/// R_SS(W) as half-planes with what bounds them in words; for a box about gravity those of
/// RobustOracle::equilibrium_half_planes.
struct LabelledHalfPlane {
  HalfPlane plane;
  std::string label;
};
std::vector<LabelledHalfPlane> equilibrium_half_planes(const Posture& posture, const WrenchBox& box);

/// The window used for unbounded regions: the contacts' bounding box grown on all sides by `window_growth` times
/// the greater of its extent and the radius of gyration.
constexpr double window_growth = 5;
Eigen::AlignedBox2d default_window(std::span<const Contact> contacts, double radius_of_gyration);

}  // namespace surefoot::stability
