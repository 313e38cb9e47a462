// Polynomials on [0, 1] with integer coefficients, and where their roots are: for the exact decision on lines.
#pragma once

#include <optional>
#include <vector>

#include "tests/support/exact_posture.hpp"

namespace surefoot::testing {

/// sum c_k t^k (1 - t)^(n - k): Bernstein form with the binomials inside, so that products are convolutions.
using Bernstein = std::vector<Integer>;

Bernstein product(const Bernstein& a, const Bernstein& b);
Bernstein difference(const Bernstein& a, const Bernstein& b);
/// a / b up to a positive factor, if b divides a.
std::optional<Bernstein> quotient(const Bernstein& a, const Bernstein& b);

/// What the coefficients say about the sign on [0, 1].
enum class Sign {
  negative = -1,  ///< below zero on (0, 1)
  zero = 0,       ///< identically
  positive = 1,   ///< above zero on (0, 1)
  open = 2,       ///< the coefficients do not tell
};
Sign sign_on_interval(const Bernstein& polynomial);
/// No coefficient is positive: the polynomial is nowhere positive.
bool nowhere_positive(const Bernstein& polynomial);

/// numerator / 2^exponent
struct DyadicPoint {
  Integer numerator;
  int exponent = 0;
};

/// For every distinct root in (0, 1]: two points at most 2^-`bits` apart, root in (low, high]. Sturm chains; exact.
std::vector<std::array<DyadicPoint, 2>> isolated_roots(const Bernstein& polynomial, int bits);

}  // namespace surefoot::testing
