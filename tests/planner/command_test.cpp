// The commands end to end: the built program, run on files as a user runs it.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"
#include "scene_text.hpp"

using nlohmann::json;
using surefoot::tests::check_untouched;
using surefoot::tests::with;
using surefoot::tests::Workplace;

namespace {

const std::string& scene = surefoot::tests::flat_scene;

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
