// Planar vectors over any number type: doubles, exact numbers, dual numbers.
// One formulation of every formula serves all of them.
#pragma once

namespace surefoot::stability {

template <class V>
struct Vec2 {
  V x, y;
};

template <class A, class B>
auto dot(const Vec2<A>& a, const Vec2<B>& b) {
  return a.x * b.x + a.y * b.y;
}
/// a_x b_y - a_y b_x, counter-clockwise positive.
template <class A, class B>
auto cross(const Vec2<A>& a, const Vec2<B>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class V>
Vec2<V> operator-(const Vec2<V>& a, const Vec2<V>& b) {
  return {a.x - b.x, a.y - b.y};
}

/// A linear form in v = (p, 1, q), the homogeneous disturbance: value = p * row.p + row.one + q * row.q.
/// Wrenches and twists in the COM frame use the same three slots (x, y, moment).
template <class V>
struct Row {
  V p, one, q;
};

template <class V>
Row<V> operator-(const Row<V>& a) {
  return {-a.p, -a.one, -a.q};
}
/// The ordinary cross product of two triples.
template <class A, class B>
auto cross(const Row<A>& a, const Row<B>& b) {
  using V = decltype(a.p * b.p);
  return Row<V>{a.one * b.q - a.q * b.one, a.q * b.p - a.p * b.q, a.p * b.one - a.one * b.p};
}
template <class A, class B>
auto dot(const Row<A>& a, const Row<B>& b) {
  return a.p * b.p + a.one * b.one + a.q * b.q;
}
template <class V, class K>
V value_at(const Row<V>& row, const K& p, const K& q) {
  return row.p * p + row.one + row.q * q;
}

}  // namespace surefoot::stability
