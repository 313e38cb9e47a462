// Where the picture of a plan writes the numbers of its waypoints, "start" and "goal".
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "gaits/plan_page.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// What a row names [px]: a place is the middle of the line that the letters stand on.
struct RowNames {
  std::vector<std::optional<Eigen::Vector2d>> numbers;  ///< of its stances; nothing where there is no room
  std::optional<Eigen::Vector2d> start, goal;
  std::vector<Eigen::AlignedBox2d> boxes;  ///< covered by waypoints and all of these
};

/// The number of stance k, or "end".
std::string number_of(const Plan& plan, int k);

/// Numbers stand above their waypoint, or else beneath or beside it, the start's name above that number; the goal's in
/// the goal from its top down, else above, beneath or beside it, not in solid ground and, if that can be, on no
/// surface. None stands over a waypoint or another one, as far as there is room. `start` is where the first COM is
/// drawn [px], `goal` the part of the goal [m], if the row shows them.
RowNames name_places(const Scene& scene, const Plan& plan, const PageRow& row,
                     const std::optional<Eigen::Vector2d>& start, const Eigen::AlignedBox2d& goal);

}  // namespace surefoot::gaits
