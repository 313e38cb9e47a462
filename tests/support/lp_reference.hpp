// The contact problem as a linear program in its full unknowns, for tests only: accelerations a and alpha, the force
// f_i of every contact (2 each), p and q; unit mass, inertia rho^2, wrench f = -(p, 1), tau = -q. Equations of motion,
// and each contact's conditions from [OR-P, Table I] on its acceleration a_i and force f_i (row W mended: f^w = 0, f^u
// > 0).
//
// Strict conditions are asked as ">= t" with t <= 1 maximised: feasible iff t > 0. The optimum t (rows normalised) is
// returned: simplex in doubles is trusted where |t| is well above its tolerance. Conventions of theory section 4 on
// rows that vanish identically come from `Structure`, decided in rationals.
#pragma once

#include <vector>

#include "tests/support/direct_reference.hpp"

namespace surefoot::testing {

/// Margins between these are too near a boundary for an LP in doubles.
inline constexpr double lp_infeasible_below = 1e-9;
inline constexpr double lp_feasible_above = 1e-7;

class LpReference {
 public:
  explicit LpReference(const SamplePosture& sample)
      : sample_(sample), structure_(analyse(sample.contacts, sample.rho)) {}
  const Structure& structure() const { return structure_; }

  /// Greatest t with  sum lambda_k ray_k = wrench needed, lambda_k >= t : positive iff the wrench is in the interior
  /// of the cone (-1 where the cone has no interior or does not span the wrench).
  double equilibrium_margin(const Eigen::Vector2d& com, const Wrench& wrench) const;
  /// The least over the four corners of W.
  double equilibrium_margin(const Eigen::Vector2d& com) const;
  /// Greatest t of the mode over all (p, q) in W (-1 where even the equalities cannot hold).
  double mode_margin(const Eigen::Vector2d& com, const ModeStructure& mode) const;

  /// Largest s such that the wrench s * corner can be supplied, least over corners.
  double equilibrium_factor(const Eigen::Vector2d& com) const;
  /// Least s such that the mode is feasible with |p| <= s kappa, |q| <= s nu; `decided` is cleared where an LP was too
  /// close.
  double mode_factor(const Eigen::Vector2d& com, const ModeStructure& mode, bool& decided) const;
  struct Factor {
    double value = 0;
    bool decided = true;
  };
  Factor safety_factor(const Eigen::Vector2d& com) const;

 private:
  SamplePosture sample_;
  Structure structure_;
};

}  // namespace surefoot::testing
