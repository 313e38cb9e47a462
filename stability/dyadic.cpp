#include "stability/dyadic.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {

Dyadic::Dyadic(double value) {
  assert(std::isfinite(value));
  if (value == 0) return;
  int exponent;
  const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(digits));
  mantissa_ = digits >> zeros;  // exact: the bits shifted out are zero
  exponent_ = exponent - 53 + zeros;
}

Dyadic operator-(Dyadic a) {
  a.mantissa_.backend().negate();
  return a;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  if (a.is_zero() || b.is_zero()) return {};
  return {a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_};
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  if (a.exponent_ == b.exponent_) return {a.mantissa_ + b.mantissa_, a.exponent_};
  return a.exponent_ > b.exponent_ ? Dyadic::sum(a, b) : Dyadic::sum(b, a);
}

Dyadic Dyadic::sum(const Dyadic& high, const Dyadic& low) {
  return {(high.mantissa_ << (high.exponent_ - low.exponent_)) + low.mantissa_, low.exponent_};
}

}  // namespace surefoot::stability
