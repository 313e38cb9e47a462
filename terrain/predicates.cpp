#include "terrain/predicates.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace surefoot::terrain {
namespace {

using Eigen::Vector2d;

constexpr double unit_roundoff = 0x1p-53;
// Each factor is a rounded difference (1 + d), each product and their difference are rounded once more:
// |error| <= (3u + O(u^2)) (|l| + |r|), the bound of Shewchuk (1997) with the rounding of the bound itself included.
constexpr double filter_relative = (3.0 + 16.0 * unit_roundoff) * unit_roundoff;
// A product that underflows is off by at most half the least subnormal; the least normal number is ample.
constexpr double filter_absolute = std::numeric_limits<double>::min();
// Expansions are exact while no product of two parts in this range overflows or has a bit below the least subnormal:
// products lie in [2^-900, 2^1000] and are multiples of 2^(-900 - 104).
constexpr double expansion_least = 0x1p-450;
constexpr double expansion_greatest = 0x1p+500;

int sign_of(double value) { return (value > 0) - (value < 0); }

struct Pair {
  double high, low;  // high + low is the exact result
};

Pair two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

Pair two_product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

/// A nonoverlapping expansion, increasing in magnitude, that doubles are added to without error (Shewchuk's
/// GROW-EXPANSION). Its sign is that of its largest nonzero component.
class ExactSum {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Pair sum = two_sum(value, parts_[i]);
      value = sum.high;
      if (sum.low != 0) parts_[kept++] = sum.low;
    }
    if (value != 0) parts_[kept++] = value;
    size_ = kept;
  }
  int sign() const { return size_ == 0 ? 0 : sign_of(parts_[size_ - 1]); }

 private:
  std::array<double, 17> parts_{};  // at most one per double added
  std::size_t size_ = 0;
};

/// Adds the product of two exact differences.
void add_product(ExactSum& sum, Pair u, Pair v, double factor) {
  for (const double a : {u.low, u.high}) {
    for (const double b : {v.low, v.high}) {
      if (a == 0 || b == 0) continue;
      const Pair product = two_product(factor * a, b);
      sum.add(product.low);
      sum.add(product.high);
    }
  }
}

Pair difference(double a, double b) { return two_sum(a, -b); }

bool expansion_is_exact(const std::array<Pair, 4>& differences) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Pair& d : differences) {
    for (const double part : {std::abs(d.high), std::abs(d.low)}) {
      if (part != 0) least = std::min(least, part);
      greatest = std::max(greatest, part);
    }
  }
  return least >= expansion_least && greatest <= expansion_greatest;
}

int rational_sign(const Vector2d& a0, const Vector2d& a1, const Vector2d& b0, const Vector2d& b1) {
  using Rational = boost::multiprecision::cpp_rational;
  const auto exact = [](double a, double b) { return Rational(Rational(a) - Rational(b)); };
  const Rational left = exact(a1.x(), a0.x()) * exact(b1.y(), b0.y());
  const Rational right = exact(a1.y(), a0.y()) * exact(b1.x(), b0.x());
  return left.compare(right);
}

}  // namespace

int detail::cross_sign(const Vector2d& a0, const Vector2d& a1, const Vector2d& b0, const Vector2d& b1,
                       Precision& decided_by) {
  const double ax = a1.x() - a0.x(), ay = a1.y() - a0.y();
  const double bx = b1.x() - b0.x(), by = b1.y() - b0.y();
  // A rounded difference has the sign of the exact one, so the signs of both products are known.
  const int left_sign = sign_of(ax) * sign_of(by), right_sign = sign_of(ay) * sign_of(bx);
  decided_by = Precision::factor_signs;
  if (left_sign != right_sign) return left_sign > right_sign ? 1 : -1;
  if (left_sign == 0) return 0;

  const double left = ax * by, right = ay * bx;
  const double det = left - right;
  const double bound = filter_relative * (std::abs(left) + std::abs(right)) + filter_absolute;
  decided_by = Precision::filter;
  if (std::isfinite(bound) && std::abs(det) > bound) return sign_of(det);

  decided_by = Precision::expansion;
  const std::array<Pair, 4> d{difference(a1.x(), a0.x()), difference(a1.y(), a0.y()), difference(b1.x(), b0.x()),
                              difference(b1.y(), b0.y())};
  if (expansion_is_exact(d)) {
    ExactSum sum;
    add_product(sum, d[0], d[3], 1);
    add_product(sum, d[1], d[2], -1);
    return sum.sign();
  }
  decided_by = Precision::rational;
  const int sign = rational_sign(a0, a1, b0, b1);
  return (sign > 0) - (sign < 0);
}

int cross_sign(const Vector2d& a0, const Vector2d& a1, const Vector2d& b0, const Vector2d& b1) {
  detail::Precision decided_by;
  return detail::cross_sign(a0, a1, b0, b1, decided_by);
}

bool segments_meet(const Vector2d& p, const Vector2d& q, const Vector2d& a, const Vector2d& b) {
  // Segments whose bounding boxes meet have a common point iff neither lies strictly on one side of the other's
  // line. (On one common line, and for single points, the boxes alone decide.)
  if (std::max(p.x(), q.x()) < std::min(a.x(), b.x()) || std::max(a.x(), b.x()) < std::min(p.x(), q.x()) ||
      std::max(p.y(), q.y()) < std::min(a.y(), b.y()) || std::max(a.y(), b.y()) < std::min(p.y(), q.y())) {
    return false;
  }
  return orientation(a, b, p) * orientation(a, b, q) <= 0 && orientation(p, q, a) * orientation(p, q, b) <= 0;
}

}  // namespace surefoot::terrain
