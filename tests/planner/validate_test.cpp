// `surefoot validate` as a user runs it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <vector>

#include "program.hpp"
#include "scene_text.hpp"

using surefoot::tests::flat_scene;
using surefoot::tests::with;
using surefoot::tests::Workplace;

TEST_CASE("A ceiling given the wrong way round is remarked on, canned scenes are not", "[validate]") {
  const Workplace place;
  const std::string on_chain_0 = with("{x: -0.3}, {x: 0.25}, {x: 0}", "{chain: 0, s: 0.7}, {chain: 0, s: 1.25}, null");
  place.write("pipe.yaml",
              with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: [[-1, 1.5], [4, 1.5]]", on_chain_0));
  const auto run = place.run("validate pipe.yaml");
  CHECK(run.status == 0);
  CHECK(run.out.find("\npipe.yaml: remark: chain 1 turns its back to chain 0 at (1.5, 1.5)") != std::string::npos);
  CHECK(place.run("plan pipe.yaml --effort 0").err.find("chain 1 turns its back") != std::string::npos);
  CHECK(place.run("plan pipe.yaml --effort 0 -q").err.empty());
  place.write("angle.yaml", with("0.6", "31"));
  CHECK_THAT(place.run("validate angle.yaml").out, Catch::Contains("remark: friction 31 on segment 0 of chain 0"));
  place.write("large.yaml", with("0.15", "15"));
  CHECK_THAT(place.run("validate large.yaml").out,
             Catch::Contains("remark: the radius of gyration, 15 m, is more than"));
  place.write("stone.yaml", with("[[-1, 0], [4, 0]]",
                                 "[[-1, 0], [0.9, 0]]\n    - vertices: [[1.3, 0], [1.1, 0]]\n"
                                 "    - vertices: [[1.5, 0], [4, 0]]"));
  CHECK_THAT(place.run("validate stone.yaml").out, Catch::Contains("remark: chain 1 runs from right to left, with no"));
  const auto canned = place.shell("'" SUREFOOT_BINARY "' validate " SUREFOOT_MAPS "/*.yaml");
  CHECK(canned.out.find("flat.yaml: valid") != std::string::npos);
  CHECK(canned.out.find("remark") == std::string::npos);
}

TEST_CASE("Terrains in millimetres are remarked on, large ones are not", "[validate]") {
  const Workplace place;
  const auto told = [&](const std::string& vertices) {
    place.write("s.yaml", with("[[-1, 0], [4, 0]]", vertices));
    return place.run("validate s.yaml").out;
  };
  CHECK_THAT(told("[[-1000, 0], [500, 0], [500, 150], [900, 150], [4000, 0]]"),
             Catch::Contains(
                 "remark: no segment of the terrain is shorter than 150 m, and the greatest reach is 0.9 m"));
  const auto far_feet = with("{x: -0.3}, {x: 0.25}, {x: 0}", "{x: -300}, {x: 250}, {x: 0}",
                             with("[[-1, 0], [4, 0]]", "[[-1000, 0], [4000, 0]]"));
  place.write("s.yaml", far_feet);
  CHECK_THAT(place.run("validate s.yaml").out, Catch::Contains("expected at most 1.8 (are all in metres?)"));
  place.write("s.yaml", with("[0.2, 0.9]", "[200, 900]", with("0.15", "150", far_feet)));
  CHECK_THAT(place.run("validate s.yaml").out,
             Catch::Contains("remark: the greatest reach is 900 m: are all lengths, nu"));
  place.write("s.yaml", with("[0.2, 0.9]", "[2.0e-7, 9.0e-7]",
                             with("0.15", "1.0e-7", with("-0.3", "-3.0e-7", with("0.25", "2.5e-7", flat_scene)))));
  CHECK_THAT(place.run("validate s.yaml").out, Catch::Contains("remark: the greatest reach is 9e-07 m: are all"));
  place.write("s.yaml", with("{x: -0.3}, {x: 0.25}, {x: 0}", "{x: 1000000000000.7}, {x: 1000000000001.25}, null",
                             with("[[-1, 0], [4, 0]]", "[[1.0e+12, 0], [1000000000004, 0]]")));
  CHECK_THAT(place.run("validate s.yaml").out,
             Catch::Contains("remark: the start is 1e+12 m from the origin, where numbers are 0.000122 m apart"));
  CHECK_THAT(told("[[-1, 0], [4, 0]]\n    - vertices: [[7, 1.0e+20], [8, 1.0e+20]]"), !Catch::Contains("remark"));
  for (const std::string large :
       {"[[-1000, 0], [4000, 0]]", "[[-1000, 0], [500, 0], [500, 0.15], [900, 0.15], [4000, 0]]",
        "[[-1, 1], [-1, 0], [99, 0], [99, 1]]", "[[-99, 0], [99, 0], [199, 5], [299, 0]]",
        "[[-99, 0], [99, 0], [199, 200]]", "[[-99, 0], [99, 0], [99, 30], [199, 30]]"}) {
    INFO(large);
    CHECK_THAT(told(large), Catch::Contains("valid") && !Catch::Contains("remark"));
  }
}

TEST_CASE("Obstacles given the wrong way round and goals in solid ground are remarked on", "[validate]") {
  const Workplace place;
  const auto told = [&](const std::string& text) {
    place.write("s.yaml", text);
    return place.run("validate s.yaml").out;
  };
  const auto with_chain = [](const std::string& vertices, const std::string& text = flat_scene) {
    return with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: " + vertices, text);
  };
  const std::string box = "[[1.4, .01], [1.4, .3], [1, .3], [1, .01]]";
  CHECK_THAT(told(with_chain(box)), Catch::Contains("remark: the free side of chain 1 is its inside"));
  // Closed, where the goal lies above it for all that is said.
  const std::string closed = "[[1.4, .7], [1.8, .7], [1.8, 1], [1.4, 1], [1.4, .7]]";
  CHECK_THAT(told(with_chain(closed,
                             with("{x: -0.3}, {x: 0.25}, {x: 0}", "{chain: 0, s: 0.7}, {chain: 0, s: 1.25}, null"))),
             Catch::Contains("remark: the free side of chain 1 is its inside, where the start does not lie"));
  CHECK_THAT(told(with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: " + closed + "\n    - vertices: " + box,
                       with("{x: -0.3}, {x: 0.25}, {x: 0}", "{chain: 0, s: 0.7}, {chain: 0, s: 1.25}, null"))),
             Catch::Contains("remark: the free sides of chains 1, 2 are their insides, where the start does not lie"));
  // A tunnel that somebody walks in.
  CHECK_THAT(told(with_chain("[[3.5, .01], [3.5, 1.6], [-.8, 1.6], [-.8, .01]]",
                             with("{x: -0.3}, {x: 0.25}, {x: 0}", "{chain: 0, s: 0.7}, {chain: 0, s: 1.25}, null"))),
             Catch::Contains("start stands\n") && !Catch::Contains("remark"));
  const auto with_height = [](const std::string& com_y) { return with("[1.5, 2]", "[1.5, 2], com_y: " + com_y); };
  CHECK_THAT(told(with_height("[-0.5, -0.01]")), Catch::Contains("remark: the goal lies behind chain 0"));
  CHECK_THAT(told(with("com_x: [1.5, 2]", "com_y: [-0.5, -0.1]")),
             Catch::Contains("remark: the goal lies behind chain 0"));
  // Under one chain, but over another.
  CHECK_THAT(told(with("[[-1, 0], [4, 0]]", "[[-1, 0], [1, 0]]\n    - vertices: [[1.05, -0.3], [1.6, -0.3]]",
                       with("com_x: [1.5, 2]", "com_y: [-0.25, -0.1]"))),
             !Catch::Contains("remark"));
  // Level with the lowest vertex of a pit.
  for (const std::string height : {"[-0.6, -0.4]", "[-0.51, -0.49]", "[-0.6, -0.41]"})
    CHECK_THAT(told(with("[[-1, 0], [4, 0]]", "[[-1, 0], [0.5, 0], [1, -0.5], [1.4, 0], [4, 0]]", with_height(height))),
               Catch::Contains("remark: the goal lies behind chain 0"));
  // Beside the ground, and below its end; however far down the goal begins.
  for (const std::string low : {"-10", "-1.0e+6"}) {
    const auto goal = [&](const std::string& x) { return with("[1.5, 2]", x + ", com_y: [" + low + ", -0.5]"); };
    CHECK_THAT(told(goal("[-1.2, -1.01]")), !Catch::Contains("remark"));
    CHECK_THAT(told(goal("[3.8, 3.98]")), Catch::Contains("remark: the goal lies behind chain 0"));
  }
  // The ordinary way to say that there is no lower limit.
  CHECK_THAT(told(with_height("[-100, 0.6]")), Catch::Contains("valid") && !Catch::Contains("remark"));
}

TEST_CASE("What most likely keeps a start from standing is remarked on beside the fault", "[validate]") {
  const Workplace place;
  // A chimney whose left wall is given upwards.
  std::string chimney = with("[[-1, 0], [4, 0]]", "[[0, 0], [0, 4]]\n    - vertices: [[0.8, 0], [0.8, 4]]");
  chimney = with("{x: -0.3}, {x: 0.25}, {x: 0}", "{chain: 0, s: 1}, {chain: 1, s: 1}, {chain: 0, s: 0.7}", chimney);
  place.write("s.yaml", with("com_x: [1.5, 2]", "com_y: [2, 2.6]", chimney));
  const auto run = place.run("validate s.yaml");
  CHECK(run.status == 2);
  CHECK_THAT(run.out, Catch::StartsWith("s.yaml:10:3: start: no COM within reach of feet ") &&
                          Catch::Contains("\ns.yaml: remark: chain 0 turns its back to chain 1 at (0, 2)"));
  CHECK_THAT(run.out, !Catch::Contains("valid"));
}

TEST_CASE("A start foot that no COM reaches together with another is remarked on", "[validate]") {
  const Workplace place;
  const std::string wide = with("[[-1, 0], [4, 0]]", "[[-1, 0], [40, 0]]");
  for (const auto& [x, far] : {std::pair("2.04", false), {"2.06", true}}) {  // reach 0.9, the nearest foot at 0.25
    place.write("s.yaml", with("{x: 0}", std::string("{x: ") + x + "}", wide));
    const auto run = place.run("validate s.yaml");
    CHECK(run.status == 0);
    CHECK((run.out.find("remark: start foot 3 at (2.06, 0) is 1.81 m from the nearest other one") !=
           std::string::npos) == far);
    CHECK((run.out.find("remark") != std::string::npos) == far);
  }
}

TEST_CASE("A plan over a ceiling without sides is remarked on, plans of canned scenes are not", "[validate]") {
  const Workplace place;
  // A plate 0.25 m over a gap, too low to go under it.
  place.write("plate.yaml", with("[[-1, 0], [4, 0]]",
                                 "[[-1, 0], [0.8, 0], [0.9, -0.6], [1.3, -0.6], [1.4, 0], [4, 0]]\n"
                                 "    - vertices: [[1.3, 0.25], [1.1, 0.25], [1, 0.25], [0.9, 0.25]]\n"
                                 "      segments: {0: {foothold: false}, 1: {foothold: false}, 2: {foothold: false}}"));
  const auto run = place.run("plan plate.yaml --effort 0 -o plan.json");
  REQUIRE(run.status == 0);
  CHECK_THAT(run.err,
             Catch::Contains("looks at the back of chain 1 at (") && Catch::Contains("give a ceiling its sides\n"));
  CHECK_THAT(place.run("check plate.yaml plan.json").err, Catch::Contains("looks at the back of chain 1 at ("));
  // The same of more pieces; an obstacle the wrong way round is no ceiling.
  const auto told_of = [&](const std::string& vertices) {
    place.write("over.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: " + vertices));
    const auto over = place.run("plan over.yaml --effort 0 -o plan.json");
    REQUIRE(over.status == 0);
    const auto check = place.run("check over.yaml plan.json");
    CHECK(over.err.find(check.err) != std::string::npos);  // the same remark
    return check.err;
  };
  CHECK_THAT(told_of("[[.8, .05], [1.2, .05], [1.2, .15], [.8, .15], [.8, .05]]"),
             Catch::Contains("looks at the back of chain 1 at (") &&
                 Catch::Contains("as solid: is it given the wrong way round?\n"));
  // The second of two, and one too high over the ground to be an obstacle.
  const std::string far = "[[-.9, .05], [-.8, .05], [-.8, .1], [-.9, .1], [-.9, .05]]\n    - vertices: ";
  for (const std::string& vertices : {far + "[[.8, .05], [1.2, .05], [1.2, .15], [.8, .15], [.8, .05]]",
                                      std::string("[[1.2, .24], [1.2, .28], [.8, .28], [.8, .24]]")})
    CHECK_THAT(told_of(vertices), Catch::Contains("as solid: is it given the wrong way round?\n"));
  CHECK_THAT(told_of("[[1.2, .05], [1, .1], [.8, .05]]"),
             Catch::Contains("as solid: is it given the wrong way round?\n"));
  for (const std::string name : {"chimney", "vee", "stairs_up", "ridge"})
    CHECK_THAT(place
                   .run("check " SUREFOOT_MAPS "/" + name + ".yaml " SUREFOOT_TESTS_DIR "/regression/golden/" + name +
                        ".json")
                   .err,
               !Catch::Contains("back of chain"));
}

TEST_CASE("A scene in order is summed up on one line, status 0", "[validate]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  const auto run = place.run("validate scene.yaml");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(run.out == "scene.yaml: valid: scene, 1 chain, 1 segment, 5 m, friction 0.6, start stands\n");
  const auto from_stdin = place.run("validate -", flat_scene);
  CHECK(from_stdin.status == 0);
  CHECK(from_stdin.out.starts_with("<stdin>: valid: "));
}

TEST_CASE("A scene in order is drawn on request, with or without a plan for it", "[validate]") {
  const Workplace place;
  place.write("gap.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [0.6, 0]]\n    - vertices: [[3.4, 0], [4, 0]]"));
  const auto run = place.run("validate gap.yaml --svg gap.svg");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Catch::StartsWith("gap.yaml: valid: "));
  const std::string svg = place.read("gap.svg");
  CHECK_THAT(svg, Catch::Contains("<title>gap</title>") && Catch::Contains(">goal</text>"));
  CHECK_THAT(svg, !Catch::Contains("R_SS") && !Catch::Contains("COM by step"));  // of plans
  CHECK_THAT(svg, !Catch::Contains("solid side"));
  place.write("room.yaml",
              with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: [[5, 1], [6, 1], [6, 2], [5, 2], [5, 1]]"));
  CHECK_THAT(place.run("validate room.yaml --svg -").out, Catch::Contains(">solid side</text>"));
  CHECK(place.run("validate gap.yaml --svg -").out == svg);
  const auto files = place.count();
  CHECK(place.run("validate gap.yaml gap.yaml --svg two.svg").status == 2);
  CHECK(place.run("validate gap.yaml --svg gap.yaml").status == 2);
  place.write("gap.yaml", with("0.6", "-1"));
  const auto bad = place.run("validate gap.yaml --svg bad.svg");
  CHECK(bad.status == 2);
  CHECK_THAT(bad.out, Catch::Contains("friction: -1 is negative"));
  CHECK(place.count() == files);
}

TEST_CASE("All faults of all scenes are listed by place, status 2", "[validate]") {
  const Workplace place;
  place.write("good.yaml", flat_scene);
  place.write("bad.yaml", with("0.6", "-1", with("com_x", "com_z")));
  const auto run = place.run("validate bad.yaml good.yaml missing.yaml");
  CHECK(run.status == 2);
  CHECK(run.err.empty());
  CHECK(run.out ==
        "bad.yaml:3:13: friction: -1 is negative; expected a number >= 0\n"
        "bad.yaml:11:8: goal: unknown key \"com_z\"; did you mean \"com_x\"?\n"
        "good.yaml: valid: good, 1 chain, 1 segment, 5 m, friction 0.6, start stands\n"
        "missing.yaml: no such file or canned scene (surefoot maps lists those)\n");
}

TEST_CASE("What plan refuses before it searches, validate refuses too", "[validate]") {
  const Workplace place;
  // Both feet left of the COM: no rule of the file is broken, but gravity's.
  place.write("scene.yaml", with("  support", "  com: [0.4, 0.4]\n  support"));
  const auto plan = place.run("plan scene.yaml"), validate = place.run("validate scene.yaml");
  CHECK(plan.status == 2);
  CHECK(validate.status == 2);
  CHECK(plan.err == "surefoot: error: " + validate.out);
  CHECK_THAT(validate.out, Catch::Contains("not stable"));
}

TEST_CASE("Commands name the first fault in the order of the file, and how many more there are", "[validate]") {
  const Workplace place;
  // The feet are read after the robot, but these faults are told by their place: goal on line 11, robot on line 6.
  const std::string one = with("com_x: [1.5, 2]", "com_x: 1.5");
  place.write("one.yaml", one);
  place.write("three.yaml", with("kappa: 0.1", "kappa: x", with("reach: [0.2, 0.9]", "reach: 0.9", one)));
  const std::string goal = "11:15: com_x: 1.5 is given; expected [from, to], the least first";
  for (const std::string command : {"plan ", "region "}) {
    CHECK(place.run(command + "one.yaml").err == "surefoot: error: one.yaml:" + goal + "\n");
    const auto run = place.run(command + "three.yaml");
    CHECK(run.status == 2);
    CHECK(run.err ==
          "surefoot: error: three.yaml:6:42: reach [least, greatest]: 0.9 is given; expected a list of 2 items "
          "in square brackets, [a, b] (and 2 more: surefoot validate three.yaml)\n");
  }
  // What is read first is not always what stands first.
  place.write("order.yaml", with("goal: {com_x: [1.5, 2]}\n", "", "goal: 1\n" + with("0.6", "-1")));
  CHECK_THAT(place.run("plan order.yaml").err, Catch::StartsWith("surefoot: error: order.yaml:1:7: goal: 1 is given"));
  CHECK_THAT(place.run("validate order.yaml").out, Catch::StartsWith("order.yaml:1:7: goal: 1 is given"));
}

TEST_CASE("A start that cannot stand is refused with its cause by plan and validate alike", "[validate]") {
  struct Start {
    std::string text, told;
  };
  const std::string level = "no COM balances on feet 1 and 2: friction bears sideways pushes below ";
  const std::string none = "no COM within reach of feet 1 and 2 balances";
  // Feet 1 and 2 stand 0.55 m apart on level ground: without kappa, COMs at least nu inside both feet balance.
  const std::vector<Start> starts{
      {with("kappa: 0.1", "kappa: 0.7"), level + "0.6 of the weight, kappa is 0.7"},
      {with("kappa: 0.1", "kappa: 0.6"), level + "0.6 of the weight, kappa is 0.6"},
      {with("kappa: 0.1", "kappa: 0", with("0.6", "0")),
       "no COM balances on feet 1 and 2: without friction they bear no sideways push, however small"},
      {with("nu: 0.03", "nu: 0.3"), none + " every disturbance: nu = 0.3 m alone is too much"},
      {with("{x: 0.25}", "{x: -0.29}"),
       none + " every disturbance: nu = 0.03 m alone is too much for feet 0.01 m apart"},
      // On a slope of tangent t friction mu bears pushes down the slope up to tan(atan mu - atan t) =
      // (mu - t) / (1 + mu t): 0.25 / 1.375 for mu = 0.75 and t = 0.5, 0.2 for mu = 1.5 and t = 1.
      {with("0.6", "0.75", with("[4, 0]", "[4, 2.5]", with("kappa: 0.1", "kappa: 0.2"))),
       level + "0.181818 of the weight, kappa is 0.2"},
      {with("0.6", "1.5", with("[4, 0]", "[4, 5]", with("kappa: 0.1", "kappa: 0.21"))),
       none + " every disturbance: kappa = 0.21 alone is too much"},
      {with("0.6", "0.5", with("[4, 0]", "[4, 5]")),
       "no COM balances on feet 1 and 2, even without disturbances: the ground is too steep for its friction"},
      {with("{x: 0.25}", "{x: -0.3}"), none + ", even without disturbances: they stand at one point"},
      // Any two of three feet: the cause that they share is said once.
      {with("  support: [1, 2]\n", "", with("kappa: 0.1", "kappa: 0.7")),
       "no COM balances on feet 1 and 2, 1 and 3, 2 and 3: friction bears sideways pushes below 0.6 of the weight, "
       "kappa "
       "is 0.7"},
      {with("  support", "  com: [0, 0.4]\n  support", with("kappa: 0.1", "kappa: 0.7")),
       level + "0.6 of the weight, kappa is 0.7"},
      // Where no COM balances, the COM that is given is not to blame.
      {with("  support", "  com: [0, 0.4]\n  support", with("nu: 0.03", "nu: 0.3")),
       none + " every disturbance: nu = 0.3 m alone is too much"},
      {with("  support", "  com: [-0.3, 0.4]\n  support", with("{x: 0.25}", "{x: -0.3}")),
       none + ", even without disturbances: they stand at one point"},
  };
  const Workplace place;
  for (const Start& start : starts) {
    INFO(start.told);
    place.write("s.yaml", start.text);
    const auto plan = place.run("plan s.yaml"), validate = place.run("validate s.yaml");
    CHECK(plan.status == 2);
    CHECK(validate.status == 2);
    CHECK(validate.out == "s.yaml:9:3: start: " + start.told + "\n");
    CHECK(plan.err == "surefoot: error: " + validate.out);
  }
  // Ground as steep as friction bears to within rounding, 0.26 = 0.4108 / 1.58: that it bears nothing is no proof that
  // it is too steep.
  place.write("s.yaml",
              with("0.6", "0.26",
                   with("[[-1, 0], [4, 0]]", "[[0, 0], [1.58, 0.4108]]",
                        with("{x: -0.3}, {x: 0.25}, {x: 0}", "{x: 0.2}, {x: 1.3}, {x: 0.5}", with("0.9]", "2]")))));
  CHECK_THAT(place.run("validate s.yaml").out,
             Catch::Contains("no COM balances on feet 1 and 2: friction bears no sideways push, kappa is 0.1") &&
                 !Catch::Contains("even without"));
  // Friction that just bears kappa is no fault of the start.
  place.write("s.yaml", with("kappa: 0.1", "kappa: 0.59"));
  CHECK_THAT(place.run("validate s.yaml").out, Catch::EndsWith("start stands\n"));
}

TEST_CASE("The goal's name stands below a ceiling that hides the upper part of the goal", "[validate]") {
  const Workplace place;
  const auto height_of_name = [&](const std::string& walls) {
    place.write("s.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n" + walls,
                               with("{x: -0.3}, {x: 0.25}, {x: 0}", "{x: -0.3}, {x: 0.25}, null")));
    const std::string svg = place.run("validate s.yaml --svg -").out;
    std::smatch found;
    REQUIRE(std::regex_search(svg, found, std::regex("y=\"([0-9.]+)\"[^>]*>goal</text>")));
    std::smatch last;  // the first is that of the legend
    const std::string rest = found.suffix();
    REQUIRE(std::regex_search(rest, last, std::regex("y=\"([0-9.]+)\"[^>]*>goal</text>")));
    return std::stod(last[1]);
  };
  const double open = height_of_name("    - vertices: [[2.4, 3], [2.4, 1.5]]\n    - vertices: [[1.4, 1.5], [1.4, 3]]");
  const double below = height_of_name("    - vertices: [[2.4, 3], [2.4, 1.5], [1.4, 1.5], [1.4, 3]]");
  CHECK(below > open + 50);
  // So far out that a line of text is less than what coordinates resolve.
  place.write("far.yaml",
              "surefoot: 1\nterrain: {friction: 0.6, chains: [{vertices: [[-1, 1e16], [4, 1e16]]}]}\n"
              "robot: {radius_of_gyration: 0.2, reach: [0.3, 3.5]}\ndisturbance: {kappa: 0.01, nu: 0.003}\n"
              "start: {feet: [{x: -0.5}, {x: 0.5}, null], com: [0, 10000000000000002]}\n"
              "goal: {com_x: [1.5, 2], com_y: [9999999999999992, 9999999999999998]}\n");
  CHECK(place.run("validate far.yaml --svg far.svg").status == 0);
}

TEST_CASE("A given COM in solid ground is told so, unless it breaks another rule first", "[validate]") {
  const Workplace place;
  place.write("s.yaml", with("  support", "  com: [0, -1.3]\n  support"));
  CHECK_THAT(place.run("validate s.yaml").out, Catch::Contains("com: foot 1 is 1.3"));
  place.write("s.yaml", with("  support", "  com: [0, -0.3]\n  support"));
  CHECK(place.run("validate s.yaml").out ==
        "s.yaml:10:8: start: the COM lies behind chain 0, in what pictures show as solid ground\n");
}

TEST_CASE("A given COM that balances nowhere near is told where it would", "[validate]") {
  const Workplace place;
  // Without disturbances the COM lies between the feet, at x = -0.3 and 0.25 (each has reach 0.9 about it).
  place.write("s.yaml",
              with("  support", "  com: [0.4, 0.4]\n  support", with("kappa: 0.1, nu: 0.03", "kappa: 0, nu: 0")));
  CHECK(
      place.run("validate s.yaml").out ==
      "s.yaml:10:8: start: not stable on feet 1 and 2: safety factor 0, limited by equilibrium; more than 1 is needed; "
      "COMs that balance there have x between -0.3 and 0.25\n");
}

TEST_CASE("A start that no search is needed to refuse is said to be impossible, though the file is in order",
          "[validate]") {
  const Workplace place;
  place.write("s.yaml", with("clearance: 0.1", "clearance: 2"));
  const auto run = place.run("validate s.yaml");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Catch::Contains("the start cannot stand: ") && Catch::Contains("keeps the clearance 2"));
}

TEST_CASE("A foot that hangs below a chain given the wrong way round is named where the start cannot stand",
          "[validate]") {
  const Workplace place;
  place.write("s.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [0, 0]]\n    - vertices: [[4, 0], [0.05, 0]]",
                             with("{x: 0}", "null")));
  CHECK_THAT(place.run("validate s.yaml").out,
             Catch::Contains(
                 "; foot 2 hangs below chain 1, which runs from right to left there: reverse its vertices?"));
}

TEST_CASE("Scene and plan in each other's place are told apart", "[validate]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  REQUIRE(place.run("plan scene.yaml --effort 0 -o plan.json").status == 0);
  REQUIRE(place.shell("'" SUREFOOT_BINARY "' plan scene.yaml --effort 0 > plan.txt").status == 0);
  CHECK(place.run("check plan.json scene.yaml").err ==
        "surefoot: error: plan.json:1:1: scene: this is a plan; expected a scene (surefoot check SCENE PLAN "
        "verifies a plan)\n");
  CHECK(place.run("check scene.yaml scene.yaml").err ==
        "surefoot: error: scene.yaml:1:1: plan: this is a scene; expected a plan (surefoot check SCENE PLAN)\n");
  CHECK(place.run("check scene.yaml plan.txt").err ==
        "surefoot: error: plan.txt:1:1: plan: this is a plan printed as text; write it with -o plan.json\n");
  CHECK(place.run("check scene.yaml plan.json").status == 0);
}

TEST_CASE("A report of many faults ends with the number of the others", "[validate]") {
  const Workplace place;
  std::string vertices = "[[-1, 0]";
  for (int i = 0; i < 250; ++i) vertices += ", [0, b]";
  place.write("scene.yaml", with("[[-1, 0], [4, 0]]", vertices + "]"));
  const auto run = place.run("validate scene.yaml");
  CHECK(run.status == 2);
  CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 101);
  CHECK(run.out.ends_with("scene.yaml: and at least 150 more\n"));
}

TEST_CASE("A COM whose stance is not frictionally stable is told so, not by its safety factor", "[validate]") {
  const Workplace place;
  // Above level ground with the COM high and off the middle clattering need not die out for e = 0.99.
  place.write("s.yaml", with("  support", "  com: [0, 0.7]\n  support",
                             with("start:", "stability: {criterion: both, restitution: 0.99}\nstart:")));
  const auto run = place.run("validate s.yaml");
  CHECK_THAT(run.out, Catch::Contains("not frictionally stable on feet 1 and 2 for restitution 0.99") &&
                          !Catch::Contains("more than 1 is needed"));
}
