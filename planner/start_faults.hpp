// Why no stance stands on start feet, in words. What is called proven holds for every COM.
#pragma once

#include <string>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

/// What the first stance must bear: under criterion frictional gravity alone.
stability::DisturbanceBox box_of_stances(const gaits::Scene& scene);

/// The legs that stand, "1 and 2".
std::string legs_in_words(const gaits::Stance& stance);

/// The rule that a first stance with a given COM breaks, with the numbers.
std::string broken_rule_words(const gaits::Scene& scene, const gaits::Stance& stance, gaits::Rule rule);

/// Proof from the friction cones alone that two feet bear no push of kappa, wherever the COM is; "" if there is none.
std::string friction_fault(const gaits::Scene& scene, const gaits::Stance& stance);

/// Start feet that may carry the first stance and from which a robot could only hang, with what may be wrong; "" if
/// there are none.
std::string hanging_feet(const gaits::Scene& scene);

struct BalanceFault {
  bool proven = false;
  std::string words;
};
/// Where no COM within reach of two feet was found to balance: whether that is proven, and which disturbance forbids
/// it.
BalanceFault balance_fault(const gaits::Scene& scene, const gaits::Stance& stance);

}  // namespace surefoot::planner
