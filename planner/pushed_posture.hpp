// A posture with what pushes it, as `surefoot simulate` reads it from a file, and the state of motion that it starts
// in.
#pragma once

#include <optional>
#include <vector>

#include "stability/hybrid_body.hpp"
#include "terrain/document.hpp"

namespace surefoot::planner {

/// The start, in one of two ways; what is not given is zero.
struct Push {
  std::optional<Eigen::Vector3d> q, q_rate;              ///< r_x, r_y, theta [m, m, rad] and their rates
  std::optional<Eigen::Vector3d> heights, heights_rate;  ///< h_1, h_2, theta and their rates
};

struct PushedPosture {
  std::vector<stability::Contact> contacts;  ///< one or two
  double rho = 0;                            ///< [m]
  std::optional<Eigen::Vector2d> com;
  std::optional<double> restitution, gravity;
  Push push;
};

PushedPosture read_pushed_posture(const terrain::Node& root);

/// Throws InputError where the push is given in both ways, or in heights that leave the place open, or begins below
/// the ground.
stability::BodyState start_of(const stability::HybridBody& body, const Push& push);

}  // namespace surefoot::planner
