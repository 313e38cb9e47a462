// No scene with a known plan is ever called impossible: random scenes (tests/support/sample_scene.hpp) are solved, and
// for every verified plan the proof is asked about the scene and about the harder scenes that the plan still solves
// (tests/support/known_plan.hpp). --tightness bisects one-parameter families for the last value with a plan and the
// first that is proven impossible. Exit status 1 if a scene with a plan is called impossible. See README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>

#include "gaits/verifier.hpp"
#include "planner/infeasibility.hpp"
#include "planner/search.hpp"
#include "terrain/document.hpp"
#include "tests/support/known_plan.hpp"
#include "tests/support/sample_scene.hpp"

namespace {

using namespace surefoot;
using Clock = std::chrono::steady_clock;
using testing::Family;
using testing::SceneKind;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

struct Settings {
  int scenes = 1000;
  std::uint32_t seed = 1;
  double time_limit = 0.5;  // [s]
  bool tightness = false;
};

std::optional<gaits::Plan> solve(const gaits::Scene& scene, double time_limit) {
  planner::SearchOptions options;
  options.time_limit = time_limit;
  try {
    gaits::Plan plan = planner::search(scene, options);
    if (plan.status == gaits::Status::solved && gaits::verify(scene, plan).holds()) return plan;
  } catch (const terrain::InputError&) {  // a start that is bad input
  }
  return std::nullopt;
}

struct Row {
  int scenes = 0, solved = 0, proven = 0, open = 0, hard = 0, wrong = 0;
  std::vector<double> times;  // [s] of the proof
};

/// The proof, its time noted.
std::optional<planner::Impossibility> ask(const gaits::Scene& scene, Row& row,
                                          const std::optional<planner::ProofWindow>& window = {}) {
  planner::ProofLimits limits;
  limits.window = window;
  const auto begin = Clock::now();
  auto proof = planner::prove_infeasible(scene, limits);
  row.times.push_back(seconds_since(begin));
  return proof;
}

void look_at(const std::string& text, const std::string& name, double time_limit, Row& row) {
  const gaits::Scene scene = gaits::parse_scene(text, name);
  ++row.scenes;
  const auto plan = solve(scene, time_limit);
  if (!plan) {
    const auto proof = ask(scene, row);
    ++(proof ? row.proven : row.open);
    return;
  }
  ++row.solved;
  for (const auto& known : testing::hard_scenes(text, *plan)) {
    ++row.hard;
    auto proof = ask(known.scene, row);
    const auto [from, to] = testing::crossing(known.scene);
    if (!proof && from != to) proof = ask(known.scene, row, planner::ProofWindow{from, to});
    if (!proof) continue;
    ++row.wrong;
    fmt::print(stderr, "WRONG: {} ({}): {}\n{}\n", name, known.what, proof->reason, text);
  }
}

void print(const std::string& name, Row row) {
  std::sort(row.times.begin(), row.times.end());
  const auto at = [&](double part) {
    return row.times.empty() ? 0 : 1e3 * row.times[static_cast<std::size_t>(part * double(row.times.size() - 1))];
  };
  fmt::print("{:<10} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>10.1f} {:>10.1f}\n", name, row.scenes, row.solved,
             row.proven, row.open, row.hard, row.wrong, at(0.5), at(1));
}

int property(const Settings& settings) {
  fmt::print("{:<10} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>10} {:>10}\n", "kind", "scenes", "solved", "proven", "open",
             "hard", "wrong", "median ms", "max ms");
  Row all;
  for (int kind = 0; kind < testing::scene_kinds; ++kind) {
    Row row;
    const char* name = to_string(static_cast<SceneKind>(kind));
    for (int k = kind; k < settings.scenes; k += testing::scene_kinds) {
      const auto seed = settings.seed + static_cast<std::uint32_t>(k);
      const std::string label = fmt::format("{} seed {}", name, seed);
      try {
        look_at(testing::sample_scene(static_cast<SceneKind>(kind), seed), label, settings.time_limit, row);
      } catch (const terrain::InputError& error) {  // drawn so that the loader refuses it: crossing chains, start
        continue;
      }
    }
    print(name, row);
    all.scenes += row.scenes, all.solved += row.solved, all.proven += row.proven, all.open += row.open;
    all.hard += row.hard, all.wrong += row.wrong;
    all.times.insert(all.times.end(), row.times.begin(), row.times.end());
  }
  print("all", all);
  return all.wrong > 0 ? 1 : 0;
}

/// The last value towards `hopeless` for which the test holds, to a thousandth.
template <class Test>
double bisect(double easy, double hopeless, Test&& test) {
  while (std::abs(easy - hopeless) > 1e-3) {
    const double middle = (easy + hopeless) / 2;
    (test(middle) ? easy : hopeless) = middle;
  }
  return easy;
}

int tightness(const Settings& settings) {
  fmt::print("{:<16} {:>12} {:>12} {:>8}\n", "family", "plan until", "proven from", "ratio");
  int wrong = 0;
  for (int k = 0; k < testing::families; ++k) {
    const auto family = static_cast<Family>(k);
    const auto [easy, hopeless] = testing::easy_and_hopeless(family);
    const auto scene = [&](double value) { return gaits::parse_scene(testing::family_scene(family, value), "family"); };
    const double solved =
        bisect(easy, hopeless, [&](double value) { return solve(scene(value), settings.time_limit).has_value(); });
    const double proven =
        bisect(hopeless, easy, [&](double value) { return planner::prove_infeasible(scene(value)).has_value(); });
    const bool upside = hopeless > easy;
    if (upside ? proven <= solved : proven >= solved) ++wrong;
    fmt::print("{:<16} {:>12.3f} {:>12.3f} {:>8.3f}\n", to_string(family), solved, proven,
               upside ? proven / solved : solved / proven);
  }
  return wrong > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"The proof of impossibility against plans"};
  app.add_option("--scenes", settings.scenes, "random scenes");
  app.add_option("--seed", settings.seed, "of the first scene");
  app.add_option("--time-limit", settings.time_limit, "of the search for a plan [s]");
  app.add_flag("--tightness", settings.tightness, "bisect families instead");
  CLI11_PARSE(app, argc, argv);
  return settings.tightness ? tightness(settings) : property(settings);
}
