// The catalogue of stiff and extreme postures behind docs/extremes.md and its test: fixed, made by rule, in groups by
// what is extreme about them. Boundaries are found by bisection on verdicts in exact arithmetic.
#pragma once

#include <string>
#include <vector>

#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

struct ExtremeCase {
  std::string group;
  std::string name;  ///< what was done to which posture
  SamplePosture sample;
};

/// Every group, in the order of the page. The same on every run.
std::vector<ExtremeCase> extreme_catalogue();

}  // namespace surefoot::testing
