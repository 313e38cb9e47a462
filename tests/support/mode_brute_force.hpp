// Kinematic-strong equilibrium [OR-H, section II] of two contacts by brute force: the equations of motion of every
// non-static mode are solved for all seven unknowns. Shares nothing with stability/, and is right up to rounding only:
// near() tells where a sign is too small to be believed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "stability/contact.hpp"

namespace surefoot::testing {

class ModeBruteForce {
 public:
  ModeBruteForce(const std::vector<stability::Contact>& contacts, const Eigen::Vector2d& com, double rho);

  /// Gravity is balanced by three of the four edges of the cones.
  bool equilibrium();
  /// In every mode the forces are possible and a kinematic constraint is violated.
  bool every_mode_leads_back();
  /// A sign met so far was of a number below 1e-9.
  bool near() const { return near_; }

 private:
  bool positive(double value);
  bool leads_back(std::array<char, 2> mode);

  double rho_;
  std::array<Eigen::Vector2d, 2> n_, t_, r_;
  std::array<double, 2> mu_;
  std::array<Eigen::Vector3d, 2> normal_, tangent_;  // with their moments about the COM
  bool near_ = false;
};

}  // namespace surefoot::testing
