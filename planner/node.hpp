// A node of the search: a two-contact stance as plain data, and the path of such nodes as a plan.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

/// Two planted feet and the COM; the entry of the free leg is the foothold it was lifted from, if any (the swing rule
/// asks for it). What step led to a node follows from the node before it, so a path of nodes is a whole plan.
struct Node {
  gaits::Feet feet;
  int free_leg = 0;                               ///< 0..2
  Eigen::Vector2d com = Eigen::Vector2d::Zero();  ///< [m]
  std::uint64_t id = 0;                           ///< nodes with the same id (not 0) have the same content

  std::array<int, 2> support() const { return {free_leg == 0 ? 1 : 0, free_leg == 2 ? 1 : 2}; }
  gaits::Stance stance() const {
    gaits::Stance stance{feet, com, 0, {}};
    stance.feet[free_leg].reset();
    return stance;
  }
};

/// The step between two consecutive nodes of a path.
inline gaits::Transfer step_between(const Node& from, const Node& to) {
  return {from.free_leg, *to.feet[from.free_leg], to.free_leg, 0, {}};
}

/// Stances and transfers of a path (safety factors are not filled in).
inline void write_path(const std::vector<Node>& path, gaits::Plan& plan) {
  plan.stances.clear();
  plan.transfers.clear();
  for (std::size_t i = 0; i < path.size(); ++i) {
    plan.stances.push_back(path[i].stance());
    if (i > 0) plan.transfers.push_back(step_between(path[i - 1], path[i]));
  }
}

}  // namespace surefoot::planner
