// Moves the COM waypoints, and footholds within their segments, of a plan to raise its least safety factor (then the
// sum), with NLopt and the oracle's gradients. Guarantees: the result passes gaits::verify if the input does, its least
// safety factor is not below the input's, steps and segments stay the same, the result is the same every time. Does not
// guarantee a global optimum.
//
// Windows of a few neighbouring COMs are treated in turn, the weakest place first; each maximises the least factor it
// touches, then their sum. A safety factor is a minimum of many smooth functions of which the oracle tells value and
// gradient of the least, and the optimum lies on ridges where several meet; a gradient method on the factor itself
// zigzags there. So every evaluation leaves a cut (its tangent), and NLopt maximises the least of the cuts within a
// trust region (refine_model.hpp), until the region is small.
#pragma once

#include <chrono>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

struct RefineOptions {
  int max_evaluations = 40;  ///< evaluations per window of the plan
  int sweeps = 2;            ///< passes over the plan
  int window = 5;            ///< neighbouring COMs that move together, >= 1
  int max_windows = 120;     ///< windows treated in all, the weakest first: bounds the work on long plans
  bool leave_out = true;     ///< skip windows that cannot gain (for tests of that rule)
  /// No window is begun later than this; what has been gained is kept. The result is the same every time only where
  /// this is not reached.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// A plan that is not solved comes back as it is. Never throws on a plan that holds;
/// std::invalid_argument for one that has not one stance more than transfers, and for windows of no COM.
gaits::Plan refine(const gaits::Scene& scene, const gaits::Plan& plan, const RefineOptions& options = {});
/// The same without the last look of the verifier: for callers that verify what they get, and fall back on `plan`.
gaits::Plan refine_unverified(const gaits::Scene& scene, const gaits::Plan& plan, const RefineOptions& options = {});

struct Timeline;
/// The part of it for one window of COMs first..last (RefineWindow), in place: true if anything changed. Factors above
/// `cap` limit nothing.
bool refine_window(const gaits::Scene& scene, gaits::Plan& plan, const Timeline& timeline, int first, int last,
                   double cap, const RefineOptions& options);

}  // namespace surefoot::planner
