#include "tests/support/extreme_factor.hpp"

#include <cmath>
#include <limits>

namespace surefoot::testing {
namespace {

double nearest(const Quotient& value) { return value.convert_to<double>(); }

/// Beyond the doubles inf is right, below them 0.
double value_error(double found, const std::optional<Quotient>& exact) {
  const double infinity = std::numeric_limits<double>::infinity();
  constexpr double greatest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  if (!exact) return std::isinf(found) ? 0 : infinity;
  if (std::isinf(found)) return *exact >= Quotient(greatest) ? 0 : infinity;
  const Quotient error = abs(Quotient(found) - *exact);
  if (error <= Quotient(std::numeric_limits<double>::denorm_min()) && *exact < Quotient(least)) return 0;
  return *exact == 0 ? (found == 0 ? 0 : infinity) : nearest(error / *exact);
}

}  // namespace

FactorComparison compared(const SamplePosture& sample, const stability::SafetyFactor& found, const ExactFactor& exact) {
  FactorComparison result;
  result.not_a_number = std::isnan(found.value) || std::isnan(found.witness.p) || std::isnan(found.witness.q) ||
                        found.gradient.array().isNaN().any();
  result.value_error = value_error(found.value, exact.value);
  if (exact.kink || result.not_a_number || !exact.value || *exact.value == 0) return result;
  double lever = 0;
  for (const Contact& contact : sample.contacts) lever = std::max(lever, (contact.position - sample.com).lpNorm<1>());
  const double x = nearest(exact.gradient[0]), y = nearest(exact.gradient[1]);
  const double size = std::abs(x) + std::abs(y) + found.value / lever;
  if (!std::isfinite(size) || size == 0) return result;
  result.gradient_error = (std::abs(found.gradient.x() - x) + std::abs(found.gradient.y() - y)) / size;
  return result;
}

}  // namespace surefoot::testing
