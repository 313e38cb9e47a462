// Frictional stability of a posture on two contacts under gravity [OR-H, Theorem 3]: after every small enough push,
// which may slide or lift feet, the body comes to rest near where it was. Sufficient, not necessary:
//   kinematic-strong equilibrium  in every non-static mode the forces are possible and the accelerations lead back
//   clattering convergence (10)   alternating collisions with restitution e die out in finite time
//   upward-facing ground          n_iy > 0 for both contacts
// Model: rigid body, straight ground at each contact, Coulomb friction, collisions by [OR-H, (4)] (no friction
// impulse).
//
// Guarantee: verdicts are decided for the doubles given: by doubles with a bound of their rounding error, else in exact
// numbers. All inequalities are strict: a boundary counts as not stable, and so does a foot exactly in line with the
// other along its normal (a mode then has no acceleration that would lead back).
// Errors: std::invalid_argument for a posture that has not two contacts or a restitution that is not between 0 and 1,
// ends excluded. COMs are finite (asserted).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "stability/posture.hpp"

namespace surefoot::stability {

/// psi_1, psi_2 of [OR-H, (6)]: what a collision at one contact adds to the speed of the other, over the impulse.
/// With the inner product of M^-1 they are -<N_1, N_2> / <N_i, N_i>; normals need not have unit length.
std::array<double, 2> psi(const Posture& posture, const Eigen::Vector2d& com);

/// [OR-H, section II]. The posture has two contacts.
bool kinematic_strong(const Posture& posture, const Eigen::Vector2d& com);
/// [OR-H, (10)] for 0 < restitution < 1.
bool clattering_converges(const Posture& posture, const Eigen::Vector2d& com, double restitution);
/// Both n_iy > 0.
bool faces_upward(const Posture& posture);

struct FrictionalVerdict {
  bool upward = false, kinematic_strong = false, clattering = false;
  bool equilibrium = false;                ///< gravity alone can be balanced
  std::optional<ContactMode> failed_mode;  ///< the first that keeps an equilibrium from being kinematic-strong
  bool stable() const { return upward && kinematic_strong && clattering; }
};
FrictionalVerdict frictional_verdict(const Posture& posture, const Eigen::Vector2d& com, double restitution);
/// frictional_verdict(...).stable(), without the work that is not needed.
bool frictionally_stable(const Posture& posture, const Eigen::Vector2d& com, double restitution);

/// The right-hand side of (10): (e^1/3 + e^2/3) / (1 + e).
double clattering_threshold(double restitution);
/// The e at which (10) is an equality for given sqrt(psi_1 psi_2); 0 if that is not positive, at most 1.
double greatest_restitution(double root_psi);

/// How far from the limits of Theorem 3. In doubles (relative error about 1e-14 of the terms of each formula).
struct FrictionalMargins {
  double psi = 0;          ///< sqrt(psi_1 psi_2) - threshold; the root counts as negative where psi_i < 0
  double restitution = 0;  ///< clattering converges for every e below this
  double com = 0;  ///< [m] every COM within this distance is stable too: a lower bound, 0 where the verdict is no
};
FrictionalMargins frictional_margins(const Posture& posture, const Eigen::Vector2d& com, double restitution);

}  // namespace surefoot::stability
