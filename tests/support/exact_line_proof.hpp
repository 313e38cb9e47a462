// Proofs in integers that a mode is feasible nowhere on an interval of a line, and the polynomials whose signs decide
// it. A proof that is not found says nothing.
#pragma once

#include "tests/support/exact_polynomial.hpp"

namespace surefoot::testing {

/// A form whose coefficients are quadratics on an interval.
using QuadraticForm = std::array<Form, 3>;

/// The rows of a mode on an interval [first, first + 1] / 2^depth of the line.
struct ModePiece {
  Bernstein d;
  std::vector<QuadraticForm> rows;
  Integer first = 0;
  int depth = 0;
};

/// The values of a row at the corners of the box.
using CornerValues = std::array<Bernstein, 4>;
std::vector<CornerValues> corner_values(const std::vector<QuadraticForm>& rows, int sign,
                                        const std::array<Form, 4>& corners);

/// a_i b_j - a_j b_i: positive where two rows meet on a side of the box (exact_posture.cpp).
Bernstein side_cross(const CornerValues& a, const CornerValues& b, int i, int j);
/// Of the gradients of two rows in (p, q).
Bernstein minor(const QuadraticForm& a, const QuadraticForm& b);
Bernstein determinant(const QuadraticForm& a, const QuadraticForm& b, const QuadraticForm& c);

/// With the sign of d (both signs where d may vanish) no wrench of the box makes all rows positive, at any point of the
/// piece but perhaps isolated zeros of d.
bool proved_empty(const ModePiece& piece, const std::array<Form, 4>& corners);

}  // namespace surefoot::testing
