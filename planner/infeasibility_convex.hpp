// A convex polygon of COMs that is cut down by half-planes, without allocation.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>

namespace surefoot::planner::proof {

/// A convex polygon of COMs, counter-clockwise [m].
class Convex {
 public:
  static constexpr int most = 48;
  Convex() = default;
  Convex(const Convex& other) : count_(other.count_) { std::copy_n(other.at_.begin(), count_, at_.begin()); }
  Convex& operator=(const Convex& other) {
    count_ = other.count_;
    std::copy_n(other.at_.begin(), count_, at_.begin());
    return *this;
  }
  bool empty() const { return count_ == 0; }
  std::span<const Eigen::Vector2d> corners() const { return {at_.data(), static_cast<std::size_t>(count_)}; }
  void add(const Eigen::Vector2d& corner) { at_[static_cast<std::size_t>(count_++)] = corner; }
  /// Keeps what has direction . (x - origin) <= bound.
  void clip(const Eigen::Vector2d& direction, const Eigen::Vector2d& origin, double bound);
  Eigen::Vector2d centre() const;  ///< mean of the corners
  Eigen::AlignedBox2d box() const;
  double radius_about(const Eigen::Vector2d& point) const;  ///< [m] of the least disc that contains it

 private:
  std::array<Eigen::Vector2d, most> at_;
  int count_ = 0;
};

}  // namespace surefoot::planner::proof
