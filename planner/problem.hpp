// What is settled before the search: the first stances that the scene's start allows, and whether any stance reaches the
// goal at all. What the scene gives is judged exactly; what it leaves open is chosen by even, deterministic sampling.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/node.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

struct StartChoice {
  std::vector<Node> nodes;  ///< legal first stances, the safest first; those in the goal before all others
  std::string fault;        ///< why there is none; empty otherwise
  bool decided = false;     ///< the fault holds for every choice left open (otherwise: none was found)
};

StartChoice choose_start(StepProposals& proposals);

/// The fault of a start that is bad input: what it gives breaks a rule, whatever is chosen for the rest. Says which rule,
/// with the numbers.
std::optional<std::string> start_fault(const gaits::Scene& scene);

struct GoalLook {
  bool standable = false;
  bool decided = false;  ///< not standable, and that is proven
  std::string fault;     ///< why not
};

/// Looks for a stance whose COM lies in the goal, over pairs of footholds near it. Found: certain. Not found: certain
/// only where `decided`; otherwise it means thousands of pairs, spread evenly, in vain.
GoalLook look_at_goal(const gaits::Scene& scene);

/// The k-th of an endless, evenly spread sequence of step codes.
StepCode spread_code(std::uint64_t k);

}  // namespace surefoot::planner
