// Robust stability of a posture [OR-P]: is the static mode possible, and no other contact mode, for every
// disturbance wrench of a box W? Rigid body in the plane, Coulomb friction, body at rest.
//
// Guarantee: verdicts are decided for the doubles given. Floating-point evaluation knows a bound of its own
// rounding error; what it cannot decide is decided in exact arithmetic (dyadic.hpp) (guard.hpp).
// Safety factors: relative error at most 1e-9 (proved in doubles, or else evaluated in fractions and rounded once; over
// the catalogue of docs/extremes.md 2e-10 at most, mostly 1e-14). Above 1 only where robust() holds, and not below 1
// where it does. Gradients: error at most 1e-9 of |gradient| + factor / lever over the catalogue, measured; at kinks a
// subgradient of one constraint. Never NaN: a value beyond the doubles is inf. Least factors on lines are found by a
// search: exact at the ends, above 1 only where line() holds.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "stability/contact.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

/// What limits a safety factor.
struct Critical {
  enum class Kind { none, equilibrium, mode } kind = Kind::none;
  ContactMode mode{};        ///< meaningful for Kind::mode
  std::string name() const;  ///< "none", "equilibrium" or the mode's letters

  static Critical of_equilibrium() { return {Kind::equilibrium, {}}; }
  static Critical of(const Posture& posture, const ModeSpec& spec) {
    return {Kind::mode, contact_mode(spec, posture.contacts())};
  }
};

/// sigma = sup {s >= 0 : the posture is robustly stable for s W}; theory section 5.
struct SafetyFactor {
  double value = 0;  ///< in [0, inf]; 0 where gravity alone already fails
  Critical critical;
  Wrench witness;                                      ///< on the boundary of sigma W (0 where sigma is 0 or inf)
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< d sigma / d com [1/m]; zero where sigma is 0 or inf
};

/// The least safety factor on a straight line of COMs.
struct LineSafetyFactor {
  SafetyFactor least;
  double lambda = 0;  ///< where on com_from -> com_to it is attained, in [0, 1]
};

/// Outcome of the straight-line test.
struct LineVerdict {
  enum class Outcome {
    stable,     ///< certified at every point of the line
    unstable,   ///< `lambda` is a point of the line where a non-static mode or no equilibrium is possible
    uncertain,  ///< tangential: neither could be shown; counts as unsafe
  } outcome = Outcome::uncertain;
  double lambda = 0;
  Critical cause;
  bool stable() const { return outcome == Outcome::stable; }
};

/// {x : normal . x + offset > 0}
struct HalfPlane {
  Eigen::Vector2d normal;
  double offset = 0;
};

/// RobustOracle(contacts, radius_of_gyration, box).robust(com) for contacts that are asked about once: without the work
/// that this COM does not need. But for their count the arguments are asserted only: a check would cost a twentieth.
bool robust(std::span<const Contact> contacts, double radius_of_gyration, const DisturbanceBox& box,
            const Eigen::Vector2d& com);

/// All questions about one set of 1 to 3 contacts. Construction does the work that does not depend on the COM;
/// member functions are const, cheap (exact numbers, where they are needed, are not), and may be called
/// from several threads. COMs are finite: asserted, as a check would cost what the answer does.
class RobustOracle {
 public:
  /// radius_of_gyration [m] > 0. Throws std::invalid_argument for non-finite numbers, negative friction or sides of the
  /// box, zero normals, or a count outside 1..3.
  RobustOracle(std::span<const Contact> contacts, double radius_of_gyration, DisturbanceBox box);

  /// com in R_SS(W): the contacts can balance every wrench of W, with strict inequality (theory section 3).
  bool equilibrium(const Eigen::Vector2d& com) const;
  /// com in R(W) [OR-P, Corollary VI.3]: equilibrium, and no non-static mode feasible anywhere in W.
  bool robust(const Eigen::Vector2d& com) const;
  /// The non-static modes feasible for some wrench of W.
  std::vector<ContactMode> feasible_modes(const Eigen::Vector2d& com) const;
  SafetyFactor safety_factor(const Eigen::Vector2d& com) const;
  /// sup {s >= 0 : com in R_SS(sW)}: the modes are not asked (criterion `equilibrium`).
  SafetyFactor equilibrium_factor(const Eigen::Vector2d& com) const;

  /// Robust stability at every COM of a straight line [OR-P, section VII; theory section 6].
  LineVerdict line(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool line_equilibrium(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// The non-static modes feasible for some wrench of W somewhere on the line (or not certified otherwise).
  std::vector<ContactMode> line_feasible_modes(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  LineSafetyFactor line_safety_factor(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  LineSafetyFactor line_equilibrium_factor(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// R_SS(W) as half-planes (facets at the corners of W); no half-plane means the whole plane.
  std::vector<HalfPlane> equilibrium_half_planes() const;
  /// R_SS(W) clipped to a convex polygon given counter-clockwise; empty where they do not meet.
  std::vector<Eigen::Vector2d> equilibrium_polygon(const std::vector<Eigen::Vector2d>& window) const;

  DisturbanceBox box() const { return box_; }
  const Posture& posture() const { return posture_; }

 private:
  Posture posture_;
  DisturbanceBox box_;
};

}  // namespace surefoot::stability
