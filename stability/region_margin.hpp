// The linear program behind a mode at one COM: max over the scaled box |u| <= 1, |w| <= 1 of the least row (rows scaled
// to size 1). A mode is feasible iff it is positive. Its optimum is one row at a corner of W, two rows on a side, or
// three rows inside; its dual gives multipliers y >= 0 with sum y_k row_k <= 0 on the whole box where it is not.
#pragma once

#include <array>

#include "stability/region_rows.hpp"

namespace surefoot::stability {

/// Solution of the margin program with its dual.
struct Margin {
  double value = 0;
  CurveId basis;
  double u = 0, w = 0;        ///< where the maximum is attained
  int count = 0;              ///< rows in the basis: basis.a, b, c
  std::array<double, 3> y{};  ///< multipliers of the rows as they are (not scaled)
};

/// The margin of `count` rows given at one COM.
Margin margin(const Form<double>* rows, int count);

}  // namespace surefoot::stability
