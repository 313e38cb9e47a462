// The verdict by a general linear program solver (GLPK), for docs/extremes.md: one LP per corner of the box and per
// mode in the unknowns p, q, twist, ray multipliers and the slack t of the strict rows; feasible where the greatest t
// exceeds 1e-8 (or what is asked for). The solver is asked for its automatic scaling and tolerances of 1e-9, gets
// lengths as they are, and may take 1000 pivots; which rows vanish identically it is told.
#pragma once

#include <string>
#include <vector>

#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

struct LpVerdict {
  bool equilibrium = false, robust = false;
  std::vector<std::string> modes;
  bool unanswered = false;  ///< some LP ended neither optimal nor infeasible, or its numbers are not finite
};
LpVerdict lp_verdict(const SamplePosture& sample, double feasible_above = 1e-8, double tolerance = 1e-9);

}  // namespace surefoot::testing
