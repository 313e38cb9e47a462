// The rules of steps in the search by layers: what it asks before a step is used, and in which order steps get their
// turn.
#include <algorithm>
#include <cmath>

#include "planner/layer_search.hpp"

namespace surefoot::planner {

using Eigen::Vector2d;
using gaits::Rule;

namespace {

/// Weight of the feet against the COM in the order of a layer: of two stances with the same COM the one whose feet are
/// ahead has come farther.
constexpr double feet_share = 0.3;
constexpr int halvings = 3;  ///< between a COM that a step may end at and one that it may not

}  // namespace

int least_steps(const ToGoal& stance, double reach_max) {
  if (!(stance.com > 0)) return 0;
  constexpr double most = 1e8, rounding = 1e-9;
  // Rounds of three steps to bring a distance to nothing.
  const auto rounds = [&](double distance) {
    return 3 * std::clamp(std::ceil(distance / (2 * reach_max) * (1 - rounding) - rounding), 0.0, most);
  };
  return static_cast<int>(
      std::min({rounds(stance.com), 1 + rounds(stance.rear - reach_max), 2 + rounds(stance.front - reach_max)}));
}

int least_steps(double distance, double reach_max) {
  return least_steps({distance, distance - reach_max, distance - reach_max}, reach_max);
}

double LayerSearch::detour(std::int32_t number, const ComCandidates::Com& to) const {
  if (detour_weight_ == 0) return 0;
  const SearchNode& node = nodes_[number];
  const auto& from = coms_.com(node.com);
  return node.detour + (to.at - from.at).norm() + to.to_goal - from.to_goal;
}

ToGoal LayerSearch::to_goal(const Vector2d& com, std::int32_t number) const {
  const auto& pair = coms_[number];
  return {scene_->goal.distance(com), pair.rear, pair.front};
}

double LayerSearch::key(const Vector2d& com, std::int32_t pair) const {
  const auto& feet = coms_[pair];
  const Vector2d middle = 0.5 * (foot(feet.first_foot).position + foot(feet.second_foot).position);
  return scene_->goal.distance((1 - feet_share) * com + feet_share * middle);
}

/// Until a pair is looked at, its COM may be anywhere within reach: say in the middle of its feet, or as near to there
/// as the reach of the foot that is lifted allows.
double LayerSearch::key_of_step(std::int32_t landing, std::int32_t lifted, std::int32_t kept) const {
  const double middle = scene_->goal.distance(0.5 * (foot(landing).position + foot(kept).position));
  const double com = std::max(middle, scene_->goal.distance(foot(lifted).position) - robot_.reach_max);
  return (1 - feet_share) * com + feet_share * middle;
}

/// After a step onto a foothold that lifts another and keeps a third, so many steps at least make a plan: the COM is
/// within reach of all three.
bool LayerSearch::is_too_long(std::size_t k, std::int32_t landing, std::int32_t lifted, std::int32_t kept) const {
  if (below_ == no_bound) return false;
  const double a = scene_->goal.distance(foot(landing).position), b = scene_->goal.distance(foot(kept).position);
  const double farthest = std::max({a, b, scene_->goal.distance(foot(lifted).position)});
  const ToGoal after{farthest - robot_.reach_max, std::max(a, b), std::min(a, b)};
  return static_cast<int>(k) + least_steps(after, robot_.reach_max) >= below_;
}

std::optional<Rule> LayerSearch::broken_placement_rule(const SearchNode& node, std::int32_t landing) {
  ++checked_;
  const Vector2d& com = coms_.com(node.com).at;
  if (!scene_->terrain.leg_is_free(com, foot(landing))) return Rule::leg_visibility;
  if (node.old_foot < 0 || node.swings_any_way) return std::nullopt;
  if (gaits::swing_is_free(*scene_, com, foot(node.old_foot).position, foot(landing).position)) return std::nullopt;
  swing_mattered_ = true;
  return Rule::swing;
}

/// All three feet, wherever the COM is between the two stances.
bool LayerSearch::feet_reach(const Entry& entry, const Vector2d& to) {
  ++scanned_;
  const SearchNode& node = nodes_[entry.node];
  const auto& pair = coms_[node.pair];
  const Vector2d& from = coms_.com(node.com).at;
  // The foot that is lifted first: it is the farthest back.
  for (const std::int32_t number : {entry.lifted, pair.first_foot, pair.second_foot, entry.landing})
    if (!gaits::within_reach(robot_, foot(number).position, from, to)) return false;
  return true;
}

/// Apart from the reach of the feet.
std::optional<Rule> LayerSearch::broken_step_rule(const Entry& entry, std::int32_t number) {
  ++checked_;
  const SearchNode& node = nodes_[entry.node];
  const Vector2d &from = coms_.com(node.com).at, &to = coms_.com(number).at;
  if (!scene_->terrain.leg_is_free(to, foot(entry.lifted))) return Rule::leg_visibility;
  if (scene_->terrain.distance(from, to, robot_.clearance) < robot_.clearance) return Rule::clearance;
  gaits::Feet three;
  three[0] = foot(coms_[node.pair].first_foot);
  three[1] = foot(coms_[node.pair].second_foot);
  three[2] = foot(entry.landing);
  if (!gaits::is_stable(*scene_, gaits::oracle_of(*scene_, three, box_), from, to)) return Rule::transfer_stability;
  return std::nullopt;
}

/// What a stance or a step at a COM breaks first, where all feet reach.
std::optional<Rule> LayerSearch::broken_rule(const Entry& entry, std::int32_t com) {
  if (coms_.holds(entry.pair, com)) return broken_step_rule(entry, com);
  return coms_.com(com).verdict == ComCandidates::Verdict::too_near ? Rule::clearance : Rule::stance_stability;
}

/// Counted only while there is no plan: then it matters what stands in the way.
void LayerSearch::refuse(Rule rule, const SearchNode& node) {
  if (below_ == no_bound) refusals_.add(rule, coms_.com(node.com).at);
}

/// A COM between a legal one and the last before it, nearer to the goal, that is not: as near as halving finds.
std::int32_t LayerSearch::sharpened(const Entry& entry, std::int32_t number) {
  std::int32_t ahead = -1;  // the first of the column before it: COMs of a column are equally near
  for (std::int32_t i = coms_.next(entry.pair, -1); i >= 0 && i != number; i = coms_.next(entry.pair, i)) {
    const double here = coms_.com(i).to_goal;
    if (here < coms_.com(number).to_goal && (ahead < 0 || here > coms_.com(ahead).to_goal)) ahead = i;
  }
  if (ahead < 0) return number;
  const Vector2d begin = coms_.com(number).at, way = coms_.com(ahead).at - begin;
  double low = 0, high = 1;
  std::int32_t best = number;
  for (int i = 0; i < halvings; ++i) {
    const double t = 0.5 * (low + high);
    const std::int32_t tried = coms_.try_one(entry.pair, begin + t * way);
    if (tried >= 0 && feet_reach(entry, coms_.com(tried).at) && !broken_step_rule(entry, tried)) low = t, best = tried;
    else high = t;
  }
  return best;
}

/// Tries the COMs of a step in their order, until one leads to a stance or is less good than another entry may be.
void LayerSearch::try_coms(std::size_t k, Entry entry, const Limits& limits) {
  const int layer = static_cast<int>(k);
  const ToGoal feet{0, coms_[entry.pair].rear, coms_[entry.pair].front};
  for (std::int32_t number; (number = coms_.next(entry.pair, entry.last)) >= 0; entry.last = number) {
    const auto com = coms_.com(number);
    if (coms_.was_refused(number)) continue;
    if (com.node >= 0 && nodes_[com.node].layer <= layer) {
      entry.has_led_on = true;  // or would have
      continue;
    }
    if (limits.below != no_bound &&
        layer + least_steps({com.to_goal, feet.rear, feet.front}, robot_.reach_max) >= limits.below)
      return;  // so are those behind it
    if (!feet_reach(entry, com.at)) continue;
    if (const double true_key = key(com.at, entry.pair) + detour_weight_ * detour(entry.node, com);
        true_key > entry.key) {
      entry.key = true_key;
      return put_back(k, entry);
    }
    if (const auto rule = broken_rule(entry, number)) {
      entry.note(*rule);
      continue;
    }
    entry.has_led_on = true;
    const bool sharpen = limits.sharpen && !entry.sharpened;
    if (!sharpen) entry.last = number;
    entry.sharpened = true;
    put_back(k, entry);
    return reach(k, entry, sharpen ? sharpened(entry, number) : number);
  }
  if (entry.has_led_on) return;
  // Refused: by reach if no COM of the pair was within reach of all three feet.
  const Rule first = coms_[entry.pair].balances ? Rule::reach : Rule::stance_stability;
  refuse(entry.refused ? entry.refused_by : first, nodes_[entry.node]);
}

}  // namespace surefoot::planner
