#include "bench/exhaustive_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "gaits/rules.hpp"

namespace surefoot::bench {

namespace {

using Eigen::Vector2d;

/// Lexicographic; smaller is better.
struct Cost {
  double first = 0, second = 0;
  auto operator<=>(const Cost&) const = default;
};

struct State {
  int a = 0, b = 0;  ///< footholds, a < b
  Vector2d com = Vector2d::Zero();
  int free_foot = -1;  ///< foothold that the free leg was lifted from
  Cost cost;
  int parent = -1;
  bool closed = false;
};

class GridSearch {
 public:
  GridSearch(const gaits::Scene& scene, const Grid& grid, std::string objective)
      : scene_(scene), grid_(grid), objective_(std::move(objective)) {
    for (const terrain::Segment& segment : scene.terrain.segments()) {
      const int n = std::max(1, static_cast<int>(std::ceil(segment.length / grid.spacing)));
      for (int i = 0; i < n; ++i)
        if (const auto foot =
                scene.terrain.foothold_at(segment.chain, segment.s_begin + segment.length * (i + 0.5) / n))
          feet_.push_back(*foot);
    }
  }

  GridOptimum run(std::uint64_t most_states) {
    GridOptimum result;
    push_starts();
    while (!open_.empty() && result.states < most_states) {
      const int at = open_.top().second;
      open_.pop();
      if (states_[at].closed) continue;
      states_[at].closed = true;
      if (scene_.goal.contains(states_[at].com)) {
        result.found = true;
        write(at, result.plan);
        break;
      }
      ++result.states;
      expand(at);
    }
    result.steps_asked = asked_;
    return result;
  }

 private:
  gaits::Stance stance(const State& state) const {
    gaits::Stance stance;
    stance.feet[0] = feet_[state.a];
    stance.feet[1] = feet_[state.b];
    stance.com = state.com;
    return stance;
  }

  void push_starts() {
    std::array<int, gaits::leg_count> number{-1, -1, -1};
    const std::size_t own = feet_.size();
    for (int leg = 0; leg < gaits::leg_count; ++leg)
      if (scene_.start.feet[leg]) {
        number[leg] = static_cast<int>(feet_.size());
        feet_.push_back(*scene_.start.feet[leg]);
      }
    landings_ = own;
    for (int free = 0; free < gaits::leg_count; ++free) {
      const int one = number[free == 0 ? 1 : 0], two = number[free == 2 ? 1 : 2];
      if (one < 0 || two < 0) continue;
      gaits::Stance first;
      for (int leg = 0; leg < gaits::leg_count; ++leg)
        if (leg != free) first.feet[leg] = scene_.start.feet[leg];
      std::vector<Vector2d> coms{scene_.start.com.value_or(Vector2d::Zero())};
      if (!scene_.start.com) coms = coms_near(first.feet);
      for (const Vector2d& com : coms) {
        first.com = com;
        if (gaits::broken_start_rule(scene_, first)) continue;
        Cost cost;
        if (objective_ == "safety")
          cost.first = -gaits::safety_factor(scene_, gaits::oracle_of(scene_, first.feet), com).value;
        add({std::min(one, two), std::max(one, two), com, number[free], cost, -1, false});
      }
    }
  }

  /// Points of the lattice within reach of the given feet.
  std::vector<Vector2d> coms_near(const gaits::Feet& feet) const {
    const double reach = scene_.robot.reach_max, h = grid_.com;
    Vector2d low = Vector2d::Constant(-std::numeric_limits<double>::infinity()), high = -low;
    for (const auto& foot : feet)
      if (foot) {
        low = low.cwiseMax(foot->position - Vector2d::Constant(reach));
        high = high.cwiseMin(foot->position + Vector2d::Constant(reach));
      }
    std::vector<Vector2d> coms;
    for (double i = std::ceil(low.x() / h); i * h <= high.x(); ++i)
      for (double j = std::ceil(low.y() / h); j * h <= high.y(); ++j) {
        const Vector2d com(i * h, j * h);
        if (gaits::within_reach(scene_.robot, feet, com, com)) coms.push_back(com);
      }
    return coms;
  }

  const std::vector<Vector2d>& coms_of(int a, int b) {
    const auto [at, fresh] = coms_.try_emplace({a, b});
    if (!fresh) return at->second;
    const State state{a, b, Vector2d::Zero(), -1, {}, -1, false};
    gaits::Stance candidate = stance(state);
    const auto oracle = gaits::oracle_of(scene_, candidate.feet);
    for (const Vector2d& com : coms_near(candidate.feet)) {
      candidate.com = com;
      if (!gaits::broken_stance_rule(scene_, candidate, oracle)) at->second.push_back(com);
    }
    return at->second;
  }

  void add(const State& state) {
    const auto [at, fresh] =
        numbers_.try_emplace({static_cast<double>(state.a), static_cast<double>(state.b), state.com.x(), state.com.y()},
                             static_cast<int>(states_.size()));
    if (fresh) {
      states_.push_back(state);
    } else {
      State& known = states_[at->second];
      if (known.closed || known.cost <= state.cost) return;
      known = state;
    }
    open_.push({state.cost, at->second});
  }

  bool is_closed(int a, int b, const Vector2d& com, const Cost& bound) const {
    const auto at = numbers_.find({static_cast<double>(a), static_cast<double>(b), com.x(), com.y()});
    return at != numbers_.end() && (states_[at->second].closed || states_[at->second].cost <= bound);
  }

  void expand(int at) {
    const State from = states_[at];
    for (int landing = 0; landing < static_cast<int>(landings_); ++landing) {
      if (landing == from.a || landing == from.b) continue;
      if ((feet_[landing].position - from.com).norm() > scene_.robot.reach_max) continue;
      const gaits::Stance standing = stance(from);
      gaits::Transfer transfer{2, feet_[landing], 0, 0, {}};
      const auto oracle = gaits::oracle_of(scene_, gaits::feet_during(standing, transfer));
      for (int lift = 0; lift < gaits::leg_count; ++lift) {
        transfer.lift = lift;
        const int kept = lift == 0 ? from.b : from.a, other = lift == 2 ? from.b : landing;
        const int lifted = lift == 0 ? from.a : lift == 1 ? from.b : landing;
        const int a = std::min(kept, other), b = std::max(kept, other);
        for (const Vector2d& com : coms_of(a, b)) try_step(at, from, standing, transfer, oracle, a, b, lifted, com);
      }
    }
  }

  void try_step(int at, const State& from, const gaits::Stance& standing, const gaits::Transfer& transfer,
                const stability::RobustOracle& oracle, int a, int b, int lifted, const Vector2d& com) {
    Cost cost = from.cost;
    if (objective_ == "distance") cost.first += (com - from.com).norm();
    if (objective_ == "steps") cost.first += 1;
    if (objective_ == "safety") cost.second += 1;
    if (is_closed(a, b, com, cost)) return;
    ++asked_;
    const auto swing_from = from.free_foot >= 0 ? std::optional(feet_[from.free_foot]) : std::nullopt;
    if (gaits::broken_transfer_rule(scene_, standing, transfer, com, swing_from, oracle)) return;
    if (objective_ == "safety") {
      const State next{a, b, com, lifted, cost, at, false};
      const double line = gaits::safety_factor(scene_, oracle, from.com, com).least.value;
      const double point = gaits::safety_factor(scene_, gaits::oracle_of(scene_, stance(next).feet), com).value;
      cost.first = std::max(cost.first, -std::min(line, point));
    }
    add({a, b, com, lifted, cost, at, false});
  }

  /// Legs are named by the places they stand on.
  void write(int at, gaits::Plan& plan) const {
    std::vector<int> chain;
    for (int i = at; i >= 0; i = states_[i].parent) chain.push_back(i);
    std::reverse(chain.begin(), chain.end());
    std::array<int, gaits::leg_count> on{-1, -1, -1};
    int next_start = static_cast<int>(landings_);
    for (int leg = 0; leg < gaits::leg_count; ++leg)
      if (scene_.start.feet[leg]) on[leg] = next_start++;
    plan.status = gaits::Status::solved;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const State& state = states_[chain[k]];
      const auto stands = [&state](int foot) { return foot == state.a || foot == state.b; };
      if (k > 0) {
        gaits::Transfer transfer;
        const gaits::Stance& before = plan.stances.back();
        for (int leg = 0; leg < gaits::leg_count; ++leg)
          if (!before.feet[leg]) transfer.leg = leg;
        int landing = state.free_foot;
        for (const int foot : {state.a, state.b})
          if (foot != states_[chain[k - 1]].a && foot != states_[chain[k - 1]].b) landing = foot;
        on[transfer.leg] = landing;
        transfer.foothold = feet_[landing];
        for (int leg = 0; leg < gaits::leg_count; ++leg)
          if (on[leg] == state.free_foot && !stands(on[leg])) transfer.lift = leg;
        plan.transfers.push_back(transfer);
      }
      gaits::Stance stance;
      for (int leg = 0; leg < gaits::leg_count; ++leg)
        if (on[leg] >= 0 && stands(on[leg])) stance.feet[leg] = feet_[on[leg]];
      stance.com = state.com;
      plan.stances.push_back(stance);
    }
    gaits::rate(scene_, plan);
  }

  const gaits::Scene& scene_;
  Grid grid_;
  std::string objective_;
  std::vector<terrain::Foothold> feet_;
  std::size_t landings_ = 0;  ///< the first so many footholds are the grid's
  std::map<std::pair<int, int>, std::vector<Vector2d>> coms_;
  std::map<std::array<double, 4>, int> numbers_;
  std::vector<State> states_;
  std::priority_queue<std::pair<Cost, int>, std::vector<std::pair<Cost, int>>, std::greater<>> open_;
  std::uint64_t asked_ = 0;
};

}  // namespace

GridOptimum exhaustive_optimum(const gaits::Scene& scene, const Grid& grid, const std::string& objective,
                               std::uint64_t most_states) {
  return GridSearch(scene, grid, objective).run(most_states);
}

}  // namespace surefoot::bench
