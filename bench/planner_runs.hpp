// Runs of planners as the benchmarks make them.
#pragma once

#include <cstdint>
#include <string>

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

}  // namespace surefoot::bench
