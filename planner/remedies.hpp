// What would help where no plan was found: one number of the scene after the other, and the criterion, is changed
// alone, until a plan is found that the verifier accepts.
//
// Guarantee: each remedy named does: the scene with just that change has a verified plan. That less would not do is not
// proven: it was tried, to `remedy_step`, and no plan was found.
#pragma once

#include <string>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/search.hpp"

namespace surefoot::planner {

/// Ratio between the change that is named and a smaller one that did not do.
constexpr double remedy_step = 1.03;

/// What is tried: all friction, the greatest reach, the disturbances, the clearance; where the criterion is robust,
/// that balance alone is asked for.
enum class Remedy { friction, reach, disturbances, clearance, equilibrium };
/// The scene with one of the numbers times `factor`, or of criterion equilibrium.
gaits::Scene changed(const gaits::Scene& scene, Remedy remedy, double factor);

struct RemedyFound {
  Remedy remedy;
  double factor = 1;
  std::string words;  ///< "friction 0.31 instead of 0.25"
};
struct Remedies {
  std::vector<RemedyFound> found;
  bool cut_off = false;  ///< by the time limit or an interruption: others, or less, might do
};
/// Within the options' time limit in all. Deterministic as search() is.
Remedies remedies(const gaits::Scene& scene, const SearchOptions& options);

}  // namespace surefoot::planner
