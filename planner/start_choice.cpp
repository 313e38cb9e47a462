// The first stances that a start allows: what the scene gives is judged, what it leaves open is chosen by even
// sampling.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "gaits/rules.hpp"
#include "planner/com_window.hpp"
#include "planner/problem.hpp"
#include "planner/refusals.hpp"
#include "planner/spread.hpp"
#include "planner/start_faults.hpp"

namespace surefoot::planner {

using Eigen::Vector2d;
using gaits::Rule;

namespace {

/// Said where no frictionally stable start was found: on most postures there is none.
constexpr const char* frictional_needs =
    "frictional stability wants a low body between wide, grippy feet: `surefoot region SCENE --stance LEG,LEG` shows "
    "where it holds";
constexpr int com_samples = 400;          ///< COMs tried per pair of start feet
constexpr int goal_samples = 200;         ///< before these, drawn from the goal where the start feet reach it
constexpr int most_moves = 60;            ///< of the safest of these towards where it is safest
constexpr std::size_t keep_per_pair = 3;  ///< first stances handed to the search per pair of start feet
constexpr int first_step_tries = 64;      ///< codes tried to see whether a first step exists
constexpr int climbing_tries = 8;         ///< beside the one that led on before, on the way to where a stance is safest

Node node_of(const gaits::Scene& scene, const gaits::Stance& stance, StepProposals& proposals) {
  Node node{scene.start.feet, 0, stance.com, proposals.next_id()};
  while (stance.feet[node.free_leg]) ++node.free_leg;
  return node;
}

/// First stances on two given feet with a COM of our choice.
class StancesOnPair {
 public:
  StancesOnPair(StepProposals& proposals, gaits::Stance stance)
      : proposals_(proposals), scene_(proposals.scene()), stance_(std::move(stance)),
        oracle_(gaits::oracle_of(scene_, stance_.feet)) {}

  /// Adds the safest few that a first step leads on from, and the one nearest to the goal; one in the goal is enough.
  void choose(StartChoice& choice, PairFaults& faults) {
    const auto refuse = [&](const std::string& fault, bool proven) {
      faults.add(stance_, fault);
      choice.decided = choice.decided && proven;
    };
    if (const std::string slips = friction_fault(scene_, stance_); !slips.empty()) return refuse(slips, true);
    const Polygon window = reach_window(stance_.feet, proposals_.robot().reach_max);
    const Polygon balanced =
        window.empty() ? window
                       : gaits::oracle_of(scene_, stance_.feet, box_of_stances(scene_)).equilibrium_polygon(window);
    if (balanced.empty()) {
      const BalanceFault fault = balance_fault(scene_, stance_);
      return refuse(fault.words, fault.proven);
    }
    const Polygon in_goal = clip_to_goal(balanced, scene_.goal);
    if (const auto node = sample(balanced, in_goal)) {
      choice.nodes.insert(choice.nodes.begin(), *node);
    } else if (found_.empty()) {
      refuse(none_found(!in_goal.empty()), false);
      if (gaits::asks_frictional(scene_.criterion) && refused_[static_cast<std::size_t>(Rule::stance_stability)] > 0)
        faults.advise(frictional_needs);
    } else {
      keep_safest(choice.nodes);
      choice.nearest.push_back(nearest_to_goal());
    }
  }

 private:
  /// Fills found_, unless a stance in the goal is met.
  std::optional<Node> sample(const Polygon& balanced, const Polygon& in_goal) {
    for (int k = in_goal.empty() ? goal_samples : 0; k < goal_samples + com_samples; ++k) {
      if (!may_stand(point_in(k < goal_samples ? in_goal : balanced, spread(k, 0), spread(k, 1)))) continue;
      const Node node = node_of(scene_, stance_, proposals_);
      if (scene_.goal.contains(node.com)) return node;
      found_.emplace_back(factor(), node);
    }
    return std::nullopt;
  }

  /// Puts the COM there.
  bool may_stand(const Vector2d& com) {
    stance_.com = com;
    const gaits::Robot& robot = proposals_.robot();
    std::optional<Rule> broken;
    if (!gaits::within_reach(robot, stance_.feet, com, com)) broken = Rule::reach;
    else if (!gaits::is_stable(scene_, oracle_, com)) broken = Rule::stance_stability;
    else if (scene_.terrain.distance(com, robot.clearance) < robot.clearance) broken = Rule::clearance;
    else broken = gaits::broken_start_rule(scene_, stance_);
    if (broken) ++refused_[static_cast<std::size_t>(*broken)];
    return !broken;
  }

  double factor() const { return gaits::safety_factor(scene_, oracle_, stance_.com).value; }

  std::string none_found(bool tried_goal) const {
    const std::string more = tried_goal ? fmt::format(" and {} in the goal", goal_samples) : "";
    return fmt::format("no COM was found to stand on feet {} in {} tries per pair{}, refused by {}",
                       legs_in_words(stance_), com_samples, more, shares(refused_));
  }

  void keep_safest(std::vector<Node>& nodes) {
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found_.size() && kept < keep_per_pair; ++i) {
      if (!has_first_step(found_[i].second)) continue;
      if (kept == 0) make_safest(found_[i]);
      nodes.push_back(found_[i].second);
      ++kept;
    }
    if (kept == 0) nodes.push_back(found_.front().second);
  }

  /// No plan is safer than its first stance: the safest is moved to where it is safest still.
  void make_safest(std::pair<double, Node>& best) {
    const double reach = scene_.robot.reach_max;
    double step = reach / 8;
    for (int move = 0; step > reach / 2000 && move < most_moves; ++move) {
      const Vector2d centre = best.second.com;
      for (const Vector2d& way : {Vector2d(step, 0), Vector2d(-step, 0), Vector2d(0, step), Vector2d(0, -step)}) {
        if (!may_stand(centre + way)) continue;
        const double found = factor();
        if (!(found > best.first)) continue;
        const Node node = node_of(scene_, stance_, proposals_);
        if (has_first_step(node, climbing_tries)) best = {found, node};
      }
      if (best.second.com == centre) step /= 2;
    }
  }

  bool has_first_step(const Node& node, int tries = first_step_tries) {
    Node next;
    if (proposals_.propose(node, spread_code(led_on_), next)) return true;
    for (int k = 0; k < tries; ++k) {
      if (k == led_on_ || !proposals_.propose(node, spread_code(k), next)) continue;
      led_on_ = k;
      return true;
    }
    return false;
  }

  const Node& nearest_to_goal() const {
    const auto nearer = [&](const auto& a, const auto& b) {
      return scene_.goal.distance(a.second.com) < scene_.goal.distance(b.second.com);
    };
    return std::min_element(found_.begin(), found_.end(), nearer)->second;
  }

  StepProposals& proposals_;
  const gaits::Scene& scene_;
  gaits::Stance stance_;
  stability::RobustOracle oracle_;
  std::vector<std::pair<double, Node>> found_;  ///< with their safety factors
  RuleCounts refused_{};
  int led_on_ = 0;  ///< the code that led on from the node asked about before: near it, the same mostly leads on again
};

}  // namespace

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
      StancesOnPair(proposals, stance).choose(choice, faults);
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

}  // namespace surefoot::planner
