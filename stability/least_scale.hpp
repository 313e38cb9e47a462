// The least s >= 0 such that the polygon {G_k . (p, 1, q) > 0} meets s W: the mode's part of the safety factor
// (theory section 5), a linear program in (p, q, s), solved incrementally (Seidel) with its dual.
#pragma once

#include <array>

#include "stability/box_test.hpp"

namespace surefoot::stability {

struct LeastScale {
  double s = 0;  ///< infinite where the polygon is empty or out of the box's axes
  Wrench at;     ///< where it is attained
  /// ds = - sum y_k (dG_k . (p, 1, q)) over the active rows.
  int active = 0;
  std::array<int, 2> row{};
  std::array<double, 2> y{};
};

/// Stops with some s >= give_up_above as soon as s is known to be that large.
LeastScale least_scale(const RowList<double>& rows, const DisturbanceBox& box, double give_up_above);

}  // namespace surefoot::stability
