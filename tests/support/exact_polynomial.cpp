#include "tests/support/exact_polynomial.hpp"

#include <algorithm>

namespace surefoot::testing {
namespace {

using Powers = std::vector<Integer>;  // sum c_k t^k, no leading zeros

void trim(Powers& p) {
  while (!p.empty() && p.back().is_zero()) p.pop_back();
}

void divide_by_content(Powers& p) {
  Integer content = 0;
  for (const Integer& c : p) content = gcd(content, c);
  if (content > 1)
    for (Integer& c : p) c /= content;
}

Powers powers(const Bernstein& b) {
  const std::size_t degree = b.size() - 1;
  Powers sum(b.size(), Integer(0));
  for (std::size_t k = 0; k <= degree; ++k) {
    Integer binomial = b[k];  // b_k t^k (1 - t)^(degree - k)
    for (std::size_t m = 0; k + m <= degree; ++m) {
      sum[k + m] += m % 2 == 0 ? binomial : Integer(-binomial);
      binomial = binomial * (degree - k - m) / (m + 1);
    }
  }
  trim(sum);
  divide_by_content(sum);
  return sum;
}

Powers derivative(const Powers& p) {
  Powers d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * k);
  return d;
}

/// a modulo b times a positive number.
Powers remainder(Powers a, const Powers& b) {
  const Integer lead = b.back(), size = abs(lead);
  while (a.size() >= b.size()) {
    const Integer top = lead.sign() > 0 ? a.back() : Integer(-a.back());
    const std::size_t shift = a.size() - b.size();
    for (Integer& c : a) c *= size;
    for (std::size_t k = 0; k < b.size(); ++k) a[k + shift] -= top * b[k];
    trim(a);
  }
  divide_by_content(a);
  return a;
}

/// a / b up to a positive factor; a is left with the remainder.
Powers divided(Powers& a, const Powers& b) {
  Powers result(a.size() - b.size() + 1, Integer(0));
  const Integer lead = b.back(), size = abs(lead);
  while (a.size() >= b.size()) {
    const Integer top = lead.sign() > 0 ? a.back() : Integer(-a.back());
    const std::size_t shift = a.size() - b.size();
    for (Integer& c : a) c *= size;
    for (Integer& c : result) c *= size;
    result[shift] += top;
    for (std::size_t k = 0; k < b.size(); ++k) a[k + shift] -= top * b[k];
    trim(a);
  }
  divide_by_content(result);
  return result;
}

std::vector<Powers> sturm_chain(const Powers& p) {
  std::vector<Powers> chain{p, derivative(p)};
  while (chain.back().size() > 1) {
    Powers next = remainder(chain[chain.size() - 2], chain.back());
    if (next.empty()) break;
    for (Integer& c : next) c = -c;
    chain.push_back(next);
  }
  return chain;
}

/// The same roots, each simple.
Powers square_free(const Powers& p) {
  const std::vector<Powers> chain = sturm_chain(p);  // ends with gcd(p, p')
  Powers rest = p;
  return chain.back().size() > 1 ? divided(rest, chain.back()) : p;
}

int sign_at(const Powers& p, const DyadicPoint& at) {
  Integer value = 0, scale = 1;
  for (std::size_t k = p.size(); k-- > 0;) {
    value = value * at.numerator + p[k] * scale;
    scale <<= at.exponent;
  }
  return value.sign();
}

int variations(const std::vector<Powers>& chain, const DyadicPoint& at) {
  int count = 0, last = 0;
  for (const Powers& p : chain) {
    const int sign = sign_at(p, at);
    if (sign * last < 0) ++count;
    if (sign != 0) last = sign;
  }
  return count;
}

DyadicPoint middle(const DyadicPoint& a, const DyadicPoint& b) { return {a.numerator + b.numerator, a.exponent + 1}; }
void refine_exponent(DyadicPoint& p) {
  p.numerator <<= 1;
  ++p.exponent;
}

struct Isolator {
  Powers polynomial;
  std::vector<Powers> chain;
  int bits;
  std::vector<std::array<DyadicPoint, 2>> found;

  /// Roots in (a, b]; both have the same exponent.
  void search(DyadicPoint a, DyadicPoint b) {
    const int count = variations(chain, a) - variations(chain, b);
    if (count == 0) return;
    if (count == 1) return narrow(a, b);
    const DyadicPoint m = middle(a, b);
    refine_exponent(a), refine_exponent(b);
    search(a, m);
    search(m, b);
  }
  void narrow(DyadicPoint a, DyadicPoint b) {
    // One simple root in (a, b]: the sign changes there, and at b it is that beyond the root, or zero.
    int beyond = sign_at(polynomial, b);
    while (a.exponent < bits) {
      const DyadicPoint m = middle(a, b);
      refine_exponent(a), refine_exponent(b);
      const int sign = sign_at(polynomial, m);
      const bool root_before = beyond != 0 ? sign == 0 || sign == beyond : sign == 0;
      if (root_before) {
        b = m;
        beyond = sign;
      } else {
        a = m;
      }
    }
    found.push_back({a, b});
  }
};

}  // namespace

Bernstein product(const Bernstein& a, const Bernstein& b) {
  Bernstein result(a.size() + b.size() - 1, Integer(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] += a[i] * b[j];
  return result;
}

Bernstein difference(const Bernstein& a, const Bernstein& b) {
  Bernstein result = a;
  for (std::size_t k = 0; k < b.size(); ++k) result[k] -= b[k];
  return result;
}

/// In x = t / (1 - t) the coefficients are those of an ordinary polynomial.
std::optional<Bernstein> quotient(const Bernstein& a, const Bernstein& b) {
  if (b.back().is_zero()) return std::nullopt;
  Powers rest = a;
  trim(rest);
  if (rest.size() < b.size()) return std::nullopt;
  Bernstein result = divided(rest, b);
  if (!rest.empty()) return std::nullopt;
  result.resize(a.size() - b.size() + 1, Integer(0));
  return result;
}

Sign sign_on_interval(const Bernstein& polynomial) {
  bool positive = false, negative = false;
  for (const Integer& c : polynomial) {
    positive |= c.sign() > 0;
    negative |= c.sign() < 0;
  }
  if (positive && negative) return Sign::open;
  return positive ? Sign::positive : negative ? Sign::negative : Sign::zero;
}

bool nowhere_positive(const Bernstein& polynomial) {
  return std::all_of(polynomial.begin(), polynomial.end(), [](const Integer& c) { return c.sign() <= 0; });
}

std::vector<std::array<DyadicPoint, 2>> isolated_roots(const Bernstein& polynomial, int bits) {
  const Powers p = powers(polynomial);
  if (p.size() < 2) return {};
  const Powers simple = square_free(p);
  Isolator isolator{simple, sturm_chain(simple), bits, {}};
  isolator.search({Integer(0), 0}, {Integer(1), 0});
  return isolator.found;
}

}  // namespace surefoot::testing
