#include "planner/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "gaits/rules.hpp"
#include "planner/com_window.hpp"
#include "planner/spread.hpp"

namespace surefoot::planner {

StepCode spread_code(std::uint64_t k) {
  StepCode code;
  for (int i = 0; i < static_cast<int>(code.size()); ++i) code[i] = spread(k, i);
  return code;
}

namespace {

constexpr std::uint64_t goal_pairs = 30000;
constexpr int coms_per_pair = 6;

/// Parts of segments that a COM in the goal may reach, with the running sum of their lengths.
struct NearGoal {
  std::vector<const terrain::Segment*> segments;
  std::vector<double> begins;  ///< of the parts, along their segments [m]
  std::vector<double> sums;    ///< [m]
};

/// What of [from, to] (shares of a segment from coordinate a to b) lies within reach of an interval.
void clip_to_reach(const std::optional<std::pair<double, double>>& interval, double reach, double a, double b,
                   double& from, double& to) {
  if (!interval) return;
  const double low = interval->first - reach, high = interval->second + reach;
  if (a == b) {
    if (a < low || a > high) to = from;
    return;
  }
  const double one = (low - a) / (b - a), other = (high - a) / (b - a);
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
}

NearGoal near_goal(const gaits::Scene& scene) {
  NearGoal near;
  double sum = 0;
  for (const terrain::Segment& segment : scene.terrain.segments()) {
    if (!segment.surface.foothold) continue;
    double from = 0, to = 1;
    clip_to_reach(scene.goal.com_x, scene.robot.reach_max, segment.a.x(), segment.b.x(), from, to);
    clip_to_reach(scene.goal.com_y, scene.robot.reach_max, segment.a.y(), segment.b.y(), from, to);
    if (!(from < to)) continue;
    near.segments.push_back(&segment);
    near.begins.push_back(from * segment.length);
    near.sums.push_back(sum += (to - from) * segment.length);
  }
  return near;
}

std::optional<terrain::Foothold> pick(const gaits::Scene& scene, const NearGoal& near, double u) {
  const double at = u * near.sums.back();
  const auto i =
      std::min(static_cast<std::size_t>(std::lower_bound(near.sums.begin(), near.sums.end(), at) - near.sums.begin()),
               near.sums.size() - 1);
  const terrain::Segment& segment = *near.segments[i];
  const double before = i > 0 ? near.sums[i - 1] : 0;
  return scene.terrain.foothold_at(segment.chain, segment.s_begin + near.begins[i] + (at - before));
}

bool stands_in_goal(const gaits::Scene& scene, const gaits::Robot& robot, gaits::Stance& stance, std::uint64_t k) {
  const Polygon window = reach_window(stance.feet, robot.reach_max);
  if (window.empty()) return false;
  const Polygon in_goal = clip_to_goal(window, scene.goal);
  if (in_goal.empty()) return false;
  const auto oracle = gaits::oracle_of(scene, stance.feet);
  const Polygon balanced = oracle.equilibrium_polygon(window);
  const Polygon polygon = balanced.empty() ? balanced : clip_to_goal(balanced, scene.goal);
  if (polygon.empty()) return false;
  for (int j = 0; j < coms_per_pair; ++j) {
    stance.com = point_in(polygon, spread(k * coms_per_pair + j, 2), spread(k * coms_per_pair + j, 3));
    if (scene.goal.contains(stance.com) && !gaits::broken_stance_rule(scene, stance, oracle)) return true;
  }
  return false;
}

}  // namespace

GoalLook look_at_goal(const gaits::Scene& scene) {
  const NearGoal near = near_goal(scene);
  if (near.segments.empty()) return {false, true, "no terrain to stand on within reach of the goal"};
  const gaits::Robot robot = gaits::drawn_in(scene.robot);
  for (std::uint64_t k = 0; k < goal_pairs; ++k) {
    const auto first = pick(scene, near, spread(k, 0)), second = pick(scene, near, spread(k, 1));
    if (!first || !second) continue;
    if ((first->position - second->position).norm() > 2 * robot.reach_max) continue;
    gaits::Stance stance;
    stance.feet[0] = first;
    stance.feet[1] = second;
    if (stands_in_goal(scene, robot, stance, k)) return {true, false, {}};
  }
  return {false, false,
          fmt::format("among {} pairs of footholds near it, spread evenly, none carries a stable stance with the COM "
                      "in the goal",
                      goal_pairs)};
}

}  // namespace surefoot::planner
