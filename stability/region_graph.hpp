// A curve in a rectangle as the graph of a polynomial, with a proved bound of its distance.
//
// In local coordinates the curve f(sigma, tau) = 0 is a graph tau(sigma) where df/dtau keeps its sign. Its Taylor
// polynomial P follows from f by fixed-point iteration on power series. With |f(sigma, P(sigma))| <= r and |df/dtau| >=
// m wherever |tau| <= max(1, max |P|), the mean value theorem gives |tau - P| <= r / m; r is a bound of the composed
// polynomial that counts every term that was dropped.
#pragma once

#include <array>
#include <optional>

#include "stability/region_bivariate.hpp"

namespace surefoot::stability {

struct Graph {
  static constexpr int degree = 8;
  std::array<double, degree + 1> p{};
  double error = 0;  ///< bounds |tau - P(sigma)| for sigma in [-1, 1], where one of both lies in [-1, 1]
  int rising = 1;    ///< sign of df/dtau
  double at(double sigma) const {
    double value = 0;
    for (int k = degree; k >= 0; --k) value = value * sigma + p[k];
    return value;
  }
};

/// sigma and tau exchanged.
CurvePolynomial swapped(const CurvePolynomial& curve);

/// False where graph_of would find none.
bool may_be_graph(const CurvePolynomial& curve);

/// None where the curve is not shown to be a graph over all of [-1, 1]; may_be_graph is known. Terms of the series are
/// left out once they fall below `enough`.
std::optional<Graph> graph_of(const CurvePolynomial& curve, double enough);

}  // namespace surefoot::stability
