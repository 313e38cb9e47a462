// The verifier accepts plans made by hand, and names every fault of their feet, legs, start and goal.
#include "gaits/verifier.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/gaits/fixtures.hpp"
#include "tests/gaits/verifier_faults.hpp"

using namespace surefoot;
using namespace surefoot::gaits;
using namespace surefoot::gaits::testing;

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
    require_fault(verify(scene, plan), Rule::gait, "stance 2", "1 foot is planted");
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
    require_only(verify(scene, plan), Rule::foothold, "stance 2",
                 "foot 3 is said to stand on segment 1, but its position and s lie on segment 0 of chain 0");
  }
  SECTION("on other segments than stated: vertices may have come or gone only if all feet further along say so") {
    const auto moved = [&](std::size_t k, std::size_t leg, int by) { plan.stances[k].feet[leg]->segment += by; };
    moved(0, 0, 1);   // the first foothold
    moved(2, 0, -1);  // the last
    auto found = verify(scene, plan);
    CHECK(found.faults.size() == 2);
    for (const auto& fault : found.faults) CHECK(fault.message.find("vertices") == std::string::npos);
    require_fault(found, Rule::foothold, "stance 1", "foot 1 is said to stand on segment 1, but");
    require_fault(found, Rule::foothold, "stance 3", "foot 1 is said to stand on segment -1, but");
    plan = plan_by_hand(scene);
    moved(2, 0, 1);
    plan.transfers[1].foothold.segment += 1;
    require_only(verify(scene, plan), Rule::foothold, "stance 3",
                 "lie on segment 0 of chain 0: have vertices before it come or gone?");
    for (const auto& [k, leg] : {std::pair(1, 2), std::pair(2, 2)}) moved(k, leg, 1);  // the one before it
    plan.transfers[0].foothold.segment += 1;
    found = verify(scene, plan);
    CHECK(found.faults.size() == 5);
    require_only(found, Rule::foothold, "stance 2", "the segment stated of a foot on chain 0 is 1 too high");
    moved(2, 0, 1);  // two vertices before the last foothold
    plan.transfers[1].foothold.segment += 1;
    require_only(verify(scene, plan), Rule::foothold, "stance 3", "of a foot on chain 0 is 2 too high");
    plan.transfers[1].foothold.segment -= 1;  // twice the same foothold, and not the same segment
    for (const auto& fault : verify(scene, plan).faults) CHECK(fault.message.find("vertices") == std::string::npos);
  }
  SECTION("normals and friction in a plan are not believed") {
    plan.stances[0].feet[0]->normal = {1, 0};
    plan.stances[0].feet[0]->friction = 0;
    require_holds(verify(scene, plan));
  }
}

TEST_CASE("what has moved the terrain away from feet is told, and these are not judged", "[verifier]") {
  const Plan plan = plan_by_hand(scene_on(level_ground_and()));  // on a chain from (-5, 0) to (5, 0)
  SECTION("a chain that begins elsewhere") {
    const double by = GENERATE(-0.75, 2.5);
    const auto found = verify(scene_on({chain({{-5 - by, 0}, {5, 0}})}), plan);
    REQUIRE(found.faults.size() == 1);
    const std::string words = std::string("begins ") + (by > 0 ? "2.5 m earlier" : "0.75 m later");
    require_only(found, Rule::foothold, "plan", words);
    require_only(found, Rule::foothold, "plan", "4 footholds lie on the ground where the plan says");
    CHECK(found.stances_with_lost_feet == 3);
    CHECK(found.transfers_with_lost_feet == 2);
  }
  SECTION("another chain before it") {
    Scene scene = scene_on({chain({{-9, -9}, {-8, -9}}), chain({{-5, 0}, {5, 0}})});
    scene.start.feet = {scene.terrain.foothold_at(1, 4.8), scene.terrain.foothold_at(1, 5.2), std::nullopt};
    const auto found = verify(scene, plan);
    REQUIRE(found.faults.size() == 1);
    require_only(found, Rule::foothold, "plan", "feet of chain 0 lie on chain 1 now");
  }
  SECTION("a detour before the later feet: the others are judged") {
    const auto found = verify(scene_on({chain({{-5, 0}, {0.3, 0}, {0.35, -0.5}, {0.4, 0}, {5, 0}})}), plan);
    REQUIRE(found.faults.size() == 1);
    require_only(found, Rule::foothold, "plan", "or is that much longer before these feet");
    require_only(found, Rule::foothold, "plan", "2 footholds lie on the ground");
    CHECK(found.stances_with_lost_feet == 2);
    CHECK(found.transfers_with_lost_feet == 2);
  }
  SECTION("vertices under feet: no chain has moved") {
    const auto found = verify(scene_on({chain({{-5, 0}, {0.6, 0}, {1, 0}, {5, 0}})}), plan);
    require_fault(found, Rule::foothold, "stance 2", "foot 3 stands on a vertex of chain 0 (s = 5.6)");
    require_fault(found, Rule::foothold, "stance 3", "foot 1 stands on a vertex of chain 0 (s = 6)");
    CHECK(all_faults(found).find("plan: foothold") == std::string::npos);
  }
  SECTION("a lost foot takes the swing from it along") {
    Plan lost = plan;
    lost.stances[0].feet[0]->position.y() = 0.5;  // lifted in transfer 1, placed in transfer 2
    CHECK(verify(scene_on(level_ground_and()), lost).transfers_with_lost_feet == 2);
  }
  SECTION("ground that went down: each foot is named") {
    const auto found = verify(scene_on({chain({{-5, -0.5}, {5, -0.5}})}), plan);
    CHECK(found.faults.size() == 8);  // 3 stances of 2 feet, 2 footholds
    require_only(found, Rule::foothold, "stance 1", "foot 1 is said to stand at");
    CHECK(found.stances_with_lost_feet == 3);
  }
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
