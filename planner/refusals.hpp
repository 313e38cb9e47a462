// What stood in the way of a search that found no plan: refused landings and steps by the rule that refused them, and
// the place where there were most.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "gaits/rules.hpp"

namespace surefoot::planner {

using RuleCounts = std::array<std::uint64_t, gaits::rule_count>;  ///< by gaits::Rule

/// The rules that refused, most frequent first: "reach 41 %, stance stability 30 %"; empty where nothing was refused.
std::string shares(const RuleCounts& refused);

class Refusals {
 public:
  /// Places are squares of that side [m].
  explicit Refusals(double side) : side_(side) {}
  void add(gaits::Rule rule, const Eigen::Vector2d& com);
  /// "1234 landings and steps refused: ...; most (60 %) with the COM from (1, 0.5) to (2, 1.5): ..."
  std::string summary() const;

 private:
  struct Place {
    RuleCounts refused{};
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< lower left [m]
    std::uint64_t order = 0;                           ///< in which places were met; the first of equals is named
  };
  double side_;
  RuleCounts total_{};
  std::unordered_map<std::uint64_t, Place> places_;
};

}  // namespace surefoot::planner
