#include "planner/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gaits/rules.hpp"
#include "planner/com_window.hpp"
#include "planner/refusals.hpp"
#include "planner/start_faults.hpp"

namespace surefoot::planner {

using Eigen::Vector2d;
using gaits::Rule;

namespace {

/// Said where no frictionally stable start was found: on most postures there is none.
constexpr const char* frictional_needs =
    "frictional stability wants a low body between wide, grippy feet: `surefoot region --stance LEG,LEG` shows where "
    "it "
    "holds";
constexpr int com_samples = 400;          ///< COMs tried per pair of start feet
constexpr int goal_samples = 200;         ///< of these, drawn from the goal where the start feet reach it
constexpr int most_moves = 60;            ///< of the safest of these towards where it is safest
constexpr std::size_t keep_per_pair = 3;  ///< first stances handed to the search per pair of start feet
constexpr int first_step_tries = 64;      ///< codes tried to see whether a first step exists
constexpr int climbing_tries = 8;         ///< beside the one that led on before, on the way to where a stance is safest
constexpr std::uint64_t goal_pairs = 30000;
constexpr int coms_per_pair = 6;

/// Coordinate i of the k-th point of the additive recurrence in five dimensions; the root of x^6 = x + 1 is its base.
double spread(std::uint64_t k, int i) {
  constexpr double root = 1.1347241384015194;
  const double value = 0.5 + static_cast<double>(k + 1) * std::pow(root, -(i + 1));
  return value - std::floor(value);
}

Node node_of(const gaits::Scene& scene, const gaits::Stance& stance, StepProposals& proposals) {
  Node node{scene.start.feet, 0, stance.com, proposals.next_id()};
  while (stance.feet[node.free_leg]) ++node.free_leg;
  return node;
}

/// `led_on` is the code that led on from the node asked about before: near it, the same mostly leads on again.
bool has_first_step(StepProposals& proposals, const Node& node, int& led_on, int tries = first_step_tries) {
  Node next;
  if (proposals.propose(node, spread_code(led_on), next)) return true;
  for (int k = 0; k < tries; ++k) {
    if (k == led_on || !proposals.propose(node, spread_code(k), next)) continue;
    led_on = k;
    return true;
  }
  return false;
}

/// First stances on two given feet with a COM of our choice: the safest few that a first step leads on from, and the
/// one nearest to the goal.
void choose_coms(StepProposals& proposals, gaits::Stance stance, StartChoice& choice, PairFaults& faults) {
  const gaits::Scene& scene = proposals.scene();
  const auto refuse = [&](const std::string& fault, bool proven) {
    faults.add(stance, fault);
    choice.decided = choice.decided && proven;
  };
  if (const std::string slips = friction_fault(scene, stance); !slips.empty()) return refuse(slips, true);
  const auto oracle = gaits::oracle_of(scene, stance.feet);
  const Polygon window = reach_window(stance.feet, proposals.robot().reach_max);
  const Polygon polygon =
      window.empty() ? window : gaits::oracle_of(scene, stance.feet, box_of_stances(scene)).equilibrium_polygon(window);
  if (polygon.empty()) {
    const BalanceFault fault = balance_fault(scene, stance);
    return refuse(fault.words, fault.proven);
  }
  const Polygon in_goal = clip_to_goal(polygon, scene.goal);
  std::vector<std::pair<double, Node>> found;
  int led_on = 0;
  RuleCounts refused{};
  const auto may_stand = [&](const Vector2d& com) {
    stance.com = com;
    const auto& robot = proposals.robot();
    std::optional<Rule> broken;
    if (!gaits::within_reach(robot, stance.feet, com, com)) broken = Rule::reach;
    else if (!gaits::is_stable(scene, oracle, com)) broken = Rule::stance_stability;
    else if (scene.terrain.distance(com, robot.clearance) < robot.clearance) broken = Rule::clearance;
    else broken = gaits::broken_start_rule(scene, stance);
    if (broken) ++refused[static_cast<std::size_t>(*broken)];
    return !broken;
  };
  for (int k = in_goal.empty() ? goal_samples : 0; k < goal_samples + com_samples; ++k) {
    if (!may_stand(point_in(k < goal_samples ? in_goal : polygon, spread(k, 0), spread(k, 1)))) continue;
    const Node node = node_of(scene, stance, proposals);
    if (scene.goal.contains(node.com)) {
      choice.nodes.insert(choice.nodes.begin(), node);
      return;
    }
    found.emplace_back(gaits::safety_factor(scene, oracle, stance.com).value, node);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  // No plan is safer than its first stance: the safest is moved to where it is safest still.
  const auto make_safest = [&](std::pair<double, Node>& best) {
    const double reach = scene.robot.reach_max;
    double step = reach / 8;
    for (int move = 0; step > reach / 2000 && move < most_moves; ++move) {
      const Vector2d centre = best.second.com;
      for (const Vector2d& way : {Vector2d(step, 0), Vector2d(-step, 0), Vector2d(0, step), Vector2d(0, -step)}) {
        if (!may_stand(centre + way)) continue;
        const double factor = gaits::safety_factor(scene, oracle, stance.com).value;
        if (!(factor > best.first)) continue;
        const Node node = node_of(scene, stance, proposals);
        if (has_first_step(proposals, node, led_on, climbing_tries)) best = {factor, node};
      }
      if (best.second.com == centre) step /= 2;
    }
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size() && kept < keep_per_pair; ++i) {
    if (!has_first_step(proposals, found[i].second, led_on)) continue;
    if (kept == 0) make_safest(found[i]);
    choice.nodes.push_back(found[i].second);
    ++kept;
  }
  if (kept == 0 && !found.empty()) choice.nodes.push_back(found.front().second);
  const auto nearest = std::min_element(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return scene.goal.distance(a.second.com) < scene.goal.distance(b.second.com);
  });
  if (nearest != found.end()) choice.nearest.push_back(nearest->second);
  if (found.empty()) {
    const std::string tried = in_goal.empty() ? "" : fmt::format(" and {} in the goal", goal_samples);
    refuse(fmt::format("no COM was found to stand on feet {} in {} tries per pair{}, refused by {}",
                       legs_in_words(stance), com_samples, tried, shares(refused)),
           false);
    if (gaits::asks_frictional(scene.criterion) && refused[static_cast<std::size_t>(Rule::stance_stability)] > 0)
      faults.advise(frictional_needs);
  }
}

}  // namespace

StepCode spread_code(std::uint64_t k) {
  StepCode code;
  for (int i = 0; i < static_cast<int>(code.size()); ++i) code[i] = spread(k, i);
  return code;
}

StartChoice choose_start(StepProposals& proposals) {
  const gaits::Scene& scene = proposals.scene();
  const gaits::Start& start = scene.start;
  StartChoice choice;
  PairFaults faults;
  choice.decided = true;
  for (int lifted = gaits::leg_count - 1; lifted >= 0; --lifted) {
    gaits::Stance stance{start.feet, start.com.value_or(Vector2d::Zero()), 0, {}};
    stance.feet[lifted].reset();
    const int a = lifted == 0 ? 1 : 0, b = lifted == 2 ? 1 : 2;
    if (!stance.feet[a] || !stance.feet[b]) continue;
    if (start.support && *start.support != std::pair(a, b)) continue;
    if (!start.com) {
      choose_coms(proposals, stance, choice, faults);
    } else if (const auto rule = gaits::broken_start_rule(scene, stance)) {
      const std::string hopeless = *rule == Rule::stance_stability ? no_com_words(scene, stance) : "";
      faults.add(stance, hopeless.empty() ? broken_rule_words(scene, stance, *rule) : hopeless);
      choice.com_decides = choice.com_decides || hopeless.empty();
    } else {
      choice.nodes.push_back(node_of(scene, stance, proposals));
    }
  }
  std::stable_partition(choice.nodes.begin(), choice.nodes.end(),
                        [&](const Node& node) { return scene.goal.contains(node.com); });
  if (choice.nodes.empty()) choice.fault = faults.words() + hanging_feet(scene);
  return choice;
}

terrain::InputError start_error(const gaits::Scene& scene, const StartChoice& choice) {
  const gaits::Start& start = scene.start;
  const std::string& given = choice.com_decides ? start.com_place : start.place;
  return terrain::InputError(fmt::format("{}: start: {}", given.empty() ? scene.file : given, choice.fault));
}

namespace {

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
