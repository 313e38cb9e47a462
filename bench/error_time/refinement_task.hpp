// One window of a plan whose least safety factor is to be raised, and ways to do it: for the benchmark of refinement.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/refine_window.hpp"

namespace surefoot::bench {

/// Variables: the COMs first..last, and the feet that are placed and lifted among them.
struct RefinementTask {
  const gaits::Scene* scene;
  gaits::Plan plan;
  int first, last;
  double cap;  ///< factors above limit nothing
};

/// `coms` neighbouring COMs around the plan's weakest place.
RefinementTask weakest_window(const gaits::Scene& scene, const gaits::Plan& plan, int coms);
/// The least factor of the window, if all rules hold; else 0.
double least_factor(const RefinementTask& task);
/// The same window with COMs and feet moved at random, all rules holding: the `count` with the least factor of many.
std::vector<RefinementTask> poor_starts(const RefinementTask& task, std::size_t count, std::uint64_t seed);

/// Greatest least factor among what was evaluated and breaks no rule.
double by_surefoot(const RefinementTask& task, int evaluations);
/// NLopt on the window itself. `algorithm` is LD_SLSQP, LD_MMA, LD_CCSAQ or LN_COBYLA (maximise t with every factor >=
/// t, reach and clearance as constraints), LN_SBPLX, LN_BOBYQA, LN_NELDERMEAD or GN_CRS2_LM (the least factor; broken
/// rules count as 0).
double by_nlopt(const RefinementTask& task, const std::string& algorithm, int evaluations);
/// Every point of a grid with n steps along each variable (few, please), then finer ones around the best.
double by_exhaustive_grid(const RefinementTask& task, int n);

}  // namespace surefoot::bench
