// Scenes that have a plan for certain, and leave it as little room as can be: what proves a scene impossible must not
// object to them. Every scene returned is one that gaits::verify accepts the plan for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::testing {

struct KnownPlan {
  std::string what;
  gaits::Scene scene;
  gaits::Plan plan;
};

/// From a scene's text and a verified plan for it: the way back (from the last stance to the first COM); reach,
/// clearance and goal drawn in to what the plan needs; disturbances raised to what it bears; no foothold but within
/// `around` [m] of those of the plan; and all of these at once. Those that do not verify are left out.
std::vector<KnownPlan> hard_scenes(const std::string& text, const gaits::Plan& plan, double around = 1e-3);

/// The widest interval of x that every way from the start to the goal crosses, from the side of the start; equal ends
/// if there is none.
std::pair<double, double> crossing(const gaits::Scene& scene);

}  // namespace surefoot::testing
