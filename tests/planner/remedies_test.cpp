// What would help where there is no plan.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "gaits/verifier.hpp"
#include "planner/remedies.hpp"
#include "program.hpp"

namespace {

using namespace surefoot;
using planner::Remedy;

gaits::Scene map(const std::string& name) {
  return gaits::load_scene(std::string(SUREFOOT_MAPS) + "/" + name + ".yaml");
}

planner::Remedies remedies_of(const gaits::Scene& scene) {
  planner::SearchOptions options;
  options.time_limit = 300;  // not by the clock, however slow the machine
  return planner::remedies(scene, options);
}

}  // namespace

TEST_CASE("A slope that is too slippery asks for the friction that angle and disturbance demand", "[remedies]") {
  // Both feet on a slope of angle a: the resultant of weight and kappa leans by a + atan(kappa) against the normal. No
  // friction below tan of that holds; the stretch is longer than any step.
  const gaits::Scene scene = map("too_slippery");
  const double needed = std::tan(std::atan2(1.4, 3.0) + std::atan(scene.disturbance.kappa)) / 0.35;
  const planner::Remedies remedies = remedies_of(scene);
  REQUIRE_FALSE(remedies.cut_off);
  bool seen = false;
  for (const auto& remedy : remedies.found) {
    CHECK(remedy.remedy != Remedy::equilibrium);  // it is balance that fails
    if (remedy.remedy != Remedy::friction) continue;
    seen = true;
    CHECK(remedy.factor >= needed);
    CHECK(remedy.factor <= 1.05 * needed);  // remedy_step, and the lattice of the search
    CHECK(remedy.words == fmt::format("all friction times {}", remedy.factor));
  }
  CHECK(seen);
}

TEST_CASE("What is said to do, does: as a scene written anew", "[remedies]") {
  tests::Workplace place;
  const std::string before = test::read_text(std::string(SUREFOOT_MAPS) + "/wind_too_strong.yaml");
  place.write("scene.yaml", before);
  const auto run = place.run("plan scene.yaml --explain -q --time-limit 300");
  REQUIRE(run.status == 3);
  const std::size_t said = run.out.find("disturbances times ");
  REQUIRE(said != std::string::npos);
  double kappa = 0, nu = 0;
  REQUIRE(std::sscanf(run.out.c_str() + run.out.find("(kappa", said), "(kappa %lf, nu %lf)", &kappa, &nu) == 2);
  CHECK(kappa < 0.2);
  const std::string old = "disturbance: {kappa: 0.2, nu: 0.03}";
  REQUIRE(before.find(old) != std::string::npos);
  std::string after = before;
  after.replace(after.find(old), old.size(), fmt::format("disturbance: {{kappa: {}, nu: {}}}", kappa, nu));
  place.write("scene.yaml", after);
  CHECK(place.run("plan scene.yaml --effort 0").status == 0);
}

TEST_CASE("A goal that nothing reaches is not helped", "[remedies]") {
  gaits::Scene scene = map("flat");
  scene.goal.com_x = {100, 101};  // beyond the ground and every reach
  const planner::Remedies remedies = remedies_of(scene);
  CHECK(remedies.found.empty());
}

TEST_CASE("A change leaves everything else of the scene as it is", "[remedies]") {
  const gaits::Scene scene = map("ice_patch");
  const gaits::Scene slippery = planner::changed(scene, Remedy::friction, 0.5);
  REQUIRE(slippery.terrain.segments().size() == scene.terrain.segments().size());
  for (std::size_t k = 0; k < scene.terrain.segments().size(); ++k) {
    const terrain::Segment &a = scene.terrain.segments()[k], &b = slippery.terrain.segments()[k];
    CHECK(b.surface.friction == 0.5 * a.surface.friction);
    CHECK((a.a == b.a && a.b == b.b && a.chain == b.chain && a.surface.foothold == b.surface.foothold));
  }
  for (std::size_t leg = 0; leg < slippery.start.feet.size(); ++leg)
    CHECK(slippery.start.feet[leg]->friction == 0.5 * scene.start.feet[leg]->friction);
  const gaits::Scene longer = planner::changed(scene, Remedy::reach, 2);
  CHECK(longer.robot.reach_max == 2 * scene.robot.reach_max);
  CHECK(longer.robot.reach_min == scene.robot.reach_min);
  CHECK(longer.disturbance.kappa == scene.disturbance.kappa);
}

TEST_CASE("Where feet brace against opposed walls it is said that criterion equilibrium would do", "[remedies]") {
  // Two walls 1 m apart with five holds each, so that every remedy is searched to its end in little time.
  const std::string text = R"(surefoot: 1
terrain:
  friction: 0.6
  chains:
    - vertices: [[0, 1.2], [0, 1.1], [0, 0.8], [0, 0.7], [0, 0.4], [0, 0.3], [0, 0], [0, -0.1], [0, -0.4], [0, -0.5]]
      segments: {1: {foothold: false}, 3: {foothold: false}, 5: {foothold: false}, 7: {foothold: false}}
    - vertices: [[1, -0.5], [1, -0.4], [1, -0.1], [1, 0], [1, 0.3], [1, 0.4], [1, 0.7], [1, 0.8], [1, 1.1], [1, 1.2]]
      segments: {1: {foothold: false}, 3: {foothold: false}, 5: {foothold: false}, 7: {foothold: false}}
robot: {radius_of_gyration: 0.15, reach: [0.2, 0.9]}
disturbance: {kappa: 0.1, nu: 0.03}
start: {feet: [{chain: 0, s: 1.25}, {chain: 1, s: 0.45}, {chain: 0, s: 1.65}], support: [1, 2]}
goal: {com_y: [0.9, 1.2]}
)";
  const gaits::Scene scene = gaits::parse_scene(text, "walls.yaml");
  REQUIRE(scene.criterion == gaits::Criterion::robust);
  const planner::Remedies remedies = remedies_of(scene);
  CHECK(std::any_of(remedies.found.begin(), remedies.found.end(),
                    [](const auto& one) { return one.remedy == Remedy::equilibrium; }));
}
