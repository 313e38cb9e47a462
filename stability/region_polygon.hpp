// R_SS(W) as a convex polygon with named sides, clipped to a window where it is unbounded or the window was asked for.
#pragma once

#include "stability/region.hpp"

namespace surefoot::stability {

/// A convex polygon whose edge k runs from corner k to corner k + 1.
struct LabelledPolygon {
  RegionPolygon corner;
  std::vector<std::string> label;
};

double area_of(const RegionPolygon& polygon);
Eigen::AlignedBox2d bounds_of(const RegionPolygon& polygon);

/// `used`: the window, if the polygon had to be, or was asked to be, clipped.
LabelledPolygon equilibrium_polygon(const std::vector<LabelledHalfPlane>& planes, std::span<const Contact> contacts,
                                    double rho, const RegionOptions& options, std::optional<Eigen::AlignedBox2d>& used);

/// A direction for the lines of the sweep that is far from those of straight boundaries: normals (all contacts break),
/// tangents, and the sides of R_SS(W); nearly level, since regions are mostly tall.
Eigen::Vector2d line_direction(std::span<const Contact> contacts, const std::vector<LabelledHalfPlane>& planes);

}  // namespace surefoot::stability
