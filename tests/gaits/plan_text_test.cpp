// What people read of a plan: the table of steps, factors, limits and lengths in words.
#include <catch2/catch.hpp>
#include <limits>
#include <regex>

#include "fixtures.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/plan_words.hpp"

namespace {

using namespace surefoot::gaits;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::lines_of;
using surefoot::gaits::testing::long_ground;
using surefoot::gaits::testing::long_walk;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::scene_on;

}  // namespace

TEST_CASE("the table has one row per step and its columns line up", "[plan_text]") {
  const Scene scene = long_ground();
  const int steps = 300;
  const std::vector<std::string> lines = lines_of(to_text(scene, long_walk(scene, steps, -20)));
  const std::regex row(R"(^ *(\d+) +([1-3]) .*)");
  std::string header;
  std::size_t rows = 0;
  std::vector<std::size_t> points;  // of the decimal points, left of the column `lifted`
  for (const std::string& line : lines) {
    REQUIRE((line.empty() || line.back() != ' '));
    if (line.starts_with("step")) header = line;
    if (header.empty() || !std::regex_match(line, row)) continue;
    ++rows;
    REQUIRE(std::stoul(line) == rows);
    const std::size_t lifted = header.find("lifted");
    REQUIRE(line[lifted] == static_cast<char>('1' + (rows - 1) % 3));
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < lifted; ++i)
      if (line[i] == '.') here.push_back(i);
    if (rows == 3) points = here;  // legs 1 and 2 have stood before, leg 3 only since the first step
    if (rows >= 3) REQUIRE(here == points);
    REQUIRE(line.substr(header.find("limit"), 11) == "equilibrium");
    REQUIRE(line.substr(header.rfind("limit")) == "UFF");
  }
  REQUIRE(rows == steps);
  REQUIRE(points.size() == 8);
}

TEST_CASE("the table says where each leg comes from and goes to", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.planner = "RRT";
  plan.seed = 7;
  plan.time_s = 0.0124;
  plan.transfers[1].safety_factor = plan.safety_factor = 1.4;
  plan.transfers[1].limit = "UFF";
  plan.safety_factor_before_refinement = 1.25;
  plan.left_out = {{"frictional stability", "no restitution is given"}};
  const std::string text = to_text(scene, plan);
  INFO(text);
  const auto says = [&](const std::string& words) { return text.find(words) != std::string::npos; };
  REQUIRE(text.starts_with("hand: solved in 2 steps\n"));
  REQUIRE(std::regex_search(
      text, std::regex(R"(\n +1 +3 +in the air +0\.600 +0\.000 +1 2 +0\.000 +0\.500 +0\.400 +0\.500 +1 +2\.50 )")));
  REQUIRE(std::regex_search(
      text,
      std::regex(
          R"(\n +2 +1 +-0\.200 +0\.000 +1\.000 +0\.000 +2 3 +0\.400 +0\.500 +0\.800 +0\.500 +2 .* 1\.40 +UFF\n)")));
  REQUIRE(std::regex_search(text, std::regex(R"(\n +end +1 3 +0\.800 +0\.500 +2\.50)")));
  REQUIRE(
      says("2 steps, COM travels 0.800 m, least safety factor 1.40 in the transfer of step 2 (UFF), 1.25 before "
           "refinement"));
  REQUIRE(says("planner RRT, seed 7, 0.012 s"));
  REQUIRE(says("frictional stability: no restitution is given"));
}

TEST_CASE("colours change nothing but colours", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  const std::string plain = to_text(scene, plan, {.colour = false, .explain = true});
  const std::string coloured = to_text(scene, plan, {.colour = true, .explain = true});
  REQUIRE(plain.find('\x1b') == std::string::npos);
  REQUIRE(coloured.find('\x1b') != std::string::npos);
  REQUIRE(std::regex_replace(coloured, std::regex("\x1b\\[[0-9;]*m"), "") == plain);
}

TEST_CASE("a name cannot talk to the terminal or break a line", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.scene = "a\x1b[31m\nb";
  const std::string text = to_text(scene, plan);
  REQUIRE(text.find('\x1b') == std::string::npos);
  REQUIRE(text.starts_with("a [31m b: solved"));
}

TEST_CASE("an unstable safety factor is never rounded up to 1", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.safety_factor = std::nextafter(1.0, 0.0);
  REQUIRE(to_text(scene, plan).find("least safety factor <1.00") != std::string::npos);
  plan.safety_factor = 0.9994;
  REQUIRE(to_text(scene, plan).find("least safety factor 0.999") != std::string::npos);
  REQUIRE(factor_in_words(0.0123456) == "0.0123");
  REQUIRE(factor_in_words(12.345) == "12.3");
  REQUIRE(factor_in_words(1 + 1e-9) == ">1.00");
  REQUIRE(factor_in_words(1.0049) == ">1.00");
  REQUIRE(factor_in_words(1.006) == "1.01");
  REQUIRE(factor_in_words(1) == "1.00");
  REQUIRE(factor_in_words(1234.5) == "1234");
  plan.safety_factor = 1;
  REQUIRE(to_text(scene, plan).find("least safety factor 1.00") != std::string::npos);
}

TEST_CASE("no plan: the status and the reason are said", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan;
  plan.scene = "gap";
  plan.status = Status::infeasible;
  plan.reason = "the gap is wider than two reaches";
  REQUIRE(to_text(scene, plan).starts_with("gap: infeasible - the gap is wider than two reaches\n"));
  plan.status = Status::no_plan_found;
  REQUIRE(to_text(scene, plan).starts_with("gap: no plan found - "));
  plan.reason = "no plan found within the time limit (auto); Layers came to COM (1, 2); 3 steps refused";
  REQUIRE(to_text(scene, plan)
              .starts_with(
                  "gap: no plan found within the time limit (auto)\n  Layers came to COM (1, 2)\n  3 steps refused\n"));
}

TEST_CASE("lengths are told in decimals, of tiny and giant robots in digits, and zero has no sign", "[plan_text]") {
  CHECK(length_in_words(-0.0004, 0.9) == "0.000");
  CHECK(length_in_words(-0.0006, 0.9) == "-0.001");
  CHECK(length_in_words(12.3456, 0.9) == "12.346");
  CHECK(length_in_words(0.0123456789, 0.05) == "0.0123");
  CHECK(length_in_words(-2.5e-7, 9e-7) == "-0.000000250");
  CHECK(length_in_words(-2.5e-10, 9e-10) == "-2.5e-10");
  CHECK(length_in_words(1.23456789e30, 9e29) == "1.23457e+30");
}

TEST_CASE("limits are spelled out with the legs they mean", "[plan_text]") {
  REQUIRE(limit_in_words("FF", {0, 2}) == "both feet break away");
  REQUIRE(limit_in_words("UF", {0, 2}) == "foot 1 slides along +t while foot 3 breaks away");
  REQUIRE(limit_in_words("RFF", {0, 1, 2}) == "foot 1 rolls or sticks while feet 2 and 3 break away");
  REQUIRE(limit_in_words("FWF", {0, 1, 2}) == "feet 1 and 3 break away while foot 2 slides along -t");
  REQUIRE(limit_in_words("UWF", {0, 1, 2}) ==
          "foot 1 slides along +t while foot 2 slides along -t while foot 3 breaks away");
  REQUIRE(limit_in_words("FFF", {0, 1, 2}) == "all feet break away");
  REQUIRE(limit_in_words("F", {1}) == "foot 2 breaks away");
  REQUIRE(limit_in_words("UF", {0}) == "UF");  // letters and legs do not match: as it is
  REQUIRE(limit_in_words("odd", {0, 1, 2}) == "odd");
  const Scene scene = long_ground();
  const std::string text = to_text(scene, long_walk(scene, 6, 0), {.colour = false, .explain = true});
  REQUIRE(text.find("UFF on legs 1 2 3: foot 1 slides along +t while feet 2 and 3 break away\n"
                    "      transfer of step 1-6\n") != std::string::npos);
  REQUIRE(text.find("equilibrium on legs 1 2: the feet cannot balance a larger disturbance\n"
                    "      stance of step 1, 4, end\n") != std::string::npos);
  Plan last = long_walk(scene, 1, 0);
  last.stances.back().limit = "FF";
  REQUIRE(to_text(scene, last, {.colour = false, .explain = true})
              .find(": both feet break away\n      the last stance\n") != std::string::npos);
}
