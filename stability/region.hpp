// The stability regions of a stance [OR-P, Figs. 2-5]: R_SS(W) as an arrangement of cells, each with the set of
// non-static modes that are feasible there for some wrench of W. The cells without modes make up the robust stability
// region R(W); with a box of one wrench they are the strong stability region R(w).
//
// Method: a sweep of straight lines on which the problem is solved exactly in one dimension (region_line.hpp). Between
// the places where the order of curves along the line changes the ends of all intervals are smooth functions, which
// Gauss-Kronrod rules integrate to many digits with few lines; those places are found by Newton's method on the pairs
// of curves that the lines on both sides name, else by bisection. Why not something else: boundaries are quadratic up
// to sextic and touch or coincide on flat and symmetric ground, where arrangement packages need exact algebraic numbers
// and fail or take seconds; the paper's list of silhouette curves is incomplete [theory 8.7], while marching along a
// line needs no list; a quadtree is as robust but its error falls only as one over its cost (bench/bench_region.cpp
// shows both). Lines are neither level nor upright but in a direction away from all normals, tangents and the vertical,
// so that straight boundaries are not parallel to them.
//
// Guarantee and limits. Modes are excluded from a strip of the sweep only by certificates that hold on rectangles
// covering it. Each cell's set of modes is confirmed by RobustOracle at a point inside (for a box about gravity;
// otherwise by the rows in doubles); a cell where that fails counts as error and is reported in `note`. `area_error`
// adds up the estimated errors of the rules (difference of two orders) and bounds for what the sweep passed over; a
// cell that lies between two lines of the sweep in a strip where its mode is not excluded (1/32 of the region's extent)
// can be missed.
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
  double area_tolerance = 1e-6;  ///< of each area, relative to the area of R_SS(W)
  std::optional<Eigen::AlignedBox2d> window;  ///< [m] clip to this; otherwise only what is unbounded is clipped
  bool curves = true;                 ///< rings of cells and boundary polylines; areas alone are cheaper
  double curve_tolerance = 1e-4;      ///< of polylines, relative to the diagonal of R_SS(W)
};

struct RegionCell {
  std::vector<ContactMode> modes;       ///< feasible for some wrench of W; empty: part of R(W)
  double area = 0;                      ///< [m^2]
  Eigen::Vector2d inside = Eigen::Vector2d::Zero();  ///< a point well inside
  std::vector<RegionPolygon> rings;     ///< the outer one first, then holes; empty without `curves`
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
  RegionPolygon equilibrium;  ///< R_SS(W), clipped; counter-clockwise
  double equilibrium_area = 0, robust_area = 0;  ///< [m^2]
  double area_error = 0;                         ///< [m^2] of any area given here
  std::vector<RegionCell> cells;                 ///< connected; greatest first, R(W) before the rest
  std::vector<ModeShare> modes;                  ///< those that occur, greatest first
  std::vector<RegionBoundary> boundaries;
  std::optional<Eigen::AlignedBox2d> window;     ///< where the region had to be, or was asked to be, clipped
  double curve_tolerance = 0;                    ///< [m]
  std::string note;                              ///< what a reader must know; usually empty
  int lines = 0;                                 ///< lines solved, a measure of the work

  bool empty() const { return equilibrium.empty(); }
};

/// Contacts and radius of gyration as for RobustOracle.
Region region(std::span<const Contact> contacts, double radius_of_gyration, const WrenchBox& box,
              const RegionOptions& options = {});

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
