// Refinement: never worse, always verified, better where there is room, the same every time.
#include "planner/refine.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "planner/refine_model.hpp"
#include "planner/search.hpp"

using namespace surefoot;

namespace {

/// Level ground, two feet 1 m apart, and a third in reach: everything can be computed by hand.
gaits::Scene level_scene(const std::string& rest, const std::string& friction = "2") {
  return gaits::parse_scene("surefoot: 1\nterrain: {friction: " + friction +
                                ", chains: [{vertices: [[-2, 0], [3, 0]]}]}\n"
                                "robot: {radius_of_gyration: 0.3, reach: [0.3, 1.2], clearance: 0.25}\n"
                                "disturbance: {kappa: 0.1, nu: 0.1}\n" +
                                rest,
                            "level.yaml");
}

/// One step: feet at 0 and 1, leg 3 is placed at 0.9, leg 2 is lifted.
gaits::Plan one_step(const gaits::Scene& scene, Eigen::Vector2d from, Eigen::Vector2d to) {
  const auto foot = [&](double x) { return scene.terrain.footholds_at_x(x).front(); };
  gaits::Plan plan;
  plan.scene = scene.name;
  plan.status = gaits::Status::solved;
  plan.planner = "by hand";
  gaits::Stance first, second;
  first.feet = {foot(0), foot(1), std::nullopt};
  first.com = from;
  second.feet = {foot(0), std::nullopt, foot(0.9)};
  second.com = to;
  plan.stances = {first, second};
  gaits::Transfer transfer;
  transfer.leg = 2, transfer.lift = 1, transfer.foothold = foot(0.9);
  plan.transfers = {transfer};
  gaits::rate(scene, plan);
  return plan;
}

const std::string start = "start: {feet: [{x: 0}, {x: 1}, null], support: [1, 2]";

}  // namespace

TEST_CASE("The model's maximiser reaches the vertex where cuts and reach meet", "[refine]") {
  // Maximise min(x, 2 - x + y) with y <= 0.5 from the bounds and |(x, y)| <= 1.2: x = 1 + y/2, on the circle.
  planner::RefineModel model;
  const auto cut = [](int element, double offset, double gx, double gy) {
    return planner::Cut{.element = element, .offset = offset, .gradient = Eigen::Vector2d(gx, gy)};
  };
  model.factors = {cut(0, 0, 1, 0), cut(1, 2, -1, 1)};
  planner::MovingPoint com, foot;
  com.first = 0, com.count = 2;
  model.reach = {{com, com, foot}};
  model.reach_min = 0.1, model.reach_max = 1.2;
  model.lower = Eigen::Vector2d(-5, -5), model.upper = Eigen::Vector2d(5, 0.5);
  model.sum_gradient = Eigen::Vector2d::Zero();
  double gain = 0;
  const Eigen::VectorXd x = planner::maximise(model, Eigen::Vector2d(0.6, 0), 0.6, 1.0, gain);
  // (1 + y/2)^2 + y^2 = 1.44: 1.25 y^2 + y - 0.44 = 0.
  const double y = (-1 + std::sqrt(1 + 4 * 1.25 * 0.44)) / 2.5;
  CHECK(x[0] == Approx(1 + y / 2).margin(2e-3));
  CHECK(x[1] == Approx(y).margin(5e-3));
  CHECK(gain == Approx(1 + y / 2 - 0.6).margin(2e-3));
}

TEST_CASE("A poor plan becomes a good one that the verifier accepts", "[refine]") {
  const auto scene = level_scene(start + "}\ngoal: {com_x: [0.1, 0.8]}\n");
  const gaits::Plan poor = one_step(scene, {0.3, 0.8}, {0.25, 0.8});
  REQUIRE(gaits::verify(scene, poor).holds());
  const gaits::Plan refined = planner::refine(scene, poor);
  CHECK(gaits::verify(scene, refined).holds());
  REQUIRE(refined.safety_factor_before_refinement);
  CHECK(*refined.safety_factor_before_refinement == Approx(poor.safety_factor));
  // Tipping about the nearer foot at distance d and height h takes d / (0.1 h + 0.1). The second stance has at most
  // 0.5 m on each side (foot 3 can move under the COM's other side), so with h >= 0.25 nothing exceeds 0.5 / 0.125 = 4.
  CHECK(refined.safety_factor > 1.8 * poor.safety_factor);
  CHECK(refined.safety_factor > 3);
  CHECK(refined.steps() == 1);
}

TEST_CASE("A given start COM stays and the last COM stays in the goal", "[refine]") {
  const auto scene = level_scene(start + ", com: [0.3, 0.8]}\ngoal: {com_x: [0.2, 0.26], com_y: [0.5, 0.9]}\n");
  const gaits::Plan poor = one_step(scene, {0.3, 0.8}, {0.25, 0.8});
  REQUIRE(gaits::verify(scene, poor).holds());
  const gaits::Plan refined = planner::refine(scene, poor);
  CHECK(gaits::verify(scene, refined).holds());
  CHECK(refined.stances[0].com == poor.stances[0].com);
  CHECK(scene.goal.contains(refined.stances[1].com));
  CHECK(refined.safety_factor > poor.safety_factor);
}

TEST_CASE("Where friction alone limits, or nothing does, refinement is left out with the reason and nothing is lost",
          "[refine]") {
  auto scene = level_scene(start + "}\ngoal: {com_x: [0.1, 0.8]}\n", "0.2");
  // Slipping takes 0.2 = 0.15 s wherever the COM is; tipping takes at least 0.45 = 0.15 * 0.5 s.
  scene.disturbance = {0.15, 0};
  const gaits::Plan slipping = one_step(scene, {0.5, 0.5}, {0.45, 0.5});
  REQUIRE(slipping.safety_factor == Approx(0.2 / 0.15));
  const gaits::Plan left = planner::refine(scene, slipping);
  REQUIRE(left.left_out.size() == slipping.left_out.size() + 1);
  CHECK_THAT(left.left_out.back().why, Catch::Contains("friction"));
  planner::RefineOptions all;
  all.leave_out = false;
  CHECK(planner::refine(scene, slipping, all).safety_factor == Approx(left.safety_factor));
  scene.disturbance = {0, 0};
  const gaits::Plan calm = one_step(scene, {0.3, 0.8}, {0.25, 0.8});
  REQUIRE(std::isinf(calm.safety_factor));
  const gaits::Plan same = planner::refine(scene, calm);
  REQUIRE(same.left_out.size() == 1);
  CHECK_THAT(same.left_out.back().why, Catch::Contains("infinite"));
  CHECK(gaits::verify(scene, same).holds());
}

TEST_CASE("No plan of a canned scene is made worse, all hold, and the result is repeatable", "[refine][maps]") {
  int improved = 0, plans = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS)) {
    const std::string name = entry.path().stem().string();
    if (name == "long_rubble" || !std::filesystem::exists(SUREFOOT_TESTS_DIR "/regression/golden/" + name + ".json"))
      continue;
    const auto scene = gaits::load_scene(entry.path().string());
    planner::SearchOptions options;
    options.time_limit = 300;
    options.effort = 0;
    const gaits::Plan found = planner::search(scene, options);
    INFO(scene.name);
    REQUIRE(found.status == gaits::Status::solved);
    REQUIRE(gaits::verify(scene, found).holds());
    const gaits::Plan refined = planner::refine(scene, found), again = planner::refine(scene, found);
    CHECK(gaits::verify(scene, refined).holds());
    CHECK(refined.safety_factor >= found.safety_factor);
    CHECK(gaits::to_json(refined) == gaits::to_json(again));
    CHECK(refined.steps() == found.steps());
    ++plans;
    improved += refined.safety_factor > 1.05 * found.safety_factor;
  }
  CHECK(plans >= 8);
  CHECK(improved >= plans / 2);
}

TEST_CASE("A start COM of our choice stays where both legs are visible, so that the gain is kept", "[refine]") {
  // A bar hangs beside the second start foot: above it the COM is safer for its neighbours but hides the leg.
  const auto scene = gaits::parse_scene(
      "surefoot: 1\nterrain: {friction: 0.6, chains: [{vertices: [[-1, 0], [6, 0]]},\n"
      "  {vertices: [[0.075, 0.2], [0.075, 0.02]]}]}\n"
      "robot: {radius_of_gyration: 0.2, reach: [0.2, 0.9], clearance: 0.1}\n"
      "disturbance: {kappa: 0.08, nu: 0.02}\n"
      "start: {feet: [{x: -0.4}, {x: 0.2}, {x: -0.1}], support: [1, 2]}\ngoal: {com_x: [1.5, 1.8]}\n",
      "bar.yaml");
  int solved = 0;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    planner::SearchOptions options;
    options.seed = seed;
    options.effort = 0;        // of the first plan, another stance than the start is the weakest
    options.time_limit = 300;  // never the limit here: budgets are iterations
    const gaits::Plan found = planner::search(scene, options);
    if (found.status != gaits::Status::solved) continue;
    CAPTURE(seed);
    ++solved;
    const gaits::Plan refined = planner::refine(scene, found);
    CHECK(gaits::verify(scene, refined).holds());
    CHECK(refined.safety_factor > found.safety_factor);
  }
  CHECK(solved >= 4);
}

TEST_CASE("No window is begun after the deadline, and the plan still holds and says so", "[refine]") {
  const auto scene = level_scene(start + "}\ngoal: {com_x: [0.1, 0.8]}\n");
  const gaits::Plan poor = one_step(scene, {0.3, 0.8}, {0.25, 0.8});
  planner::RefineOptions options;
  options.deadline = {};  // long ago
  const gaits::Plan same = planner::refine(scene, poor, options);
  CHECK(gaits::verify(scene, same).holds());
  CHECK(same.stances[0].com == poor.stances[0].com);
  CHECK(same.stances[1].com == poor.stances[1].com);
  REQUIRE(same.left_out.size() == poor.left_out.size() + 1);
  CHECK(same.left_out.back().why == "the time limit was reached");
}

TEST_CASE("A plan that is not solved comes back as it is", "[refine]") {
  const auto scene = level_scene(start + "}\ngoal: {com_x: [0.1, 0.8]}\n");
  gaits::Plan none;
  none.reason = "limit reached";
  const gaits::Plan same = planner::refine(scene, none);
  CHECK(same.status == gaits::Status::no_plan_found);
  CHECK(same.reason == "limit reached");
  CHECK_FALSE(same.safety_factor_before_refinement);
}

TEST_CASE("What cannot be refined is refused with words", "[refine][misuse]") {
  const auto scene = level_scene(start + "}\ngoal: {com_x: [0.1, 0.8]}\n");
  gaits::Plan plan = one_step(scene, {0, 0.4}, {0.2, 0.4});
  plan.stances.pop_back();
  CHECK_THROWS_WITH(planner::refine(scene, plan), Catch::Contains("one stance more than transfers"));
  plan = one_step(scene, {0, 0.4}, {0.2, 0.4});
  planner::RefineOptions options;
  options.window = 0;
  CHECK_THROWS_WITH(planner::refine(scene, plan, options), Catch::Contains("window"));
}
