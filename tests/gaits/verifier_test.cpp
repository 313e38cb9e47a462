// The verifier accepts plans made by hand and names the rule of every single fault put into them.
#include "gaits/verifier.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/gaits/fixtures.hpp"

using namespace surefoot;
using namespace surefoot::gaits;
using surefoot::gaits::testing::chain;
using surefoot::gaits::testing::foot_at;
using surefoot::gaits::testing::level_factor;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::scene_on;

namespace {

std::string all_faults(const Verification& verification) {
  std::string text;
  for (const Fault& fault : verification.faults) text += to_string(fault) + "\n";
  return text;
}

/// Every fault is of this rule, and there is one at this place that says this.
void require_only(const Verification& verification, Rule rule, const std::string& place, const std::string& part) {
  INFO(all_faults(verification));
  REQUIRE_FALSE(verification.holds());
  bool found = false;
  for (const Fault& fault : verification.faults) {
    CHECK(fault.rule == rule);
    found = found || (fault.place == place && fault.message.find(part) != std::string::npos);
  }
  CHECK(found);
}

/// One such fault, whatever else is broken with it.
void require_fault(const Verification& verification, Rule rule, const std::string& place, const std::string& part) {
  INFO(all_faults(verification));
  bool found = false;
  for (const Fault& fault : verification.faults) {
    found = found || (fault.rule == rule && fault.place == place && fault.message.find(part) != std::string::npos);
  }
  CHECK(found);
}

void require_holds(const Verification& verification) {
  INFO(all_faults(verification));
  CHECK(verification.holds());
}

}  // namespace

TEST_CASE("a plan made by hand on level ground holds", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  const Verification verification = verify(scene, plan_by_hand(scene));
  require_holds(verification);
  CHECK(verification.stances == 3);
  CHECK(verification.transfers == 2);
}

TEST_CASE("the same plan holds for a robot that braces", "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  scene.criterion = Criterion::equilibrium;
  require_holds(verify(scene, plan_by_hand(scene)));
}

TEST_CASE("lifting the leg that was just placed is a legal way to shift the COM", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  // Leg 3 is set down at x = 0.45 and lifted again; the COM goes to x = 0.05 meanwhile: 0.15 m to foot 2.
  const double sigma = level_factor(scene, 0.15, 0.5);
  const auto middle = foot_at(scene, 5.45);
  plan.stances.insert(plan.stances.begin(), plan.stances.front());
  plan.stances[1].com = {0.05, 0.5};
  plan.stances[1].safety_factor = sigma;
  // On the line the outer feet are at -0.2 and 0.45: 0.2 m at its start is the least.
  plan.transfers.insert(plan.transfers.begin(), Transfer{2, middle, 2, level_factor(scene, 0.2, 0.5), ""});
  plan.safety_factor = sigma;
  require_holds(verify(scene, plan));
}

TEST_CASE("a plan of no step holds where the start reaches the goal", "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  scene.goal = {std::pair(-0.1, 0.1), std::pair(0.5, 0.5)};
  Plan plan = plan_by_hand(scene);
  plan.stances.resize(1);
  plan.transfers.clear();
  require_holds(verify(scene, plan));
}

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

TEST_CASE("which legs are placed and lifted is checked", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  SECTION("another leg lifted than the next stance says") {
    plan.transfers[0].lift = 1;
    const auto verification = verify(scene, plan);
    require_fault(verification, Rule::gait, "transfer 1 (leg 3)", "leg 2 is lifted but stands in stance 2");
    require_fault(verification, Rule::gait, "transfer 1 (leg 3)", "leg 1 stands and is not lifted");
  }
  SECTION("a leg placed that stands already") {
    plan.transfers[0].leg = 1;
    require_fault(verify(scene, plan), Rule::gait, "transfer 1 (leg 2)", "leg 2 is placed but stands already");
  }
  SECTION("a foot that moves while it stands") {
    plan.stances[1].feet[1] = foot_at(scene, 5.2 + 1e-12);
    const auto verification = verify(scene, plan);
    require_only(verification, Rule::gait, "transfer 1 (leg 3)", "foot 2 stands at chain 0, s = 5.2, but in stance 2");
  }
  SECTION("a leg that comes down elsewhere than the next stance says") {
    plan.transfers[0].foothold = foot_at(scene, 5.55);
    require_only(verify(scene, plan), Rule::gait, "transfer 1 (leg 3)", "foot 3 stands at chain 0, s = 5.55");
  }
  SECTION("legs that do not exist") {
    const int leg = GENERATE(-1, 3, 1000000);
    plan.transfers[1].leg = leg;
    require_fault(verify(scene, plan), Rule::gait, "transfer 2 (leg " + std::to_string(leg + 1) + ")",
                  "legs are numbered 1 to 3");
    plan = plan_by_hand(scene);
    plan.transfers[1].lift = leg;
    require_fault(verify(scene, plan), Rule::gait, "transfer 2 (leg 1)", "legs are numbered 1 to 3");
  }
  SECTION("three feet or one in a stance") {
    plan.stances[1].feet[0] = plan.stances[0].feet[0];
    require_fault(verify(scene, plan), Rule::gait, "stance 2", "3 feet are planted");
    plan.stances[1].feet = {};
    plan.stances[1].feet[1] = foot_at(scene, 5.2);
    require_fault(verify(scene, plan), Rule::gait, "stance 2", "1 feet are planted");
  }
  SECTION("a missing transfer, a missing stance") {
    plan.transfers.pop_back();
    require_only(verify(scene, plan), Rule::gait, "plan", "3 stances and 1 transfers");
    plan = plan_by_hand(scene);
    plan.stances.pop_back();
    require_fault(verify(scene, plan), Rule::gait, "plan", "2 stances and 2 transfers");
  }
  SECTION("no stances at all, or a status that claims nothing") {
    plan.status = Status::no_plan_found;
    require_only(verify(scene, plan), Rule::gait, "plan", "status is no_plan_found");
    plan = Plan{};
    plan.status = Status::solved;
    require_only(verify(scene, plan), Rule::gait, "plan", "there are no stances");
  }
}

TEST_CASE("feet stand where the scene lets them, and where the plan says", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  SECTION("on a vertex") {
    const Scene broken = scene_on({chain({{-5, 0}, {0.6, 0}, {5, 0}})});
    plan.stances[1].feet[2]->s = plan.stances[2].feet[2]->s = plan.transfers[0].foothold.s = 5.6;
    plan.transfers[1].foothold.segment = plan.stances[2].feet[0]->segment = 1;
    require_fault(verify(broken, plan), Rule::foothold, "transfer 1 (leg 3)", "on a vertex of chain 0 (s = 5.6)");
    require_fault(verify(broken, plan), Rule::foothold, "stance 2", "foot 3 stands on a vertex");
  }
  SECTION("on a segment where no foot may stand") {
    auto ground = chain({{-5, 0}, {0.5, 0}, {0.7, 0}, {5, 0}});
    ground.surfaces[1].foothold = false;
    const Scene broken = scene_on({ground});
    plan.stances[1].feet[2]->segment = plan.stances[2].feet[2]->segment = plan.transfers[0].foothold.segment = 1;
    plan.transfers[1].foothold.segment = plan.stances[2].feet[0]->segment = 2;
    require_only(verify(broken, plan), Rule::foothold, "transfer 1 (leg 3)", "segment 1 of chain 0, where no foot may");
  }
  SECTION("outside the chain, on another chain, at no number") {
    terrain::Foothold& foot = plan.transfers[0].foothold;
    foot.s = 12;
    require_fault(verify(scene, plan), Rule::foothold, "transfer 1 (leg 3)", "s = 12, outside chain 0");
    foot.s = -1;
    require_fault(verify(scene, plan), Rule::foothold, "transfer 1 (leg 3)", "s = -1, outside chain 0");
    foot.s = std::numeric_limits<double>::quiet_NaN();
    require_fault(verify(scene, plan), Rule::foothold, "transfer 1 (leg 3)", "s = nan, outside chain 0");
    foot = foot_at(scene, 5.6);
    foot.chain = GENERATE(-1, 1, 77);
    require_fault(verify(scene, plan), Rule::foothold, "transfer 1 (leg 3)", "which does not exist");
  }
  SECTION("elsewhere than stated") {
    plan.stances[1].feet[2]->position.y() = 1e-6;
    require_only(verify(scene, plan), Rule::foothold, "stance 2", "foot 3 is said to stand at");
    plan = plan_by_hand(scene);
    plan.stances[1].feet[2]->position.x() = std::numeric_limits<double>::quiet_NaN();
    require_only(verify(scene, plan), Rule::foothold, "stance 2", "foot 3 is said to stand at");
    plan = plan_by_hand(scene);
    plan.stances[1].feet[2]->segment = 1;
    require_only(verify(scene, plan), Rule::foothold, "stance 2", "foot 3 is said to stand on segment 1");
  }
  SECTION("normals and friction in a plan are not believed") {
    plan.stances[0].feet[0]->normal = {1, 0};
    plan.stances[0].feet[0]->friction = 0;
    require_holds(verify(scene, plan));
  }
}

TEST_CASE("the scene's friction decides, not the plan's", "[verifier]") {
  // kappa = 0.1: feet hold the whole box only where mu > 0.1.
  auto ground = chain({{-5, 0}, {5, 0}}, 0.09);
  const Scene slippery = scene_on({ground});
  const Plan plan = plan_by_hand(scene_on(level_ground_and()));
  require_fault(verify(slippery, plan), Rule::stance_stability, "stance 1", "not stable");
  require_fault(verify(slippery, plan), Rule::transfer_stability, "transfer 1 (leg 3)", "not stable");
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

TEST_CASE("the goal is reached by the last stance", "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  SECTION("in x") {
    scene.goal = {std::pair(0.81, 0.9), {}};
    require_only(verify(scene, plan), Rule::gait, "stance 3", "the last COM has x = 0.8, the goal is [0.81, 0.9]");
  }
  SECTION("in y") {
    scene.goal.com_y = std::pair(0.1, 0.49);
    require_only(verify(scene, plan), Rule::gait, "stance 3", "the last COM has y = 0.5, the goal is [0.1, 0.49]");
  }
  SECTION("ends are included") {
    scene.goal = {std::pair(0.8, 0.8), std::pair(0.5, 0.5)};
    require_holds(verify(scene, plan));
  }
}

TEST_CASE("the plan starts as the scene says", "[verifier]") {
  Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  SECTION("another COM") {
    scene.start.com = Eigen::Vector2d(0.01, 0.5);
    require_only(verify(scene, plan), Rule::gait, "stance 1", "the COM is at (0, 0.5), but starts at (0.01, 0.5)");
    scene.start.com = Eigen::Vector2d(0, 0.5);
    require_holds(verify(scene, plan));
  }
  SECTION("another foothold") {
    scene.start.feet[1] = foot_at(scene, 5.21);
    require_only(verify(scene, plan), Rule::gait, "stance 1", "foot 2 stands at chain 0, s = 5.2, but starts at");
  }
  SECTION("a leg that starts in the air") {
    scene.start.feet[0].reset();
    const auto verification = verify(scene, plan);
    require_only(verification, Rule::gait, "stance 1", "leg 1 stands, but it starts in the air");
  }
  SECTION("other legs that carry") {
    scene.start.feet[2] = foot_at(scene, 5.6);
    scene.start.support = std::pair(0, 2);
    const auto verification = verify(scene, plan);
    require_only(verification, Rule::gait, "stance 1", "carried by legs 1 and 3, but leg 2 stands");
    require_only(verification, Rule::gait, "stance 1", "carried by legs 1 and 3, but leg 3 does not stand");
    scene.start.support = std::pair(0, 1);
    require_holds(verify(scene, plan));
  }
}

TEST_CASE("numbers that are none are faults, not crashes", "[verifier]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  const auto k = static_cast<std::size_t>(GENERATE(0, 1, 2));
  plan.stances[k].com.y() = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  require_only(verify(scene, plan), Rule::gait, "stance " + std::to_string(k + 1), "not a pair of finite numbers");
}

TEST_CASE("all faults are reported, not the first only", "[verifier]") {
  Scene scene = scene_on(level_ground_and({chain({{0.3, 0.24}, {0.3, 0.26}})}));
  scene.robot.reach_max = 0.75;
  scene.goal = {std::pair(2.0, 3.0), {}};
  const auto verification = verify(scene, plan_by_hand(scene));
  require_fault(verification, Rule::leg_visibility, "transfer 1 (leg 3)", "at touch-down leg 3");
  require_fault(verification, Rule::reach, "transfer 1 (leg 3)", "foot 3");
  require_fault(verification, Rule::reach, "transfer 1 (leg 3)", "foot 1");
  require_fault(verification, Rule::reach, "transfer 2 (leg 1)", "foot 1");
  require_fault(verification, Rule::gait, "stance 3", "the goal is [2, 3]");
}
