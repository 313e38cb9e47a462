// One run of one OMPL planner over stances and steps, without OMPL in sight.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/node.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

struct OmplRun {
  std::string planner = "RRT";      ///< Layers, RRT, KPIECE1, EST or SST
  std::uint32_t seed = 1;           ///< 1 .. gaits::greatest_seed
  std::uint64_t iterations = 1000;  ///< budget: the same run ends at the same iteration
  double goal_bias = 0.5;           ///< share of iterations that aim at the goal
  std::string objective = "steps";  ///< what SST counts: steps, or distance of the COM
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  std::function<bool()> interrupted = [] { return false; };
};

/// A path from one of the starts (none of which is in the goal) to the goal; empty if the budget ended first.
/// Adds the iterations done to `iterations_done`.
std::vector<Node> run_ompl(StepProposals& proposals, const std::vector<Node>& starts, const OmplRun& run,
                           std::uint64_t& iterations_done);

}  // namespace surefoot::planner
