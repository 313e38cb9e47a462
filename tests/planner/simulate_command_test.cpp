// `surefoot simulate` as a user runs it: outcomes with known answers, events, and one clear line for everything
// improper.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "program.hpp"

using nlohmann::json;
using surefoot::tests::Workplace;

namespace {

constexpr double g = 9.81;
const std::string ball = R"({"contacts": [{"p": [0, 0], "n": [0, 1], "mu": 0.5}], "com": [0, 0.3], "rho": 0.1})";
const std::string level =
    R"({"contacts": [{"p": [-0.5, 0], "n": [0, 1], "mu": 0.5}, {"p": [0.5, 0], "n": [0, 1], "mu": 0.5}], )"
    R"("com": [0, 0.2], "rho": 0.1, "restitution": 0.1})";
const std::string vee =
    R"({"contacts": [{"p": [-0.5, 0.15], "n": [0.4, 1], "mu": 0.5}, {"p": [0.5, 0.15], "n": [-0.4, 1], "mu": 0.5}], )"
    R"("com": [0, 0.18], "rho": 0.15, "restitution": 0.1})";

}  // namespace

TEST_CASE("A dropped ball comes to rest when its bounces have added up", "[simulate]") {
  const Workplace place;
  place.write("ball.json", ball);
  for (const char* e : {"0.5", "0.999999"}) {
    const auto outcome =
        place.run(std::string("simulate ball.json --q 0,0.2,0 --time-limit 1e9 --json - --restitution ") + e);
    REQUIRE(outcome.status == 0);
    const json tree = json::parse(outcome.out);
    const double fall = std::sqrt(2 * 0.2 / g), ends = fall + 2 * std::stod(e) * g * fall / (g * (1 - std::stod(e)));
    CHECK(tree["outcome"] == "left");  // 0.2 m is more than a tenth of the radius of gyration
    const auto wider = place.run(
        std::string("simulate ball.json --q 0,0.2,0 --time-limit 1e9 --neighbourhood 1 --json - --restitution ") + e);
    const json full = json::parse(wider.out);
    CHECK(full["outcome"] == "rest");
    CHECK(full["time"].get<double>() == Approx(ends).epsilon(1e-12));
  }
}

TEST_CASE("A sliding block stops after v^2 / (2 mu g)", "[simulate]") {
  const Workplace place;
  place.write("level.json", level);
  const double v = 0.3, way = v * v / (2 * 0.5 * g);
  const auto outcome = place.run("simulate level.json --q-rate 0.3,0,0 --json out.json --svg out.svg");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out.find("at rest") != std::string::npos);
  const json tree = json::parse(place.read("out.json"));
  CHECK(tree["outcome"] == "rest");
  CHECK(tree["q"][0].get<double>() == Approx(way).epsilon(1e-11));
  CHECK(tree["time"].get<double>() == Approx(v / (0.5 * g)).epsilon(1e-11));
  CHECK(tree["collisions"] == 0);
  CHECK(tree["events"][0]["mode"] == "UU");
  CHECK(place.read("out.svg").find("<svg") != std::string::npos);
}

TEST_CASE("Pushed postures of the guaranteed region return to rest, all of them, the same on every run", "[simulate]") {
  const Workplace place;
  place.write("vee.json", vee);
  const auto outcome = place.run("simulate vee.json --sample 100 --json -"),
             again = place.run("simulate vee.json --sample 100 --json -");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == again.out);
  const json tree = json::parse(outcome.out);
  CHECK(tree["classes"]["guaranteed"]["runs"] == 100);
  CHECK(tree["classes"]["guaranteed"]["rest"] == 100);
}

TEST_CASE("Improper input to simulate ends with one line and status 2", "[simulate]") {
  const Workplace place;
  place.write("vee.json", vee);
  place.write("ball.json", ball);
  const struct {
    const char *arguments, *says;
  } cases[] = {
      {"simulate", "expected a posture file"},
      {"simulate missing.json", "missing.json"},
      {"simulate " SUREFOOT_MAPS "/vee.yaml", "takes a scene with --scene"},
      {"simulate ball.json", "restitution is missing"},
      {"simulate ball.json --restitution 1", "between 0 and 1"},
      {"simulate vee.json --restitution -0.1", "between 0 and 1"},
      {"simulate vee.json --q 0,-1,0", "below the ground"},
      {"simulate vee.json --q 0,1", "expected rx,ry,theta"},
      {"simulate vee.json --q 0,0,nan", "expected rx,ry,theta"},
      {"simulate vee.json --q 0,0.1,0 --heights 0,0,0", "given twice"},
      {"simulate vee.json --sample 0", "expected a count >= 1"},
      {"simulate vee.json --sample 5 --svg out.svg", "no picture"},
      {"simulate vee.json --json vee.json", "would be overwritten"},
      {"simulate vee.json --svg - --json -", "one of them"},
      {"simulate vee.json --gravity 0", "expected a number > 0"},
  };
  for (const auto& c : cases) {
    const auto outcome = place.run(c.arguments);
    INFO(c.arguments << ": " << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.one_error());
    CHECK(outcome.err.find(c.says) != std::string::npos);
    CHECK(outcome.out.empty());
  }
  CHECK(place.count() == 2);
}

TEST_CASE("Rounds of rocking from foot to foot are told once and counted", "[simulate]") {
  const Workplace place;
  const std::string call =
      "simulate --scene " SUREFOOT_MAPS "/vee.yaml --stance 1,3 --com=-0.35,0.1 --q 0,2e-4,1e-4 --restitution 0.05";
  const json events = json::parse(place.run(call + " --json -").out)["events"];
  std::size_t lines = 1;  // of the whole table: the start, then every event, collisions in a row as one
  std::string before;
  for (const json& event : events) {
    const std::string kind = event["event"];
    if (kind != "sample" && (kind != "collision" || before != "collision")) ++lines;
    before = kind;
  }
  const std::string report = place.run(call).out;
  CHECK_THAT(report, Catch::StartsWith("vee: start feet of legs 1, 3, here contacts 1 and 2, restitution 0.05: "));
  std::istringstream text(report);
  std::string line;
  std::size_t told = 0, folded = 0;
  for (int head = 0; head < 3; ++head) std::getline(text, line);
  while (std::getline(text, line) && !line.empty()) {
    std::size_t length = 0, times = 0;
    const auto at = line.find("... these ");
    ++told;
    if (at == std::string::npos) continue;
    REQUIRE(std::sscanf(line.c_str() + at, "... these %zu lines %zu times more", &length, &times) == 2);
    folded += length * times;
    --told;
  }
  CHECK(folded > 20);
  CHECK(told + folded == lines);
}

TEST_CASE("Two start feet of a scene are simulated like the posture they make", "[simulate]") {
  const Workplace place;
  const std::string scene =
      "simulate --scene " SUREFOOT_MAPS "/vee.yaml --stance 1,3 --com=-0.35,0.1 --q 0,2e-4,1e-4 --json -";
  const auto from_scene = place.run(scene + " --restitution 0.05");
  REQUIRE(from_scene.status == 0);
  // maps/vee.yaml: level start, friction 0.8, feet at -0.5 and -0.2, rho 0.2.
  place.write("same.json",
              R"({"contacts": [{"p": [-0.5, 0], "n": [0, 1], "mu": 0.8}, {"p": [-0.2, 0], "n": [0, 1], "mu": 0.8}], )"
              R"("rho": 0.2, "com": [-0.35, 0.1], "restitution": 0.05})");
  const auto posture = place.run("simulate same.json --q 0,2e-4,1e-4 --json -");
  REQUIRE(posture.status == 0);
  json one = json::parse(from_scene.out), other = json::parse(posture.out);
  CHECK(one["outcome"] == other["outcome"]);
  CHECK(one["events"].size() == other["events"].size());
  CHECK(one["time"].get<double>() == Approx(other["time"].get<double>()).epsilon(1e-9));
  const auto heights = place.run(scene);
  CHECK(heights.status == 2);
  CHECK(heights.err.find("restitution is missing") != std::string::npos);
  const auto bare = place.run("simulate --scene " SUREFOOT_MAPS "/vee.yaml --stance 1,3");
  CHECK(bare.err.find("restitution is missing") != std::string::npos);  // all that is missing at once
  CHECK(bare.err.find("--com x,y") != std::string::npos);
  const auto both = place.run("simulate same.json --scene " SUREFOOT_MAPS "/vee.yaml");
  CHECK(both.status == 2);
  CHECK(both.err.find("expected one of them") != std::string::npos);
  const auto three =
      place.run("simulate --scene " SUREFOOT_MAPS "/vee.yaml --stance 1,2,3 --restitution 0.1 --com 0,0.5");
  CHECK(three.status == 2);
  CHECK(place.run("simulate same.json --stance 1,2").status == 2);
}
