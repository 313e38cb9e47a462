// Polynomials of two local coordinates (sigma, tau), both in [-1, 1] on a rectangle, multiplied without loss: products
// of rows up to degree 6. Ranges on the rectangle are bounded by sums of coefficients.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "stability/region_poly.hpp"

namespace surefoot::stability {

/// a <= s <= b, lo <= t <= hi.
struct Rectangle {
  double a = 0, b = 0, lo = 0, hi = 0;
  double s() const { return 0.5 * (a + b); }
  double t() const { return 0.5 * (lo + hi); }
  double ds() const { return 0.5 * (b - a); }
  double dt() const { return 0.5 * (hi - lo); }
  double area() const { return (b - a) * (hi - lo); }
};

/// Sum of c[place(i, j)] sigma^i tau^j over i + j <= D.
template <int D>
struct Bivariate {
  static constexpr int size = (D + 1) * (D + 2) / 2;
  std::array<double, size> c{};
};
constexpr int place(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }

template <int A, int B>
Bivariate<A + B> operator*(const Bivariate<A>& f, const Bivariate<B>& g) {
  Bivariate<A + B> product;
  for (int n = 0; n <= A; ++n)
    for (int j = 0; j <= n; ++j) {
      const double factor = f.c[place(n - j, j)];
      for (int m = 0; m <= B; ++m)
        for (int l = 0; l <= m; ++l) product.c[place(n - j + m - l, j + l)] += factor * g.c[place(m - l, l)];
    }
  return product;
}
template <int D>
Bivariate<D> operator+(Bivariate<D> f, const Bivariate<D>& g) {
  for (int k = 0; k < f.size; ++k) f.c[k] += g.c[k];
  return f;
}
template <int D>
Bivariate<D> operator-(Bivariate<D> f, const Bivariate<D>& g) {
  for (int k = 0; k < f.size; ++k) f.c[k] -= g.c[k];
  return f;
}
template <int D>
Bivariate<D> operator*(Bivariate<D> f, double k) {
  for (double& c : f.c) c *= k;
  return f;
}

/// Greatest value on the rectangle, or more: even powers lie in [0, 1], others in [-1, 1].
template <int D>
double upper(const Bivariate<D>& f) {
  double sum = f.c[0];
  for (int n = 1; n <= D; ++n)
    for (int j = 0; j <= n; ++j) {
      const double c = f.c[place(n - j, j)];
      sum += (n % 2 == 0 && j % 2 == 0) ? std::max(c, 0.0) : std::abs(c);
    }
  return sum;
}
template <int D>
double lower(const Bivariate<D>& f) {
  double sum = f.c[0];
  for (int n = 1; n <= D; ++n)
    for (int j = 0; j <= n; ++j) {
      const double c = f.c[place(n - j, j)];
      sum -= (n % 2 == 0 && j % 2 == 0) ? std::max(-c, 0.0) : std::abs(c);
    }
  return sum;
}
template <int D>
double magnitude(const Bivariate<D>& f) {
  double sum = 0;
  for (const double c : f.c) sum += std::abs(c);
  return sum;
}

/// f in the local coordinates of a rectangle.
inline Bivariate<2> local(const Poly2& f, const Rectangle& r) {
  const Poly2 g = f.about(r.s(), r.t());
  const double ds = r.ds(), dt = r.dt();
  return {{g.c, g.s * ds, g.t * dt, g.ss * ds * ds, g.st * ds * dt, g.tt * dt * dt}};
}

/// Bounds the rounding error of local(f, r) and of f itself anywhere in the rectangle.
inline double local_error(const Poly2& f, const Rectangle& r) {
  constexpr double rounding = 1e-14;  // some thirty operations of 1e-16, with room
  const double s = std::max(std::abs(r.a), std::abs(r.b)), t = std::max(std::abs(r.lo), std::abs(r.hi));
  return rounding * (std::abs(f.c) + s * (std::abs(f.s) + s * std::abs(f.ss) + t * std::abs(f.st)) +
                     t * (std::abs(f.t) + t * std::abs(f.tt)));
}

/// A polynomial of degree 2, 4 or 6 behind one type.
struct CurvePolynomial {
  int degree = 0;
  Bivariate<6> f;    // coefficients beyond `degree` are not set
  double error = 0;  // of its values on the rectangle
  template <int D>
  static CurvePolynomial of(const Bivariate<D>& from, double error) {
    CurvePolynomial curve;
    curve.degree = D;
    std::copy(from.c.begin(), from.c.end(), curve.f.c.begin());
    curve.error = error;
    return curve;
  }
};

}  // namespace surefoot::stability
