// The planner against the exhaustive optimum of a grid, and against OMPL's planners over time; see bench/README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bench/exhaustive_grid.hpp"
#include "bench/planner_runs.hpp"
#include "gaits/verifier.hpp"

using namespace surefoot;
using surefoot::bench::planned;

namespace {

double way_of_com(const gaits::Plan& plan) {
  double sum = 0;
  for (std::size_t k = 1; k < plan.stances.size(); ++k) sum += (plan.stances[k].com - plan.stances[k - 1].com).norm();
  return sum;
}

std::string value(const gaits::Plan& plan, const std::string& objective) {
  if (plan.status != gaits::Status::solved) return "-";
  if (objective == "distance") return fmt::format("{:.3f} m", way_of_com(plan));
  if (objective == "safety") return fmt::format("{:.3f} in {} steps", plan.safety_factor, plan.steps());
  return fmt::format("{}", plan.steps());
}

void against_grid(const std::vector<std::string>& scenes, const bench::Grid& grid, const std::string& objective,
                  double effort, std::uint64_t most_states) {
  fmt::print("| scene | grid optimum ({}) | states | s | Layers | s |\n|---|---|---|---|---|---|\n", objective);
  for (const std::string& file : scenes) {
    const gaits::Scene scene = gaits::load_scene(file);
    const auto begin = std::chrono::steady_clock::now();
    const auto optimum = bench::exhaustive_optimum(scene, grid, objective, most_states);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const bool holds = optimum.found && gaits::verify(scene, optimum.plan).holds();
    const gaits::Plan plan = planned(scene, "Layers", 1, effort, objective);
    fmt::print("| {} | {}{} | {} | {:.1f} | {} | {:.2f} |\n", scene.name,
               optimum.found ? value(optimum.plan, objective) : "not found",
               optimum.found && !holds ? " (REFUSED)" : "", optimum.states, seconds, value(plan, objective),
               plan.time_s);
    std::fflush(stdout);
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Best steps after restarts until `limit` seconds, from every seed on; the median.
double steps_after(const std::vector<std::pair<double, int>>& runs, double limit) {
  std::vector<double> best;
  for (std::size_t first = 0; first < runs.size(); ++first) {
    double time = 0, steps = INFINITY;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto& [seconds, found] = runs[(first + i) % runs.size()];
      time += seconds;
      if (time > limit) break;
      if (found > 0) steps = std::min<double>(steps, found);
    }
    best.push_back(steps);
  }
  return median(best);
}

void planners_over_time(const std::vector<std::string>& scenes, int seeds) {
  const std::vector<double> limits{0.02, 0.1, 0.3, 1};
  fmt::print("| scene | planner | solved | first plan, ms (median) | steps of it |");
  for (const double limit : limits) fmt::print(" steps after {} s |", limit);
  fmt::print("\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& file : scenes) {
    const gaits::Scene scene = gaits::load_scene(file);
    for (const char* planner : {"Layers", "RRT", "KPIECE1", "EST", "SST"}) {
      std::vector<std::pair<double, int>> runs;
      std::vector<double> times, steps;
      for (int seed = 1; seed <= seeds; ++seed) {
        const gaits::Plan plan = planned(scene, planner, static_cast<std::uint32_t>(seed), 0, "steps");
        const bool solved = plan.status == gaits::Status::solved;
        runs.emplace_back(plan.time_s, solved ? plan.steps() : -1);
        if (solved) times.push_back(1e3 * plan.time_s), steps.push_back(plan.steps());
      }
      fmt::print("| {} | {} | {}/{} | {:.1f} | {} |", scene.name, planner, times.size(), seeds, median(times),
                 median(steps));
      for (const double limit : limits) {
        double reached = steps_after(runs, limit);
        // Layers betters its own plan instead: the largest effort that ends in time.
        if (std::string(planner) == "Layers")
          for (const double effort : {0.05, 0.15, 0.5, 1.0, 1.5, 2.0}) {
            const gaits::Plan plan = planned(scene, planner, 1, effort, "steps");
            if (plan.time_s <= limit) reached = std::min<double>(reached, plan.steps());
          }
        fmt::print(" {} |", std::isfinite(reached) ? fmt::format("{}", reached) : "-");
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Plans against the exhaustive optimum of a grid, or planners against each other over time.");
  std::vector<std::string> scenes;
  bench::Grid grid;
  std::string objective = "steps";
  double effort = 1;
  std::uint64_t most_states = 100'000'000;
  int seeds = 20;
  bool over_time = false;
  app.add_option("SCENE", scenes, "scene files")->required();
  app.add_option("--spacing", grid.spacing, "of footholds [m]");
  app.add_option("--com", grid.com, "side of the lattice of COMs [m]");
  app.add_option("--objective", objective, "steps, safety or distance");
  app.add_option("--effort", effort, "of the planner");
  app.add_option("--most-states", most_states, "give up beyond");
  app.add_flag("--planners", over_time, "planners over time instead");
  app.add_option("--seeds", seeds, "per planner");
  CLI11_PARSE(app, count, words);
  if (over_time) planners_over_time(scenes, seeds);
  else against_grid(scenes, grid, objective, effort, most_states);
}
