#include "gaits/scene.hpp"

#include <fmt/format.h>

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
  const double x = outside(com_x, com.x()), y = outside(com_y, com.y());
  if (x == 0 || y == 0) return x + y;  // the search asks often, and mostly for one coordinate
  return std::hypot(x, y);
}

const std::vector<std::string>& planner_names() {
  static const std::vector<std::string> names{"auto", "Layers", "RRT", "KPIECE1", "EST", "SST"};
  return names;
}

const std::vector<std::string>& objective_names() {
  static const std::vector<std::string> names{"steps", "safety", "distance"};
  return names;
}

const std::string* known_word(std::string_view word, const std::vector<std::string>& words) {
  const std::string lower = terrain::lower_case(std::string(word));
  const auto found =
      std::find_if(words.begin(), words.end(), [&](const auto& one) { return terrain::lower_case(one) == lower; });
  return found == words.end() ? nullptr : &*found;
}

std::string not_known(std::string_view what, std::string_view word, const std::vector<std::string>& words) {
  const std::string near = terrain::near_miss(word, words);
  return fmt::format("{}: \"{}\" is not known; expected one of: {}{}", what, terrain::shown(word),
                     fmt::join(words, ", "), near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near));
}

stability::Contact contact_at(const terrain::Foothold& foothold) {
  return {foothold.position, foothold.normal, foothold.friction};
}

}  // namespace surefoot::gaits
