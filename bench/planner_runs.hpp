// Runs of planners as the benchmarks make them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bench/error_time/timing.hpp"
#include "gaits/verifier.hpp"
#include "planner/search.hpp"

namespace surefoot::bench {

/// No proof beside the search.
inline gaits::Plan planned(const gaits::Scene& scene, const std::string& planner, std::uint32_t seed, double effort,
                           const std::string& objective) {
  planner::SearchOptions options;
  options.planner = planner;
  options.seed = seed;
  options.effort = effort;
  options.objective = objective;
  options.prove = false;
  return planner::search(scene, options);
}

/// CPU time of all threads [s], by phase, of a run as `surefoot plan --no-refine --effort 0` goes, without starting and
/// printing.
struct FirstPlan {
  double load, search, verify;
  int steps;
  double whole() const { return load + search + verify; }
};
/// Nothing: no verified plan.
inline std::optional<FirstPlan> first_plan(const std::string& file, std::uint32_t seed) {
  constexpr auto clock = CLOCK_PROCESS_CPUTIME_ID;
  const double begin = cpu_time(clock);
  const gaits::Scene scene = gaits::load_scene(file);
  const double loaded = cpu_time(clock);
  planner::SearchOptions options;
  options.seed = seed;
  options.effort = 0;
  const gaits::Plan plan = planner::search(scene, options);
  const double found = cpu_time(clock);
  if (plan.status != gaits::Status::solved || !gaits::verify(scene, plan).holds()) return std::nullopt;
  return FirstPlan{loaded - begin, found - loaded, cpu_time(clock) - found, plan.steps()};
}

}  // namespace surefoot::bench
