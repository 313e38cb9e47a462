// Time to the first verified plan of each scene, by phase: reading the file, search, verification. Median over seeds;
// see README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "gaits/verifier.hpp"
#include "planner/search.hpp"

using namespace surefoot;

namespace {

/// Of this process, all its threads [s].
double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Row {
  std::vector<double> load, search, verify, whole, wall, steps;  // [ms]
};

/// One run as `surefoot plan --no-refine --effort 0` goes, without starting and printing. False: no verified plan.
bool run(const std::string& file, std::uint32_t seed, Row& row) {
  const double wall = wall_time(), begin = cpu_time();
  const gaits::Scene scene = gaits::load_scene(file);
  const double loaded = cpu_time();
  planner::SearchOptions options;
  options.seed = seed;
  options.effort = 0;
  const gaits::Plan plan = planner::search(scene, options);
  const double found = cpu_time();
  const bool holds = plan.status == gaits::Status::solved && gaits::verify(scene, plan).holds();
  const double end = cpu_time();
  if (!holds) return false;
  row.load.push_back(1e3 * (loaded - begin));
  row.search.push_back(1e3 * (found - loaded));
  row.verify.push_back(1e3 * (end - found));
  row.whole.push_back(1e3 * (end - begin));
  row.wall.push_back(1e3 * (wall_time() - wall));
  row.steps.push_back(plan.steps());
  return true;
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Time to the first verified plan, median over seeds.");
  std::vector<std::string> scenes;
  int seeds = 20;
  app.add_option("SCENE", scenes, "scene files")->required();
  app.add_option("--seeds", seeds, "1, 2, ... so many");
  CLI11_PARSE(app, count, words);
  fmt::print(
      "| scene | verified | steps | load, ms CPU | search | verification | whole | whole, slowest | whole, wall |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  bool all = true;
  for (const std::string& file : scenes) {
    Row row;
    int solved = 0;
    for (int seed = 1; seed <= seeds; ++seed) solved += run(file, static_cast<std::uint32_t>(seed), row);
    all = all && solved == seeds;
    const std::string name = file.substr(file.find_last_of('/') + 1);
    const double slowest = row.whole.empty() ? std::nan("") : *std::max_element(row.whole.begin(), row.whole.end());
    fmt::print("| {} | {}/{} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name, solved, seeds,
               median(row.steps), median(row.load), median(row.search), median(row.verify), median(row.whole), slowest,
               median(row.wall));
    std::fflush(stdout);
  }
  return all ? 0 : 1;
}
