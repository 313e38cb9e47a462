// Every canned scene, run as a user would. The plans of golden/ are what the program gave when they were last updated
// on purpose (update_golden.sh).
//
// What is compared. Two runs on one machine must agree in every byte but time_s. A stored plan may come from another
// compiler, C library or processor, whose last bits differ, so it is compared by what a robot would do: the same legs
// on the same segments in the same order, lengths within `length_tolerance`, safety factors within `factor_tolerance`.
// Stored is what the search found (--no-refine): refinement can make more of a last bit where many plans are equally
// safe, so of the refined plan the order of the legs is compared, and that it is not less safe.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"

using nlohmann::json;
using surefoot::test::ProgramRun;
using surefoot::test::read_text;
using surefoot::test::run_program;

namespace {

// Far above a last bit, far below what a foot could tell.
constexpr double length_tolerance = 1e-6;  // [m]
constexpr double factor_tolerance = 1e-6;  // relative

// No scene ends by it; generous, since sanitizers slow the search down.
constexpr const char* solvable_limit = "300";  // [s]
constexpr const char* effort = "0.2";          // of the usual: enough to tell a change by

const std::set<std::string> solvable{"flat", "slope",           "vee",       "ridge",  "stairs_up", "stairs_down",
                                     "gap",  "stepping_stones", "ice_patch", "rubble", "chimney",   "long_rubble"};
const std::set<std::string> impossible{"gap_too_wide",         "step_too_high", "too_slippery",
                                       "wall_too_high",        "drop_too_deep", "chimney_too_wide",
                                       "ceiling_too_low",      "ice_too_long",  "no_footholds",
                                       "chimney_too_slippery", "start_island",  "wind_too_strong",
                                       "goal_off_the_edge",    "goal_too_high"};

std::string map_of(const std::string& name) { return std::string(SUREFOOT_MAPS) + "/" + name + ".yaml"; }
std::string golden_of(const std::string& name) {
  return std::string(SUREFOOT_TESTS_DIR) + "/regression/golden/" + name + ".json";
}

ProgramRun plan(const std::string& name, const char* limit, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"plan",         map_of(name), "--format", "json",
                                     "--time-limit", limit,        "--effort", effort};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(SUREFOOT_BINARY, arguments);
}

/// The text of a plan without the line that tells the time.
std::string timeless(std::string text) {
  const auto at = text.find("\"time_s\"");
  REQUIRE(at != std::string::npos);
  return text.erase(at, text.find('\n', at) - at);
}

void same_length(const json& found, const json& expected) {
  CHECK(std::abs(found.get<double>() - expected.get<double>()) <= length_tolerance);
}

void same_point(const json& found, const json& expected) {
  for (int axis = 0; axis < 2; ++axis) same_length(found.at(axis), expected.at(axis));
}

/// A number, or the string "inf".
void same_factor(const json& found, const json& expected) {
  if (found.is_number() && expected.is_number())
    CHECK(found.get<double>() == Approx(expected.get<double>()).epsilon(factor_tolerance));
  else CHECK(found == expected);
}

void same_foothold(const json& found, const json& expected) {
  CHECK(found.at("chain") == expected.at("chain"));
  CHECK(found.at("segment") == expected.at("segment"));
  for (const char* key : {"s", "x", "y"}) same_length(found.at(key), expected.at(key));
}

void same_stance(const json& found, const json& expected) {
  REQUIRE(found.at("feet").size() == expected.at("feet").size());
  for (const auto& [leg, foothold] : expected.at("feet").items()) {
    CAPTURE(leg);
    REQUIRE(found.at("feet").contains(leg));
    same_foothold(found.at("feet").at(leg), foothold);
  }
  same_point(found.at("com"), expected.at("com"));
  same_factor(found.at("safety_factor"), expected.at("safety_factor"));
}

void same_transfer(const json& found, const json& expected) {
  CHECK(found.at("place").at("leg") == expected.at("place").at("leg"));
  same_foothold(found.at("place").at("foothold"), expected.at("place").at("foothold"));
  CHECK(found.at("lift") == expected.at("lift"));
  same_factor(found.at("safety_factor"), expected.at("safety_factor"));
}

void same_plan(const json& found, const json& expected) {
  for (const char* key : {"surefoot", "scene", "status", "planner", "seed", "steps"}) {
    CAPTURE(key);
    REQUIRE(found.at(key) == expected.at(key));
  }
  same_factor(found.at("safety_factor"), expected.at("safety_factor"));
  REQUIRE(found.at("stances").size() == expected.at("stances").size());
  for (std::size_t k = 0; k < expected.at("stances").size(); ++k) {
    INFO("stance " << k);
    same_stance(found.at("stances").at(k), expected.at("stances").at(k));
  }
  REQUIRE(found.at("transfers").size() == expected.at("transfers").size());
  for (std::size_t k = 0; k < expected.at("transfers").size(); ++k) {
    INFO("transfer " << k);
    same_transfer(found.at("transfers").at(k), expected.at("transfers").at(k));
  }
}

/// Refinement may move what the search found, not what it decided: legs and their order.
void same_steps(const json& refined, const json& searched) {
  REQUIRE(refined.at("transfers").size() == searched.at("transfers").size());
  for (std::size_t k = 0; k < searched.at("transfers").size(); ++k) {
    INFO("transfer " << k);
    CHECK(refined.at("transfers").at(k).at("place").at("leg") == searched.at("transfers").at(k).at("place").at("leg"));
    CHECK(refined.at("transfers").at(k).at("lift") == searched.at("transfers").at(k).at("lift"));
  }
  const json &after = refined.at("safety_factor"), &before = searched.at("safety_factor");
  if (before.is_number() && after.is_number()) CHECK(after.get<double>() >= before.get<double>());
  else CHECK(after == "inf");
}

void solves(const std::string& name) {
  REQUIRE(solvable.count(name) == 1);
  const ProgramRun searched = plan(name, solvable_limit, {"--no-refine"});
  INFO(searched.err);
  REQUIRE(searched.status == 0);
  INFO("if the change is meant: tests/regression/update_golden.sh " << name);
  same_plan(json::parse(searched.out), json::parse(read_text(golden_of(name))));

  const ProgramRun refined = plan(name, solvable_limit);
  REQUIRE(refined.status == 0);
  same_steps(json::parse(refined.out), json::parse(searched.out));

  const std::string file =
      (std::filesystem::temp_directory_path() / ("surefoot-canned-" + name + "-" + std::to_string(getpid()))).string();
  const ProgramRun written = plan(name, solvable_limit, {"-o", file});
  const ProgramRun checked = run_program(SUREFOOT_BINARY, {"check", map_of(name), file});
  const std::string in_file = read_text(file);
  std::filesystem::remove(file);
  CHECK(written.status == 0);
  CHECK(timeless(in_file) == timeless(refined.out));
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}

}  // namespace

TEST_CASE("every map is either solvable, with a stored plan, or known to be impossible", "[canned]") {
  std::set<std::string> on_disk, known = impossible;
  known.insert(solvable.begin(), solvable.end());
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS))
    if (entry.path().extension() == ".yaml") on_disk.insert(entry.path().stem().string());
  CHECK(on_disk == known);
  for (const std::string& name : on_disk) {
    CAPTURE(name);
    const std::string text = read_text(map_of(name));
    CHECK(text.rfind(impossible.count(name) ? "# Impossible: " : "# Exercises: ", 0) == 0);
    CHECK(std::filesystem::exists(golden_of(name)) == (solvable.count(name) == 1));
  }
}

#define SOLVES(name)                                                                                         \
  TEST_CASE("canned scene " name " gives its stored plan, twice the same, and the plan holds", "[canned]") { \
    solves(name);                                                                                            \
  }
SOLVES("flat")
SOLVES("slope")
SOLVES("vee")
SOLVES("ridge")
SOLVES("stairs_up")
SOLVES("stairs_down")
SOLVES("gap")
SOLVES("stepping_stones")
SOLVES("ice_patch")
SOLVES("rubble")
SOLVES("chimney")
SOLVES("long_rubble")

#define ENDS_WITHOUT_PLAN(name)                                                      \
  TEST_CASE("canned scene " name " is proven impossible and says why", "[canned]") { \
    const ProgramRun run = plan(name, solvable_limit);                               \
    INFO(run.out << run.err);                                                        \
    REQUIRE(run.status == 3);                                                        \
    const json answer = json::parse(run.out);                                        \
    CHECK(answer.at("status") == "infeasible");                                      \
    CHECK(!answer.at("reason").get<std::string>().empty());                          \
    CHECK(answer.at("stances").empty());                                             \
  }
ENDS_WITHOUT_PLAN("gap_too_wide")
ENDS_WITHOUT_PLAN("step_too_high")
ENDS_WITHOUT_PLAN("too_slippery")
ENDS_WITHOUT_PLAN("wall_too_high")
ENDS_WITHOUT_PLAN("drop_too_deep")
ENDS_WITHOUT_PLAN("chimney_too_wide")
ENDS_WITHOUT_PLAN("ceiling_too_low")
ENDS_WITHOUT_PLAN("ice_too_long")
ENDS_WITHOUT_PLAN("no_footholds")
ENDS_WITHOUT_PLAN("chimney_too_slippery")
ENDS_WITHOUT_PLAN("start_island")
ENDS_WITHOUT_PLAN("wind_too_strong")
ENDS_WITHOUT_PLAN("goal_off_the_edge")
ENDS_WITHOUT_PLAN("goal_too_high")

TEST_CASE("the rubble scenes are what their script makes of the arguments they name", "[canned]") {
  if (run_program("/bin/sh", {"-c", "command -v python3"}).status != 0) {
    WARN("python3 is not installed: not compared");
    return;
  }
  for (const char* name : {"rubble", "long_rubble"}) {
    const std::string text = read_text(map_of(name));
    const std::string marker = "Made by: python3 maps/make_rubble.py ";
    const std::size_t begin = text.find(marker);
    REQUIRE(begin != std::string::npos);
    const std::string arguments = text.substr(begin + marker.size(), text.find('\n') - begin - marker.size());
    const ProgramRun made =
        run_program("/bin/sh", {"-c", "exec python3 '" SUREFOOT_MAPS "/make_rubble.py' " + arguments});
    CHECK(made.status == 0);
    CHECK(made.out == text);
  }
}
