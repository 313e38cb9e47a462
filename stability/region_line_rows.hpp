// A mode's rows along a straight line of COMs, and what holds on a stretch of it by Bernstein coefficients.
#pragma once

#include <array>
#include <cmath>

#include "stability/region_margin.hpp"

namespace surefoot::stability {

/// A cubic on [t, t + length] by its Bernstein coefficients.
struct Cubic {
  double c[4] = {0, 0, 0, 0};
  /// Adds f times the linear function with values l0 and l1 at the ends.
  void add(const Quadratic& given, double t, double length, double l0, double l1) {
    const Quadratic f = given.about(t);
    const double b0 = f.c0, b1 = f.c0 + 0.5 * f.c1 * length, b2 = f.c0 + length * (f.c1 + length * f.c2);
    c[0] += b0 * l0;
    c[1] += (2 * b1 * l0 + b0 * l1) / 3;
    c[2] += (b2 * l0 + 2 * b1 * l1) / 3;
    c[3] += b2 * l1;
  }
  bool positive() const { return c[0] > 0 && c[1] > 0 && c[2] > 0 && c[3] > 0; }
};

/// Bernstein coefficients of a quadratic on [t, t + length].
inline std::array<double, 3> bernstein(const Quadratic& given, double t, double length) {
  const Quadratic f = given.about(t);
  return {f.c0, f.c0 + 0.5 * f.c1 * length, f.c0 + length * (f.c1 + length * f.c2)};
}

using Bern = std::array<double, 3>;
inline Bern scaled(const Bern& f, double k) { return {f[0] * k, f[1] * k, f[2] * k}; }
inline bool positive(const Bern& f) { return f[0] > 0 && f[1] > 0 && f[2] > 0; }
/// a b + c d > 0 by the coefficients of degree 4.
inline bool positive(const Bern& a, const Bern& b, const Bern& c, const Bern& d) {
  const auto coefficient = [](const Bern& f, const Bern& g, int k) {
    switch (k) {
      case 0: return f[0] * g[0];
      case 1: return (f[0] * g[1] + f[1] * g[0]) / 2;
      case 2: return (f[0] * g[2] + 4 * f[1] * g[1] + f[2] * g[0]) / 6;
      case 3: return (f[1] * g[2] + f[2] * g[1]) / 2;
      default: return f[2] * g[2];
    }
  };
  for (int k = 0; k <= 4; ++k)
    if (!(coefficient(a, b, k) + coefficient(c, d, k) > 0)) return false;
  return true;
}

/// A mode's rows on a line, with the sign of D applied.
struct LineRows {
  std::array<Form<Quadratic>, 6> row;
  int count = 0;

  LineRows(const RegionMode& mode, double s, double sign) : count(mode.count) {
    for (int k = 0; k < count; ++k) {
      const Form<Poly2>& f = mode.row[k].form;
      row[k] = {on_line(f.u, s) * sign, on_line(f.one, s) * sign, on_line(f.w, s) * sign};
    }
  }
  /// One witness for all of [t, t + length] that moves on a straight line from that of m to that of n.
  bool witnessed_between(double t, double length, const Margin& m, const Margin& n) const {
    for (int k = 0; k < count; ++k) {
      Cubic f;
      f.add(row[k].one, t, length, 1, 1);
      f.add(row[k].u, t, length, m.u, n.u);
      f.add(row[k].w, t, length, m.w, n.w);
      if (!f.positive()) return false;
    }
    return true;
  }
  /// Multipliers likewise: their combination is negative at the corners of the box.
  bool excluded_between(double t, double length, const Margin& m, const Margin& n) const {
    std::array<double, 6> y0{}, y1{};
    const auto spread = [](const Margin& from, std::array<double, 6>& y) {
      double sum = 0;
      for (int k = 0; k < from.count; ++k) sum += from.y[k];
      for (int k = 0; k < from.count; ++k) y[from.basis.row(k)] = from.y[k] / sum;
    };
    spread(m, y0);
    spread(n, y1);
    for (const double u : {-1.0, 1.0})
      for (const double w : {-1.0, 1.0}) {
        Cubic f;
        for (int k = 0; k < count; ++k)
          if (y0[k] != 0 || y1[k] != 0) f.add((row[k].one + row[k].u * u + row[k].w * w) * -1, t, length, y0[k], y1[k]);
        if (!f.positive()) return false;
      }
    return true;
  }
  /// On a side of the box a row is e + f w, w the free coordinate. Two rows that leave a narrow channel for w:
  ///   feasible   at the edge w = -e_i / f_i of the channel all other rows are positive (f_i e_l - e_i f_l > 0 for f_i
  ///   > 0), and
  ///              |w| < 1; a little inwards row i is positive too
  ///   excluded   |f_j| row_i + |f_i| row_j does not depend on w and is negative at this side and at the opposite one
  /// Polynomials of degree 4, wherever the channel leads.
  bool channel_between(double t, double length, const Margin& m) const {
    const double end = m.basis.place & 1 ? 1 : -1;
    const bool free_w = m.basis.place < 2;
    std::array<Bern, 6> e, f, opposite;
    for (int k = 0; k < count; ++k) {
      const Quadratic &fixed = free_w ? row[k].u : row[k].w, &free = free_w ? row[k].w : row[k].u;
      e[k] = bernstein(row[k].one + fixed * end, t, length);
      opposite[k] = bernstein(row[k].one + fixed * -end, t, length);
      f[k] = bernstein(free, t, length);
    }
    const int a = m.basis.a, b = m.basis.b;
    const double sa = f[a][0] < 0 ? -1 : 1, sb = f[b][0] < 0 ? -1 : 1;
    if (sa == sb || !positive(scaled(f[a], sa)) || !positive(scaled(f[b], sb))) return false;
    if (!(m.value > 0)) {
      const Bern fa = scaled(f[a], -sa), fb = scaled(f[b], -sb);  // -|f|
      return positive(fb, e[a], fa, e[b]) && positive(fb, opposite[a], fa, opposite[b]);
    }
    const auto at_edge = [&](int i, double sign) {
      const Bern fi = scaled(f[i], sign), ei = scaled(e[i], -sign);
      const Bern low{fi[0] - e[i][0], fi[1] - e[i][1], fi[2] - e[i][2]};
      const Bern high{fi[0] + e[i][0], fi[1] + e[i][1], fi[2] + e[i][2]};
      if (!positive(low) || !positive(high)) return false;
      for (int l = 0; l < count; ++l)
        if (l != i && !positive(fi, e[l], ei, f[l])) return false;
      return true;
    };
    return at_edge(a, sa) || at_edge(b, sb);
  }
  Margin margin_at(double t) const {
    std::array<Form<double>, 6> g;
    for (int k = 0; k < count; ++k) g[k] = {row[k].u.at(t), row[k].one.at(t), row[k].w.at(t)};
    return margin(g.data(), count);
  }
};

}  // namespace surefoot::stability
