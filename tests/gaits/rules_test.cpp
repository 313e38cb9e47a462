// The rules of a step against dense sampling, and against the verifier on random steps over random ground.
#include "gaits/rules.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "gaits/verifier.hpp"
#include "tests/gaits/fixtures.hpp"

using namespace surefoot;
using namespace surefoot::gaits;
using Eigen::Vector2d;
using surefoot::gaits::testing::chain;
using surefoot::gaits::testing::foot_at;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::scene_on;
using terrain::Chain;

namespace {

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  int pick(int count) { return static_cast<int>((*this)(0, count)); }

 private:
  std::mt19937 random_;
};

/// Crossing by the parameters of the two lines, for lines in general position.
bool cross_each_other(const Vector2d& p, const Vector2d& q, const Vector2d& a, const Vector2d& b) {
  Eigen::Matrix2d system;
  system << q - p, a - b;
  if (std::abs(system.determinant()) < 1e-14) return false;
  const Vector2d at = system.inverse() * (a - p);
  return at.minCoeff() >= 0 && at.maxCoeff() <= 1;
}

/// Rubble from x = -2 to x = 2 with heights in [0, rough].
Chain rubble(Dice& dice, double rough) {
  std::vector<terrain::Point> vertices;
  for (double x = -2; x <= 2; x += 0.25) vertices.push_back({x + dice(-0.1, 0.1), dice(0, rough)});
  return chain(vertices, dice(0.3, 1));
}

/// Distance of a point from a segment by looking at 2001 of its points.
double sampled_distance(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  double least = 1e9;
  for (int i = 0; i <= 2000; ++i) least = std::min(least, (a + (i / 2000.0) * (b - a) - point).norm());
  return least;
}

}  // namespace

TEST_CASE("a foot is within reach of a line iff it is within reach of all its points", "[rules]") {
  Dice dice(1);
  Robot robot;
  robot.reach_min = 0.3;
  robot.reach_max = 1;
  int within = 0, not_within = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector2d foot(dice(-1, 1), dice(-1, 1)), from(dice(-1, 1), dice(-1, 1)), to(dice(-1, 1), dice(-1, 1));
    const double least = sampled_distance(foot, from, to),
                 greatest = std::max((from - foot).norm(), (to - foot).norm());
    // 2000 steps of at most 1.5 mm: the sampled least is at most 1e-6 m above the true one where that is 0.3 m.
    if (std::abs(least - 0.3) < 2e-6) continue;
    const bool expected = least > 0.3 && greatest <= 1;
    INFO(foot.transpose() << " | " << from.transpose() << " | " << to.transpose());
    CHECK(within_reach(robot, foot, from, to) == expected);
    (expected ? within : not_within)++;
  }
  CHECK(within > 200);
  CHECK(not_within > 200);
}

TEST_CASE("reach is a closed interval, and a point is a line of no length", "[rules]") {
  Robot robot;
  robot.reach_min = 0.5;
  robot.reach_max = 1.25;
  CHECK(within_reach(robot, {0, 0}, {0.3, 0.4}, {0.3, 0.4}));  // 0.5
  CHECK(within_reach(robot, {0, 0}, {0.75, 1}, {0.75, 1}));    // 1.25
  CHECK_FALSE(within_reach(robot, {0, 0}, {0.29, 0.4}, {0.29, 0.4}));
  CHECK_FALSE(within_reach(robot, {0, 0}, {0.75, 1.0000001}, {0.75, 1}));
  // Both ends at 1.118 m, half way at 0.5 m; a little lower it is nearer.
  CHECK(within_reach(robot, {0, 0}, {-1, 0.5}, {1, 0.5}));
  CHECK_FALSE(within_reach(robot, {0, 0}, {-1, 0.4999999}, {1, 0.4999999}));
  robot.reach_min = 0;
  CHECK(within_reach(robot, {0, 0}, {-1, 0}, {1, 0}));
}

TEST_CASE("a COM chosen for the robot drawn in needs no slack", "[rules]") {
  Robot robot;
  robot.reach_min = 0.2;
  robot.reach_max = 0.9;
  robot.clearance = 0;
  const Robot inner = drawn_in(robot);
  CHECK(inner.reach_min == Approx(0.2 + 0.9e-9).epsilon(1e-15));
  CHECK(inner.reach_max == Approx(0.9 - 0.9e-9).epsilon(1e-15));
  CHECK(inner.clearance > 0);
  CHECK_FALSE(within_reach(inner, {0, 0}, {0, 0.9}, {0, 0.9}));
  CHECK(within_reach(inner, {0, 0}, {0, 0.899999998}, {0, 0.899999998}));
}

TEST_CASE("the COM line is clear iff all its points are", "[rules]") {
  Dice dice(2);
  int clear = 0, not_clear = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Scene scene = scene_on({chain({{-5, -1}, {5, -1}}), rubble(dice, 0.6)});
    scene.robot.clearance = trial % 3 == 0 ? 0 : 0.1;
    const Vector2d from(dice(-1, 1), dice(0, 1.2)), to(dice(-1, 1), dice(0, 1.2));
    double least = 1e9;
    bool crosses = false;
    for (const auto& segment : scene.terrain.segments()) {
      crosses = crosses || cross_each_other(from, to, segment.a, segment.b);
      for (const auto& end : {segment.a, segment.b}) least = std::min(least, sampled_distance(end, from, to));
      for (const auto& end : {from, to}) least = std::min(least, sampled_distance(end, segment.a, segment.b));
    }
    if (std::abs(least - scene.robot.clearance) < 1e-3) continue;
    const bool expected = !crosses && least > scene.robot.clearance;
    INFO("trial " << trial);
    CHECK(clear_of_terrain(scene, from, to) == expected);
    (expected ? clear : not_clear)++;
  }
  CHECK(clear > 50);
  CHECK(not_clear > 50);
}

TEST_CASE("the free leg can swing iff it can turn one way or the other", "[rules]") {
  Dice dice(3);
  int free = 0, blocked = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::vector<Chain> chains{chain({{-5, -1}, {5, -1}})};
    for (int i = 0; i < 3; ++i) {  // short bars at different heights, so that none crosses another
      const double x = dice(-0.5, 0.5), y = -0.4 + 0.3 * i;
      chains.push_back(chain({{x, y}, {x + dice(0.02, 0.3), y + dice(-0.1, 0.1)}}));
    }
    Scene scene = scene_on(chains);
    scene.robot.reach_min = 0.4;
    const Vector2d com(dice(-0.3, 0.3), dice(-0.3, 0.3)), old_foot(dice(-2, 2), -1), new_foot(dice(-2, 2), -1);
    // Turns of a leg of this length by less than a thousandth of a circle; whether any touches something.
    const auto can_turn = [&](double begin, double end, double length) {
      if (end < begin) end += 2 * std::numbers::pi;
      for (int i = 0; i <= 1000; ++i) {
        const double angle = begin + (end - begin) * i / 1000;
        const Vector2d tip = com + length * Vector2d(std::cos(angle), std::sin(angle));
        for (const auto& segment : scene.terrain.segments()) {
          if (cross_each_other(com, tip, segment.a, segment.b)) return false;
        }
      }
      return true;
    };
    const double a = std::atan2(old_foot.y() - com.y(), old_foot.x() - com.x());
    const double b = std::atan2(new_foot.y() - com.y(), new_foot.x() - com.x());
    const bool shorter = can_turn(a, b, 0.398) || can_turn(b, a, 0.398);
    const bool longer = can_turn(a, b, 0.402) || can_turn(b, a, 0.402);
    if (shorter != longer) continue;
    INFO("trial " << trial);
    CHECK(swing_is_free(scene, com, old_foot, new_foot) == longer);
    (longer ? free : blocked)++;
  }
  CHECK(free > 100);
  CHECK(blocked > 100);
}

TEST_CASE("a leg that may shorten to nothing can always swing", "[rules]") {
  Scene scene = scene_on(level_ground_and({chain({{-0.1, 0.4}, {0.1, 0.4}}), chain({{-0.1, 0.6}, {0.1, 0.6}})}));
  CHECK_FALSE(swing_is_free(scene, {0, 0.5}, {-0.4, 0}, {0.4, 0}));
  scene.robot.reach_min = 0;
  CHECK(swing_is_free(scene, {0, 0.5}, {-0.4, 0}, {0.4, 0}));
}

TEST_CASE("the plan made by hand breaks no rule, and is rated with the closed form", "[rules]") {
  Scene scene = scene_on(level_ground_and());
  scene.criterion = GENERATE(Criterion::robust, Criterion::equilibrium);
  Plan plan = plan_by_hand(scene);
  CHECK_FALSE(broken_start_rule(scene, plan.stances[0]).has_value());
  for (int k = 0; k < 2; ++k) {
    const auto at = static_cast<std::size_t>(k);
    CHECK_FALSE(broken_transfer_rule(scene, plan.stances[at], plan.transfers[at], plan.stances[at + 1].com,
                                     k == 0 ? scene.start.feet[2] : foot_at(scene, 4.8))
                    .has_value());
    CHECK_FALSE(broken_stance_rule(scene, plan.stances[at + 1]).has_value());
  }
  plan.safety_factor = 0;
  for (Stance& stance : plan.stances) stance.safety_factor = 0;
  for (Transfer& transfer : plan.transfers) transfer.safety_factor = 0;
  rate(scene, plan);
  for (const Stance& stance : plan.stances) CHECK(stance.safety_factor == Approx(2.5).epsilon(1e-9));
  for (const Transfer& transfer : plan.transfers) CHECK(transfer.safety_factor == Approx(2.5).epsilon(1e-9));
  CHECK(plan.safety_factor == Approx(2.5).epsilon(1e-9));
  CHECK_FALSE(plan.stances[0].limit.empty());
}

TEST_CASE("the start is what the scene says", "[rules]") {
  Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  scene.start.com = Vector2d(0.01, 0.5);
  CHECK(broken_start_rule(scene, plan.stances[0]) == Rule::gait);
  scene.start.com.reset();
  scene.start.feet[2] = foot_at(scene, 5.5);
  scene.start.support = std::pair(1, 2);
  CHECK(broken_start_rule(scene, plan.stances[0]) == Rule::gait);
  scene.start.support.reset();
  CHECK_FALSE(broken_start_rule(scene, plan.stances[0]).has_value());
  scene.start.feet[1] = foot_at(scene, 5.25);
  CHECK(broken_start_rule(scene, plan.stances[0]) == Rule::gait);
}

// One random step over random ground: what the rules accept, the verifier accepts; what they refuse, it refuses, and
// names the rule.
TEST_CASE("rules and verifier agree on random steps", "[rules][verifier]") {
  Dice dice(4);
  std::map<std::string, int> seen;
  for (int trial = 0; trial < 20000; ++trial) {
    Scene scene = scene_on({rubble(dice, dice(0, 0.3))});
    scene.robot.reach_max = dice(0.7, 1.2);
    scene.robot.reach_min = dice(0, 0.35);
    scene.criterion = trial % 4 == 0 ? Criterion::equilibrium : Criterion::robust;
    scene.goal = {std::pair(-9.0, 9.0), {}};
    const auto random_foot = [&](double x) {
      const auto found = scene.terrain.footholds_at_x(x);
      return found.empty() ? std::nullopt : std::optional(found.front());
    };
    scene.start.feet = {random_foot(dice(-0.4, 0)), random_foot(dice(0, 0.4)),
                        trial % 2 ? random_foot(dice(-0.6, 0)) : std::nullopt};
    scene.start.support = std::pair(0, 1);
    Plan plan;
    plan.status = Status::solved;
    Stance first{{scene.start.feet[0], scene.start.feet[1], std::nullopt}, {dice(-0.15, 0.15), dice(0.2, 0.7)}, 0, ""};
    const auto landing = random_foot(dice(0.2, 0.8));
    if (!first.feet[0] || !first.feet[1] || !landing) continue;
    Transfer transfer{2, *landing, dice.pick(3), 0, ""};
    Feet feet_after = feet_during(first, transfer);
    feet_after[static_cast<std::size_t>(transfer.lift)].reset();
    Stance second{feet_after, {dice(0, 0.5), dice(0.2, 0.7)}, 0, ""};
    plan.stances = {first, second};
    plan.transfers = {transfer};
    rate(scene, plan);
    auto broken = broken_start_rule(scene, first);
    if (!broken) broken = broken_transfer_rule(scene, first, transfer, second.com, scene.start.feet[2]);
    if (!broken) broken = broken_stance_rule(scene, second);
    const Verification verification = verify(scene, plan);
    INFO("trial " << trial << ": " << (broken ? to_string(*broken) : "holds"));
    INFO((verification.holds() ? std::string("no fault") : to_string(verification.faults.front())));
    if (!broken) {
      CHECK(verification.holds());
    } else {
      const bool named = std::any_of(verification.faults.begin(), verification.faults.end(),
                                     [&](const auto& fault) { return fault.rule == *broken; });
      CHECK(named);
    }
    ++seen[broken ? to_string(*broken) : "holds"];
  }
  // Each outcome is met often enough for the comparison to mean something.
  for (const char* outcome : {"holds", "reach", "clearance", "leg visibility", "swing", "stance stability"}) {
    INFO(outcome << " met " << seen[outcome] << " times");
    CHECK(seen[outcome] >= 20);
  }
}
