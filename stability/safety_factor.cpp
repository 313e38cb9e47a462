// Safety factors of points and straight lines (theory section 5): the facets' part in closed form, the modes' part by the
// linear program of least_scale.hpp; along a line by certificates at the level of the best value found.
#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/least_scale.hpp"
#include "stability/line_test.hpp"
#include "stability/point_test.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::stability {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Eigen::Vector2d;

SafetyFactor unlimited() {
  SafetyFactor sigma;
  sigma.value = infinity;
  return sigma;
}

SafetyFactor zero(const Critical& critical) {
  SafetyFactor sigma;
  sigma.critical = critical;
  return sigma;
}

/// The facet's part of sigma: (z . g at p = q = 0) / (kappa |d/dp| + nu |d/dq|), if less than `best`.
void lower_by_facet(const Facet& facet, double x, double y, const DisturbanceBox& box, SafetyFactor& best) {
  const Row<double>& z = facet.z;
  const double at_gravity = z.one + z.q * x, slope = z.p - z.q * y;
  const double spread = box.kappa * std::abs(slope) + box.nu * std::abs(z.q);
  if (!(at_gravity > 0)) {
    best = zero(Critical::of_equilibrium());
    return;
  }
  const double value = at_gravity / spread;
  if (!(value < best.value)) return;
  best.value = value;
  best.critical = Critical::of_equilibrium();
  best.witness = {-std::copysign(value * box.kappa, slope), -std::copysign(value * box.nu, z.q)};
  // d|slope| = sign(slope) (-z.q dy)
  best.gradient = Vector2d(z.q, value * box.kappa * std::copysign(1.0, slope) * z.q) / spread;
}

/// A mode's part of sigma at one COM, in doubles.
LeastScale mode_scale(const Frame<double>& frame, const ModeSpec& spec, const DisturbanceBox& box, double give_up) {
  RowSink<double> sink;
  emit_rows(frame, spec, sink);
  if (sink.d && *sink.d < 0)
    for (int k = 0; k < sink.rows.count; ++k) sink.rows.row[k] = -sink.rows.row[k];
  return least_scale(sink.rows, box, give_up);
}

Vector2d mode_gradient(const Posture& posture, const Vector2d& com, const ModeSpec& spec, const LeastScale& scale) {
  RowSink<Dual> sink;
  emit_rows(posture.dual_frame(com), spec, sink);
  const double sign = sink.d && sink.d->value < 0 ? -1 : 1;
  Vector2d gradient = Vector2d::Zero();
  for (int k = 0; k < scale.active; ++k) {
    const Dual value = value_at(sink.rows.row[scale.row[k]], scale.at.p, scale.at.q);
    gradient -= sign * scale.y[k] * Vector2d(value.dx, value.dy);
  }
  return gradient;
}

void lower_by_mode(const Posture& posture, const Frame<double>& frame, const Vector2d& com, const ModeSpec& spec,
                   const DisturbanceBox& box, SafetyFactor& best) {
  const LeastScale scale = mode_scale(frame, spec, box, best.value);
  if (!(scale.s < best.value)) return;
  best.value = scale.s;
  best.critical = Critical::of(posture, spec);
  best.witness = scale.at;
  best.gradient = scale.s > 0 ? mode_gradient(posture, com, spec, scale) : Vector2d::Zero();
}

}  // namespace

SafetyFactor RobustOracle::equilibrium_factor(const Vector2d& com) const {
  if (posture_.flat_cone()) return zero(Critical::of_equilibrium());
  const double x = com.x() - posture_.position(0).x(), y = com.y() - posture_.position(0).y();
  SafetyFactor best = unlimited();
  for (const Facet& facet : posture_.facets()) {
    lower_by_facet(facet, x, y, box_, best);
    if (best.value == 0) break;
  }
  return best;
}

SafetyFactor RobustOracle::safety_factor(const Vector2d& com) const {
  SafetyFactor best = equilibrium_factor(com);
  const Frame<double> frame = posture_.frame(com);
  for (const ModeSpec& spec : posture_.modes()) {
    if (best.value == 0) break;
    lower_by_mode(posture_, frame, com, spec, box_, best);
  }
  return best;
}

// ---- lines ------------------------------------------------------------------------------------------------------

LineSafetyFactor RobustOracle::line_equilibrium_factor(const Vector2d& from, const Vector2d& to) const {
  // The facet ratio is linear over convex, hence quasi-concave in lambda: the least value is at an end.
  const SafetyFactor start = equilibrium_factor(from), end = equilibrium_factor(to);
  return end.value < start.value ? LineSafetyFactor{end, 1} : LineSafetyFactor{start, 0};
}

namespace {

/// The least of one mode's scale along a line, searched below a bound that certificates then confirm.
class LineMinimum {
 public:
  LineMinimum(const Posture& posture, const Vector2d& from, const Vector2d& to, const DisturbanceBox& box)
      : posture_(posture), from_(from), to_(to), box_(box), query_(posture, from, to, box) {}

  Vector2d at(double lambda) const { return from_ + lambda * (to_ - from_); }

  double scale(const ModeSpec& spec, double lambda) const {
    return mode_scale(posture_.frame(from_, to_, lambda), spec, box_, infinity).s;
  }

  /// Modes that cannot lower a bound.
  std::uint32_t not_below(double best) const { return query_.screened(confirmed_level(best)); }

  /// Lowers `best` to the mode's least scale on the line, if that is lower. Where certificates at the level of the bound
  /// stop, the scale is evaluated: lower than the bound, it is followed downhill to a local minimum, which becomes the bound.
  void lower(const ModeSpec& spec, double& best, double& best_lambda) const {
    double step = 1e-9;  // in lambda, where doubles can neither certify nor find a lower value; doubled each time
    double lambda = 0;
    while (lambda < 1 && best > 0) {
      lambda = query_.excluded_up_to(spec, confirmed_level(best), lambda);
      if (lambda >= 1) return;
      const double probe = std::min(1.0, lambda + step);
      step *= 2;
      if (std::min(scale(spec, lambda), scale(spec, probe)) < best) descend(spec, lambda, best, best_lambda);
      lambda = probe;
    }
  }

 private:
  // Factors beyond this are confirmed at this level only: larger disturbances exceed the body's weight by far.
  static double confirmed_level(double best) {
    constexpr double strictness = 1 - 1e-7, greatest_level = 1e6;  // certificates are strict: slightly below the bound
    return std::min(best * strictness, greatest_level);
  }

  void consider(const ModeSpec& spec, double lambda, double& best, double& best_lambda) const {
    const double value = scale(spec, lambda);
    if (!(value < best)) return;
    best = value;
    best_lambda = lambda;
  }

  /// Doubling steps to the right until the scale rises, then golden-section search.
  void descend(const ModeSpec& spec, double lambda, double& best, double& best_lambda) const {
    consider(spec, lambda, best, best_lambda);
    double left = lambda, middle = lambda, step = 1e-9, value = scale(spec, lambda);
    double right = lambda;
    while (right < 1) {
      right = std::min(1.0, middle + step);
      const double next = scale(spec, right);
      if (!(next <= value)) break;
      left = middle;
      middle = right;
      value = next;
      step *= 2;
    }
    golden_section(spec, left, right, best, best_lambda);
  }

  void golden_section(const ModeSpec& spec, double a, double b, double& best, double& best_lambda) const {
    constexpr double ratio = 0.6180339887498949;
    constexpr int iterations = 70;  // the interval shrinks by 1e-14
    double c = b - ratio * (b - a), d = a + ratio * (b - a);
    double fc = scale(spec, c), fd = scale(spec, d);
    for (int k = 0; k < iterations && b > a; ++k) {
      if (fc < fd) {
        b = d, d = c, fd = fc;
        c = b - ratio * (b - a), fc = scale(spec, c);
      } else {
        a = c, c = d, fc = fd;
        d = a + ratio * (b - a), fd = scale(spec, d);
      }
    }
    for (const double lambda : {a, b, c, d}) consider(spec, lambda, best, best_lambda);
  }

  const Posture& posture_;
  Vector2d from_, to_;
  DisturbanceBox box_;
  LineQuery query_;
};

}  // namespace

LineSafetyFactor RobustOracle::line_safety_factor(const Vector2d& from, const Vector2d& to) const {
  const SafetyFactor start = safety_factor(from), end = safety_factor(to);
  LineSafetyFactor result = end.value < start.value ? LineSafetyFactor{end, 1} : LineSafetyFactor{start, 0};
  const LineMinimum search(posture_, from, to, box_);
  std::uint32_t excluded = result.least.value > 0 ? search.not_below(result.least.value) : ~0u;
  for (const ModeSpec& spec : posture_.modes()) {
    const bool screened = excluded & 1;
    excluded >>= 1;
    if (screened || result.least.value == 0) continue;
    double best = result.least.value, lambda = result.lambda;
    search.lower(spec, best, lambda);
    if (!(best < result.least.value)) continue;
    result.lambda = lambda;
    const Vector2d com = search.at(lambda);
    lower_by_mode(posture_, posture_.frame(com), com, spec, box_, result.least);
  }
  return result;
}

}  // namespace surefoot::stability
