// Scenes are read as formats.md says, and every fault is told at the value that is wrong.
#include "gaits/scene.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

using namespace surefoot;
using namespace surefoot::gaits;

namespace {

// Ground: y = 0 up to x = 0.5, a riser of 0.15 m without foothold, a tread up to x = 2; a ceiling from x = 2 to x
// = 1.5.
const std::string good = R"(surefoot: 1
name: test
terrain:
  friction: 0.6
  chains:
    - vertices: [[-1, 0], [0.5, 0], [0.5, 0.15], [2, 0.15]]
      segments: {1: {foothold: false}}
    - vertices: [[2, 3], [1.5, 3]]
robot:
  radius_of_gyration: 0.12
  reach: [0.2, 0.9]
  clearance: 0.05
  mass: 10
disturbance: {kappa: 0.1, nu: 0.03}
stability:
  criterion: robust
  restitution: 0.1
start:
  feet: [{x: -0.2}, {x: 0.1}, {chain: 0, s: 1.75}]
  support: [2, 1]
  com: [-0.05, 0.5]
goal: {com_x: [1.6, 1.9], com_y: [0.5, 0.5]}
search: {seed: 7, time_limit: 2.5, planner: EST, objective: safety}
)";

std::string with(const std::string& old_part, const std::string& new_part) {
  const std::size_t at = good.find(old_part);
  REQUIRE(at != std::string::npos);
  REQUIRE(good.find(old_part, at + 1) == std::string::npos);
  std::string text = good;
  return text.replace(at, old_part.size(), new_part);
}

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "s.yaml");
  } catch (const terrain::InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Fault {
  const char *old_part, *new_part, *error;
};

}  // namespace

TEST_CASE("a scene is read as it is written", "[scene]") {
  const Scene scene = parse_scene(good, "dir/file.yaml");
  CHECK(scene.file == "dir/file.yaml");
  CHECK(scene.name == "test");
  CHECK(scene.terrain.chain_count() == 2);
  CHECK(scene.robot.radius_of_gyration == 0.12);
  CHECK(scene.robot.reach_min == 0.2);
  CHECK(scene.robot.reach_max == 0.9);
  CHECK(scene.robot.clearance == 0.05);
  CHECK(scene.robot.mass == 10.0);
  CHECK(scene.disturbance.kappa == 0.1);
  CHECK(scene.disturbance.nu == 0.03);
  CHECK(scene.criterion == Criterion::robust);
  CHECK(scene.restitution == 0.1);
  REQUIRE(scene.start.feet[2].has_value());
  // s = 1.5 m of ground, 0.15 m of riser, 0.1 m of tread.
  CHECK(scene.start.feet[2]->segment == 2);
  CHECK(scene.start.feet[2]->position.x() == Approx(0.6).epsilon(1e-14));
  CHECK(scene.start.feet[2]->position.y() == Approx(0.15).epsilon(1e-14));
  CHECK(scene.start.feet[0]->position == Eigen::Vector2d(-0.2, 0));
  CHECK(scene.start.support == std::pair(0, 1));  // in the order of the legs
  CHECK(scene.start.com == Eigen::Vector2d(-0.05, 0.5));
  CHECK(scene.goal.com_x == std::pair(1.6, 1.9));
  CHECK(scene.goal.com_y == std::pair(0.5, 0.5));
  CHECK(scene.search.seed == 7);
  CHECK(scene.search.time_limit == 2.5);
  CHECK(scene.search.planner == "EST");
  CHECK(scene.search.objective == "safety");
}

TEST_CASE("what is optional may be left out", "[scene]") {
  const Scene scene = parse_scene(R"(
surefoot: 1
terrain: {friction: 0.6, chains: [{vertices: [[-1, 0], [2, 0]]}]}
robot: {radius_of_gyration: 0.12, reach: [0, 0.9]}
disturbance: {kappa: 0, nu: 0}
start: {feet: [{x: -0.2}, null, {x: 0.1}]}
goal: {com_y: [0.4, 0.6]}
)",
                                  "dir/two.steps.yaml");
  CHECK(scene.name == "two.steps");
  CHECK(scene.robot.reach_min == 0);
  CHECK(scene.robot.clearance == 0);
  CHECK_FALSE(scene.robot.mass.has_value());
  CHECK(scene.criterion == Criterion::robust);
  CHECK_FALSE(scene.restitution.has_value());
  CHECK_FALSE(scene.start.feet[1].has_value());
  CHECK_FALSE(scene.start.support.has_value());
  CHECK_FALSE(scene.start.com.has_value());
  CHECK_FALSE(scene.goal.com_x.has_value());
  CHECK(scene.search.seed == 1);
  CHECK(scene.search.time_limit == 10);
  CHECK(scene.search.planner == "auto");
  CHECK(scene.search.objective == "steps");
}

TEST_CASE("all choices of criterion, planner and objective that exist are accepted", "[scene]") {
  CHECK(parse_scene(with("criterion: robust", "criterion: equilibrium"), "s").criterion == Criterion::equilibrium);
  CHECK(parse_scene(with("criterion: robust", "criterion: frictional"), "s").criterion == Criterion::frictional);
  CHECK(parse_scene(with("criterion: robust", "criterion: both"), "s").criterion == Criterion::both);
  for (const std::string name : {"auto", "RRT", "KPIECE1", "EST", "SST"}) {
    CHECK(parse_scene(with("planner: EST", "planner: " + name), "s").search.planner == name);
  }
  for (const std::string name : {"steps", "safety", "distance"}) {
    CHECK(parse_scene(with("objective: safety", "objective: " + name), "s").search.objective == name);
  }
  CHECK(parse_scene(with("seed: 7", "seed: 2147483562"), "s").search.seed == 2147483562u);
}

TEST_CASE("the goal is a box with its border", "[scene]") {
  const Goal goal{std::pair(1.0, 2.0), std::pair(0.5, 0.5)};
  CHECK(goal.contains({1, 0.5}));
  CHECK(goal.contains({2, 0.5}));
  CHECK_FALSE(goal.contains({2.0000001, 0.5}));
  CHECK_FALSE(goal.contains({1.5, 0.50000001}));
  CHECK(Goal{std::pair(1.0, 2.0), {}}.contains({1.5, -1e9}));
  CHECK(Goal{{}, std::pair(1.0, 2.0)}.contains({1e9, 1}));
  CHECK_FALSE(Goal{{}, std::pair(1.0, 2.0)}.contains({0, 0}));
}

TEST_CASE("unknown keys are refused at every level, where they stand", "[scene]") {
  const Fault fault =
      GENERATE(Fault{"name: test", "nam: test", "s.yaml:2:1: scene: unknown key \"nam\"; did you mean \"name\"?"},
               Fault{"friction: 0.6", "frictoin: 0.6", "s.yaml:4:3: terrain: unknown key \"frictoin\""},
               Fault{"clearance: 0.05", "clearence: 0.05",
                     "s.yaml:12:3: robot: unknown key \"clearence\"; did you mean"},
               Fault{"nu: 0.03", "mu: 0.03", "s.yaml:14:27: disturbance: unknown key \"mu\""},
               Fault{"restitution: 0.1", "e: 0.1", "s.yaml:17:3: stability: unknown key \"e\""},
               Fault{"support: [2, 1]", "supports: [2, 1]", "s.yaml:20:3: start: unknown key \"supports\""},
               Fault{"{x: 0.1}", "{z: 0.1}", "s.yaml:19:22: foot: unknown key \"z\""},
               Fault{"com_x:", "x:", "s.yaml:22:8: goal: unknown key \"x\""},
               Fault{"seed: 7", "sede: 7", "s.yaml:23:10: search: unknown key \"sede\"; did you mean \"seed\"?"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("of keys that stand a level too far out or in it is said where they belong", "[scene]") {
  const Fault fault =
      GENERATE(Fault{"  mass: 10", "mass: 10", "s.yaml:13:1: scene: unknown key \"mass\"; it belongs inside \"robot\""},
               Fault{"seed: 7", "seed: 7, com_x: [1, 2]", "search: unknown key \"com_x\"; it belongs inside \"goal\""},
               Fault{"terrain:\n", "terrain:\n  goal: 1\n",
                     "terrain: unknown key \"goal\"; it belongs at the top level"},
               Fault{"nu: 0.03", "nu: 0.03, restitution: 0.1",
                     "disturbance: unknown key \"restitution\"; it belongs inside \"stability\""});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::Contains(fault.error));
}

TEST_CASE("what is required is missed", "[scene]") {
  const Fault fault = GENERATE(
      Fault{"surefoot: 1\n", "", "s.yaml:1:1: scene: \"surefoot\" is missing; add \"surefoot: 1\" at the top level"},
      Fault{"disturbance: {kappa: 0.1, nu: 0.03}\n", "",
            "s.yaml:1:1: scene: \"disturbance\" is missing; for none add \"disturbance: {kappa: 0, nu: 0}\""},
      Fault{"goal: {com_x: [1.6, 1.9], com_y: [0.5, 0.5]}\n", "",
            "s.yaml:1:1: scene: \"goal\" is missing; add such as \"goal: {com_x: [1.5, 1.9]}\""},
      Fault{"{kappa: 0.1, nu: 0.03}", "{nu: 0.03}", "s.yaml:14:14: disturbance: \"kappa\" is missing"},
      Fault{"  radius_of_gyration: 0.12\n", "", "s.yaml:10:3: robot: \"radius_of_gyration\" is missing"},
      Fault{"  reach: [0.2, 0.9]\n", "", "s.yaml:10:3: robot: \"reach\" is missing"},
      Fault{"  feet: [{x: -0.2}, {x: 0.1}, {chain: 0, s: 1.75}]\n", "", "s.yaml:19:3: start: \"feet\" is missing"},
      Fault{"{chain: 0, s: 1.75}", "{chain: 0}", "s.yaml:19:31: foot: \"s\" is missing"},
      Fault{"{chain: 0, s: 1.75}", "{s: 1.75}", "s.yaml:19:31: foot: \"chain\" is missing"},
      Fault{"{com_x: [1.6, 1.9], com_y: [0.5, 0.5]}", "{}",
            "s.yaml:22:7: goal: nothing is given; expected {com_x: [from, to]}, com_y or both"},
      Fault{"{com_x: [1.6, 1.9], com_y: [0.5, 0.5]}", "1.6",
            "s.yaml:22:7: goal: 1.6 is given; expected {com_x: [from, to]}, com_y or both"},
      Fault{"{com_x: [1.6, 1.9], com_y: [0.5, 0.5]}", "[1.6, 1.9]",
            "s.yaml:22:7: goal: a list of 2 items is given; expected {com_x: [from, to]}, com_y or both"},
      Fault{"{kappa: 0.1, nu: 0.03}", "0.1",
            "s.yaml:14:14: disturbance: 0.1 is given; expected {kappa: ..., nu: ...}"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("another format version is refused", "[scene]") {
  CHECK(error_of(with("surefoot: 1", "surefoot: 2")) ==
        "s.yaml:1:11: surefoot: format version 2 is not known; expected 1");
  CHECK_THAT(error_of(with("surefoot: 1", "surefoot: one")), Catch::StartsWith("s.yaml:1:11: surefoot: one is not"));
  // A file of a later version may hold keys unknown to this one: the version is what must be told.
  for (const std::string other : {"1.0", "0.1", "+1", "2.5"})
    CHECK(error_of("surefoot: " + other + "\n") ==
          "s.yaml:1:11: surefoot: format version " + other + " is not known; expected 1");
  CHECK(error_of("surefoot: \"1\"\n") == "s.yaml:1:11: surefoot: \"1\" is a text; expected a number, without quotes");
  CHECK_THAT(error_of("surefoot: 2\nnovelty: 1\n"), Catch::StartsWith("s.yaml:1:11: surefoot: format version 2"));
}

TEST_CASE("numbers out of range are refused where they stand", "[scene]") {
  const Fault fault =
      GENERATE(Fault{"reach: [0.2, 0.9]", "reach: [-0.1, 0.9]", "s.yaml:11:11: least reach: -0.1 is negative"},
               Fault{"reach: [0.2, 0.9]", "reach: [0.9, 0.9]", "s.yaml:11:10: reach: [0.9, 0.9] is empty"},
               Fault{"reach: [0.2, 0.9]", "reach: [0.9, 0.2]", "s.yaml:11:10: reach: [0.9, 0.2] is empty"},
               Fault{"reach: [0.2, 0.9]", "reach: [0.2]",
                     "s.yaml:11:10: reach [least, greatest]: a list of 1 item is given"},
               Fault{"reach: [0.2, 0.9]", "reach: 0.9", "s.yaml:11:10: reach [least, greatest]: 0.9 is given"},
               Fault{"reach: [0.2, 0.9]", "reach: [0.2, 1e200]", "s.yaml:11:16: greatest reach: 1e+200 is too large"},
               Fault{"reach: [0.2, 0.9]", "reach: [0.2, .inf]", "s.yaml:11:16: greatest reach: .inf is not a finite"},
               Fault{"gyration: 0.12", "gyration: 0", "s.yaml:10:23: radius_of_gyration: 0 is not positive"},
               Fault{"gyration: 0.12", "gyration: -1", "s.yaml:10:23: radius_of_gyration: -1 is not positive"},
               Fault{"gyration: 0.12", "gyration: .nan", "s.yaml:10:23: radius_of_gyration: .nan is not a finite"},
               Fault{"gyration: 0.12", "gyration: 1e-200", "s.yaml:10:23: radius_of_gyration: 1e-200 is too small"},
               Fault{"clearance: 0.05", "clearance: -0.05", "s.yaml:12:14: clearance: -0.05 is negative"},
               Fault{"mass: 10", "mass: 0", "s.yaml:13:9: mass: 0 is not positive"},
               Fault{"kappa: 0.1", "kappa: -0.1", "s.yaml:14:22: kappa: -0.1 is negative"},
               Fault{"nu: 0.03", "nu: -1e-9", "s.yaml:14:31: nu: -1e-9 is negative"},
               Fault{"nu: 0.03", "nu: ten", "s.yaml:14:31: nu: ten is not a finite"},
               Fault{"restitution: 0.1", "restitution: 0", "s.yaml:17:16: restitution: 0 is out of range"},
               Fault{"restitution: 0.1", "restitution: 1", "s.yaml:17:16: restitution: 1 is out of range"},
               Fault{"com: [-0.05, 0.5]", "com: [-0.05]", "s.yaml:21:8: com [x, y]: a list of 1 item"},
               Fault{"com: [-0.05, 0.5]", "com: [-0.05, up]", "s.yaml:21:16: y of com: up is not a finite"},
               Fault{"com_x: [1.6, 1.9]", "com_x: [1.9, 1.6]", "s.yaml:22:15: com_x: [1.9, 1.6] is empty"},
               Fault{"com_y: [0.5, 0.5]", "com_y: 0.5",
                     "s.yaml:22:34: com_y: 0.5 is given; expected [from, to], the least first"},
               Fault{"seed: 7", "seed: 0", "s.yaml:23:16: seed: 0 is out of range; expected 1 to 2147483562"},
               Fault{"seed: 7", "seed: 2147483563", "s.yaml:23:16: seed: 2147483563 is out of range"},
               Fault{"seed: 7", "seed: 1.5", "s.yaml:23:16: seed: 1.5 is not an integer"},
               Fault{"time_limit: 2.5", "time_limit: 0", "s.yaml:23:31: time_limit: 0 is not positive"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("words that are not choices are refused, near ones suggested", "[scene]") {
  const Fault fault = GENERATE(
      Fault{"criterion: robust", "criterion: robst",
            "s.yaml:16:14: criterion: \"robst\" is not known; expected one of: robust, equilibrium, frictional, both "
            "(did you mean \"robust\"?)"},
      Fault{"planner: EST", "planner: rtt",
            "s.yaml:23:45: planner: \"rtt\" is not known; expected one of: auto, Layers, RRT, KPIECE1, EST, SST (did "
            "you mean \"RRT\"?)"},
      Fault{"planner: EST", "planner: dijkstra",
            "s.yaml:23:45: planner: \"dijkstra\" is not known; expected one of: auto, Layers, RRT, KPIECE1, EST, SST"},
      Fault{"objective: safety", "objective: step",
            "s.yaml:23:61: objective: \"step\" is not known; expected one of: steps, safety, distance (did you mean "
            "\"steps\"?)"},
      Fault{"name: test", "name: [a]", "s.yaml:2:7: name: a list of 1 item is given"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("choices may be written in upper or lower case, as on the command line", "[scene]") {
  CHECK(parse_scene(with("planner: EST", "planner: kpiece1"), "s.yaml").search.planner == "KPIECE1");
  CHECK(parse_scene(with("objective: safety", "objective: Distance"), "s.yaml").search.objective == "distance");
  CHECK(parse_scene(with("criterion: robust", "criterion: Equilibrium"), "s.yaml").criterion == Criterion::equilibrium);
}

TEST_CASE("feet that cannot stand where they are put are refused", "[scene]") {
  const Fault fault = GENERATE(
      Fault{"s: 1.75", "s: 1.5", "s.yaml:19:45: s: 1.5 is on a vertex of chain 0"},
      Fault{"s: 1.75", "s: 0", "s.yaml:19:45: s: 0 is on a vertex of chain 0"},
      Fault{"s: 1.75", "s: 1.6", "s.yaml:19:45: s: 1.6 is on segment 1 of chain 0, where no foot may stand"},
      Fault{"s: 1.75", "s: 3.16", "s.yaml:19:45: s: 3.16 is outside chain 0; expected 0 to 3.15"},
      Fault{"s: 1.75", "s: -0.1", "s.yaml:19:45: s: -0.1 is outside chain 0"},
      Fault{"chain: 0,", "chain: 2,", "s.yaml:19:39: chain: 2 does not exist; chains are 0 to 1"},
      Fault{"chain: 0,", "chain: -1,", "s.yaml:19:39: chain: -1 does not exist"},
      Fault{"chain: 0,", "chain: 4294967296,", "s.yaml:19:39: chain: 4294967296 does not exist"},
      Fault{"{x: 0.1}", "{x: 3}", "s.yaml:19:25: x: 3 is beyond the terrain; expected -1 to 2"},
      Fault{"{x: 0.1}", "{x: 0.5}",
            "s.yaml:19:25: x: 0.5 is on a vertical face from y = 0 to 0.15, segment 1 of chain 0; expected another "
            "x"},
      Fault{"{x: 0.1}", "{x: 1.75}",
            "s.yaml:19:25: x: 1.75 is ambiguous; expected one of: {chain: 0, s: 2.9}, {chain: 1, s: 0.25} (a ceiling)"},
      Fault{"{x: 0.1}", "{x: 0.1, s: 1}", "s.yaml:19:21: foot: x is given besides chain and s"},
      Fault{"{x: 0.1}", "{}", "s.yaml:19:21: foot: nothing is given"},
      Fault{"{x: 0.1}", "{x: 0.1, y: 0}",
            "s.yaml:19:33: y: the height of a foot follows from the terrain; expected {x} alone, or {chain, s}"},
      Fault{"{x: 0.1}", "0.1",
            "s.yaml:19:21: foot: 0.1 is given; expected {x: number}, {chain: number, s: number} or null"},
      Fault{"{x: 0.1}, ", "",
            "s.yaml:19:9: feet: a list of 2 items is given; expected a list of 3, one for each leg (null: in the "
            "air)"},
      Fault{"{x: -0.2}, {x: 0.1}", "~, null", "s.yaml:19:9: feet: 1 given; expected at least 2"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("an x without foothold is told what is there instead", "[scene]") {
  // Two chains: a step whose riser may be stood on, a tread that may not, a gap from 2 to 2.5.
  const auto error_at = [](const std::string& x) {
    const std::string chains =
        "    - vertices: [[-1, 0], [0.5, 0], [0.5, 0.15], [1, 0.15], [2, 0.15]]\n"
        "      segments: {2: {foothold: false}}\n"
        "    - vertices: [[2.5, 0], [4, 0]]\n";
    std::string text = with("{x: 0.1}", "{x: " + x + "}");
    const auto at = text.find("    - vertices: [[-1");
    const auto end = text.find("robot:");
    return error_of(text.replace(at, end - at, chains));
  };
  CHECK(error_at("0.5") ==
        "s.yaml:19:25: x: 0.5 is on a vertical face from y = 0 to 0.15, segment 1 of chain 0; expected another x, or "
        "{chain: 0, s} with s between 1.5 and 1.65 to stand on the face");
  CHECK(error_at("0.75") ==
        "s.yaml:19:25: x: 0.75 is on segment 2 of chain 0, where no foot may stand (foothold: false); expected a "
        "foothold");
  CHECK(error_at("1") == "s.yaml:19:25: x: 1 is on a vertex of chain 0; expected a point inside a segment");
  CHECK(error_at("2.25") ==
        "s.yaml:19:25: x: 2.25 is in a gap of the terrain, from 2 to 2.5; expected a point inside a segment");
  CHECK(error_at("-1.5") == "s.yaml:19:25: x: -1.5 is beyond the terrain; expected -1 to 4");
  CHECK(error_at("4") == "s.yaml:19:25: x: 4 is on a vertex of chain 1; expected a point inside a segment");
}

TEST_CASE("ground given from right to left is told at its chain, and only where no foot can push up", "[scene]") {
  const auto scene = [](const std::string& chains, const std::string& feet, const std::string& friction = "0.6") {
    return "surefoot: 1\nterrain:\n  friction: " + friction + "\n  chains:\n" + chains +
           "robot: {radius_of_gyration: 0.1, reach: [0.1, 0.9]}\ndisturbance: {kappa: 0, nu: 0}\nstart: {feet: " +
           feet + "}\ngoal: {com_x: [1, 2]}\n";
  };
  const std::string three = "[{x: 0}, {x: 0.4}, {x: 0.2}]", reversed = "    - vertices: [[2.5, 0], [-1, 0]]\n";
  CHECK(error_of(scene(reversed, three)) ==
        "s.yaml:5:17: vertices: chain 0 runs from right to left under the start feet, so free space is below it and no "
        "foot "
        "can push up; reverse its vertices?");
  // With a floor below it is a ceiling, as it was meant.
  const std::string floor = "    - vertices: [[-1, -2], [2.5, -2]]\n";
  CHECK(error_of(scene(reversed + floor, "[{chain: 1, s: 1}, {chain: 1, s: 1.4}, null]")) == "no error");
  CHECK_THAT(error_of(scene(floor + reversed, "[{chain: 1, s: 1}, {chain: 1, s: 1.4}, null]")),
             Catch::StartsWith("s.yaml:6:17: vertices: chain 1 runs from right to left"));
  // One foot that can push up leaves the verdict to balance.
  CHECK(error_of(scene(floor + "    - vertices: [[2.5, -1.5], [-1, -1.5]]\n",
                       "[{chain: 0, s: 1}, {chain: 1, s: 2.1}, null]")) == "no error");
  // Overhanging walls, n = (3, -1) / sqrt 10 and its mirror image: f = n + mu t rises by (-1 + 3 mu) / sqrt 10, so
  // that friction above 1/3 can carry and friction below cannot.
  const std::string walls = "    - vertices: [[-0.2, 0.6], [0, 0]]\n    - vertices: [[0.6, 0], [0.8, 0.6]]\n";
  const std::string braced = "[{chain: 0, s: 0.2}, {chain: 1, s: 0.2}, null]";
  const std::string overhang = "    - vertices: [[0, 0.6], [-0.2, 0]]\n    - vertices: [[0.8, 0], [0.6, 0.6]]\n";
  CHECK(error_of(scene(walls, braced, "0")) == "no error");
  CHECK(error_of(scene(overhang, braced, "0.34")) == "no error");
  CHECK_THAT(error_of(scene(overhang, braced, "0.33")), Catch::StartsWith("s.yaml:5:17: vertices: chain 0 runs from"));
}

TEST_CASE("a plan given as a scene is called one", "[scene]") {
  CHECK(error_of("{\"surefoot\": 1, \"scene\": \"a\", \"stances\": [], \"transfers\": []}") ==
        "s.yaml:1:1: scene: this is a plan; expected a scene (surefoot check SCENE PLAN verifies a plan)");
}

TEST_CASE("a support that cannot be is refused", "[scene]") {
  const Fault fault =
      GENERATE(Fault{"support: [2, 1]", "support: [2, 2]", "s.yaml:20:12: support: leg 2 is named twice"},
               Fault{"support: [2, 1]", "support: [0, 1]",
                     "s.yaml:20:13: support: leg 0 does not exist; expected 1 to 3"},
               Fault{"support: [2, 1]", "support: [2, 4]", "s.yaml:20:16: support: leg 4 does not exist"},
               Fault{"support: [2, 1]", "support: [1, 2, 3]", "s.yaml:20:12: support [leg, leg]: a list of 3 items"},
               Fault{"{x: 0.1}", "null", "s.yaml:20:13: support: leg 2 starts in the air"});
  CHECK_THAT(error_of(with(fault.old_part, fault.new_part)), Catch::StartsWith(fault.error));
}

TEST_CASE("a start that no COM can reach is refused", "[scene]") {
  SECTION("a support foot out of reach of the given COM") {
    // Foot 2 at (0.1, 0): sqrt(0.6^2 + 0.8^2) = 1 m.
    CHECK(error_of(with("com: [-0.05, 0.5]", "com: [-0.5, 0.8]")) ==
          "s.yaml:21:8: com: foot 2 is 1 m away, out of reach; expected 0.2 to 0.9");
    CHECK_THAT(error_of(with("com: [-0.05, 0.5]", "com: [-0.2, 0.1]")),
               Catch::StartsWith("s.yaml:21:8: com: foot 1 is 0.1 m"));
  }
  SECTION("without a support, two feet must be within reach") {
    const std::string text = with("  support: [2, 1]\n  com: [-0.05, 0.5]", "  com: [-0.6, 0.7]");
    // Foot 1: sqrt(0.16 + 0.49) = 0.81; foot 2: sqrt(0.49 + 0.49) = 0.99; foot 3 farther.
    CHECK_THAT(error_of(text), Catch::StartsWith("s.yaml:20:8: com: feet within reach are 1; expected 2"));
  }
  SECTION("feet farther apart than two legs are long") {
    const std::string text = with("  support: [2, 1]\n  com: [-0.05, 0.5]", "  support: [1, 3]");
    CHECK(error_of(text) == "no error");
    std::string far = text;
    far.replace(far.find("reach: [0.2, 0.9]"), 17, "reach: [0.2, 0.4]");
    CHECK_THAT(error_of(far),
               Catch::StartsWith("s.yaml:19:9: feet: 0.813941 m apart, out of reach of any COM; expected at most 0.8"));
  }
  SECTION("the limit itself is within reach") {
    // Foot 2 is at 3-4-5 from the COM, but 0.4 - 0.1 is 0.30000000000000004 in doubles.
    std::string text = with("com: [-0.05, 0.5]", "com: [0.4, 0.4]");
    text.replace(text.find("{x: -0.2}"), 9, "{x: 0.3}");
    text.replace(text.find("reach: [0.2, 0.9]"), 17, "reach: [0.2, 0.5]");
    CHECK(error_of(text) == "no error");
    text.replace(text.find("reach: [0.2, 0.5]"), 17, "reach: [0.2, 0.4999999]");
    CHECK_THAT(error_of(text), Catch::StartsWith("s.yaml:21:8: com: foot 2 is 0.5 m away"));
  }
}

TEST_CASE("faults of the terrain and of the file are told too", "[scene]") {
  CHECK_THAT(error_of(with("friction: 0.6", "friction: -0.6")),
             Catch::StartsWith("s.yaml:4:13: friction: -0.6 is negative"));
  CHECK_THAT(error_of("surefoot: 1\nsurefoot: 1\n"), Catch::StartsWith("s.yaml:2:1: "));
  CHECK_THAT(error_of(""), Catch::StartsWith("s.yaml:1:1: "));
  CHECK_THAT(error_of("[1, 2]"), Catch::StartsWith("s.yaml:1:1: "));
  CHECK_THROWS_AS(load_scene("/nonexistent/scene.yaml"), terrain::InputError);
  CHECK_THROWS_AS(load_scene(std::filesystem::temp_directory_path().string()), terrain::InputError);
}

TEST_CASE("every canned scene loads", "[scene]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS)) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path());
    CHECK_NOTHROW(load_scene(entry.path().string()));
    ++scenes;
  }
  CHECK(scenes >= 15);
}

TEST_CASE("a contact is where its foothold is", "[scene]") {
  const Scene scene = parse_scene(good, "s");
  const stability::Contact contact = contact_at(*scene.start.feet[0]);
  CHECK(contact.position == Eigen::Vector2d(-0.2, 0));
  CHECK(contact.normal == Eigen::Vector2d(0, 1));
  CHECK(contact.friction == 0.6);
}
