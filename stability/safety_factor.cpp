// Safety factors of points and straight lines (theory section 5): the facets' part in closed form, the modes' part by
// the linear program of least_scale.hpp; along a line by certificates at the level of the best value found.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

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

/// The facets' part of sigma at one COM: the least of (z . g at p = q = 0) / (kappa |d/dp| + nu |d/dq|). In doubles
/// where their error bounds leave safety_factor_accuracy, otherwise in fractions.
class FacetFactors {
 public:
  FacetFactors(const Posture& posture, const Vector2d& com, const DisturbanceBox& box)
      : posture_(posture), com_(com), box_(box), x_(com.x() - posture.position(0).x()),
        y_(com.y() - posture.position(0).y()) {
    assert(com.allFinite());
    // z: 18 u a^2 (times lengths); x, y 1 u, products and sums 5 u of 2 a^2: together below facet_error, 32 u a^2.
    const double lengths = posture.spread() + std::abs(x_) + std::abs(y_);
    const bool hopeless = GuardScale(posture.edge_bound(), posture.rho2(), box).at(lengths).nothing_certain();
    gravity_error_ = hopeless ? infinity : posture.facet_error() * lengths + underflow_slack;
    spread_error_ = posture.facet_error() * (lengths * box.kappa + box.nu) + underflow_slack;
  }

  SafetyFactor least() const {
    SafetyFactor best = unlimited();
    std::uint32_t uncertain = 0;
    for (std::size_t k = 0; k < posture_.facets().size() && best.value > 0; ++k)
      if (!lower_in_doubles(posture_.facets()[k].z, best)) uncertain |= 1u << k;
    for (std::size_t k = 0; uncertain != 0 && best.value > 0; ++k, uncertain >>= 1)
      if (uncertain & 1 && may_lower(posture_.facets()[k].z, best)) lower_exactly(posture_.facets()[k], best);
    return best;
  }

 private:
  struct Terms {
    double at_gravity, slope, spread;
  };
  Terms terms(const Row<double>& z) const {
    const double slope = z.p - z.q * y_;
    return {z.one + z.q * x_, slope, box_.kappa * std::abs(slope) + box_.nu * std::abs(z.q)};
  }

  /// False where doubles cannot tell.
  bool lower_in_doubles(const Row<double>& z, SafetyFactor& best) const {
    const auto [at_gravity, slope, spread] = terms(z);
    if (at_gravity < -gravity_error_) {
      best = zero(Critical::of_equilibrium());
      return true;
    }
    constexpr double half = safety_factor_accuracy / 2;
    if (!(at_gravity * half > gravity_error_ && spread * half > spread_error_)) return false;
    const double value = at_gravity / spread;
    if (!(value < best.value)) return true;
    best.value = value;
    best.critical = Critical::of_equilibrium();
    best.witness = {-std::copysign(value * box_.kappa, slope), -std::copysign(value * box_.nu, z.q)};
    // d|slope| = sign(slope) (-z.q dy)
    best.gradient = Vector2d(z.q, value * box_.kappa * std::copysign(1.0, slope) * z.q) / spread;
    return true;
  }

  bool may_lower(const Row<double>& z, const SafetyFactor& best) const {
    const Terms t = terms(z);
    return !(t.at_gravity - gravity_error_ > best.value * (t.spread + spread_error_) && std::isfinite(best.value));
  }

  void lower_exactly(const Facet& facet, SafetyFactor& best) const {
    const Row<Dyadic> exact = posture_.exact_facet(facet);
    const Row<Fraction> z{fraction(exact.p), fraction(exact.one), fraction(exact.q)};
    const Vector2d& origin = posture_.position(0);
    const Fraction x = Fraction(com_.x()) - Fraction(origin.x()), y = Fraction(com_.y()) - Fraction(origin.y());
    const Fraction kappa(box_.kappa), nu(box_.nu), at_gravity = z.one + z.q * x, slope = z.p - z.q * y;
    if (at_gravity <= 0) {
      best = zero(Critical::of_equilibrium());
      return;
    }
    const Fraction spread = kappa * abs(slope) + nu * abs(z.q);
    if (spread == 0) return;
    const Fraction value = at_gravity / spread;
    if (std::isfinite(best.value) && value >= Fraction(best.value)) return;
    const auto number = [](const Fraction& k) { return k.convert_to<double>(); };
    best.value = number(value);
    best.critical = Critical::of_equilibrium();
    best.witness = {number(-value * kappa * slope.sign()), number(-value * nu * z.q.sign())};
    best.gradient = Vector2d(number(z.q / spread), number(value * kappa * slope.sign() * z.q / spread));
  }

  const Posture& posture_;
  Vector2d com_;
  DisturbanceBox box_;
  double x_, y_, gravity_error_, spread_error_;
};

/// Beyond the greatest double nothing limits.
void tidy(SafetyFactor& sigma) {
  if (sigma.value == infinity) sigma = unlimited();
  const auto no_negative_zero = [](double& value) { value += 0.0; };
  for (double* value : {&sigma.witness.p, &sigma.witness.q, &sigma.gradient.x(), &sigma.gradient.y()})
    no_negative_zero(*value);
}

/// The least of the modes' scales, below a bound.
class ModeFactors {
 public:
  ModeFactors(const Posture& posture, const Vector2d& com, const DisturbanceBox& box)
      : posture_(posture), query_(posture, com, box) {}

  void lower(const ModeSpec& spec, double& bound) {
    if (keep(spec, query_.in_doubles(spec, bound, found_), bound)) return;
    keep(spec, query_.in_fractions(spec, bound, found_), bound);
  }
  /// What doubles leave open is asked again below the bound that the other modes give.
  void lower_by_all(double& bound) {
    std::uint32_t open = 0, bit = 1;
    for (const ModeSpec& spec : posture_.modes()) {
      if (!keep(spec, query_.in_doubles(spec, bound, found_), bound)) open |= bit;
      if (bound == 0) return;
      bit <<= 1;
    }
    for (std::size_t k = 0; open != 0 && bound > 0; ++k, open >>= 1)
      if (open & 1) lower(posture_.modes()[k], bound);
  }
  /// What was found; `otherwise` if nothing.
  SafetyFactor least_or(const SafetyFactor& otherwise) {
    if (!critical_) return otherwise;
    return {scale_.s, Critical::of(posture_, *critical_), scale_.at, query_.gradient(*critical_, scale_)};
  }

 private:
  /// False where undecided.
  bool keep(const ModeSpec& spec, ScaleQuery::Outcome outcome, double& bound) {
    if (outcome == ScaleQuery::Outcome::undecided) return false;
    if (outcome == ScaleQuery::Outcome::not_below) return true;
    scale_ = found_;
    critical_ = &spec;
    bound = scale_.s;
    return true;
  }

  const Posture& posture_;
  ScaleQuery query_;
  const ModeSpec* critical_ = nullptr;
  ModeScale scale_, found_;
};

/// Makes a value consistent with a verdict, which is exact: a factor above 1 says stable, below 1 not.
bool near_one(double value) { return std::abs(value - 1) <= 4 * safety_factor_accuracy; }

}  // namespace

SafetyFactor RobustOracle::equilibrium_factor(const Vector2d& com) const {
  if (posture_.flat_cone()) return zero(Critical::of_equilibrium());
  SafetyFactor best = FacetFactors(posture_, com, box_).least();
  if (near_one(best.value)) best.value = equilibrium(com) ? std::max(best.value, 1.0) : std::min(best.value, 1.0);
  tidy(best);
  return best;
}

SafetyFactor RobustOracle::safety_factor(const Vector2d& com) const {
  if (posture_.flat_cone()) return zero(Critical::of_equilibrium());
  SafetyFactor best = FacetFactors(posture_, com, box_).least();
  if (best.value == 0) return best;
  ModeFactors modes(posture_, com, box_);
  double bound = best.value;
  modes.lower_by_all(bound);
  best = modes.least_or(best);
  if (near_one(best.value)) best.value = robust(com) ? std::max(best.value, 1.0) : std::min(best.value, 1.0);
  tidy(best);
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
    return unproved_scale(posture_.frame(from_, to_, lambda), spec, box_);
  }

  /// Modes that cannot lower a bound.
  std::uint32_t not_below(double best) const { return query_.scan(confirmed_level(best), false).excluded; }

  /// Lowers `best` to the mode's least scale on the line, if that is lower. Where certificates at the level of the
  /// bound stop, the scale is evaluated: lower than the bound, it is followed downhill to a local minimum, which
  /// becomes the bound.
  void lower(const ModeSpec& spec, double& best, double& best_lambda) const {
    double step = 1e-9;  // in lambda, where doubles can neither certify nor find a lower value; doubled each time
    double lambda = 0;
    while (lambda < 1 && best > 0) {
      lambda = query_.excluded_up_to(spec, confirmed_level(best), lambda);
      if (lambda >= 1) return;
      const double probe = std::min(1.0, lambda + step);
      step *= 2;
      if (std::min(scale(spec, lambda), scale(spec, probe)) < best) descend(spec, lambda, probe, best, best_lambda);
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

  /// Doubling steps to the right until the scale rises, then golden-section search. The scale may jump where rows
  /// vanish (a COM straight above a foot): what both looked at counts, whatever the search makes of it.
  void descend(const ModeSpec& spec, double lambda, double probe, double& best, double& best_lambda) const {
    consider(spec, lambda, best, best_lambda);
    consider(spec, probe, best, best_lambda);
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

/// The search samples; the verdict is certified. A line that is not stable has no factor above 1, a stable one none
/// below.
LineSafetyFactor made_consistent(const LineSafetyFactor& found, const RobustOracle& oracle, const Vector2d& from,
                                 const Vector2d& to) {
  constexpr double sampling_error = 1e-6;
  if (found.least.value < 1 - sampling_error) return found;
  LineSafetyFactor result = found;
  const LineVerdict verdict = oracle.line(from, to);
  if (verdict.stable()) {
    result.least.value = std::max(found.least.value, 1.0);
  } else if (found.least.value > 1) {
    const SafetyFactor there = oracle.safety_factor(from + verdict.lambda * (to - from));
    if (there.value <= 1) return {there, verdict.lambda};
    result.lambda = verdict.lambda;
    result.least.value = 1;
    result.least.critical = verdict.cause;
  }
  return result;
}

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
    // Doubles may have followed it to a place where rows vanish and it jumps; then it is as low beside.
    for (const double aside : {0.0, -0x1p-40, 0x1p-40, -0x1p-30, 0x1p-30, -0x1p-20, 0x1p-20}) {
      const double at = std::clamp(lambda + aside, 0.0, 1.0);
      ModeFactors there(posture_, search.at(at), box_);
      best = result.least.value;
      there.lower(spec, best);
      if (!(best < result.least.value)) continue;
      result = {there.least_or(result.least), at};
      break;
    }
  }
  result = made_consistent(result, *this, from, to);
  tidy(result.least);
  return result;
}

}  // namespace surefoot::stability
