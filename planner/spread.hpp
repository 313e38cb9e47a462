// Points that fill a cube evenly, however many are taken.
#pragma once

#include <cmath>
#include <cstdint>

namespace surefoot::planner {

/// Coordinate i of the k-th point of the additive recurrence in five dimensions; the root of x^6 = x + 1 is its base.
inline double spread(std::uint64_t k, int i) {
  constexpr double root = 1.1347241384015194;
  const double value = 0.5 + static_cast<double>(k + 1) * std::pow(root, -(i + 1));
  return value - std::floor(value);
}

}  // namespace surefoot::planner
