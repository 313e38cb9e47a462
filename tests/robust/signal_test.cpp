// SIGINT, SIGTERM and SIGHUP at any moment: the program ends by that signal with one line, or in order; files are whole
// or untouched, and none is left beside them.
#include <catch2/catch.hpp>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/planner/program.hpp"
#include "tests/planner/scene_text.hpp"

using nlohmann::json;
using namespace surefoot::tests;
namespace test = surefoot::test;

namespace {

const std::string old_file = "precious";

/// Both files are the old ones or whole, and there is nothing beside them.
void check_files(const Workplace& place) {
  const std::string plan = place.read("plan.json"), drawing = place.read("plan.svg");
  if (plan != old_file) CHECK(json::parse(plan)["status"] == "solved");
  if (drawing != old_file) {
    CHECK(drawing.starts_with("<"));
    CHECK_THAT(drawing, Catch::EndsWith("</svg>\n"));
  }
  CHECK(place.count() == 3);
}

void prepare(const Workplace& place) {
  place.write("scene.yaml", flat_scene);
  place.write("plan.json", old_file);
  place.write("plan.svg", old_file);
}

std::vector<std::string> plan_words(const Workplace& place, const std::string& effort) {
  return {SUREFOOT_BINARY, "plan", place / "scene.yaml", "-q",    "--effort",
          effort,          "-o",   place / "plan.json",  "--svg", place / "plan.svg"};
}

/// The program with a shim that raises a signal at one call. Signals are not ignored, whatever the tests were started
/// by.
Workplace::Outcome run_with_shim(const Workplace& place, const std::string& order) {
  std::vector<std::string> words{"--default-signal=INT,TERM,HUP", "LD_PRELOAD=" SUREFOOT_SIGNAL_SHIM,
                                 "ASAN_OPTIONS=verify_asan_link_order=0", "SUREFOOT_SIGNAL=" + order};
  for (const std::string& word : plan_words(place, "0")) words.push_back(word);
  return {test::run_program("/usr/bin/env", words)};
}

}  // namespace

TEST_CASE("A signal at any step of writing leaves no part of a file", "[robust]") {
  struct Step {
    const char* function;
    int calls;  // with two outputs: each is tried for, then staged, then put in place
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (const Step& step :
         {Step{"mkstemp", 4}, Step{"fchmod", 4}, Step{"fsync", 2}, Step{"unlink", 2}, Step{"rename", 2}})
      for (int call = 1; call <= step.calls; ++call)
        for (const char* moment : {"before", "after"}) {
          const Workplace place;
          prepare(place);
          const std::string order =
              std::to_string(signal) + ":" + step.function + ":" + std::to_string(call) + ":" + moment;
          const auto run = run_with_shim(place, order);
          INFO(order << "\n" << run.err);
          CHECK(run.out.empty());
          check_files(place);
          if (signal == SIGINT && run.status == 0) {  // it asks for an early end of a search that is over already
            CHECK(place.read("plan.json") != old_file);
            CHECK(place.read("plan.svg") != old_file);
            continue;
          }
          CHECK(run.status == 128 + signal);
          CHECK(run.one_error());
          CHECK_THAT(run.err, Catch::Contains(signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP"));
        }
}

TEST_CASE("A signal at a random moment ends the program in order or by that signal", "[robust]") {
  constexpr std::uint32_t seed = 20;
  std::mt19937 random(seed);
  for (int round = 0; round < 24; ++round) {
    const bool terminate = round % 2 == 0;
    const double seconds = 0.4 * static_cast<double>(random()) / 4294967296.0;
    const Workplace place;
    prepare(place);
    std::vector<std::string> words{"--preserve-status", "-s", terminate ? "TERM" : "INT", std::to_string(seconds)};
    for (const std::string& word : plan_words(place, "0.3")) words.push_back(word);
    const Workplace::Outcome run{test::run_program("/usr/bin/timeout", words)};
    INFO((terminate ? "SIGTERM" : "SIGINT") << " after " << seconds << " s: status " << run.status << "\n" << run.err);
    CHECK(run.out.empty());
    if (run.status > 128) {
      CHECK(run.status == 128 + (terminate ? SIGTERM : SIGINT));
      CHECK((run.one_error() || run.err.empty()));  // nothing is said before main() begins
    } else {
      // In time, or the search ended early with what it had (nothing is status 1, and then no file is touched).
      CHECK((run.status == 0 || (!terminate && run.status == 1)));
      if (run.status == 1) CHECK(place.read("plan.json") == old_file);
    }
    check_files(place);
  }
}
