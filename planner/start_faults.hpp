// Why no stance stands on start feet, in words. What is called proven holds for every COM.
#pragma once

#include <string>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

/// What the first stance must bear: under criterion frictional gravity alone.
stability::DisturbanceBox box_of_stances(const gaits::Scene& scene);

/// The legs that stand, "1 and 2".
std::string legs_in_words(const gaits::Stance& stance);

/// The rule that a first stance with a given COM breaks, with the numbers; another COM may keep it.
std::string broken_rule_words(const gaits::Scene& scene, const gaits::Stance& stance, gaits::Rule rule);

/// Proof from the friction cones alone that two feet bear no push of kappa, wherever the COM is; "" if there is none.
std::string friction_fault(const gaits::Scene& scene, const gaits::Stance& stance);

/// Start feet that may carry the first stance and from which a robot could only hang, with what may be wrong; "" if
/// there are none.
std::string hanging_feet(const gaits::Scene& scene);

/// Causes of all pairs of start feet, in words that name the pair as "feet 1 and 2", or no pair. What differs in
/// nothing but the pair is said once: "no COM balances on feet 1 and 2, 1 and 3: ...".
class PairFaults {
 public:
  void add(const gaits::Stance& stance, const std::string& words);
  /// Said once, behind the causes.
  void advise(const std::string& advice) { advice_ = advice; }
  std::string words() const;

 private:
  struct Cause {
    std::string before, legs, after;
  };
  std::vector<Cause> causes_;
  std::string advice_;
};

struct BalanceFault {
  bool proven = false;
  std::string words;
};
/// Where no COM within reach of two feet was found to balance: whether that is proven, and which disturbance forbids
/// it.
BalanceFault balance_fault(const gaits::Scene& scene, const gaits::Stance& stance);

/// Proof that no COM within reach of two feet balances, in the words of the two above; "" if there is none.
std::string no_com_words(const gaits::Scene& scene, const gaits::Stance& stance);

}  // namespace surefoot::planner
