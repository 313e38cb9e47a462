// A mode's part of the safety factor (theory section 5): the least s >= 0 such that the open polygon {G_k . (p, 1, q) >
// 0} of the mode meets s W. A linear program in (p, q, s), solved incrementally (Seidel) with its dual. One formulation
// for two number types: in doubles, where bounds on either side then prove the value; in fractions, where they do not.
//
// Proof of a value s found in doubles, every row G_k being within e_k(s) = c_k + s l_k of the true one anywhere in s W:
//   from below  for any y >= 0, with A = |sum y_k a_k|_1 in box coordinates (P, Q) = (p / kappa, q / nu), the sum of
//   the true
//               rows is at most s' A + sum y_k (b_k + e_k(s')) on s' W. Negative: none of s' W is feasible. The dual
//               solution is y.
//   from above  a point of (1 + eps) s W where every row exceeds e_k((1 + eps) s).
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <optional>

#include "stability/box_test.hpp"
#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

using Fraction = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// Exact.
Fraction fraction(const Dyadic& value);

/// Safety factors are within this relative distance of the true value; where doubles cannot prove it, fractions are
/// used.
constexpr double safety_factor_accuracy = 1e-9;
/// Doubles prove nothing beyond this factor: disturbances that exceed the body's weight this much are left to
/// fractions.
constexpr double greatest_proved_scale = 1e9;

/// A row in box coordinates: a . (P, Q) + b > 0. A pinned axis (kappa or nu = 0) has coefficient 0.
template <class K>
struct ScaledRow {
  Vec2<K> a;
  K b;
  K at(const Vec2<K>& v) const { return a.x * v.x + a.y * v.y + b; }
};

template <class K>
struct ScaledRows {
  std::array<ScaledRow<K>, max_rows> row;
  int count = 0;
};

template <class K>
struct LeastScale {
  bool empty = false;  ///< no point in the plane satisfies the rows
  K s = K(0);
  Vec2<K> v{K(0), K(0)};  ///< in box coordinates, where s is attained
  /// Multipliers of the active rows: sum y_k a_k is an outward normal of the side(s) of s W reached, of 1-norm 1; zero
  /// if `empty`.
  int active = 0;
  std::array<int, 3> row{};
  std::array<K, 3> y{K(0), K(0), K(0)};
};

/// The least s of the closed polygon {rows >= 0}. Stops at some s >= give_up once s is known to be that large.
template <class K>
LeastScale<K> least_scale(const ScaledRows<K>& rows, const std::optional<K>& give_up);

/// A mode's least scale.
struct ModeScale {
  double s = 0;
  Wrench at;
  LeastScale<double> dual;
  bool exact = false;  ///< it comes from fractions
};

/// The error of a row at a point of s W is at most constant + s linear.
struct RowErrors {
  double constant, linear;
};

/// From the derivation in guard.hpp (there at the end: 64 u a and 64 u a^2). Rows of normals alone need 2 u of rho^2, 3
/// u of R, and 3 u for their value.
struct ScaleErrors {
  RowErrors area, length, normal;
  double denominator;
};

/// The modes' scales at one COM.
class ScaleQuery {
 public:
  ScaleQuery(const Posture& posture, const Eigen::Vector2d& com, const DisturbanceBox& box);

  enum class Outcome { not_below, found, undecided };
  /// Whether the mode's scale is less than `bound`, and if so which; what is said is proved to safety_factor_accuracy.
  Outcome in_doubles(const ModeSpec& spec, double bound, ModeScale& scale) const;
  /// The same in fractions, rounded once: always decided.
  Outcome in_fractions(const ModeSpec& spec, double bound, ModeScale& scale);
  /// d s / d com of the scale found last; zero where s is 0.
  Eigen::Vector2d gradient(const ModeSpec& spec, const ModeScale& scale);

 private:
  const Frame<Dyadic>& exact_frame();
  Eigen::Vector2d exact_gradient(const ModeSpec& spec);

  const Posture& posture_;
  Eigen::Vector2d com_;
  DisturbanceBox box_;
  Frame<double> frame_;
  bool nothing_certain_;
  ScaleErrors errors_;
  std::optional<Frame<Dyadic>> exact_;
  std::optional<LeastScale<Fraction>> found_;  // the last one in fractions, and the sign given to its rows
  bool negative_ = false;
};

/// A mode's scale in doubles as it comes, for searches whose result is evaluated again.
double unproved_scale(const Frame<double>& frame, const ModeSpec& spec, const DisturbanceBox& box);

}  // namespace surefoot::stability
