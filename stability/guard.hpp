// Bounds on the rounding error of the rows of rows.hpp in double precision.
//
// Let u = 2^-53. Normals are scaled by powers of two so that |n_x|, |n_y| <= 1; a = 1 + max mu bounds the components of
// cone edges; R bounds |r_x| + |r_y| over contacts (and over the line, where there is one); rho2 = rho^2. Errors,
// relative to the magnitude given, follow by counting operations ("k u" below; second-order terms are absorbed by
// rounding up):
//   r = fl(x_i - x)                        1 u of R
//   nz = r x n                             3 u of R            sz = r x C       5 u of a R      (C itself: 2 u of a)
//   normal_cross p, one                    5 u of 2 R          q slot           2 u of 2
//   slide_row p, one                      12 u of 2 a (rho2 + R^2)             q slot   9 u of 2 a R
//   roll_force_row p, one                  9 u of a (rho2 + R^2)               q slot   6 u of a R
//   force_cross p, one                    13 u of 2 a (rho2 + R^2)             q slot   9 u of 4 a R
//   z of two slides p, one                 9 u of 2 a^2 R      q slot           6 u of 2 a^2
//   slide_denominator                     10 u of 2 a (rho2 + R^2)
//   two-slide denominator                 17 u of 8 a^2 (rho2 + R^2)
// A row's value at (p, q) with |p| <= P, |q| <= Q adds 3 u of its magnitude. Hence every row value of the first class
// has an error of at most 64 u a ((rho2 + R^2)(1 + P) + R Q), of the length class 64 u a^2 (R (1 + P) + Q), and every
// denominator of at most 136 u a^2 (rho2 + R^2). At a point of a line r has 4 u, which the factor below
// contains: 136 * 3 < 512. Underflow adds an absolute error below `underflow_slack` while all quantities are within
// [1e-70, 1e70] or 0; outside of that the bounds are infinite and nothing is certain. What is not certain is decided
// exactly.
#pragma once

#include <limits>

#include "stability/contact.hpp"
#include "stability/rows.hpp"

namespace surefoot::stability {

/// False only in the copy of this folder that the benchmark of the guard's cost is measured against (bench/README.md):
/// doubles are then taken at their word, and nothing is decided exactly.
#ifdef SUREFOOT_UNGUARDED
constexpr bool guarded = false;
#else
constexpr bool guarded = true;
#endif

constexpr double unit_roundoff = 0x1p-53;
constexpr double row_error_factor = 512 * unit_roundoff;
constexpr double underflow_slack = 1e-290;

/// Error bounds for one COM, or for all COMs of a line.
struct Guard {
  double area = 0;         // rows added by Sink::add [m^2]
  double length = 0;       // rows added by Sink::add_length [m]
  double denominator = 0;  // D

  bool nothing_certain() const { return area == std::numeric_limits<double>::infinity(); }
};

/// What guards of one posture and one box have in common.
class GuardScale {
 public:
  GuardScale(double a, double rho2, const DisturbanceBox& box)
      : rho2_(rho2), kappa_(box.kappa), nu_(box.nu), factor_(row_error_factor * a * a),
        ordinary_(ordinary(a) && ordinary(rho2) && ordinary(box.kappa) && ordinary(box.nu)) {}

  Guard at(double radius) const {
    if constexpr (!guarded) return {0, 0, 0};
    if (!ordinary_ || !ordinary(radius)) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return {infinity, infinity, infinity};
    }
    const double area_scale = rho2_ + radius * radius;
    return {factor_ * (area_scale * (1 + kappa_) + radius * nu_) + underflow_slack,
            factor_ * (radius * (1 + kappa_) + nu_) + underflow_slack, factor_ * area_scale + underflow_slack};
  }

 private:
  static bool ordinary(double x) { return x == 0 || (x > 1e-70 && x < 1e70); }
  double rho2_, kappa_, nu_, factor_;
  bool ordinary_;
};

}  // namespace surefoot::stability
