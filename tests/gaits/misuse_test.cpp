// What a user of the library may get wrong with terrains, scenes and plans: an error with words, a fault of the plan,
// or an assertion; never anything worse.
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "tests/gaits/fixtures.hpp"
#include "tests/support/aborts.hpp"

using namespace surefoot::gaits;
using namespace surefoot::gaits::testing;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

/// Another terrain: plans made for scene_on(level_ground_and()) find chain 1 missing and their ground lower.
Scene elsewhere() { return scene_on({chain({{100, -3}, {101, -3}})}); }

}  // namespace

TEST_CASE("A terrain is asked for what it has not", "[misuse]") {
  const Scene scene = scene_on(level_ground_and());
  const auto& ground = scene.terrain;
  for (const int none : {-1, 1, 1 << 30}) {
    CHECK_THROWS_AS(ground.chain_length(none), std::out_of_range);
    CHECK_THROWS_AS(ground.is_closed(none), std::out_of_range);
    CHECK_THROWS_AS(ground.segment(none, 0), std::out_of_range);
    CHECK_THROWS_AS(ground.segment(0, none), std::out_of_range);
    CHECK_FALSE(ground.foothold_at(none, 1));
    surefoot::terrain::Foothold foot = foot_at(scene, 5);
    foot.chain = none;
    CHECK_THROWS_AS(ground.leg_is_free({0, 0.5}, foot), std::out_of_range);
  }
  for (const double s : {no_number, inf, -inf, -1.0, 11.0}) CHECK_FALSE(ground.foothold_at(0, s));
  for (const double x : {no_number, inf, -6.0}) CHECK(ground.footholds_at_x(x).empty());
}

TEST_CASE("Rules are asked with feet and legs that there are not", "[misuse]") {
  Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  CHECK_THROWS_AS(oracle_of(scene, Feet{}), std::invalid_argument);
  for (const int leg : {-1, 3, 1 << 30}) {
    Transfer transfer = plan.transfers[0];
    transfer.leg = leg;
    CHECK(broken_transfer_rule(scene, plan.stances[0], transfer, plan.stances[1].com, {}) == Rule::gait);
    CHECK_THROWS_AS(feet_during(plan.stances[0], transfer), std::out_of_range);
    transfer = plan.transfers[0];
    transfer.lift = leg;
    CHECK(broken_transfer_rule(scene, plan.stances[0], transfer, plan.stances[1].com, {}) == Rule::gait);
  }
  CHECK(broken_stance_rule(scene, Stance{}) == Rule::gait);
  scene.criterion = Criterion::frictional;  // and no restitution
  CHECK_THROWS_WITH(broken_stance_rule(scene, plan.stances[0]), Catch::Contains("restitution"));
  scene.restitution = 0.5;
  CHECK_THROWS_WITH(is_stable(scene, oracle_of(scene, feet_during(plan.stances[0], plan.transfers[0])), {0, 0.5}),
                    Catch::Contains("two contacts"));
  scene.robot.radius_of_gyration = 0;
  CHECK_THROWS_WITH(oracle_of(scene, plan.stances[0].feet), Catch::Contains("radius of gyration"));
}

TEST_CASE("A plan that is no plan is not rated", "[misuse]") {
  const Scene scene = scene_on(level_ground_and());
  for (const auto& spoil : std::vector<std::function<void(Plan&)>>{[](Plan& plan) { plan.transfers.pop_back(); },
                                                                   [](Plan& plan) { plan.stances.pop_back(); },
                                                                   [](Plan& plan) { plan.stances.clear(); },
                                                                   [](Plan& plan) { plan.stances[1].feet = {}; }}) {
    Plan plan = plan_by_hand(scene);
    spoil(plan);
    CHECK_THROWS_AS(rate(scene, plan), std::invalid_argument);
    CHECK_FALSE(verify(scene, plan).holds());
    CHECK_FALSE(to_json(plan).empty());
  }
  Plan plan = plan_by_hand(scene);
  plan.transfers[0].leg = 7;
  CHECK_THROWS_AS(rate(scene, plan), std::out_of_range);
  plan = {};
  CHECK_NOTHROW(rate(scene, plan));
}

TEST_CASE("A plan of another scene is found out, and can be told and drawn", "[misuse]") {
  const Plan plan = plan_by_hand(scene_on(level_ground_and()));
  const Scene scene = elsewhere();
  CHECK_FALSE(verify(scene, plan).holds());
  CHECK_FALSE(to_text(scene, plan, {.colour = true, .explain = true}).empty());
  CHECK_FALSE(to_svg(scene, plan).empty());
  CHECK_FALSE(to_html(scene, plan).empty());
}

#ifndef NDEBUG
TEST_CASE("Points that are not finite stop a build with assertions", "[misuse]") {
  const Scene scene = scene_on(level_ground_and());
  const auto& ground = scene.terrain;
  const Point good(0, 0.5);
  for (const Point& bad : {Point(no_number, 0), Point(0, inf)}) {
    const std::vector<std::function<void()>> calls{[&] { ground.distance(bad, 1); },
                                                   [&] { ground.distance(good, bad, 1); },
                                                   [&] { ground.distance(good, no_number); },
                                                   [&] { ground.blocks(bad, good); },
                                                   [&] { ground.leg_is_free(bad, foot_at(scene, 5)); },
                                                   [&] { ground.stretches_within(bad, 0, 1); },
                                                   [&] { ground.stretches_within(good, no_number, 1); },
                                                   [&] {
                                                     ground.sector_is_free(bad, 1, {0, 1}, {1, 0});
                                                   },
                                                   [&] {
                                                     ground.sector_is_free(good, 1, {0, 0}, {1, 0});
                                                   },
                                                   [&] {
                                                     ground.sector_is_free(good, 1, bad, {1, 0});
                                                   }};
    for (std::size_t k = 0; k < calls.size(); ++k) {
      INFO("call " << k);
      CHECK(surefoot::test::aborts(calls[k]));
    }
  }
}
#endif
