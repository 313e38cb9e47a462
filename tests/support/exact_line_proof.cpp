#include "tests/support/exact_line_proof.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::testing {
namespace {

Bernstein negated(const Bernstein& a) { return difference(Bernstein(a.size(), Integer(0)), a); }

Bernstein slot(const QuadraticForm& row, Integer Form::*member, int sign) {
  return {sign * row[0].*member, sign * row[1].*member, sign * row[2].*member};
}

}  // namespace

std::vector<CornerValues> corner_values(const std::vector<QuadraticForm>& rows, int sign,
                                        const std::array<Form, 4>& corners) {
  std::vector<CornerValues> values(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (int c = 0; c < 4; ++c) {
      for (const Form& coefficient : rows[k]) values[k][c].push_back(sign * dot(coefficient, corners[c]));
    }
  }
  return values;
}

Bernstein side_cross(const CornerValues& a, const CornerValues& b, int i, int j) {
  return difference(product(a[i], b[j]), product(a[j], b[i]));
}

Bernstein minor(const QuadraticForm& a, const QuadraticForm& b) {
  return difference(product(slot(a, &Form::p, 1), slot(b, &Form::q, 1)),
                    product(slot(a, &Form::q, 1), slot(b, &Form::p, 1)));
}
Bernstein determinant(const QuadraticForm& a, const QuadraticForm& b, const QuadraticForm& c) {
  Bernstein sum = product(slot(a, &Form::one, -1), minor(b, c));
  sum = difference(sum, product(slot(b, &Form::one, 1), minor(c, a)));
  return negated(difference(sum, product(slot(c, &Form::one, 1), minor(a, b))));
}

namespace {

bool row_excludes(const CornerValues& a) { return std::all_of(a.begin(), a.end(), nowhere_positive); }

/// The size of a row, as an exponent of two.
long magnitude(const CornerValues& a) {
  unsigned bits = 0;
  for (const Bernstein& values : a)
    for (const Integer& value : values)
      if (!value.is_zero()) bits = std::max(bits, msb(abs(value)));
  return bits;
}
double scaled_down(const Integer& value, long bits) {
  long exponent = 0;
  const double fraction = mpz_get_d_2exp(&exponent, value.backend().data());
  return std::ldexp(fraction, static_cast<int>(std::max(exponent - bits, -2000L)));
}

/// sum y_k row_k is nowhere positive at the corners, for rows brought to one magnitude. Where y comes from does not
/// matter.
bool multipliers_exclude(const std::vector<const CornerValues*>& rows, const std::vector<double>& y) {
  std::vector<long> bits;
  for (const CornerValues* row : rows) bits.push_back(magnitude(*row));
  const long most = *std::max_element(bits.begin(), bits.end());
  bool any = false;
  std::vector<Integer> factor;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!(y[k] >= 0 && y[k] <= 1)) return false;
    factor.push_back(Integer(std::llround(y[k] * 0x1p40)) << static_cast<unsigned>(most - bits[k]));
    any |= !factor.back().is_zero();
  }
  for (int c = 0; any && c < 4; ++c) {
    for (int j = 0; j < 3; ++j) {
      Integer sum = 0;
      for (std::size_t k = 0; k < rows.size(); ++k) sum += factor[k] * (*rows[k])[c][j];
      if (sum.sign() > 0) return false;
    }
  }
  return any;
}

/// theta a + (1 - theta) b <= 0 for twelve coefficients: the middle of the interval of theta.
bool pair_excludes(const CornerValues& a, const CornerValues& b) {
  const long bits_a = magnitude(a), bits_b = magnitude(b);
  double low = 0, high = 1;
  for (int c = 0; c < 4; ++c) {
    for (int j = 0; j < 3; ++j) {
      const double x = scaled_down(a[c][j], bits_a), y = scaled_down(b[c][j], bits_b);
      if (x > 0 && y > 0) return false;
      if (x > 0) high = std::min(high, y / (y - x));
      if (y > 0) low = std::max(low, y / (y - x));
    }
  }
  const double theta = 0.5 * (low + high);
  return low <= high && multipliers_exclude({&a, &b}, {theta, 1 - theta});
}

struct Gradient {
  double p, q;
};
/// In the middle of the interval, in half sides of the box.
Gradient gradient(const CornerValues& a) {
  const long bits = magnitude(a);
  const auto middle = [&](int c) {
    return scaled_down(a[c][0], bits) + scaled_down(a[c][1], bits) + scaled_down(a[c][2], bits);
  };
  return {middle(1) - middle(0), middle(2) - middle(1)};
}
bool triple_excludes(const CornerValues& a, const CornerValues& b, const CornerValues& c) {
  const Gradient ga = gradient(a), gb = gradient(b), gc = gradient(c);
  double ya = gb.p * gc.q - gb.q * gc.p, yb = gc.p * ga.q - gc.q * ga.p, yc = ga.p * gb.q - ga.q * gb.p;
  if (ya < 0) ya = -ya, yb = -yb, yc = -yc;
  const double sum = ya + yb + yc;
  if (!(ya > 0 && yb > 0 && yc > 0)) return false;
  return multipliers_exclude({&a, &b, &c}, {ya / sum, yb / sum, yc / sum});
}

/// Not positive wherever sign * D is not negative. At a zero of D all rows of one slide are parallel, and D is a
/// factor.
bool not_positive_with(const Bernstein& value, const Bernstein& d, int sign) {
  if (nowhere_positive(value)) return true;
  if (sign_on_interval(d) != Sign::open) return false;
  const auto factor = quotient(value, d);
  return factor && nowhere_positive(sign > 0 ? *factor : negated(*factor));
}
/// The pair test of exact_posture.cpp with signs that hold on the interval; also where the two rows only just miss each
/// other all along.
bool pair_signs_exclude(const CornerValues& a, const CornerValues& b, const Bernstein& d, int sign) {
  std::array<bool, 4> not_a, not_b;
  for (int c = 0; c < 4; ++c) {
    not_a[c] = nowhere_positive(a[c]);
    not_b[c] = nowhere_positive(b[c]);
    if (!not_a[c] && !not_b[c]) return false;
  }
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    if ((not_a[i] && not_a[j]) || (not_b[i] && not_b[j])) continue;
    const bool a_at_i = not_b[i];  // then b is left at j
    if (!not_positive_with(a_at_i ? side_cross(a, b, i, j) : side_cross(a, b, j, i), d, sign)) return false;
  }
  return true;
}

/// y = (minor(b, c), minor(c, a), minor(a, b)) cancels the gradients whatever lambda is.
bool triple_signs_exclude(const QuadraticForm& a, const QuadraticForm& b, const QuadraticForm& c, int sign) {
  const std::array<Bernstein, 3> y{minor(b, c), minor(c, a), minor(a, b)};
  for (const int side : {1, -1}) {
    bool any = false, all = true;
    for (const Bernstein& factor : y) {
      const Sign found = sign_on_interval(factor);
      all &= static_cast<int>(found) == side || found == Sign::zero;
      any |= static_cast<int>(found) == side;
    }
    if (!any || !all) continue;
    const Bernstein constant = determinant(a, b, c);
    return nowhere_positive(side * sign > 0 ? constant : negated(constant));
  }
  return false;
}

bool empty_with_sign(const ModePiece& piece, int sign, const std::array<Form, 4>& corners) {
  const std::vector<CornerValues> at = corner_values(piece.rows, sign, corners);
  const std::size_t count = at.size();
  if (std::any_of(at.begin(), at.end(), row_excludes)) return true;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      if (pair_excludes(at[a], at[b]) || pair_signs_exclude(at[a], at[b], piece.d, sign)) return true;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      for (std::size_t c = b + 1; c < count; ++c)
        if (triple_excludes(at[a], at[b], at[c]) ||
            triple_signs_exclude(piece.rows[a], piece.rows[b], piece.rows[c], sign))
          return true;
  return false;
}

}  // namespace

bool proved_empty(const ModePiece& piece, const std::array<Form, 4>& corners) {
  const Sign d = sign_on_interval(piece.d);
  // D = 0 at an end of the interval belongs to both signs; feasibility with one sign is an open condition, so a point
  // where D > 0 next to it would be found there. Isolated zeros of D are looked at by PieceDecision::feasible.
  if (d == Sign::positive) return empty_with_sign(piece, 1, corners);
  if (d == Sign::negative) return empty_with_sign(piece, -1, corners);
  return empty_with_sign(piece, 1, corners) && empty_with_sign(piece, -1, corners);
}

}  // namespace surefoot::testing
