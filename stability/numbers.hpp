// The number types on which the formulas of rows.hpp are evaluated.
//   double    a point, fast
//   Dyadic    a point, exact for the doubles given
//   Dual      a point, with the gradient in x
#pragma once

#include "stability/dyadic.hpp"

namespace surefoot::stability {

/// Value and gradient in (x, y): forward differentiation.
struct Dual {
  double value = 0, dx = 0, dy = 0;
  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants have no gradient
  Dual(double v, double gx, double gy) : value(v), dx(gx), dy(gy) {}

  friend Dual operator-(const Dual& a) { return {-a.value, -a.dx, -a.dy}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.dx + b.dx, a.dy + b.dy}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.dx - b.dx, a.dy - b.dy}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.dx * b.value + a.value * b.dx, a.dy * b.value + a.value * b.dy};
  }
};

/// The type of the constants that go with a variable type (normals, friction, radius of gyration).
template <class V>
struct ConstantOf {
  using type = double;
};
template <>
struct ConstantOf<Dyadic> {
  using type = Dyadic;
};
template <class V>
using Constant = typename ConstantOf<V>::type;

}  // namespace surefoot::stability
