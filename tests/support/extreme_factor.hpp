// How far a safety factor and its gradient are from exact arithmetic.
#pragma once

#include "stability/robust_oracle.hpp"
#include "tests/support/extreme_exact.hpp"

namespace surefoot::testing {

struct FactorComparison {
  bool not_a_number = false;
  double value_error = 0;  ///< relative; infinite where one is zero or infinite and the other is not
  double gradient_error =
      0;  ///< over |gradient| + sigma / lever (greatest distance COM - contact); 0 at kinks and where both overflow
};

FactorComparison compared(const SamplePosture& sample, const stability::SafetyFactor& found, const ExactFactor& exact);

}  // namespace surefoot::testing
