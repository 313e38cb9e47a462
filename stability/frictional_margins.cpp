// How far a posture is from the limits of Theorem 3.
#include <algorithm>
#include <cmath>

#include "stability/box_test.hpp"
#include "stability/frictional.hpp"
#include "stability/polynomial_frame.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::stability {
namespace {

constexpr double unlimited = HUGE_VAL;

/// Radius of a disc in which f keeps the sign it has in the middle: |f - f(0)| <= |gradient| r + |f''| / 2 r^2.
double radius_of_sign(const Poly2& f) {
  const double middle = 0.5 * (f.ss + f.tt), spread = std::hypot(0.5 * (f.ss - f.tt), 0.5 * f.st);
  return first_root({-std::abs(f.c), std::hypot(f.s, f.t), std::abs(middle) + spread});
}

/// Forces stay possible and one acceleration keeps leading back.
double radius_of_mode(const Frame<Poly2>& frame, const ModeSpec& spec) {
  GravityRows<Poly2> rows;
  emit_rows(frame, spec, rows);
  double radius = rows.d ? radius_of_sign(*rows.d) : unlimited, back = 0;
  const double sign = rows.d && rows.d->c < 0 ? -1 : 1;
  for (int k = 0; k < rows.count; ++k) {
    const bool kinematic = k < rows.count - force_rows(spec);
    if (!kinematic) radius = std::min(radius, radius_of_sign(rows.value[k]));
    if (kinematic && sign * rows.value[k].c < 0) back = std::max(back, radius_of_sign(rows.value[k]));
  }
  return std::min(radius, back);
}

/// (10) says -X > theta sqrt(D_1) sqrt(D_2); sqrt(D_i) = |(rho n_i, r_i x n_i)| changes by at most |n_i| per metre, X
/// by at most |gradient| r + |n_1| |n_2| r^2.
double radius_of_clattering(const Frame<Poly2>& frame, double threshold) {
  const Poly2 x = normal_product(frame, 0, 1);
  double root[2] = {}, size[2] = {};
  for (int i : {0, 1}) {
    root[i] = std::sqrt(normal_product(frame, i, i).c);
    size[i] = std::hypot(frame.at[i].n.x, frame.at[i].n.y);
  }
  const double excess = -x.c - threshold * root[0] * root[1];
  if (!(excess > 0)) return 0;
  return first_root({-excess, std::hypot(x.s, x.t) + threshold * (root[0] * size[1] + root[1] * size[0]),
                     (1 + threshold) * size[0] * size[1]});
}

double radius_of_equilibrium(const Posture& posture, const Eigen::Vector2d& com) {
  double radius = posture.flat_cone() ? 0 : unlimited;
  for (const Facet& facet : posture.facets()) {
    const double value = facet.z.one + facet.z.q * (com.x() - posture.position(0).x());
    radius = std::min(radius, facet.z.q != 0 ? std::max(0.0, value / std::abs(facet.z.q)) : unlimited);
  }
  return radius;
}

}  // namespace

double clattering_threshold(double restitution) {
  const double s = std::cbrt(restitution);
  return s / (1 - s + s * s);
}

/// s + 1/s = 1 + c, the root below 1 (see converges_exactly in frictional.cpp).
double greatest_restitution(double root_psi) {
  if (!(root_psi > 0)) return 0;
  const double c = std::max(1.0, 1 / root_psi);
  const double s = 2 / (1 + c + std::sqrt((c - 1) * (c + 3)));
  return s * s * s;
}

FrictionalMargins frictional_margins(const Posture& posture, const Eigen::Vector2d& com, double restitution) {
  const auto [first, second] = psi(posture, com);
  const double root_psi = std::copysign(std::sqrt(first * second), first);
  const double threshold = clattering_threshold(restitution);
  FrictionalMargins margins{root_psi - threshold, greatest_restitution(root_psi), 0};
  if (!frictional_verdict(posture, com, restitution).stable()) return margins;
  const Frame<Poly2> frame = frame_around(posture, com, Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY());
  margins.com = std::min(radius_of_equilibrium(posture, com), radius_of_clattering(frame, threshold));
  for (const ModeSpec& spec : posture.modes()) margins.com = std::min(margins.com, radius_of_mode(frame, spec));
  return margins;
}

}  // namespace surefoot::stability
