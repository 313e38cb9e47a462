// The verifier names stances and transfers that are not stable, and safety factors that are not those stated.
#include "gaits/verifier.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/gaits/fixtures.hpp"
#include "tests/gaits/verifier_faults.hpp"

using namespace surefoot;
using namespace surefoot::gaits;
using namespace surefoot::gaits::testing;

TEST_CASE("a stance is rejected where the centre of pressure can leave its feet", "[verifier]") {
  // Feet 0.2 m on either side, 0.1 * 0.5 + 0.03 = 0.08 m of sway: the COM may be 0.12 m off the middle.
  Scene scene = scene_on(level_ground_and());
  scene.goal = {std::pair(-1.0, 1.0), {}};
  Plan plan = plan_by_hand(scene);
  plan.stances.resize(1);
  plan.transfers.clear();
  const double x = GENERATE(0.119, 0.121, -0.119, -0.121);
  plan.stances[0].com.x() = x;
  plan.stances[0].safety_factor = plan.safety_factor = level_factor(scene, 0.2 - std::abs(x), 0.5);
  if (std::abs(x) < 0.12) {
    require_holds(verify(scene, plan));
  } else {
    require_only(verify(scene, plan), Rule::stance_stability, "stance 1", "not stable");
  }
}

// Feet on slopes -0.3, 0.1 and 1.2; rho = 0.05 m. At lambda = 0.65 the COM is (0.092, 0.44), the feet have
// r x n = -0.425, -0.086, -0.08 for n = (-slope, 1), and with p = 0, q = 0.04 the body falls free of all of them (FFF):
// n . a + (r x n) alpha = -1 - (r x n) q / rho^2 = 5.8, 0.38, 0.28 > 0.
TEST_CASE("a transfer is rejected that is stable at its ends and not between them", "[verifier]") {
  Scene scene =
      scene_on({chain({{-0.6, 0.095}, {-0.3, 0.005}, {-0.05, -0.01}, {0.15, 0.01}, {0.25, 0.14}, {0.35, 0.26}}, 1)});
  scene.robot.radius_of_gyration = 0.05;
  scene.robot.reach_min = 0.1;
  scene.disturbance = {0.05, 0.04};
  scene.goal = {std::pair(0.19, 0.19), {}};
  const auto foot = [&](double x) { return scene.terrain.footholds_at_x(x).at(0); };
  scene.start.feet = {foot(-0.45), foot(0.05), std::nullopt};
  Plan plan;
  plan.status = Status::solved;
  plan.stances = {Stance{scene.start.feet, {-0.09, 0.7}, 0, ""},
                  Stance{Feet{std::nullopt, foot(0.05), foot(0.3)}, {0.19, 0.3}, 0, ""}};
  plan.transfers = {Transfer{2, foot(0.3), 0, 0, ""}};
  rate(scene, plan);
  require_only(verify(scene, plan), Rule::transfer_stability, "transfer 1 (leg 3)", "not stable at lambda = 0.");
  CHECK(broken_transfer_rule(scene, plan.stances[0], plan.transfers[0], plan.stances[1].com, std::nullopt) ==
        Rule::transfer_stability);
  CHECK(plan.transfers[0].safety_factor < 1);
  CHECK(plan.stances[0].safety_factor > 1);
  CHECK(plan.stances[1].safety_factor > 1);

  // A robot that braces need not mind.
  scene.criterion = Criterion::equilibrium;
  rate(scene, plan);
  require_holds(verify(scene, plan));
}

TEST_CASE("the scene's friction decides, not the plan's", "[verifier]") {
  // kappa = 0.1: feet hold the whole box only where mu > 0.1.
  auto ground = chain({{-5, 0}, {5, 0}}, 0.09);
  const Scene slippery = scene_on({ground});
  const Plan plan = plan_by_hand(scene_on(level_ground_and()));
  require_fault(verify(slippery, plan), Rule::stance_stability, "stance 1", "not stable");
  require_fault(verify(slippery, plan), Rule::transfer_stability, "transfer 1 (leg 3)", "not stable");
}

TEST_CASE("stated safety factors are compared with those found", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  SECTION("of a stance") {
    plan.stances[1].safety_factor *= 1 + 1e-5;
    require_only(verify(scene, plan), Rule::stance_stability, "stance 2", "the stated safety factor is 2.50002");
  }
  SECTION("of a transfer") {
    plan.transfers[1].safety_factor *= 1 - 1e-5;
    require_only(verify(scene, plan), Rule::transfer_stability, "transfer 2 (leg 1)",
                 "the stated safety factor is 2.4999");
  }
  SECTION("of the plan: the least of all") {
    plan.safety_factor = 2.4;
    require_only(verify(scene, plan), Rule::gait, "plan", "the stated safety factor is 2.4");
  }
  SECTION("infinite or not a number") {
    plan.stances[1].safety_factor = std::numeric_limits<double>::infinity();
    require_only(verify(scene, plan), Rule::stance_stability, "stance 2", "the stated safety factor is inf");
    plan.stances[1].safety_factor = std::numeric_limits<double>::quiet_NaN();
    require_only(verify(scene, plan), Rule::stance_stability, "stance 2", "the stated safety factor is nan");
  }
  SECTION("six digits suffice") {
    plan.stances[1].safety_factor *= 1 + 9e-7;
    require_holds(verify(scene, plan));
  }
  SECTION("without disturbances the factor is infinite") {
    Scene calm = scene_on(level_ground_and());
    calm.disturbance = {0, 0};
    for (Stance& stance : plan.stances) stance.safety_factor = std::numeric_limits<double>::infinity();
    for (Transfer& transfer : plan.transfers) transfer.safety_factor = std::numeric_limits<double>::infinity();
    plan.safety_factor = std::numeric_limits<double>::infinity();
    require_holds(verify(calm, plan));
  }
}

TEST_CASE("a false factor is told of a stance that fails by another criterion, not of one that is not robust",
          "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  scene.criterion = Criterion::frictional;
  scene.restitution = 0.99;  // clattering on level ground dies out only for small ones
  Plan plan = plan_by_hand(scene);
  plan.stances[1].safety_factor = 99;
  require_fault(verify(scene, plan), Rule::stance_stability, "stance 2", "not frictionally stable");
  require_fault(verify(scene, plan), Rule::stance_stability, "stance 2", "the stated safety factor is 99");
  // What the plan only states wrongly comes last.
  const std::vector<Fault> faults = verify(scene, plan).faults;
  CHECK(faults.back().message.starts_with("the stated safety factor"));
  CHECK_FALSE(faults.front().stated);
  scene.criterion = Criterion::robust;
  scene.restitution.reset();
  plan = plan_by_hand(scene);
  plan.stances[1].com.x() += 10;  // out of balance
  int stated = 0, unstable = 0;
  for (const Fault& fault : verify(scene, plan).faults) {
    if (fault.place != "stance 2") continue;
    stated += fault.message.starts_with("the stated safety factor");
    unstable += fault.message.starts_with("not stable");
  }
  CHECK(unstable == 1);
  CHECK(stated == 0);
}
