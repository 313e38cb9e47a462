// The robot as the planner sees it: a body with a COM and three legs that are straight lines from the COM.
#pragma once

#include <optional>

namespace surefoot::gaits {

constexpr int leg_count = 3;

struct Robot {
  double radius_of_gyration = 0;  ///< rho [m], > 0
  double reach_min = 0;           ///< least distance COM - planted foot [m], >= 0
  double reach_max = 0;           ///< greatest distance COM - planted foot [m], > reach_min
  double clearance = 0;           ///< least distance COM - terrain [m], >= 0
  std::optional<double> mass;     ///< [kg]; verdicts do not depend on it
};

}  // namespace surefoot::gaits
