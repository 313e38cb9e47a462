// Number types on which rows.hpp and the curves of a region are evaluated as functions of the COM.
//   Poly2  polynomial of degree <= 2 in two coordinates (s, t); products drop what is of higher degree, which is exact
//          for the rows (at most two factors of degree 1) and gives the Taylor jet of second order for products of rows
//   Jet    value and derivative along a line
#pragma once

#include <algorithm>
#include <cmath>

namespace surefoot::stability {

/// c + s S + t T + ss S^2 + st S T + tt T^2
struct Poly2 {
  double c = 0, s = 0, t = 0, ss = 0, st = 0, tt = 0;

  Poly2() = default;
  Poly2(double constant) : c(constant) {}  // NOLINT: a constant is a polynomial
  Poly2(double c0, double cs, double ct, double css = 0, double cst = 0, double ctt = 0)
      : c(c0), s(cs), t(ct), ss(css), st(cst), tt(ctt) {}

  double at(double S, double T) const { return c + S * (s + S * ss + T * st) + T * (t + T * tt); }
  /// The same polynomial about (S, T).
  Poly2 about(double S, double T) const {
    return {at(S, T), s + 2 * S * ss + T * st, t + S * st + 2 * T * tt, ss, st, tt};
  }
  double size() const {
    return std::max({std::abs(c), std::abs(s), std::abs(t), std::abs(ss), std::abs(st), std::abs(tt)});
  }

  friend Poly2 operator-(const Poly2& a) { return {-a.c, -a.s, -a.t, -a.ss, -a.st, -a.tt}; }
  friend Poly2 operator+(const Poly2& a, const Poly2& b) {
    return {a.c + b.c, a.s + b.s, a.t + b.t, a.ss + b.ss, a.st + b.st, a.tt + b.tt};
  }
  friend Poly2 operator-(const Poly2& a, const Poly2& b) {
    return {a.c - b.c, a.s - b.s, a.t - b.t, a.ss - b.ss, a.st - b.st, a.tt - b.tt};
  }
  friend Poly2 operator*(const Poly2& a, double k) { return {a.c * k, a.s * k, a.t * k, a.ss * k, a.st * k, a.tt * k}; }
  friend Poly2 operator*(double k, const Poly2& a) { return a * k; }
  friend Poly2 operator*(const Poly2& a, const Poly2& b) {
    return {a.c * b.c,
            a.c * b.s + a.s * b.c,
            a.c * b.t + a.t * b.c,
            a.c * b.ss + a.s * b.s + a.ss * b.c,
            a.c * b.st + a.s * b.t + a.t * b.s + a.st * b.c,
            a.c * b.tt + a.t * b.t + a.tt * b.c};
  }
};

/// Value and derivative.
struct Jet {
  double v = 0, d = 0;
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.v + b.v, a.d + b.d}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.v - b.v, a.d - b.d}; }
  friend Jet operator*(const Jet& a, double k) { return {a.v * k, a.d * k}; }
  friend Jet operator*(const Jet& a, const Jet& b) { return {a.v * b.v, a.v * b.d + a.d * b.v}; }
};

/// c0 + c1 T + c2 T^2: a row's slot on a line.
struct Quadratic {
  double c0 = 0, c1 = 0, c2 = 0;
  double at(double T) const { return c0 + T * (c1 + T * c2); }
  Jet jet(double T) const { return {at(T), c1 + 2 * T * c2}; }
  Quadratic about(double T) const { return {at(T), c1 + 2 * T * c2, c2}; }
  friend Quadratic operator+(const Quadratic& a, const Quadratic& b) { return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2}; }
  friend Quadratic operator*(const Quadratic& a, double k) { return {a.c0 * k, a.c1 * k, a.c2 * k}; }
};

/// At fixed S.
inline Quadratic on_line(const Poly2& f, double S) { return {f.c + S * (f.s + S * f.ss), f.t + S * f.st, f.tt}; }

/// The least T > 0 at which a quadratic that is negative at 0 vanishes; infinity if there is none.
inline double first_root(const Quadratic& f) {
  constexpr double never = HUGE_VAL;
  if (f.c2 == 0) return f.c1 > 0 ? -f.c0 / f.c1 : never;
  const double half = 0.5 * f.c1, discriminant = half * half - f.c2 * f.c0;
  if (f.c2 > 0) {  // opens upwards, negative at 0: the greater root
    const double root = std::sqrt(discriminant);
    return half <= 0 ? (root - half) / f.c2 : -f.c0 / (root + half);
  }
  if (discriminant < 0 || half <= 0) return never;  // opens downwards: the lesser root, if to the right
  return -f.c0 / (half + std::sqrt(discriminant));
}

}  // namespace surefoot::stability
