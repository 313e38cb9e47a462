// The independent verifier: rebuilds every check of a plan from the scene. With the search and its rules it shares the
// stability oracle, the terrain's segments, the names of the rules and the words for frictional faults; nothing else
// (geometry by brute force over all segments; nothing in the plan is believed but footholds, COMs and legs).
//
// Guarantee: a plan that holds obeys every rule of rules.hpp, reach and clearance up to `verifier_slack`; stability
// verdicts have no slack: they are the oracle's exact ones, asked of oracles built here, and every line is sampled
// besides. Not checked: the plan's run time, its planner's name, what it says was left out.
#pragma once

#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/rules.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// Slack at the limits of reach, clearance and swing, and between a stated position and the one rebuilt from arc
/// length; relative to reach_max. Origin: a position far from the origin (1e6 m) is a double with an error of 1e-10 m.
constexpr double verifier_slack = 1e-9;
/// Relative difference allowed between a stated safety factor and the one computed here (formats: plans are read by
/// programs that may print fewer digits).
constexpr double safety_factor_tolerance = 1e-6;

struct Fault {
  Rule rule;
  std::string place;    ///< "stance 3", "transfer 2 (leg 1)", "plan"; counted from 1, transfer k leads to stance k + 1
  std::string message;  ///< what was found and what is required, with numbers
  bool stated = false;  ///< only a safety factor that the plan states is not that of the scene
};

/// "transfer 2 (leg 1): reach: foot 1 is ..."
std::string to_string(const Fault& fault);

struct Verification {
  std::vector<Fault> faults;       ///< empty: the plan holds
  int stances = 0, transfers = 0;  ///< how many were checked
  double least_factor = 0;         ///< found here, of all that could be asked
  /// How many of the stances and transfers have a foot that stands nowhere or not where the plan says (a fault names
  /// it, or what has come between all of them and the ground): stability was not asked there, nor its reach, leg and
  /// swing.
  int stances_with_lost_feet = 0, transfers_with_lost_feet = 0;
  bool holds() const { return faults.empty(); }
};

/// Every rule at every stance and transfer; also start, goal, and the safety factors that the plan states
/// (to 1e-6 relative).
Verification verify(const Scene& scene, const Plan& plan);

}  // namespace surefoot::gaits
