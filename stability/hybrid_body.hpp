// The planar rigid body of [OR-H, (1)-(3)] above one or two straight pieces of ground, and its state.
// h_i, their rates and the sliding speeds are kept beside the configuration and changed by their own increments, so
// that a gap of 1e-12 m is known to 16 digits of itself, not of the posture.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "stability/rows.hpp"

namespace surefoot::stability {

/// Displacement from the nominal posture, velocity, and what the contacts see of them.
struct BodyState {
  Eigen::Vector2d r = Eigen::Vector2d::Zero();  ///< of the COM [m]
  double theta = 0;                             ///< [rad]
  Eigen::Vector2d v = Eigen::Vector2d::Zero();  ///< [m/s]
  double omega = 0;                             ///< [rad/s]
  std::array<double, 2> h{};                    ///< height above the ground along its normal [m]; exactly 0: touches
  std::array<double, 2> rate{};                 ///< of h [m/s]; 0 with h = 0: the contact is closed
  std::array<double, 2> slip{};                 ///< speed along t_i [m/s]

  bool closed(int i) const { return h[i] == 0 && rate[i] == 0; }
};

class HybridBody {
 public:
  /// `linearised`: [OR-H, (5)-(6)], arms and accelerations as in the nominal posture. One or two contacts; normals
  /// of any length; rho and gravity [m/s^2] > 0. Throws std::invalid_argument for anything else.
  HybridBody(std::span<const Contact> contacts, const Eigen::Vector2d& com, double radius_of_gyration, double gravity,
             bool linearised = false);

  int contacts() const { return count_; }
  const Eigen::Vector2d& com() const { return com_; }
  double rho() const { return rho_; }
  double rho2() const { return rho2_; }
  double gravity() const { return gravity_; }
  bool linearised() const { return linearised_; }
  double friction(int i) const { return friction_[i]; }
  const Eigen::Vector2d& normal(int i) const { return normal_[i]; }
  const Eigen::Vector2d& tangent(int i) const { return tangent_[i]; }
  const Eigen::Vector2d& ground(int i) const { return ground_[i]; }  ///< the nominal contact [m]
  double extent() const { return extent_; }                          ///< distance of the contacts, at least rho [m]
  /// From the COM to contact point i of the body turned by theta.
  Eigen::Vector2d arm(int i, double theta) const;
  /// omega^2 as far as it bends paths: 0 in the linearised body.
  double turning(const BodyState& state) const { return linearised_ ? 0 : state.omega * state.omega; }

  /// From q = (r_x, r_y, theta) and its rates. Heights within rounding of 0 are 0.
  BodyState state_at(const Eigen::Vector3d& q, const Eigen::Vector3d& q_rate) const;
  /// From q' = (h_1, h_2, theta) and its rates [OR-H, (5)]; throws std::invalid_argument where the
  /// two normals are parallel.
  BodyState state_at_heights(const Eigen::Vector3d& heights, const Eigen::Vector3d& heights_rate) const;
  bool parallel_normals() const;

  /// Where contact point i of the body is.
  Eigen::Vector2d point(const BodyState& state, int i) const;
  /// Greatest displacement of the COM or of a contact point from the nominal posture [m].
  double excursion(const BodyState& state) const;
  /// Per mass [m^2/s^2], 0 at rest in the nominal posture.
  double energy(const BodyState& state) const;
  /// Greatest speed of the COM or, by turning, of a contact point about it [m/s].
  double speed(const BodyState& state) const;
  /// Acceleration of contact i along its normal in free flight [m/s^2].
  double free_acceleration(const BodyState& state, int i) const;

  /// Acceleration along d at contact i that a force e (per mass) at contact j causes: an entry of the inverse inertia
  /// seen at the contacts, with arms turned by theta.
  double response(double theta, int i, const Eigen::Vector2d& d, int j, const Eigen::Vector2d& e) const;
  /// An impulse e (per mass) at contact j [m/s].
  void push(BodyState& state, int j, const Eigen::Vector2d& e) const;
  /// Free flight for a time s >= 0, exact up to rounding [OR-H, M q'' + G = 0].
  void fly(BodyState& state, double s) const;

 private:
  Eigen::Vector2d turned_by(const Eigen::Vector2d& arm, double angle) const;

  int count_;
  Eigen::Vector2d com_;
  double rho_, rho2_, gravity_, extent_;
  bool linearised_;
  std::array<Eigen::Vector2d, 2> ground_, arm_, normal_, tangent_;
  std::array<double, 2> friction_;
};

/// Whether all numbers of a state, and of its contacts, are finite.
bool is_finite(const HybridBody& body, const BodyState& state);

/// a turned by a quarter.
inline Eigen::Vector2d quarter(const Eigen::Vector2d& a) { return {-a.y(), a.x()}; }
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
/// sin x - x to full relative accuracy.
double sin_minus(double x);

}  // namespace surefoot::stability
