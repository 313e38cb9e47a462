#include "planner/com_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace surefoot::planner {
namespace {

/// What is left of a convex polygon where direction . x <= bound.
void clip(Polygon& polygon, const Eigen::Vector2d& direction, double bound, Polygon& scratch) {
  scratch.clear();
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[i + 1 < n ? i + 1 : 0];
    const double at_a = direction.dot(a) - bound, at_b = direction.dot(b) - bound;
    if (at_a <= 0) scratch.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) scratch.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  polygon.swap(scratch);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A polygon of no area: a point between its first vertex and the one farthest from it.
Eigen::Vector2d point_on_line(const Polygon& polygon, double u) {
  const auto farthest = std::max_element(polygon.begin(), polygon.end(), [&](const auto& a, const auto& b) {
    return (a - polygon.front()).squaredNorm() < (b - polygon.front()).squaredNorm();
  });
  return polygon.front() + u * (*farthest - polygon.front());
}

}  // namespace

Polygon clip_to_half_plane(const Polygon& polygon, const Eigen::Vector2d& direction, double bound) {
  Polygon clipped = polygon, scratch;
  clip(clipped, direction, bound, scratch);
  return clipped;
}

Polygon reach_window(const gaits::Feet& feet, double reach_max) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector2d low(-infinity, -infinity), high(infinity, infinity);
  Eigen::Vector4d diagonal =
      Eigen::Vector4d::Constant(infinity);  // bounds in directions (1,1), (-1,1), (-1,-1), (1,-1)
  for (const auto& foot : feet) {
    if (!foot) continue;
    const Eigen::Vector2d& p = foot->position;
    low = low.cwiseMax(p - Eigen::Vector2d::Constant(reach_max));
    high = high.cwiseMin(p + Eigen::Vector2d::Constant(reach_max));
    const double r = std::numbers::sqrt2 * reach_max, sum = p.x() + p.y(), difference = p.x() - p.y();
    diagonal = diagonal.cwiseMin(Eigen::Vector4d(sum + r, r - difference, r - sum, difference + r));
  }
  if (!(low.array() < high.array()).all()) return {};
  Polygon polygon{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, scratch;
  scratch.reserve(8);
  clip(polygon, {1, 1}, diagonal[0], scratch);
  clip(polygon, {-1, 1}, diagonal[1], scratch);
  clip(polygon, {-1, -1}, diagonal[2], scratch);
  clip(polygon, {1, -1}, diagonal[3], scratch);
  return polygon;
}

Polygon clip_to_goal(const Polygon& polygon, const gaits::Goal& goal) {
  Polygon clipped = polygon, scratch;
  if (goal.com_x) {
    clip(clipped, {-1, 0}, -goal.com_x->first, scratch);
    clip(clipped, {1, 0}, goal.com_x->second, scratch);
  }
  if (goal.com_y) {
    clip(clipped, {0, -1}, -goal.com_y->first, scratch);
    clip(clipped, {0, 1}, goal.com_y->second, scratch);
  }
  // Rounding may leave a vertex an ulp outside a narrow interval.
  for (auto& vertex : clipped) {
    if (goal.com_x) vertex.x() = std::clamp(vertex.x(), goal.com_x->first, goal.com_x->second);
    if (goal.com_y) vertex.y() = std::clamp(vertex.y(), goal.com_y->first, goal.com_y->second);
  }
  return clipped;
}

Eigen::Vector2d point_in(const Polygon& polygon, double u, double v) {
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) area += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  if (!(area > 0)) return point_on_line(polygon, u);
  double left = u * area;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    const double part = cross(a, b);
    if (left > part && i + 1 < polygon.size()) {
      left -= part;
      continue;
    }
    // Within the triangle: the square root makes the distance from the apex uniform by area.
    const double w = part > 0 ? std::sqrt(std::clamp(left / part, 0.0, 1.0)) : 0.5;
    return polygon[0] + w * ((1 - v) * a + v * b);
  }
  return polygon[0];
}

}  // namespace surefoot::planner
