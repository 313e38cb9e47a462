// The search for a 2-3-2 gait: the planner "Layers" (anytime_search.hpp) and OMPL's over stances (state) and steps
// (control), with a clean-up of the paths found, and the proof that there is none (infeasibility.hpp) where they fail.
// A plan it returns has been put together from legal steps only (gaits/rules.hpp); the independent verifier has the
// last word. That no plan was found proves nothing, unless the status is `infeasible`.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

struct SearchOptions {
  std::uint32_t seed = 1;        ///< 1 .. gaits::greatest_seed
  double time_limit = 10;        ///< [s] wall time; seldom reached: searches end by the work they may do
  std::string planner = "auto";  ///< one of planner_names()
  std::string objective = "steps";
  double effort = 1;  ///< work spent on a better plan, relative to the usual; 0: the first plan will do
  bool prove = true;  ///< try to prove that there is no plan when none is found
  /// Asked now and then, by several threads; true ends the search with the best plan so far.
  std::function<bool()> interrupted = [] { return false; };
  /// Told now and then how things stand, in words.
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// gaits::planner_names().
const std::vector<std::string>& planner_names();

/// A plan whose safety factors are filled in, or the reason there is none. Deterministic for a seed as long as the time
/// limit is not reached, whatever the number of processors (two are used). The caller verifies. Throws
/// terrain::InputError ("file:line:column: start: ...") for a start that is bad input (StartChoice::decided in
/// problem.hpp), std::invalid_argument for a planner or an objective that there is not, a seed out of range, an effort
/// below 0.
gaits::Plan search(const gaits::Scene& scene, const SearchOptions& options);

/// When a time limit [s] that began to run at `begin` is reached.
std::chrono::steady_clock::time_point deadline_after(std::chrono::steady_clock::time_point begin, double limit);

}  // namespace surefoot::planner
