// The area of R(W) from verdicts of RobustOracle alone: what regions are held against.
#pragma once

#include "stability/robust_oracle.hpp"

namespace surefoot::testing {

struct ReferenceArea {
  double area = 0;
  double error = 0;  ///< sum of the differences of two rules; parts of R(W) between equal samples are not seen
};

/// On level lines through the polygon (which holds R(W)), R(W) is found from samples: neighbours that are both robust
/// by the certificate of the line between them, ends by bisection, and where neighbours have different modes by
/// halving. Over the lines adaptive Simpson rules, between the heights of the polygon's corners.
ReferenceArea reference_area(const stability::RobustOracle& oracle, const std::vector<Eigen::Vector2d>& polygon,
                             double tolerance);

}  // namespace surefoot::testing
