// Convex polygons of COMs: those within reach of planted feet, and points drawn from them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

using Polygon = std::vector<Eigen::Vector2d>;  ///< convex, counter-clockwise [m]

/// An octagon that contains every COM within `reach_max` of all the given feet (at least one); empty if there is none.
/// It circumscribes: the corners, and the discs of reach_min, are for the caller to reject.
Polygon reach_window(const gaits::Feet& feet, double reach_max);

/// The part of a polygon where direction . com <= bound; empty if there is none. May be a line or a point.
Polygon clip_to_half_plane(const Polygon& polygon, const Eigen::Vector2d& direction, double bound);

/// The part of a polygon in which the goal is reached; empty if there is none. May be a line or a point.
Polygon clip_to_goal(const Polygon& polygon, const gaits::Goal& goal);

/// The point of a polygon that (u, v) in [0, 1]^2 maps to: uniform by area over its fan of triangles, uniform by length
/// where the polygon is a line. The polygon is not empty.
Eigen::Vector2d point_in(const Polygon& polygon, double u, double v);

}  // namespace surefoot::planner
