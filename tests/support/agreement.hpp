// Helpers shared by the tests that hold the oracle against the references.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "stability/robust_oracle.hpp"
#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

inline stability::RobustOracle oracle_of(const SamplePosture& sample) {
  return {sample.contacts, sample.rho, sample.box};
}

inline std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

inline std::vector<std::string> mode_names(const std::vector<ContactMode>& modes) {
  std::vector<std::string> names;
  for (const ContactMode& mode : modes) names.push_back(mode.name());
  return sorted(names);
}

/// A safety factor so large that it says "nothing limits": an LP in doubles cannot tell it from infinite.
inline constexpr double practically_infinite = 1e6;

}  // namespace surefoot::testing
