// What `surefoot check` says of plans that were edited, or made for another scene.
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

}  // namespace

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
