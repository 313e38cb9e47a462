// The search: each planner finds legal plans or says why there are none, and does the same twice.
#include "planner/search.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "gaits/verifier.hpp"
#include "planner/problem.hpp"
#include "planner/step_proposals.hpp"
#include "stability/decisions.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot;

namespace {

std::string scene_text(const std::string& terrain, const std::string& start, const std::string& goal,
                       const std::string& more = "") {
  return "surefoot: 1\nname: test\nterrain:\n" + terrain +
         "robot: {radius_of_gyration: 0.2, reach: [0.2, 0.9], clearance: 0.1}\n"
         "disturbance: {kappa: 0.08, nu: 0.02}\n" +
         "start: " + start + "\ngoal: " + goal + "\n" + more;
}

const std::string level = "  friction: 0.6\n  chains:\n    - vertices: [[-1, 0], [6, 0]]\n";
const std::string two_steps =
    "  friction: 0.6\n  chains:\n    - vertices: [[-1, 0], [0.5, 0], [0.5, 0.15], [0.9, 0.15], [0.9, 0.3], [3, 0.3]]\n";
const std::string gap =
    "  friction: 0.6\n  chains:\n    - vertices: [[-1, 0], [0.8, 0]]\n    - vertices: [[1.2, 0.05], [3, 0.05]]\n";
const std::string walls =
    "  friction: 0.7\n  chains:\n    - vertices: [[0, 3], [0.05, 1.6], [0, -0.5]]\n"
    "    - vertices: [[1, -0.5], [0.95, 1.2], [1, 3]]\n";
const std::string three_feet = "{feet: [{x: -0.4}, {x: 0.15}, {x: -0.1}], support: [1, 2]}";

gaits::Scene flat_scene() { return gaits::parse_scene(scene_text(level, three_feet, "{com_x: [2, 2.4]}"), "flat"); }
gaits::Scene stairs_scene() {
  return gaits::parse_scene(scene_text(two_steps, three_feet, "{com_x: [1.6, 1.9]}"), "stairs");
}
gaits::Scene gap_scene() { return gaits::parse_scene(scene_text(gap, three_feet, "{com_x: [1.8, 2.1]}"), "gap"); }
gaits::Scene walls_scene() {
  return gaits::parse_scene(scene_text(walls, "{feet: [{chain: 0, s: 2.6}, {chain: 1, s: 0.9}, {chain: 0, s: 2.9}]}",
                                       "{com_y: [1.6, 1.9]}", "stability: {criterion: equilibrium}\n"),
                            "walls");
}

gaits::Plan run(const gaits::Scene& scene, const std::string& planner = "auto", std::uint32_t seed = 1,
                const std::string& objective = "steps") {
  planner::SearchOptions options;
  options.planner = planner;
  options.seed = seed;
  options.objective = objective;
  options.time_limit = 300;  // never the limit here: budgets are work
  options.effort = 0.05;     // what is claimed holds for any
  return planner::search(scene, options);
}

/// Every number of a plan that its steps consist of, as bytes.
std::string bytes(const gaits::Plan& plan) {
  std::string all;
  const auto put = [&](const auto& value) { all.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto foothold = [&](const terrain::Foothold& foot) {
    put(foot.chain), put(foot.segment), put(foot.s), put(foot.position.x()), put(foot.position.y());
    put(foot.normal.x()), put(foot.normal.y()), put(foot.friction);
  };
  for (const auto& stance : plan.stances) {
    for (const auto& foot : stance.feet)
      if (foot) foothold(*foot);
    put(stance.com.x()), put(stance.com.y()), put(stance.safety_factor);
    all += stance.limit;
  }
  for (const auto& transfer : plan.transfers) {
    put(transfer.leg), put(transfer.lift), put(transfer.safety_factor);
    foothold(transfer.foothold);
  }
  put(plan.safety_factor);
  for (const auto& note : plan.left_out) all += note.what + note.why;
  return all + plan.planner + plan.reason;
}

void require_holds(const gaits::Scene& scene, const gaits::Plan& plan) {
  INFO("planner " << plan.planner << ", seed " << plan.seed << ", reason '" << plan.reason << "'");
  REQUIRE(plan.status == gaits::Status::solved);
  REQUIRE(plan.stances.size() == plan.transfers.size() + 1);
  CHECK(plan.reason.empty());
  CHECK(scene.goal.contains(plan.stances.back().com));
  const auto verification = gaits::verify(scene, plan);
  for (const auto& fault : verification.faults) UNSCOPED_INFO(fault.place << ": " << fault.message);
  CHECK(verification.holds());
}

}  // namespace

TEST_CASE("every planner finds a verified plan on level ground, stairs and across a gap", "[search]") {
  const std::string name = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  const auto make = GENERATE(&flat_scene, &stairs_scene, &gap_scene);
  const gaits::Scene scene = make();
  CAPTURE(name, scene.file);
  const gaits::Plan plan = run(scene, name);
  require_holds(scene, plan);
  if (name != "auto") CHECK(plan.planner == name);
  CHECK(plan.steps() > 0);
}

TEST_CASE("every planner climbs between two walls under criterion equilibrium", "[search]") {
  const std::string name = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  const gaits::Scene scene = walls_scene();
  CAPTURE(name);
  require_holds(scene, run(scene, name));
}

TEST_CASE("the same seed gives the same plan, byte for byte, whatever ran before", "[search]") {
  const std::string name = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  const gaits::Scene scene = stairs_scene();
  CAPTURE(name);
  const std::string first = bytes(run(scene, name, 7));
  const std::string other = bytes(run(scene, name, 8));
  CHECK(first == bytes(run(stairs_scene(), name, 7)));
  CHECK(first != other);
}

TEST_CASE("objectives are served: no plan of `distance` moves the COM farther than that of `steps` on the same seed",
          "[search]") {
  const gaits::Scene scene = flat_scene();
  const auto way = [](const gaits::Plan& plan) {
    double sum = 0;
    for (std::size_t i = 1; i < plan.stances.size(); ++i) sum += (plan.stances[i].com - plan.stances[i - 1].com).norm();
    return sum;
  };
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto steps = run(scene, "RRT", seed, "steps"), distance = run(scene, "RRT", seed, "distance"),
               safety = run(scene, "RRT", seed, "safety");
    require_holds(scene, distance);
    require_holds(scene, safety);
    CHECK(way(distance) <= way(steps) + 1e-12);
    CHECK(safety.safety_factor >= steps.safety_factor);
  }
}

TEST_CASE("a start that is in the goal needs no step", "[search]") {
  const gaits::Scene scene =
      gaits::parse_scene(scene_text(level, three_feet, "{com_x: [-0.2, 0.1], com_y: [0.3, 0.6]}"), "there");
  const std::string name = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  const gaits::Plan plan = run(scene, name);
  require_holds(scene, plan);
  CHECK(plan.steps() == 0);
}

TEST_CASE("a goal interval of one point is reached exactly", "[search]") {
  const gaits::Scene scene = gaits::parse_scene(scene_text(level, three_feet, "{com_x: [1.7, 1.7]}"), "point");
  const gaits::Plan plan = run(scene);
  require_holds(scene, plan);
  CHECK(plan.stances.back().com.x() == 1.7);
}

TEST_CASE("feet that start in the air and a start that leaves support and COM open are chosen for", "[search]") {
  const std::string start = GENERATE("{feet: [{x: -0.4}, null, {x: 0.15}]}", "{feet: [{x: -0.4}, {x: 0}, {x: 0.3}]}",
                                     "{feet: [{x: -0.4}, {x: 0}, {x: 0.3}], com: [-0.2, 0.5]}");
  CAPTURE(start);
  const gaits::Scene scene = gaits::parse_scene(scene_text(level, start, "{com_x: [1.5, 1.8]}"), "open");
  require_holds(scene, run(scene));
}

TEST_CASE("a given start that is not stable is bad input, said with its numbers", "[search]") {
  // The COM lies 0.1 m outside the feet: on level ground not even gravity can be balanced.
  const auto scene =
      gaits::parse_scene(scene_text(level, "{feet: [{x: -0.4}, {x: 0}, {x: -0.2}], support: [1, 2], com: [0.1, 0.5]}",
                                    "{com_x: [2, 3]}"),
                         "unstable.yaml");
  CHECK_THROWS_WITH(run(scene),
                    Catch::StartsWith("unstable.yaml:9:69: start: not stable on feet 1 and 2: safety factor 0"));
  const auto low =
      gaits::parse_scene(scene_text(level,
                                    "{feet: [{x: -0.4}, {x: 0.1}, {x: -0.2}], support: [1, 2], com: [-0.15, 0.06]}",
                                    "{com_x: [2, 3]}"),
                         "low.yaml");
  CHECK_THROWS_WITH(run(low),
                    Catch::Contains("low.yaml:9:71: start: the COM is 0.06 m from the terrain, clearance is 0.1 m"));
}

TEST_CASE("start feet that no COM balances on are bad input", "[search]") {
  // Two feet on one slope of 45 degrees with friction 0.3: they slide wherever the COM is.
  const auto scene = gaits::parse_scene(scene_text("  friction: 0.3\n  chains:\n    - vertices: [[-1, -1], [2, 2]]\n",
                                                   "{feet: [{x: 0}, {x: 0.3}, null]}", "{com_x: [1, 1.5]}"),
                                        "slide.yaml");
  CHECK_THROWS_WITH(run(scene),
                    Catch::Contains(
                        "slide.yaml:9:8: start: no COM balances on feet 1 and 2, even without disturbances"));
}

TEST_CASE("start feet that one COM alone can reach are not called bad input", "[search]") {
  // Feet 2 reach_max apart on facing slopes; the COM halfway holds as a start.
  const std::string slopes =
      "  friction: 2\n  chains:\n"
      "    - vertices: [[-1, 1], [0.25, -0.25], [0.25, -2], [1.55, -2], [1.55, -0.25], [2.8, 1]]\n";
  const auto given =
      gaits::parse_scene(scene_text(slopes, "{feet: [{x: 0}, {x: 1.8}, null], com: [0.9, 0]}", "{com_x: [1.5, 2]}"),
                         "slopes");
  planner::StepProposals proposals(given);
  REQUIRE(planner::choose_start(proposals).nodes.size() == 1);
  const auto open =
      gaits::parse_scene(scene_text(slopes, "{feet: [{x: 0}, {x: 1.8}, null]}", "{com_x: [1.5, 2]}"), "slopes");
  const auto plan = run(open);
  CHECK(plan.status == gaits::Status::no_plan_found);
  CHECK_THAT(plan.reason, Catch::StartsWith("start is not stable: no COM within reach of feet 1 and 2 was found"));
}

TEST_CASE("friction of exactly kappa costs no search its margin, nor its time in exact arithmetic", "[search]") {
  const std::string tread =
      "  friction: 0.6\n  chains:\n"
      "    - {vertices: [[-1, 0], [0.5, 0], [1, 0], [4, 0]], segments: {1: {friction: 0.08}}}\n";
  const auto scene = gaits::parse_scene(scene_text(tread, three_feet, "{com_x: [3, 3.2]}"), "tread");
  REQUIRE(scene.disturbance.kappa == 0.08);
  stability::decisions = {};
  const auto plan = run(scene, "Layers");
  require_holds(scene, plan);
  CHECK(plan.safety_factor > 1.0000000005);
  CHECK(stability::decisions.lines_exactly < 20);
}

TEST_CASE("terrain that is farther away than any journey changes nothing", "[search]") {
  const std::string far = "    - vertices: [[7, 1.0e+20], [8, 1.0e+20]]\n";
  const auto scene = gaits::parse_scene(scene_text(level + far, three_feet, "{com_x: [2, 2.4]}"), "far");
  const std::string name = GENERATE("auto", "Layers", "RRT", "KPIECE1", "EST", "SST");
  CAPTURE(name);
  require_holds(scene, run(scene, name));
}

TEST_CASE("that a goal cannot be stood on is proven", "[search]") {
  SECTION("no terrain in reach: proven") {
    const auto plan = run(gaits::parse_scene(scene_text(level, three_feet, "{com_x: [8, 9]}"), "void"));
    CHECK(plan.status == gaits::Status::infeasible);
    CHECK_THAT(plan.reason, Catch::StartsWith("in the goal, between x = 8 and 9: "));
  }
  SECTION("too high: proven, and its height told beside its place") {
    const std::string goal = "{com_x: [1, 2], com_y: [1000.1, 1000.2]}";
    const auto plan = run(gaits::parse_scene(scene_text(level, three_feet, goal), "high"));
    CHECK(plan.status == gaits::Status::infeasible);
    CHECK_THAT(plan.reason, Catch::StartsWith("in the goal, between x = 1 and 2 and between y = 1000.1 and 1000.2: "));
  }
  SECTION("ground too steep to stand on: proven") {
    const auto plan =
        run(gaits::parse_scene(scene_text("  friction: 0.4\n  chains:\n    - vertices: [[-1, 0], [1, 0], [6, 5]]\n",
                                          three_feet, "{com_x: [4, 4.2]}"),
                               "steep"));
    CHECK(plan.status == gaits::Status::infeasible);
    CHECK_THAT(plan.reason, Catch::StartsWith("in the goal, between x = 4 and 4.2: "));
    CHECK(plan.stances.empty());
  }
}

TEST_CASE("a goal beyond a gap wider than two legs is not found: what was refused is counted, and then it is proven",
          "[search]") {
  const auto scene = gaits::parse_scene(
      scene_text("  friction: 0.6\n  chains:\n    - vertices: [[-1, 0], [0.8, 0]]\n    - vertices: [[3, 0], [5, 0]]\n",
                 three_feet, "{com_x: [4, 4.2]}"),
      "wide");
  planner::SearchOptions options;
  options.planner = GENERATE("RRT", "KPIECE1", "EST", "SST");
  options.time_limit = 0.5;  // what is claimed does not depend on where it ends
  options.prove = false;
  const auto plan = planner::search(scene, options);
  CHECK(plan.status == gaits::Status::no_plan_found);
  CHECK_THAT(plan.reason, Catch::Contains("no plan found") && Catch::Contains("legal steps among"));
  if (options.planner != "RRT" && test::rounds(2) < 2) return;  // the same proof, at length
  // Given time, the reason is that no plan exists: the far edges are 2.2 m apart, two legs of 0.9 m reach 1.8 m.
  options.time_limit = 300;
  options.prove = true;
  const auto proven = planner::search(scene, options);
  CHECK(proven.status == gaits::Status::infeasible);
  CHECK(proven.reason == "between x = 0.8 and 3: no support pair within reach 0.9 spans the gap of 2.2 m");
}

TEST_CASE("options that mean nothing are refused with words", "[search][misuse]") {
  const auto refused = [](const auto& spoil) {
    planner::SearchOptions options;
    spoil(options);
    try {
      planner::search(flat_scene(), options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("not refused");
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused([](auto& options) { options.planner = "PRM"; }) == "unknown planner 'PRM'");
  CHECK(refused([](auto& options) { options.objective = "speed"; }) == "unknown objective 'speed'");
  CHECK(refused([](auto& options) { options.seed = 0; }) == "seed: out of range");
  CHECK(refused([](auto& options) { options.seed = gaits::greatest_seed + 1u; }) == "seed: out of range");
  for (const double effort : {-1e-9, none})
    CHECK_THAT(refused([&](auto& options) { options.effort = effort; }), Catch::Contains("effort >= 0"));
  CHECK_THAT(refused([&](auto& options) { options.time_limit = none; }), Catch::Contains("a time limit"));
  CHECK(refused([](auto& options) { options.time_limit = -1; }) == "not refused");  // over before it began
}

TEST_CASE("every proposal that is called legal obeys the rules, asked one by one", "[search]") {
  const auto make = GENERATE(&flat_scene, &stairs_scene, &gap_scene, &walls_scene);
  const gaits::Scene scene = make();
  CAPTURE(scene.file);
  planner::StepProposals proposals(scene);
  const auto start = planner::choose_start(proposals);
  REQUIRE_FALSE(start.nodes.empty());
  for (const auto& node : start.nodes) CHECK_FALSE(gaits::broken_start_rule(scene, node.stance()));
  planner::Node at = start.nodes.front();
  int legal = 0;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    planner::Node next = at;
    // In place, as a planner may do it.
    if (!proposals.propose(next, planner::spread_code(k), next)) continue;
    ++legal;
    const auto transfer = planner::step_between(at, next);
    CHECK_FALSE(gaits::broken_transfer_rule(scene, at.stance(), transfer, next.com, at.feet[at.free_leg]));
    CHECK_FALSE(gaits::broken_stance_rule(scene, next.stance()));
    planner::Node again = at;
    REQUIRE(proposals.propose(at, planner::spread_code(k), again));
    CHECK((again.com == next.com && again.free_leg == next.free_leg));
    CHECK(proposals.is_legal(at, next));
    at = next;
  }
  CHECK(legal > 100);
  CHECK(proposals.counts().legal == static_cast<std::uint64_t>(3 * legal) + [&] {
    // First steps that were tried at the choice of a start count too.
    planner::StepProposals fresh(scene);
    planner::choose_start(fresh);
    return fresh.counts().legal;
  }());
}

TEST_CASE("a refused proposal leaves its result as it was and is counted under one rule", "[search]") {
  const gaits::Scene scene = stairs_scene();
  planner::StepProposals proposals(scene);
  const planner::Node at = planner::choose_start(proposals).nodes.front();
  const auto before = proposals.counts();
  int refused = 0;
  for (std::uint64_t k = 0; k < 500; ++k) {
    planner::Node next = at;
    if (proposals.propose(at, planner::spread_code(k), next)) continue;
    ++refused;
    CHECK(next.id == at.id);
  }
  std::uint64_t counted = 0;
  for (std::size_t rule = 0; rule < before.blocked.size(); ++rule)
    counted += proposals.counts().blocked[rule] - before.blocked[rule];
  CHECK(counted == static_cast<std::uint64_t>(refused));
}
