// Where the picture of a plan says "start" and "goal".
#pragma once

#include "gaits/plan_heading.hpp"
#include "gaits/plan_page.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// The middle of the line [px] on which the name of the start stands, whose COM is drawn at `com` [px]: above it and
/// its number, or else beneath or beside it, over no other waypoint if that can be.
Eigen::Vector2d start_name_place(const Plan& plan, const PageRow& row, const Eigen::Vector2d& com);

/// The middle of the line [px] on which the name of the goal (the part [m] that a row shows) stands: in the goal from
/// its top down, else above, beneath or beside it; not in solid ground and, if that can be, over no waypoint, no
/// surface and not over the name of the start (its line in this row, if it has it).
Eigen::Vector2d goal_name_place(const Scene& scene, const Plan& plan, const PageRow& row,
                                const Eigen::AlignedBox2d& goal, const std::optional<Eigen::Vector2d>& start);

}  // namespace surefoot::gaits
