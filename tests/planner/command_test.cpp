// The commands end to end: the built program, run on files as a user runs it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"
#include "scene_text.hpp"

using nlohmann::json;
using surefoot::tests::with;
using surefoot::tests::Workplace;

namespace {

const std::string& scene = surefoot::tests::flat_scene;

/// Neither written nor left beside.
void check_untouched(const Workplace& place, std::ptrdiff_t files) {
  CHECK(place.read("plan.json") == "precious");
  CHECK(place.read("plan.svg") == "precious");
  CHECK(place.count() == files);
}

}  // namespace

TEST_CASE("A plan is printed, and a plan file is accepted by check", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  const auto text = place.run("plan scene.yaml");
  CHECK(text.status == 0);
  CHECK(text.err.empty());
  CHECK(text.out.find('\x1b') == std::string::npos);
  CHECK_THAT(text.out, Catch::Contains("step"));
  for (const std::string format : {"json", "yaml"}) {
    const auto run = place.run("plan scene.yaml --format " + format + " -o plan." + format + " --svg plan.svg");
    CHECK(run.status == 0);
    CHECK(run.out.empty());
    CHECK_THAT(place.read("plan.svg"), Catch::Contains("<svg"));
    const auto check = place.run("check scene.yaml plan." + format);
    CHECK(check.status == 0);
    CHECK(check.err.empty());
    CHECK(check.out.starts_with("holds: "));
  }
  CHECK(place.count() == 4);
}

TEST_CASE("JSON on stdout is the same plan as JSON in a file, and the same seed gives it again", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  const auto tree = [](const std::string& text) {
    json parsed = json::parse(text);
    parsed.erase("time_s");
    return parsed;
  };
  const auto first = place.run("plan scene.yaml --format json --seed 7");
  const auto second = place.run("plan - --format json --seed 7 -o -", scene);
  REQUIRE(first.status == 0);
  REQUIRE(second.status == 0);
  REQUIRE(place.run("plan scene.yaml -q --seed 7 -o plan.json").status == 0);
  json from_stdin = tree(second.out), from_file = tree(place.read("plan.json"));
  from_stdin["scene"] = from_file["scene"];  // a scene from stdin has no file name to be called by
  CHECK(tree(first.out) == from_file);
  CHECK(from_stdin == from_file);
  CHECK(from_file["seed"] == 7);
}

TEST_CASE("A plan that was tampered with does not hold, and check says where", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  json plan = json::parse(place.run("plan scene.yaml --format json").out);
  plan["stances"][1]["com"][1] = 3.0;
  place.write("plan.json", plan.dump());
  const auto check = place.run("check scene.yaml plan.json");
  CHECK(check.status == 1);
  CHECK(check.err.empty());
  CHECK_THAT(check.out, Catch::Contains("reach"));
  CHECK_THAT(check.out, !Catch::Contains("holds"));
  plan["status"] = "no_plan_found";
  place.write("plan.json", plan.dump());
  CHECK(place.run("check scene.yaml plan.json").status == 1);
}

TEST_CASE("A COM that was moved into the ground is told so, of another scene's plan it is not", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  json plan = json::parse(place.run("plan scene.yaml --format json").out);
  plan["stances"][1]["com"][1] = -0.2;
  place.write("plan.json", plan.dump());
  CHECK_THAT(place.run("check scene.yaml plan.json").err,
             Catch::Contains("the COM of stance 2 lies behind chain 0, in what pictures show as solid ground\n"));
  plan["scene"] = "another";
  place.write("plan.json", plan.dump());
  CHECK_THAT(place.run("check scene.yaml plan.json").err,
             Catch::Contains("for a scene named another") && !Catch::Contains("behind"));
}

TEST_CASE("A page that plays the plan comes with it, the same whenever it is made", "[command]") {
  const Workplace place;
  place.write("scene.yaml", with("surefoot: 1", "surefoot: 1\nname: '</script><b>'"));
  REQUIRE(place.run("plan scene.yaml -q -o plan.json --html plan.html").status == 0);
  REQUIRE(place.run("plan scene.yaml -q -o again.json --html again.html").status == 0);
  const std::string page = place.read("plan.html");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(page == place.read("again.html"));
  const auto check = place.run("check scene.yaml plan.json --html checked.html --svg checked.svg");
  CHECK(check.status == 0);
  CHECK(check.out.starts_with("holds: "));
  CHECK(place.read("checked.html") == page);
  CHECK_THAT(place.read("checked.svg"), Catch::Contains("<svg"));
  const auto on_stdout = place.run("check scene.yaml plan.json --html -");
  CHECK(on_stdout.status == 0);
  CHECK(on_stdout.out == page);
  const std::string plan = place.read("plan.json"), scene_text = place.read("scene.yaml");
  for (const char* bad : {"--html nowhere/x.html", "--html ./plan.json", "--svg scene.yaml", "--svg - --html -",
                          "--html .", "--svg x --html ./x"}) {
    const auto run = place.run(std::string("check scene.yaml plan.json ") + bad);
    INFO(bad << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
    CHECK(run.out.empty());
  }
  CHECK(place.read("plan.json") == plan);
  CHECK(place.read("scene.yaml") == scene_text);
  CHECK(place.count() == 7);
}

TEST_CASE("A plan that does not hold can be looked at with what is wrong with it", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  json plan = json::parse(place.run("plan scene.yaml --format json").out);
  plan["stances"][1]["com"][1] = 3.0;
  place.write("plan.json", plan.dump());
  const auto check = place.run("check scene.yaml plan.json --html plan.html");
  CHECK(check.status == 1);
  const std::string first = check.out.substr(0, check.out.find('\n'));
  REQUIRE(first.starts_with("stance 2: "));
  CHECK_THAT(place.read("plan.html"), Catch::Contains("\"faults\":[\"" + first + "\""));
  CHECK_THAT(place.run("check scene.yaml plan.json --svg -").out,
             Catch::Contains("REFUSED by the verifier") && Catch::Contains(first.substr(0, 60)));
  // The last line counts: as many faults as there are lines above it.
  std::istringstream lines(check.out);
  std::string last;
  int count = -1;
  for (std::string line; std::getline(lines, line); last = line) ++count;
  int told = 0;
  REQUIRE(std::sscanf(last.c_str(), "does not hold: %d fault", &told) == 1);
  CHECK(told == count);
  CHECK(check.err.find("named") == std::string::npos);
  plan["scene"] = "elsewhere";
  place.write("plan.json", plan.dump());
  CHECK_THAT(place.run("check scene.yaml plan.json").err, Catch::Contains("for a scene named elsewhere"));
}

TEST_CASE("Names that promise another kind of file are refused before anything is planned", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  for (const char* names :
       {"-o plan.svg", "-o plan.png", "-o plan.JPG", "--svg plan.png", "--svg page.HTML", "--html plan.svg"}) {
    const auto run = place.run(std::string("plan scene.yaml ") + names);
    INFO(names << ": " << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
  }
  CHECK(place.count() == 1);
  REQUIRE(place.run("plan scene.yaml -q --effort 0 -o plan.YML").status == 0);
  CHECK(place.run("check scene.yaml plan.YML").status == 0);
  REQUIRE(place.run("plan scene.yaml -q --effort 0 -o plan.json --svg picture.svg").status == 0);
  CHECK_THAT(place.run("plan picture.svg").err, Catch::Contains("picture.svg:1:1: this is a picture or a page"));
}

TEST_CASE("Feet that have lost their ground are told once each, and nothing that only follows", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  REQUIRE(place.run("plan scene.yaml --effort 0 -o plan.json").status == 0);
  place.write("lower.yaml", with("[[-1, 0], [4, 0]]", "[[-1, -0.5], [4, -0.5]]"));
  const auto run = place.run("check lower.yaml plan.json");
  CHECK(run.status == 1);
  std::istringstream lines(run.out);
  std::vector<std::string> said;
  for (std::string line; std::getline(lines, line);) {
    CHECK((line.find(": foothold: ") != std::string::npos || line.starts_with("does not hold: ")));
    if (const auto at = line.find("is said to stand at"); at != std::string::npos)
      said.push_back(line.substr(line.find("foot "), line.find(" (and so") - line.find("foot ")));
  }
  std::sort(said.begin(), said.end());
  CHECK(said.size() > 2);
  CHECK(std::adjacent_find(said.begin(), said.end()) == said.end());
  CHECK_THAT(run.out, Catch::Contains("more places)"));
  CHECK_THAT(run.out, Catch::Contains("; for feet that were not found stability is not judged in "));
}

TEST_CASE("A chain that begins elsewhere than when the plan was made is named, not all feet on it", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  REQUIRE(place.run("plan scene.yaml --effort 0 -o plan.json").status == 0);
  place.write("longer.yaml", with("[[-1, 0]", "[[-2, 0]"));  // arc lengths count from the first vertex
  const auto run = place.run("check longer.yaml plan.json");
  CHECK(run.status == 1);
  CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 2);
  CHECK_THAT(run.out, Catch::StartsWith("plan: foothold: chain 0 begins 1 m earlier than when the plan was made"));
  CHECK_THAT(run.out, Catch::Contains("\ndoes not hold: 1 fault; for feet that were not found"));
}

TEST_CASE("Where the scene has become safer only what the plan states is wrong, and check says so", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  REQUIRE(place.run("plan scene.yaml --effort 0 -o plan.json").status == 0);
  place.write("safer.yaml", with("kappa: 0.1, nu: 0.03", "kappa: 0.05, nu: 0.015"));  // factors double
  const auto run = place.run("check safer.yaml plan.json");
  CHECK(run.status == 1);
  CHECK_THAT(run.out, Catch::Contains("every stance and transfer is stable and legal (least safety factor "));
  const double before = json::parse(place.read("plan.json"))["safety_factor"];
  const auto at = run.out.rfind("least safety factor ");
  CHECK(std::stod(run.out.substr(at + 20)) == Approx(2 * before).epsilon(1e-5));
  place.write("harder.yaml", with("kappa: 0.1", "kappa: 0.59"));
  CHECK_THAT(place.run("check harder.yaml plan.json").out, !Catch::Contains("every stance"));
}

TEST_CASE("Where friction is another one than the plan was made with, check says where", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  REQUIRE(place.run("plan scene.yaml --effort 0 -o plan.json").status == 0);
  place.write("loose.yaml", with("friction: 0.6", "friction: 0.11"));
  const auto run = place.run("check loose.yaml plan.json");
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Catch::Contains("made with friction 0.6 under foot 1 of stance 1, where this scene has 0.11"));
  // A vertex before the feet changes the numbers of their segments; feet of a chain that begins elsewhere are lost.
  const std::string slippery = with("friction: 0.6", "friction: 0.11");
  const auto begun = [&](const char* vertices) {
    return std::string(slippery).replace(slippery.find("[[-1, 0]"), 8, vertices);
  };
  place.write("numbered.yaml", begun("[[-1, 0], [-0.9, 0]"));
  CHECK_THAT(place.run("check numbered.yaml plan.json").err, Catch::Contains("made with friction 0.6 under foot 1"));
  place.write("moved.yaml", begun("[[-2, 0]"));
  CHECK_THAT(place.run("check moved.yaml plan.json").err, !Catch::Contains("made with friction"));
  // A vertex before the feet changes the numbers of their segments; feet of a chain that begins elsewhere are lost.
  place.write("numbered.yaml",
              with("[[-1, 0], [4, 0]]", "[[-1, 0], [-0.9, 0], [4, 0]]", with("friction: 0.6", "friction: 0.11")));
  CHECK_THAT(place.run("check numbered.yaml plan.json").err, Catch::Contains("made with friction 0.6 under foot 1"));
  place.write("moved.yaml", with("[[-1, 0], [4, 0]]", "[[-2, 0], [4, 0]]", with("friction: 0.6", "friction: 0.11")));
  CHECK_THAT(place.run("check moved.yaml plan.json").err, !Catch::Contains("made with friction"));
}

TEST_CASE("Without a plan the status says so and no file is touched", "[command]") {
  const Workplace place;
  place.write("scene.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [0.6, 0], [0.6, -9], [5, -9], [5, 0], [6, 0]]"));
  place.write("plan.json", "precious");
  place.write("plan.svg", "precious");
  const auto run = place.run("plan scene.yaml --time-limit 0.3 -o plan.json --svg plan.svg");
  CHECK((run.status == 1 || run.status == 3));
  CHECK(run.out.empty());
  CHECK_THAT(run.err, Catch::Contains("plan.json, plan.svg are not written"));
  check_untouched(place, 3);
  const auto explained = place.run("plan scene.yaml --time-limit 5 -o plan.json --explain");
  CHECK(explained.out.empty());
  CHECK_THAT(explained.err, Catch::Contains("alone would do") || Catch::Contains("found to help"));
  const auto text = place.run("plan scene.yaml --time-limit 0.3 --format json");
  CHECK((text.status == 1 || text.status == 3));  // a busy machine may not come to the proof in time, either time
  CHECK(json::parse(text.out)["status"] == (text.status == 1 ? "no_plan_found" : "infeasible"));
}

TEST_CASE("An explanation is told beside a plan that goes elsewhere", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  const auto run = place.run("plan scene.yaml --format json --explain --effort 0");
  CHECK(run.status == 0);
  CHECK(json::parse(run.out)["status"] == "solved");
  CHECK_THAT(run.err, Catch::Contains("What limits the steps"));
  CHECK_THAT(place.run("plan scene.yaml --format json --effort 0").err, !Catch::Contains("What limits the steps"));
}

TEST_CASE("Bad scenes give one error with its place, status 2, and leave files alone", "[command]") {
  struct Bad {
    const char* what;
    std::string text;
    const char* place;  // in the error
  };
  const std::vector<Bad> bad{
      {"broken YAML", with("chains:", "chains: ["), "scene.yaml:"},
      {"tab", with("  friction", "\tfriction"), "scene.yaml:3:"},
      {"unknown key", with("friction:", "frictoin:"), "scene.yaml:3:3"},
      {"wrong type", with("0.6", "slippery"), "scene.yaml:3:13"},
      {"NaN", with("0.6", ".nan"), "scene.yaml:3:13"},
      {"infinite", with("0.6", ".inf"), "scene.yaml:3:13"},
      {"negative friction", with("0.6", "-0.6"), "scene.yaml:3:13"},
      {"foot outside the chain", with("{x: -0.3}", "{x: -30}"), "scene.yaml:9:"},
      {"foot outside by arc length", with("{x: -0.3}", "{chain: 0, s: 99}"), "scene.yaml:9:"},
      {"feet too far apart for any COM", with("{x: -0.3}, {x: 0.25}", "{x: -0.9}, {x: 2.5}"), "scene.yaml:"},
      {"COM out of reach", with("  support", "  com: [0, 5]\n  support"), "scene.yaml:"},
      {"empty", "", "scene.yaml"},
      {"not a map", "[1, 2]\n", "scene.yaml:1:1"},
      {"unknown planner", scene + "search: {planner: RTT}\n", "planner"},
      {"binary", std::string("\0\xff\x01", 3), "scene.yaml"},
  };
  for (const Bad& b : bad) {
    INFO(b.what);
    const Workplace place;
    place.write("scene.yaml", b.text);
    place.write("plan.json", "precious");
    place.write("plan.svg", "precious");
    const auto run = place.run("plan scene.yaml -o plan.json --svg plan.svg");
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    INFO(run.err);
    CHECK(run.one_error());
    CHECK_THAT(run.err, Catch::Contains(b.place));
    check_untouched(place, 3);
  }
}

TEST_CASE("Bad usage is one error and status 2", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  place.write("plan.json", "precious");
  place.write("plan.svg", "precious");
  for (const char* arguments : {"",
                                "paln scene.yaml",
                                "plan",
                                "plan missing.yaml",
                                "plan .",
                                "plan ''",
                                "plan scene.yaml extra",
                                "plan scene.yaml --sede 3",
                                "plan scene.yaml --seed x",
                                "plan scene.yaml --seed 0",
                                "plan scene.yaml --seed -1",
                                "plan scene.yaml --seed 1e3",
                                "plan scene.yaml --seed 99999999999999999999",
                                "plan scene.yaml --time-limit nan",
                                "plan scene.yaml --time-limit -1",
                                "plan scene.yaml --time-limit 0",
                                "plan scene.yaml --format jsno",
                                "plan scene.yaml --planner RTT",
                                "plan scene.yaml --objective speed",
                                "plan scene.yaml -o nowhere/plan.json",
                                "plan scene.yaml -o .",
                                "plan scene.yaml -o ''",
                                "plan scene.yaml -o scene.yaml",
                                "plan scene.yaml -o ./scene.yaml",
                                "plan scene.yaml -o plan.json --svg ./plan.json",
                                "plan scene.yaml -o plan.json --svg nowhere/plan.svg",
                                "plan scene.yaml -o plan.json --html nowhere/plan.html",
                                "plan scene.yaml --html .",
                                "plan scene.yaml --html scene.yaml",
                                "plan scene.yaml --svg plan.svg --html ./plan.svg",
                                "plan scene.yaml --svg -",
                                "plan scene.yaml --html -",
                                "plan scene.yaml -q -v",
                                "check scene.yaml",
                                "check scene.yaml missing.json",
                                "check scene.yaml scene.yaml",
                                "check scene.yaml plan.json",
                                "check - -",
                                "query a b",
                                "simulate",
                                "simulate scene.yaml"}) {
    const auto run = place.run(arguments);
    INFO("surefoot " << arguments << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(run.one_error());
    check_untouched(place, 3);
    CHECK(place.read("scene.yaml") == scene);
  }
}

TEST_CASE("Misspelt words are answered with what was probably meant", "[command]") {
  const Workplace place;
  std::filesystem::create_directory(place / "maps");
  place.write("maps/stairs_up.yaml", scene);
  CHECK_THAT(place.run("paln x").err, Catch::Contains("did you mean plan?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --sede 3").err, Catch::Contains("did you mean --seed?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --time 3").err, Catch::Contains("did you mean --time-limit?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml -svg a.svg").err, Catch::Contains("did you mean --svg?"));
  for (const char* words : {"help", "help plan"}) CHECK_THAT(place.run(words).err, Catch::Contains("surefoot --help"));
  CHECK_THAT(place.run("-version").err, Catch::Contains("did you mean --version?"));
  CHECK_THAT(place.run("--plan a.yaml").err, Catch::Contains("did you mean surefoot plan?"));
  CHECK_THAT(place.run("--svg a.svg").err, Catch::Contains("expected a command before --svg: plan, check,"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --format xml").err,
             Catch::Contains("expected one of: text, json, yaml"));
  const std::vector<std::pair<std::string, std::string>> early{{"--seed 3 plan x", "--seed"},
                                                               {"-q plan x", "-q"},
                                                               {"--svg=a.svg plan x", "--svg"},
                                                               {"-o p.json plan x", "-o"}};
  for (const auto& [words, option] : early)
    CHECK_THAT(place.run(words).err, Catch::Contains(option + " belongs behind the command: surefoot plan ... "));
  const std::vector<std::pair<std::string, std::string>> empty{{"plan ''", "SCENE"},
                                                               {"check maps/stairs_up.yaml ''", "PLAN"},
                                                               {"plan maps/stairs_up.yaml -o ''", "--output"},
                                                               {"plan maps/stairs_up.yaml --svg ''", "--svg"},
                                                               {"query ''", "FILE"}};
  for (const auto& [words, name] : empty) {
    const auto run = place.run(words);
    CHECK(run.status == 2);
    CHECK(run.err == "surefoot: error: " + name + " is an empty text\n");
  }
  const std::string nines(20, '9'), number = "a number such as 0.25 or 1e-3",
                                    whole = "a whole number between -2^63 and 2^63";
  const std::vector<std::pair<std::string, std::string>> beyond{{"--seed " + nines, whole},
                                                                {"--seed -" + nines, whole},
                                                                {"--seed 0x" + nines, whole},
                                                                {"--effort 1e400", number},
                                                                {"--time-limit 1e-400", number}};
  for (const auto& [option, expected] : beyond) {
    const std::size_t blank = option.find(' ');
    const auto run = place.run("plan maps/stairs_up.yaml " + option);
    CHECK(run.status == 2);
    CHECK(run.err == "surefoot: error: " + option.substr(0, blank) + ": found " + option.substr(blank + 1) +
                         ", expected " + expected + "\n");
  }
  CHECK(place.run("plan maps/stairs_up.yaml -q --effort 1e-310 -o plan.yaml").status == 0);
  CHECK_THAT(place.run("plan 1e400").err, Catch::Contains("1e400: "));  // the name of a file
  for (const std::string word : {"-o=x.json", "-o="})
    CHECK_THAT(place.run("plan x " + word).err, Catch::EndsWith("error: " + word + ": behind " + word.substr(0, 2) +
                                                                " stands a space, no equals sign\n"));
  CHECK_THAT(place.run("plan x -q=1").err, Catch::EndsWith("error: -q=1: -q takes no value\n"));
  CHECK_THAT(place.run("plan x -x=1").err, Catch::Contains("not expected here"));
  CHECK_THAT(place.run("validate -- -a=b.yaml").out, Catch::StartsWith("-a=b.yaml: no such file"));
  CHECK_THAT(place.run("simulate vee").err, Catch::Contains("vee: this is a canned scene; expected a posture"));
  CHECK_THAT(place.run("region --posture p.json --wrench 0.1 -0.05").err,
             Catch::Contains("a scene, -0.05, and --posture are given; expected one of them"));
  CHECK_THAT(place.run("version").err, Catch::EndsWith("expected surefoot --version\n"));
  CHECK_THAT(place.run("plan").err, Catch::EndsWith("SCENE is missing (surefoot plan --help tells more)\n"));
  CHECK_THAT(place.run("plan x --svg").err, Catch::EndsWith("error: --svg: expected FILE behind it\n"));
  CHECK_THAT(place.run("plan x --svg a --svg b").err, Catch::EndsWith("error: --svg is given more than once\n"));
  const auto many = place.run("plan a.yaml b.yaml c.yaml d.yaml e.yaml");
  CHECK(many.status == 2);
  CHECK_THAT(many.err,
             Catch::Contains("not expected here: b.yaml, c.yaml, d.yaml and 1 more word (surefoot plan --help"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --planner RTT").err, Catch::Contains("did you mean \"RRT\"?"));
  for (const char* name : {"stairs_up.yaml", "maps/stairs_pu.yaml", "stairsup"})
    CHECK_THAT(place.run(std::string("plan ") + name).err, Catch::Contains("did you mean maps/stairs_up.yaml?"));
}

TEST_CASE("The command bench hands its words to surefoot-bench beside the program, or says what to do", "[command]") {
  const Workplace place;
  place.shell("cp '" SUREFOOT_BINARY "' surefoot");
  const auto alone = place.shell("./surefoot bench verdict");
  INFO(alone.err);
  CHECK(alone.status == 2);
  CHECK(alone.out.empty());
  CHECK(alone.one_error());
  CHECK_THAT(alone.err, Catch::Contains("./surefoot bench builds it"));
  place.write("surefoot-bench", "#!/bin/sh\nprintf '%s|' \"$@\"\nexit 5\n");
  const auto handed = place.shell("chmod +x surefoot-bench && ./surefoot bench verdict --out 'a b'");
  CHECK(handed.status == 5);
  CHECK(handed.out == "verdict|--out|a b|");
}

TEST_CASE("Help and version go to stdout", "[command]") {
  const Workplace place;
  for (const char* arguments : {"--help", "-h", "plan --help", "check --help", "query --help"}) {
    const auto run = place.run(arguments);
    INFO(arguments);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK_THAT(run.out, Catch::Contains("surefoot"));
  }
  for (const char* command : {"plan", "check", "query"})
    CHECK_THAT(place.run(std::string(command) + " --help").out, Catch::Contains("Example: "));
  const auto version = place.run("--version");
  CHECK(version.status == 0);
  for (const char* word : {"surefoot ", "OMPL ", "NLopt ", "Eigen ", "yaml-cpp 0."})
    CHECK_THAT(version.out, Catch::Contains(word));
}

TEST_CASE("Output that cannot be written is an error, not a crash", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  place.write("plan.json", "precious");
  for (const char* arguments : {"plan scene.yaml >/dev/full", "plan scene.yaml >&-", "plan scene.yaml -o /dev/full",
                                "plan scene.yaml -o - --svg plan.svg >/dev/full", "--help >/dev/full"}) {
    const auto run = place.run(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
  }
  CHECK(place.count() == 2);
  CHECK(place.shell("{ '" SUREFOOT_BINARY "' plan scene.yaml; echo $? >status; } | true").status == 0);
  CHECK(std::stoi(place.read("status")) < 3);  // not 128 + SIGPIPE
  CHECK(place.run("plan scene.yaml 2>&-").status == 0);
  CHECK(place.run("plan scene.yaml -o plan.json <&- >&- 2>&-").status == 0);
  CHECK_NOTHROW(json::parse(place.read("plan.json")));
}

TEST_CASE("An output file keeps its permissions and the links to it", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  place.write("plan.json", "old");
  std::filesystem::permissions(place / "plan.json", std::filesystem::perms(0640));
  std::filesystem::create_symlink("plan.json", place / "link.json");
  REQUIRE(place.run("plan scene.yaml -o link.json").status == 0);
  CHECK(std::filesystem::is_symlink(place / "link.json"));
  CHECK(std::filesystem::status(place / "plan.json").permissions() == std::filesystem::perms(0640));
  CHECK(json::parse(place.read("plan.json"))["status"] == "solved");
}

TEST_CASE("Quiet says nothing beside the result, verbose counts on stderr", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  CHECK(place.run("plan scene.yaml -q -o plan.json").err.empty());
  const auto verbose = place.run("plan scene.yaml -v");
  CHECK(verbose.status == 0);
  CHECK_THAT(verbose.err, Catch::Contains("verified"));
  CHECK_THAT(verbose.out, !Catch::Contains("surefoot: "));
  CHECK(verbose.err.find('\r') == std::string::npos);
}
