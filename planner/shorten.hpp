// Cleans up a path that a sampling planner found: superfluous steps are left out, then COMs are moved to where the
// objective would have them. Every step of the result is legal; best effort, not optimal.
#pragma once

#include <string>
#include <vector>

#include "planner/node.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

/// A path with the same ends (the last COM may move within the goal) and at most as many steps.
/// objective: steps, safety or distance.
std::vector<Node> shorten(StepProposals& proposals, std::vector<Node> path, const std::string& objective);

}  // namespace surefoot::planner
