#include "stability/region_graph.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

constexpr int n = Graph::degree;
using Coefficients = std::array<double, n + 1>;

/// Product without terms of order above `order`.
Coefficients product(const Coefficients& a, const Coefficients& b, int order) {
  Coefficients c{};
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// Adds the part of f of power j in tau, a polynomial in sigma.
void add_power(const CurvePolynomial& f, int j, int order, Coefficients& to) {
  for (int i = 0; i <= std::min(f.degree - j, order); ++i) to[i] += f.f.c[place(i, j)];
}

Coefficients composed(const CurvePolynomial& f, const Coefficients& p, int order) {
  Coefficients value{};
  add_power(f, f.degree, order, value);
  for (int j = f.degree - 1; j >= 0; --j) {
    value = product(value, p, order);
    add_power(f, j, order, value);
  }
  return value;
}

double norm(const Coefficients& c) {
  double sum = 0;
  for (const double x : c) sum += std::abs(x);
  return sum;
}

/// Bounds |f(sigma, P(sigma))| on [-1, 1]: coefficients kept, and `rest` for those dropped.
double residual(const CurvePolynomial& f, const Coefficients& p) {
  const double size = norm(p);
  Coefficients value{};
  double rest = 0;
  add_power(f, f.degree, n, value);
  for (int j = f.degree - 1; j >= 0; --j) {
    double dropped = 0;
    for (int i = 1; i <= n; ++i) {
      double tail = 0;
      for (int k = n - i + 1; k <= n; ++k) tail += std::abs(p[k]);
      dropped += std::abs(value[i]) * tail;
    }
    rest = rest * size + dropped;
    value = product(value, p, n);
    add_power(f, j, n, value);
  }
  return norm(value) + rest;
}

bool straight(const CurvePolynomial& f) {
  return f.degree == 2 && f.f.c[place(2, 0)] == 0 && f.f.c[place(1, 1)] == 0 && f.f.c[place(0, 2)] == 0;
}

/// The root of f(0, tau) nearest to tau = 0 that Newton's method finds; NaN without one in reach.
double root_in_middle(const CurvePolynomial& f) {
  constexpr int most = 10;
  constexpr double reach = 4;
  if (straight(f)) return -f.f.c[place(0, 0)] / f.f.c[place(0, 1)];
  double tau = 0;
  for (int k = 0; k < most; ++k) {
    double value = 0, slope = 0;
    for (int j = f.degree; j >= 0; --j) {
      slope = slope * tau + value;
      value = value * tau + f.f.c[place(0, j)];
    }
    const double step = value / slope;
    tau -= step;
    if (!(std::abs(tau) <= reach)) return NAN;
    if (std::abs(step) < 1e-15) return tau;
  }
  return tau;
}

/// Sign and least size of df/dtau for |sigma| <= 1, |tau| <= reach; 0 if it may vanish.
double slope_bound(const CurvePolynomial& f, double reach) {
  const double middle = f.f.c[place(0, 1)];
  double rest = 0, power = 1;
  for (int j = 1; j <= f.degree; ++j, power *= reach)
    for (int i = 0; i <= f.degree - j; ++i) {
      const double c = j * f.f.c[place(i, j)] * power;
      if (i == 0 && j == 1) continue;
      const bool even = i % 2 == 0 && j % 2 == 1;
      rest += even && c * middle > 0 ? 0 : std::abs(c);
    }
  const double least = std::abs(middle) - rest;
  return least > 0 ? std::copysign(least, middle) : 0;
}

double size_within(const CurvePolynomial& f, double reach) {
  double sum = 0, power = 1;
  for (int j = 0; j <= f.degree; ++j, power *= reach)
    for (int i = 0; i <= f.degree - j; ++i) sum += std::abs(f.f.c[place(i, j)]) * power;
  return sum;
}

}  // namespace

CurvePolynomial swapped(const CurvePolynomial& curve) {
  CurvePolynomial other = curve;
  for (int i = 0; i <= curve.degree; ++i)
    for (int j = 0; i + j <= curve.degree; ++j) other.f.c[place(j, i)] = curve.f.c[place(i, j)];
  return other;
}

std::optional<Graph> graph_of(const CurvePolynomial& f) {
  if (slope_bound(f, 1) == 0) return std::nullopt;
  const double start = root_in_middle(f);
  if (!std::isfinite(start)) return std::nullopt;
  Graph graph;
  Coefficients& p = graph.p;
  p[0] = start;
  double slope = 0, power = 1;  // df/dtau at the start
  for (int j = 1; j <= f.degree; ++j, power *= start) slope += j * f.f.c[place(0, j)] * power;
  for (int order = 1; order <= n; ++order) {  // each step fixes one more coefficient
    const Coefficients rest = composed(f, p, order);
    for (int k = 0; k <= order; ++k) p[k] -= rest[k] / slope;
  }
  const double reach = std::max(1.0, norm(p));
  const double least = slope_bound(f, reach);
  if (least == 0) return std::nullopt;
  constexpr double rounding = 1e-14;
  graph.error = (residual(f, p) + f.error * reach + rounding * size_within(f, reach)) / std::abs(least);
  graph.rising = least > 0 ? 1 : -1;
  if (!std::isfinite(graph.error)) return std::nullopt;
  return graph;
}

}  // namespace surefoot::stability
