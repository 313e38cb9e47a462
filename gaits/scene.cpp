#include "gaits/scene.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

bool Goal::contains(const Eigen::Vector2d& com) const {
  const auto inside = [](const std::optional<std::pair<double, double>>& interval, double value) {
    return !interval || (interval->first <= value && value <= interval->second);
  };
  return inside(com_x, com.x()) && inside(com_y, com.y());
}

double Goal::distance(const Eigen::Vector2d& com) const {
  const auto outside = [](const std::optional<std::pair<double, double>>& interval, double value) {
    return interval ? std::max({interval->first - value, value - interval->second, 0.0}) : 0.0;
  };
  return std::hypot(outside(com_x, com.x()), outside(com_y, com.y()));
}

stability::Contact contact_at(const terrain::Foothold& foothold) {
  return {foothold.position, foothold.normal, foothold.friction};
}

}  // namespace surefoot::gaits
