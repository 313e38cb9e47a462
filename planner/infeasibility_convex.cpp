#include "planner/infeasibility_convex.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::planner::proof {

using Eigen::Vector2d;

void Convex::clip(const Vector2d& direction, const Vector2d& origin, double bound) {
  std::array<double, most> height;
  bool all_in = true;
  for (int i = 0; i < count_; ++i) {
    height[i] = direction.dot(at_[i] - origin) - bound;
    if (!std::isfinite(height[i])) return;  // beyond the doubles: nothing is known, nothing is cut
    all_in &= height[i] <= 0;
  }
  if (all_in || count_ + 1 >= most) return;  // too many corners: left as it is, which contains the part wanted
  std::array<Vector2d, most> kept;
  int n = 0;
  for (int i = 0; i < count_; ++i) {
    const int next = i + 1 < count_ ? i + 1 : 0;
    if (height[i] <= 0) kept[n++] = at_[i];
    if ((height[i] < 0 && height[next] > 0) || (height[i] > 0 && height[next] < 0))
      kept[n++] = at_[i] + (at_[next] - at_[i]) * (height[i] / (height[i] - height[next]));
  }
  std::copy_n(kept.begin(), n, at_.begin());
  count_ = n;
}

Vector2d Convex::centre() const {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : corners()) sum += corner - at_[0];
  return at_[0] + sum / count_;
}

Eigen::AlignedBox2d Convex::box() const {
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : corners()) box.extend(corner);
  return box;
}

double Convex::radius_about(const Vector2d& point) const {
  double squared = 0;
  for (const Vector2d& corner : corners()) squared = std::max(squared, (corner - point).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace surefoot::planner::proof
