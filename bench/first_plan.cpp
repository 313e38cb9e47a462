// Time to the first verified plan of each scene, by phase: reading the file, search, verification. Median over seeds;
// see README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bench/planner_runs.hpp"

using namespace surefoot;

namespace {

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median_of(const std::vector<double>& values) { return values.empty() ? std::nan("") : bench::median(values); }

struct Row {
  std::vector<double> load, search, verify, whole, wall, steps;  // [ms]
};

/// False: no verified plan.
bool run(const std::string& file, std::uint32_t seed, Row& row) {
  const double wall = wall_time();
  const auto found = bench::first_plan(file, seed);
  if (!found) return false;
  row.load.push_back(1e3 * found->load);
  row.search.push_back(1e3 * found->search);
  row.verify.push_back(1e3 * found->verify);
  row.whole.push_back(1e3 * found->whole());
  row.wall.push_back(1e3 * (wall_time() - wall));
  row.steps.push_back(found->steps);
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
               median_of(row.steps), median_of(row.load), median_of(row.search), median_of(row.verify),
               median_of(row.whole), slowest, median_of(row.wall));
    std::fflush(stdout);
  }
  return all ? 0 : 1;
}
