// Scenes that ask for frictional stability get it at every stance. Others do not pay for it.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "planner/problem.hpp"
#include "planner/search.hpp"
#include "planner/step_proposals.hpp"
#include "stability/decisions.hpp"
#include "stability/frictional.hpp"

using namespace surefoot;

namespace {

// Level ground takes a low body of long, grippy legs: with feet at distances b from the COM at height h, friction
// between b h / (rho^2 + h^2) and b / h, and b > 2.06 rho for e = 0.1 (psi > 0.618).
gaits::Scene scene_with(const std::string& stability) {
  return gaits::parse_scene(
      "surefoot: 1\nname: low\nterrain:\n  friction: 2\n  chains:\n    - vertices: [[-3, 0], [8, 0]]\n"
      "robot: {radius_of_gyration: 0.15, reach: [0.05, 1.6], clearance: 0.03}\n"
      "disturbance: {kappa: 0.05, nu: 0.01}\n" +
          stability +
          "start: {feet: [{x: -0.4}, {x: 0.4}, {x: -0.3}], support: [1, 2], com: [0, 0.12]}\n"
          "goal: {com_x: [1.5, 2]}\n",
      "low");
}

gaits::Plan run(const gaits::Scene& scene, const std::string& planner) {
  planner::SearchOptions options;
  options.planner = planner;
  options.time_limit = 300;  // never the limit here: budgets are work
  options.effort = 0.05;
  stability::decisions = {};
  return planner::search(scene, options);
}

std::string why_left_out(const gaits::Plan& plan) {
  for (const auto& note : plan.left_out)
    if (note.what == "frictional stability") return note.why;
  return "";
}

void require_holds(const gaits::Scene& scene, const gaits::Plan& plan) {
  INFO(plan.planner << ": " << plan.reason);
  REQUIRE(plan.status == gaits::Status::solved);
  REQUIRE(plan.steps() > 0);
  const auto verification = gaits::verify(scene, plan);
  for (const auto& fault : verification.faults) UNSCOPED_INFO(fault.place << ": " << fault.message);
  CHECK(verification.holds());
}

int unstable_stances(const gaits::Scene& scene, const gaits::Plan& plan, double restitution) {
  int count = 0;
  for (const auto& stance : plan.stances) {
    std::vector<stability::Contact> contacts;
    for (const auto& foot : stance.feet)
      if (foot) contacts.push_back({foot->position, foot->normal, foot->friction});
    const stability::Posture posture(contacts, scene.robot.radius_of_gyration);
    count += !stability::frictionally_stable(posture, stance.com, restitution);
  }
  return count;
}

}  // namespace

TEST_CASE("a scene with criterion both and restitution 0.1 plans and verifies, every stance frictionally stable",
          "[frictional]") {
  const std::string planner = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  const std::string criterion = GENERATE("both", "frictional");
  CAPTURE(planner, criterion);
  const gaits::Scene scene = scene_with("stability: {criterion: " + criterion + ", restitution: 0.1}\n");
  const gaits::Plan plan = run(scene, planner);
  require_holds(scene, plan);
  CHECK(unstable_stances(scene, plan, 0.1) == 0);
  CHECK(stability::decisions.frictional > 0);
  CHECK(why_left_out(plan) == "");
}

TEST_CASE("a scene without restitution executes nothing of frictional stability and says so", "[frictional]") {
  const std::string planner = GENERATE("auto", "Layers", "RRT");
  const gaits::Scene scene = scene_with("");
  const gaits::Plan plan = run(scene, planner);
  require_holds(scene, plan);
  CHECK(stability::decisions.frictional == 0);
  CHECK(stability::decisions.modes_by_rows + stability::decisions.modes_by_screen > 0);  // it did count
  CHECK(why_left_out(plan) == "no restitution is given");
}

TEST_CASE("a restitution alone does not ask for frictional stability", "[frictional]") {
  const gaits::Scene scene = scene_with("stability: {restitution: 0.1}\n");
  const gaits::Plan plan = run(scene, "Layers");
  require_holds(scene, plan);
  CHECK(stability::decisions.frictional == 0);
  CHECK(why_left_out(plan) == "the criterion does not ask for it");
}

TEST_CASE("a plan of criterion robust does not verify where both is asked and a stance would clatter on",
          "[frictional]") {
  const gaits::Plan plan = run(scene_with(""), "Layers");
  const gaits::Scene scene = scene_with("stability: {criterion: both, restitution: 0.1}\n");
  REQUIRE(plan.status == gaits::Status::solved);
  const int unstable = unstable_stances(scene, plan, 0.1);
  REQUIRE(unstable > 0);
  const auto verification = gaits::verify(scene, plan);
  int faults = 0;
  for (const auto& fault : verification.faults) faults += fault.message.find("frictionally") != std::string::npos;
  CHECK(faults == unstable);
}

TEST_CASE("frictional criteria without a restitution are refused at their place", "[frictional]") {
  const std::string criterion = GENERATE("both", "frictional");
  CHECK_THROWS_WITH(scene_with("stability: {criterion: " + criterion + "}\n"),
                    Catch::Contains("low:9:24: criterion: frictional stability needs a restitution"));
}

TEST_CASE("under criterion frictional the first stance need not bear the disturbances of the transfers",
          "[frictional]") {
  const std::string text =
      "surefoot: 1\nterrain:\n  friction: 2\n  chains:\n    - vertices: [[-3, 0], [8, 0]]\n"
      "robot: {radius_of_gyration: 0.15, reach: [0.05, 1.6], clearance: 0.03}\n"
      "disturbance: {kappa: 2.5, nu: 0.01}\n"  // more than friction bears
      "stability: {criterion: CRITERION, restitution: 0.1}\n"
      "start: {feet: [{x: -0.4}, {x: 0.4}, {x: -0.3}], support: [1, 2]}\n"
      "goal: {com_x: [1.5, 2]}\n";
  const auto scene_of = [&text](const std::string& criterion) {
    std::string scene = text;
    return gaits::parse_scene(scene.replace(scene.find("CRITERION"), 9, criterion), "slow");
  };
  const gaits::Scene frictional = scene_of("frictional"), both = scene_of("both");
  planner::StepProposals proposals(frictional), strict(both);
  const planner::StartChoice start = planner::choose_start(proposals), refused = planner::choose_start(strict);
  REQUIRE_FALSE(start.nodes.empty());
  for (const planner::Node& node : start.nodes) {
    const std::vector<stability::Contact> feet{{{-0.4, 0}, {0, 1}, 2}, {{0.4, 0}, {0, 1}, 2}};
    const stability::Posture posture(feet, 0.15);
    CHECK(stability::frictional_verdict(posture, node.com, 0.1).stable());
  }
  CHECK(refused.nodes.empty());
  CHECK(refused.decided);
}
