// What the page of a plan (plan_io.hpp, to_html) is given to play: the plan itself and what is worked out from it here,
// so that the page only draws.
#pragma once

#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// One JSON object in ASCII without `<`, `>` and `&`: safe inside an HTML element whatever the scene is called.
///   plan          the tree of to_json without time_s
///   scene         robot, disturbance, criterion, start feet, goal
///   stances[k]    factor and why: safety factor and limit in words; region: rings [m];
///                 free: {leg, from}, the leg in the air and the foothold it left (null: it has not stood yet)
///   transfers[k]  factor, why and region alike; turn: angle [rad] by which the free leg turns before it is placed
///                 (null: no way is free; absent: it comes from nowhere)
///   terrain       ground (polygons), surface (stretches), legend
/// Regions are where the COM may be under the scene's criterion, to within `region_detail`; where the criterion is
/// frictional those of stances are R_SS(W), which they need but which is not enough. Limits of reach are left to the
/// page.
std::string player_data(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults);

/// Of the curves that bound a region, relative to the extent of R_SS(W): a pixel on a screen.
constexpr double region_detail = 3e-3;

}  // namespace surefoot::gaits
