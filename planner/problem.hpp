// What is settled before the search: the first stances that the scene's start allows, and whether any stance reaches
// the goal at all. What the scene gives is judged exactly; what it leaves open is chosen by even, deterministic
// sampling.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/node.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

struct StartChoice {
  /// Legal first stances: those in the goal before all others, then by pair of feet (legs 1 and 2, 1 and 3, 2 and 3),
  /// the safest of each pair first.
  std::vector<Node> nodes;
  /// Where the COM is open: of each pair the one nearest to the goal. For searches that have tried the others.
  std::vector<Node> nearest;
  std::string fault;         ///< why there is none, with the rule and the numbers; empty otherwise
  bool decided = false;      ///< the fault is proven for every choice left open: bad input (otherwise: none was found)
  bool com_decides = false;  ///< the scene gives a COM, and with another one the fault may be gone
};

StartChoice choose_start(StepProposals& proposals);
/// The error of a start whose fault is decided, at its place in the scene.
terrain::InputError start_error(const gaits::Scene& scene, const StartChoice& choice);

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
