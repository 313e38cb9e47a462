// The search for a 2-3-2 gait: OMPL over stances (state) and steps (control), then a clean-up of the path found.
// A plan it returns has been put together from legal steps only (gaits/rules.hpp); the independent verifier has the
// last word. That no plan was found proves nothing, unless the status is `infeasible`.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

struct SearchOptions {
  std::uint32_t seed = 1;       ///< 1 .. gaits::greatest_seed
  double time_limit = 10;       ///< [s] wall time; reached only when no plan is found
  std::string planner = "auto"; ///< one of planner_names()
  std::string objective = "steps";
};

/// gaits::planner_names().
const std::vector<std::string>& planner_names();

/// A plan whose safety factors are filled in, or the reason there is none. Deterministic for a seed as long as the time
/// limit is not reached. The caller verifies. Throws terrain::InputError ("file:line:column: start: ...") for a
/// start that is bad input (StartChoice::decided in problem.hpp), std::invalid_argument for a planner that is not in
/// planner_names().
gaits::Plan search(const gaits::Scene& scene, const SearchOptions& options);

/// When a time limit [s] that began to run at `begin` is reached.
std::chrono::steady_clock::time_point deadline_after(std::chrono::steady_clock::time_point begin, double limit);

}  // namespace surefoot::planner
