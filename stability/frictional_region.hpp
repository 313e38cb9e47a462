// Where the COM of a stance on two contacts may be for frictional stability [OR-H, section V.C, Fig. 3]: within R_EQ,
// the vertical strip of COMs that gravity alone can be balanced from,
//   kinematic-strong equilibrium  enlarged by a greater radius of gyration
//   clattering convergence (10)   made smaller by it
//   both, on upward-facing ground: frictionally stable (Theorem 3)
//
// Method. On a vertical line of COMs every row of a mode is a quadratic in the height and (10) has a quartic as its
// boundary; their roots cut the line into intervals on which verdicts do not change, and the exact verdicts of
// frictional.hpp decide each of them at one point. Lengths are integrated across the strip by Gauss-Kronrod rules, the
// interval that contributes most to the error halved first. Corners and vertical tangents of the boundary fall between
// ever narrower intervals, so that the error falls geometrically with the work.
//
// Guarantee. None of the error: `error` is the usual estimate (the difference of both rules), far above the true error
// where boundaries are smooth. A part of a region narrower than the first intervals (1/32 of the strip) may be missed.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stability/contact.hpp"
#include "stability/region.hpp"

namespace surefoot::stability {

struct FrictionalRegionOptions {
  double area_tolerance = 1e-6;               ///< aimed at, relative to the area of R_EQ in the window
  std::optional<Eigen::AlignedBox2d> window;  ///< [m] otherwise default_window(): the strip has no end
  bool polygons = true;                       ///< areas alone are cheaper
};

struct FrictionalPart {
  double area = 0, error = 0;  ///< [m^2]
  /// Without holes; the first half of the vertices is the lower side from left to right, the second the upper side
  /// back. Where a part divides or unites, polygons meet along a vertical line.
  std::vector<RegionPolygon> polygons;
};

struct FrictionalRegion {
  double restitution = 0;
  Eigen::AlignedBox2d window;  ///< [m] all is clipped to this
  Eigen::AlignedBox2d strip;   ///< R_EQ in the window; empty if no COM there is balanced
  bool upward = false;         ///< the ground faces upward under both feet; otherwise `stable` is empty
  FrictionalPart kinematic_strong, clattering, stable;
  int lines = 0;  ///< on which verdicts were decided: a measure of the work

  double equilibrium_area() const { return strip.isEmpty() ? 0 : strip.volume(); }
};

/// Two contacts, radius of gyration [m] > 0, 0 < restitution < 1; what is not throws std::invalid_argument, as for
/// region().
FrictionalRegion frictional_region(std::span<const Contact> contacts, double radius_of_gyration, double restitution,
                                   const FrictionalRegionOptions& options = {});

}  // namespace surefoot::stability
