// The frame of a posture as a function of the COM, and the rows of a mode under gravity alone.
#pragma once

#include <array>
#include <optional>

#include "stability/box_test.hpp"
#include "stability/posture.hpp"
#include "stability/region_poly.hpp"
#include "stability/rows.hpp"

namespace surefoot::stability {

/// The frame at the COM origin + s e_s + t e_t, as polynomials in (s, t).
inline Frame<Poly2> frame_around(const Posture& posture, const Eigen::Vector2d& origin, const Eigen::Vector2d& e_s,
                                 const Eigen::Vector2d& e_t) {
  const Frame<double> base = posture.frame(origin);
  Frame<Poly2> frame;
  frame.rho2 = base.rho2;
  frame.contacts = base.contacts;
  for (int i = 0; i < base.contacts; ++i) {
    const ContactTerms<double>& from = base.at[i];
    ContactTerms<Poly2>& to = frame.at[i];
    to.n = from.n, to.edge = from.edge, to.mu = from.mu;
    to.r = {Poly2(from.r.x, -e_s.x(), -e_t.x()), Poly2(from.r.y, -e_s.y(), -e_t.y())};
    to.nz = cross(to.r, to.n);
    for (int e : {edge_u, edge_w}) to.sz[e] = cross(to.r, to.edge[e]);
  }
  return frame;
}

/// The rows of a mode under gravity, p = q = 0: their middle slots. A sink of emit_rows.
template <class V>
struct GravityRows {
  std::array<V, max_rows> value;
  std::array<bool, max_rows> is_length{};
  int count = 0;
  std::optional<V> d;
  void denominator(const V& at) { d = at; }
  bool add(const Row<V>& row) {
    value[count++] = row.one;
    return false;
  }
  bool add_length(const Row<V>& row) {
    is_length[count] = true;
    return add(row);
  }
};

}  // namespace surefoot::stability
