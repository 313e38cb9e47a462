// The verifier names COMs out of reach or too near, legs that cut the terrain and swings that meet it.
#include "gaits/verifier.hpp"

#include <catch2/catch.hpp>

#include "tests/gaits/fixtures.hpp"
#include "tests/gaits/verifier_faults.hpp"

using namespace surefoot;
using namespace surefoot::gaits;
using namespace surefoot::gaits::testing;

TEST_CASE("a COM out of reach is rejected with leg, distance and place on the line", "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  SECTION("too far: leg 3 touches down 0.781 m away") {
    scene.robot.reach_max = 0.75;
    require_only(verify(scene, plan_by_hand(scene)), Rule::reach, "transfer 1 (leg 3)",
                 "foot 3 is 0.781024968 m from the COM at lambda = 0; at most 0.75 is allowed");
  }
  SECTION("too near in the middle of a line whose ends are far enough") {
    scene.robot.reach_min = 0.52;  // stances: sqrt(0.04 + 0.25) = 0.5385; over foot 2 at half way: 0.5
    const auto verification = verify(scene, plan_by_hand(scene));
    require_only(verification, Rule::reach, "transfer 1 (leg 3)",
                 "foot 2 is 0.5 m from the COM at lambda = 0.5; at least 0.52 is required");
    require_only(verification, Rule::reach, "transfer 2 (leg 1)", "foot 3 is 0.5 m");
    CHECK(verification.faults.size() == 2);
  }
  SECTION("limits are closed") {
    scene.robot.reach_max = std::hypot(0.6, 0.5);
    require_holds(verify(scene, plan_by_hand(scene)));
    scene.robot.reach_max = std::hypot(0.6, 0.5) * (1 - 1e-8);
    require_fault(verify(scene, plan_by_hand(scene)), Rule::reach, "transfer 1 (leg 3)", "foot 3");
  }
}

TEST_CASE("the COM keeps clear of terrain along the line and does not pass through it", "[verifier]") {
  SECTION("a needle hangs into the line") {
    const Scene scene = scene_on(level_ground_and({chain({{0.2, 1}, {0.2, 0.45}})}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::clearance, "transfer 1 (leg 3)",
                 "the COM meets the terrain (chain 1, segment 0)");
  }
  SECTION("it does so too where no clearance is asked for") {
    Scene scene = scene_on(level_ground_and({chain({{0.2, 1}, {0.2, 0.45}})}));
    scene.robot.clearance = 0;
    require_only(verify(scene, plan_by_hand(scene)), Rule::clearance, "transfer 1 (leg 3)", "meets the terrain");
  }
  SECTION("a needle ends 0.03 m above the line") {
    Scene scene = scene_on(level_ground_and({chain({{0.2, 1}, {0.2, 0.53}})}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::clearance, "transfer 1 (leg 3)",
                 "within 0.03 m of the terrain (chain 1, segment 0); 0.05 is required");
    scene.robot.clearance = 0.03 - 1e-12;
    require_holds(verify(scene, plan_by_hand(scene)));
  }
  SECTION("a COM at rest too near the ground") {
    Scene scene = scene_on(level_ground_and());
    scene.robot.clearance = 0.51;
    require_only(verify(scene, plan_by_hand(scene)), Rule::clearance, "stance 3", "within 0.5 m of the terrain");
  }
}

TEST_CASE("legs do not cut the terrain at touch-down, at lift-off and at the start", "[verifier]") {
  SECTION("touch-down: the leg from (0, 0.5) to (0.6, 0) passes (0.3, 0.25)") {
    const Scene scene = scene_on(level_ground_and({chain({{0.3, 0.24}, {0.3, 0.26}})}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::leg_visibility, "transfer 1 (leg 3)", "at touch-down leg 3");
  }
  SECTION("touching counts") {
    // A single stance on a dyadic grid: the leg from (0, 0.5) to (0.25, 0) passes (0.125, 0.25) exactly.
    for (const double end : {0.25, 0.2500001}) {
      Scene scene = scene_on(level_ground_and({chain({{0.125, 0.3}, {0.125, end}})}));
      scene.goal = {std::pair(-1.0, 1.0), {}};
      scene.start.feet = {foot_at(scene, 4.75), foot_at(scene, 5.25), std::nullopt};
      Plan plan = plan_by_hand(scene);
      plan.stances = {Stance{scene.start.feet, {0, 0.5}, level_factor(scene, 0.25, 0.5), ""}};
      plan.transfers.clear();
      plan.safety_factor = plan.stances[0].safety_factor;
      if (end == 0.25) {
        require_only(verify(scene, plan), Rule::leg_visibility, "stance 1", "meets chain 1");
      } else {
        require_holds(verify(scene, plan));
      }
    }
  }
  SECTION("lift-off: the leg from (0.4, 0.5) to (-0.2, 0) passes (-0.1, 0.083)") {
    const Scene scene = scene_on(level_ground_and({chain({{-0.1, 0.07}, {-0.1, 0.09}})}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::leg_visibility, "transfer 1 (leg 3)", "at lift-off leg 1");
  }
  SECTION("start: the leg from (0, 0.5) to (-0.2, 0) passes (-0.1, 0.25)") {
    const Scene scene = scene_on(level_ground_and({chain({{-0.1, 0.24}, {-0.1, 0.26}})}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::leg_visibility, "stance 1", "at the start leg 1");
  }
  SECTION("a robot below the ground: free space is on the left") {
    Scene scene = scene_on({chain({{5, 0}, {-5, 0}})});
    Plan plan = plan_by_hand(scene);
    for (std::size_t leg = 0; leg < 2; ++leg) scene.start.feet[leg] = plan.stances[0].feet[leg];
    require_fault(verify(scene, plan), Rule::leg_visibility, "stance 1", "leg 1 comes through the ground");
  }
}

TEST_CASE("the free leg must be able to swing one way or the other", "[verifier]") {
  // Transfer 2: leg 1 goes from (-0.2, 0) to (1, 0) about (0.4, 0.5); shortest it is 0.2 m long.
  const auto below = chain({{0.38, 0.35}, {0.42, 0.35}}), above = chain({{0.38, 0.65}, {0.42, 0.65}});
  SECTION("blocked both ways") {
    const Scene scene = scene_on(level_ground_and({below, above}));
    require_only(verify(scene, plan_by_hand(scene)), Rule::swing, "transfer 2 (leg 1)",
                 "cannot swing from (-0.2, 0) to (1, 0) about (0.4, 0.5): chain 1, segment 0 and chain 2, segment 0");
  }
  SECTION("one way free") {
    for (const auto& obstacle : {below, above}) {
      const Scene scene = scene_on(level_ground_and({obstacle}));
      require_holds(verify(scene, plan_by_hand(scene)));
    }
  }
  SECTION("a shorter leg passes between them") {
    Scene scene = scene_on(level_ground_and({below, above}));
    scene.robot.reach_min = 0.149;
    require_holds(verify(scene, plan_by_hand(scene)));
    scene.robot.reach_min = 0.151;
    require_only(verify(scene, plan_by_hand(scene)), Rule::swing, "transfer 2 (leg 1)", "cannot swing");
  }
  SECTION("the first step swings from the start foot, if there is one") {
    // About (0, 0.5) from (-0.4, 0) to (0.6, 0).
    Scene scene =
        scene_on(level_ground_and({chain({{-0.02, 0.35}, {0.02, 0.35}}), chain({{-0.02, 0.65}, {0.02, 0.65}})}));
    require_holds(verify(scene, plan_by_hand(scene)));
    scene.start.feet[2] = foot_at(scene, 4.6);
    require_only(verify(scene, plan_by_hand(scene)), Rule::swing, "transfer 1 (leg 3)", "cannot swing");
  }
}

TEST_CASE("a leg that was set down and lifted again swings from where it was set down", "[verifier]") {
  // Leg 3 is set down at x = 0.45 and lifted; then about (0.05, 0.5) it swings on to x = 0.6. Under the COM a bar spans
  // the directions from (0.45, 0) to (0.6, 0), another hangs above: blocked both ways. Neither is in the way of a leg.
  const Scene scene =
      scene_on(level_ground_and({chain({{0.17, 0.371}, {0.174, 0.374}}), chain({{0.03, 0.65}, {0.07, 0.65}})}));
  Plan plan = plan_by_hand(scene);
  plan.stances.insert(plan.stances.begin(), plan.stances.front());
  plan.stances[1].com = {0.05, 0.5};
  plan.transfers.insert(plan.transfers.begin(), Transfer{2, foot_at(scene, 5.45), 2, 0, ""});
  rate(scene, plan);
  require_only(verify(scene, plan), Rule::swing, "transfer 2 (leg 3)", "cannot swing from (0.45, 0) to (0.6, 0)");
  CHECK(broken_transfer_rule(scene, plan.stances[1], plan.transfers[1], plan.stances[2].com, foot_at(scene, 5.45)) ==
        Rule::swing);
}
