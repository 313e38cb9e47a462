#include "stability/region_graph.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

constexpr int n = Graph::degree;
using Coefficients = std::array<double, n + 1>;

/// A polynomial in sigma of degree `degree`; higher coefficients are zero.
struct Series {
  Coefficients c{};
  int degree = 0;
};

/// Product without terms of order above `order`.
Series product(const Series& a, const Series& b, int order) {
  Series c;
  c.degree = std::min(a.degree + b.degree, order);
  for (int i = 0; i <= a.degree; ++i)
    for (int j = 0, last = std::min(b.degree, order - i); j <= last; ++j) c.c[i + j] += a.c[i] * b.c[j];
  return c;
}

/// Adds the part of f of power j in tau, a polynomial in sigma.
void add_power(const CurvePolynomial& f, int j, int order, Series& to) {
  const int last = std::min(f.degree - j, order);
  for (int i = 0; i <= last; ++i) to.c[i] += f.f.c[place(i, j)];
  to.degree = std::max(to.degree, last);
}

Series composed(const CurvePolynomial& f, const Series& p, int order) {
  Series value;
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
double residual(const CurvePolynomial& f, const Series& p) {
  const double size = norm(p.c);
  Series value;
  double rest = 0;
  add_power(f, f.degree, n, value);
  for (int j = f.degree - 1; j >= 0; --j) {
    double dropped = 0, tail = 0;  // tail: of p, from order n - i + 1
    for (int i = n - p.degree + 1; i <= value.degree; ++i) {
      tail += std::abs(p.c[n - i + 1]);
      dropped += std::abs(value.c[i]) * tail;
    }
    rest = rest * size + dropped;
    value = product(value, p, n);
    add_power(f, j, n, value);
  }
  return norm(value.c) + rest;
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

bool may_be_graph(const CurvePolynomial& f) { return slope_bound(f, 1) != 0; }

std::optional<Graph> graph_of(const CurvePolynomial& f, double enough) {
  const double start = root_in_middle(f);
  if (!std::isfinite(start)) return std::nullopt;
  Series p;
  p.c[0] = start;
  double slope = 0, power = 1;  // df/dtau at the start
  for (int j = 1; j <= f.degree; ++j, power *= start) slope += j * f.f.c[place(0, j)] * power;
  const int last = straight(f) ? 1 : n;
  double before = HUGE_VAL;
  for (int order = 1; order <= last; ++order) {  // each step fixes one more coefficient
    const Series rest = composed(f, p, order);
    p.degree = order;
    for (int k = 0; k <= order; ++k) p.c[k] -= rest.c[k] / slope;
    const double now = std::abs(p.c[order]);
    if (now < enough && before * now < enough * enough && order > 1) break;
    before = now;
  }
  const double reach = std::max(1.0, norm(p.c));
  const double least = slope_bound(f, reach);
  if (least == 0) return std::nullopt;
  constexpr double rounding = 1e-14;
  Graph graph;
  graph.p = p.c;
  graph.error = (residual(f, p) + f.error * reach + rounding * size_within(f, reach)) / std::abs(least);
  graph.rising = least > 0 ? 1 : -1;
  if (!std::isfinite(graph.error)) return std::nullopt;
  return graph;
}

}  // namespace surefoot::stability
