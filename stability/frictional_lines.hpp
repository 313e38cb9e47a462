// The exact one-dimensional problem behind frictional_region.hpp: the parts of a vertical line of COMs on which a
// posture is kinematic-strong, clattering converges, or both.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "stability/polynomial_frame.hpp"

namespace surefoot::stability {

struct Interval {
  double low, high;
};
using Intervals = std::vector<Interval>;

enum FrictionalPartIndex { kinematic_part, clattering_part, stable_part, frictional_part_count };
using FrictionalLengths = std::array<double, frictional_part_count>;

struct FrictionalLine {
  double x = 0;                                       ///< [m]
  std::array<Intervals, frictional_part_count> part;  ///< heights [m], ascending

  FrictionalLengths lengths() const;
};

class FrictionalLines {
 public:
  /// `strip` is R_EQ, clipped. Two contacts, 0 < restitution < 1.
  FrictionalLines(std::span<const Contact> contacts, double rho, double restitution, const Eigen::AlignedBox2d& strip);

  FrictionalLine at(double x);
  bool upward() const { return upward_; }
  int asked() const { return asked_; }

 private:
  void add(const Poly2& f);
  void decide(FrictionalLine& line, double low, double high) const;

  Posture posture_;
  double restitution_;
  Eigen::AlignedBox2d strip_;
  Eigen::Vector2d origin_;
  Frame<Poly2> frame_;
  bool upward_;
  std::vector<Poly2> curves_;  ///< rows of modes, without repetition
  std::vector<double> cuts_;
  int asked_ = 0;
};

}  // namespace surefoot::stability
