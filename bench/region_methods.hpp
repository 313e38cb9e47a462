// Ways to the area of R(W) that bench_region compares with those of stability/region.hpp.
#pragma once

#include <string>
#include <vector>

#include "stability/region.hpp"

namespace surefoot::bench {

struct Stance {
  std::string name;
  std::vector<stability::Contact> contacts;
  double rho = 0;
  stability::DisturbanceBox box;
};

struct Area {
  double value = 0, error = 0;  ///< error: the method's own
};

Eigen::AlignedBox2d bounds_of(const stability::RegionPolygon& polygon);

/// Oracle calls at the corners of an n x n grid; a cell whose corners differ counts half as error, which bounds the sum
/// where boundaries cross cells at all angles.
Area by_grid(const stability::RobustOracle& oracle, const Eigen::AlignedBox2d& box, int n);
/// Squares excluded for all modes by certificates, or refused for one; what is left at the last depth counts half.
Area by_quadtree(const Stance& stance, const Eigen::AlignedBox2d& box, int depth);
/// The sweep of region_sweep.hpp without any proof; its error is its own estimate.
Area by_sweep(const Stance& stance, double tolerance);

}  // namespace surefoot::bench
