// Safety factors and gradients in exact arithmetic, on the rows of exact_posture.hpp: every candidate of the linear
// program is tried, gradients are differences over 2^-200 of the contacts' spread. For tests and docs/extremes.md only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/exact_posture.hpp"

namespace surefoot::testing {

using Quotient = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

struct ExactVerdict {
  bool equilibrium = false, robust = false;
  std::vector<std::string> modes;  ///< feasible ones, sorted
};
ExactVerdict exact_verdict(const SamplePosture& sample);

struct ExactFactor {
  std::optional<Quotient> value;  ///< nothing: infinite
  Quotient gradient[2];           ///< 0 where the value is 0 or infinite
  bool kink = false;              ///< one-sided derivatives differ
};
ExactFactor exact_safety_factor(const SamplePosture& sample);

}  // namespace surefoot::testing
