// The planner Layers: its lattice, its bounds, its plans, and its place among OMPL's planners. (Its plans against those
// of an exhaustive search: bench/exhaustive.cpp.)
#include <sched.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <set>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "planner/anytime_search.hpp"
#include "planner/foothold_lattice.hpp"
#include "planner/layer_search.hpp"
#include "planner/ompl_search.hpp"
#include "planner/problem.hpp"
#include "planner/search.hpp"

using namespace surefoot;
using namespace surefoot::planner;

namespace {

std::string scene_text(const std::string& vertices, double goal, const std::string& stability = "") {
  return "surefoot: 1\nterrain:\n  friction: 0.6\n  chains:\n    - vertices: " + vertices +
         "\nrobot: {radius_of_gyration: 0.2, reach: [0.2, 0.9], clearance: 0.1}\n"
         "disturbance: {kappa: 0.08, nu: 0.02}\nstart: {feet: [{x: -0.4}, {x: 0.15}, {x: -0.1}], support: [1, 2]}\n"
         "goal: {com_x: [" +
         std::to_string(goal) + ", " + std::to_string(goal + 0.4) + "]}\n" + stability;
}

const std::string level = "[[-1, 0], [5, 0]]";
const std::string steps = "[[-1, 0], [0.5, 0], [0.5, 0.15], [0.9, 0.15], [0.9, 0.3], [4, 0.3]]";
const std::string dip = "[[-1, 0], [0.6, 0], [1, -0.3], [1.5, -0.3], [1.9, 0.05], [4, 0.05]]";

gaits::Plan plan_of(const gaits::Scene& scene, const std::vector<Node>& path) {
  gaits::Plan plan;
  plan.status = gaits::Status::solved;
  write_path(path, plan);
  gaits::rate(scene, plan);
  return plan;
}

void require_holds(const gaits::Scene& scene, const gaits::Plan& plan) {
  const auto verification = gaits::verify(scene, plan);
  for (const auto& fault : verification.faults) UNSCOPED_INFO(fault.place << ": " << fault.message);
  REQUIRE(verification.holds());
}

}  // namespace

TEST_CASE("the levels of a lattice hold each place once, the first within the spacing, each half of the one before",
          "[layers]") {
  const terrain::Terrain terrain({{{{0, 0}, {1, 0}, {1.4, 0.3}}, {{0.5, true}, {0.5, true}}}});
  FootholdLattice lattice(terrain, 0.3, 0.02);
  std::set<double> places;
  double spacing = 0.3;
  for (int level_number = 0; level_number < 9; ++level_number, spacing /= 2) {
    std::vector<int> numbers;
    lattice.look_from({0.7, 0.5}, 0, 2);
    lattice.list(level_number, numbers);
    REQUIRE(!numbers.empty());
    for (const int number : numbers) CHECK(places.insert(lattice[number].s).second);
    // With the ends of the segments, at arc lengths 0, 1 and 1.5, no gap is wider than the spacing.
    double last = 0;
    for (const double s : places) {
      CHECK(s - last <= spacing + 1e-12);
      last = s;
    }
    CHECK(1.5 - last <= spacing + 1e-12);
  }
}

TEST_CASE("a long segment is divided as a short one is, wherever it is looked at", "[layers]") {
  // 1e7 m of ground: at spacing 0.1 no list of all its footholds would fit into memory.
  const terrain::Terrain terrain({{{{-5e6, 0}, {5e6, 0}}, {{0.5, true}}}});
  for (const double x : {-5e6 + 0.3, -5e6 + 6.4, 0.0, 1234567.8, 5e6 - 0.3}) {
    FootholdLattice lattice(terrain, 0.1, 0.02);
    std::set<double> places;
    double spacing = 0.1;
    for (int level_number = 0; level_number < 4; ++level_number, spacing /= 2) {
      std::vector<int> numbers;
      lattice.look_from({x, 0.5}, 0, 1);
      lattice.list(level_number, numbers);
      for (const int number : numbers) CHECK(places.insert(lattice[number].s).second);
      double last = std::max(0.0, x + 5e6 - std::sqrt(0.75));
      for (const double s : places) {
        CHECK(s - last <= spacing + 1e-8);
        last = s;
      }
      CHECK(std::min(1e7, x + 5e6 + std::sqrt(0.75)) - last <= spacing + 1e-8);
    }
    CHECK(lattice.size() < 10000);
  }
}

TEST_CASE("the goal is found to be standable however long the ground under it is", "[layers]") {
  const double half = GENERATE(5.0, 1e5, 1e7);
  const std::string ends = std::to_string(half);
  const gaits::Scene scene = gaits::parse_scene(scene_text("[[-" + ends + ", 0], [" + ends + ", 0]]", 3), "long");
  CHECK(look_at_goal(scene).standable);
  SearchOptions options;
  options.planner = "Layers";
  options.effort = 0;
  require_holds(scene, search(scene, options));
}

TEST_CASE("footholds are numbered by the order of the questions, but the places are the same", "[layers]") {
  const terrain::Terrain terrain({{{{0, 0}, {1, 0}, {2, 0.3}, {3, 0}}, {{0.5, true}, {0.5, true}, {0.5, true}}}});
  const auto places = [&](const std::vector<Eigen::Vector2d>& coms) {
    FootholdLattice lattice(terrain, 0.1, 0.02);
    std::set<double> found;
    for (const auto& com : coms)
      for (int level_number : {1, 0}) {
        std::vector<int> numbers;
        lattice.look_from(com, 0.1, 0.9);
        lattice.list(level_number, numbers);
        for (const int number : numbers) {
          CHECK((lattice[number].position - com).norm() <= 0.9);
          CHECK((lattice[number].position - com).norm() >= 0.1);
          found.insert(lattice[number].s);
        }
      }
    return found;
  };
  CHECK(places({{0.5, 0.4}, {1.5, 0.5}, {2.5, 0.5}}) == places({{2.5, 0.5}, {0.5, 0.4}, {1.5, 0.5}, {0.5, 0.4}}));
}

TEST_CASE("least_steps: three steps gain two reaches and no more", "[layers]") {
  CHECK(least_steps(0, 1) == 0);
  CHECK(least_steps(1e-6, 1) == 1);
  CHECK(least_steps(2, 1) == 1);
  CHECK(least_steps(2.001, 1) == 4);
  CHECK(least_steps(4, 1) == 4);
  CHECK(least_steps(4.001, 1) == 7);
  CHECK(least_steps(8, 2) == least_steps(4, 1));
}

TEST_CASE("least_steps: the feet of a stance bound what its first steps gain", "[layers]") {
  // COM, rear and front foot from the goal, for a reach of 1. A step ends within reach of the rear foot.
  CHECK(least_steps({0, 3, 3}, 1) == 0);
  CHECK(least_steps({0.5, 0.9, 0.2}, 1) == 1);
  CHECK(least_steps({0.5, 1.1, 0.2}, 1) == 2);  // the rear foot is lifted first
  CHECK(least_steps({1.5, 2.2, 1.3}, 1) == 3);  // both are
  CHECK(least_steps({2.1, 2.5, 1.5}, 1) == 4);  // 2 reaches in three steps are not enough
  CHECK(least_steps({2.1, 3.05, 1.5}, 1) == 5);
  CHECK(least_steps({3.9, 4.8, 3.7}, 1) == 6);
}

TEST_CASE("no plan of any planner gains more than least_steps allows, over every part of it", "[layers]") {
  const gaits::Scene scene = gaits::parse_scene(scene_text(level, 3.2), "level");
  const std::string name = GENERATE("Layers", "RRT", "EST");
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    SearchOptions options;
    options.planner = name;
    options.seed = seed;
    options.effort = 0.05;
    const gaits::Plan plan = search(scene, options);
    REQUIRE(plan.status == gaits::Status::solved);
    for (std::size_t i = 0; i < plan.stances.size(); ++i)
      for (std::size_t k = i + 1; k < plan.stances.size(); ++k) {
        // As if the goal were where the COM is after k steps.
        const auto from_there = [&](const Eigen::Vector2d& at) { return (at - plan.stances[k].com).norm(); };
        ToGoal stance{from_there(plan.stances[i].com), 0, std::numeric_limits<double>::infinity()};
        for (const auto& foot : plan.stances[i].feet) {
          if (!foot) continue;
          stance.rear = std::max(stance.rear, from_there(foot->position));
          stance.front = std::min(stance.front, from_there(foot->position));
        }
        CHECK(least_steps(stance, scene.robot.reach_max) <= static_cast<int>(k - i));
        CHECK(least_steps(stance.com, scene.robot.reach_max) <= least_steps(stance, scene.robot.reach_max));
      }
    if (plan.resolution) CHECK(plan.resolution->least_steps <= plan.steps());
  }
}

TEST_CASE("improving keeps a plan that holds and never makes it longer", "[layers]") {
  const std::string vertices = GENERATE(level, steps, dip);
  const gaits::Scene scene = gaits::parse_scene(scene_text(vertices, 2.6), "scene");
  StepProposals proposals(scene);
  AnytimeSearch search(proposals, choose_start(proposals).nodes, {});
  REQUIRE(search.find(1'000'000));
  std::size_t length = search.path().size();
  for (int i = 0; i < 8; ++i) {
    require_holds(scene, plan_of(scene, search.path()));
    CHECK(search.path().size() <= length);
    length = search.path().size();
    search.improve(20'000);
  }
  // 2.6 m less the COM's start at -0.1 or so: two reaches every three steps.
  CHECK(search.path().size() - 1 >= 4);
  CHECK(search.path().size() - 1 <= 7);
}

TEST_CASE("shares of refusals by rule, and the square with most of them", "[layers]") {
  using gaits::Rule;
  Refusals refusals(0.5);
  CHECK(refusals.summary() == "no landing or step refused");
  for (int i = 0; i < 6; ++i) refusals.add(Rule::reach, {1.2, -0.1});
  for (int i = 0; i < 2; ++i) refusals.add(Rule::swing, {1.3, -0.4});
  for (int i = 0; i < 2; ++i) refusals.add(Rule::swing, {0.7, 0.1});
  CHECK(refusals.summary() ==
        "10 landings and steps refused: reach 60 %, swing 40 %; most of them (80 %) with the COM between (1, -0.5) and "
        "(1.5, 0): reach 75 %, swing 25 %");
}

TEST_CASE("the safest plan is much safer than the shortest where the terrain allows", "[layers]") {
  const gaits::Scene scene = gaits::parse_scene(scene_text(steps, 2.2), "steps");
  SearchOptions options;
  options.effort = 0.2;
  const gaits::Plan shortest = search(scene, options);
  options.objective = "safety";
  const gaits::Plan safest = search(scene, options);
  require_holds(scene, safest);
  CHECK(safest.safety_factor > 1.5 * shortest.safety_factor);
  CHECK(safest.steps() >= shortest.steps());
}

TEST_CASE("as an OMPL planner it solves, and its solution is a path of legal steps", "[layers]") {
  const gaits::Scene scene = gaits::parse_scene(scene_text(dip, 2.6), "dip");
  StepProposals proposals(scene);
  OmplRun run;
  run.planner = "Layers";
  std::uint64_t iterations = 0;
  const auto path = run_ompl(proposals, choose_start(proposals).nodes, run, iterations);
  REQUIRE(path.size() > 1);
  require_holds(scene, plan_of(scene, path));
  for (std::size_t i = 1; i < path.size(); ++i) CHECK(proposals.is_legal(path[i - 1], path[i]));
}

TEST_CASE("an interrupted search ends with the best plan so far", "[layers]") {
  const gaits::Scene scene = gaits::parse_scene(scene_text(level, 3.2), "level");
  std::atomic<int> asked = 0;
  SearchOptions options;
  options.effort = 1e9;  // would go on for hours
  options.interrupted = [&asked] { return ++asked > 2000; };
  const gaits::Plan plan = search(scene, options);
  require_holds(scene, plan);
  CHECK(asked < 2200);  // it was not asked on and on
}

TEST_CASE("the plan is the same on one processor and on all", "[layers]") {
  const std::string objective = GENERATE("steps", "safety", "distance");
  const gaits::Scene scene = gaits::parse_scene(scene_text(steps, 2.6), "steps");
  SearchOptions options;
  options.objective = objective;
  options.effort = 0.15;
  options.time_limit = 1e6;
  const gaits::Plan on_all = search(scene, options);
  cpu_set_t all, one;
  REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);  // threads inherit it
  const gaits::Plan on_one = search(scene, options);
  REQUIRE(sched_setaffinity(0, sizeof all, &all) == 0);
  require_holds(scene, on_all);
  REQUIRE(on_one.stances.size() == on_all.stances.size());
  for (std::size_t k = 0; k < on_all.stances.size(); ++k) {
    CHECK(on_one.stances[k].com == on_all.stances[k].com);
    for (int leg = 0; leg < gaits::leg_count; ++leg) {
      const auto &a = on_one.stances[k].feet[leg], &b = on_all.stances[k].feet[leg];
      REQUIRE(a.has_value() == b.has_value());
      if (a) CHECK(a->s == b->s);
    }
  }
}

TEST_CASE("a search that finds nothing says how far it came and what refused its steps", "[layers]") {
  // A gap of 1.9 m, wider than two reaches.
  const std::string gap = "[[-1, 0], [1, 0], [1, -3], [2.9, -3], [2.9, 0], [5, 0]]";
  const gaits::Scene scene = gaits::parse_scene(scene_text(gap, 3.6), "gap");
  SearchOptions options;
  options.planner = "Layers";
  options.prove = false;
  const gaits::Plan plan = search(scene, options);
  REQUIRE(plan.status == gaits::Status::no_plan_found);
  CAPTURE(plan.reason);
  double x = 0, y = 0, left = 0;
  const auto at = plan.reason.find("Layers came to COM (");
  REQUIRE(at != std::string::npos);
  REQUIRE(std::sscanf(plan.reason.c_str() + at, "Layers came to COM (%lf, %lf), %lf m", &x, &y, &left) == 3);
  CHECK(x > 0.5);  // near the edge
  CHECK(x < 1.9);  // and not beyond the reach of the ground before it
  CHECK(left == Approx(3.6 - x).margin(0.01));
  CHECK_THAT(plan.reason,
             Catch::Contains("landings and steps refused: ") && Catch::Contains("%) with the COM between ("));
}

TEST_CASE("a plan is found where the swing of a leg depends on where it was lifted", "[layers]") {
  // A ceiling 0.45 m over a floor: with the COM from 0.15 to 0.3 m high both are nearer than the leg is short.
  const std::string text =
      "surefoot: 1\nterrain:\n  friction: 0.6\n  chains:\n    - vertices: [[-1, 0], [4, 0]]\n"
      "    - vertices: [[2.2, 0.45], [0.9, 0.45]]\n      segments: {0: {foothold: false}}\n"
      "robot: {radius_of_gyration: 0.2, reach: [0.3, 0.9], clearance: 0.1}\n"
      "disturbance: {kappa: 0.05, nu: 0.02}\nstart: {feet: [{x: -0.4}, {x: 0.15}, {x: -0.1}], support: [1, 2]}\n"
      "goal: {com_x: [2.8, 3.2]}\n";
  const gaits::Scene scene = gaits::parse_scene(text, "tunnel");
  StepProposals proposals(scene);
  LayerSearch layers(proposals, choose_start(proposals).nodes, {}, scene.disturbance);
  REQUIRE(layers.run({}) == LayerSearch::End::found);
  CHECK(layers.swing_mattered());
  SearchOptions options;
  options.planner = "Layers";
  options.effort = 0;
  require_holds(scene, search(scene, options));
}
