#include "stability/region_line.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

constexpr int most_steps = 400;  // typical: 2 to 20

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
std::array<double, 3> bernstein(const Quadratic& given, double t, double length) {
  const Quadratic f = given.about(t);
  return {f.c0, f.c0 + 0.5 * f.c1 * length, f.c0 + length * (f.c1 + length * f.c2)};
}

using Bern = std::array<double, 3>;
Bern scaled(const Bern& f, double k) { return {f[0] * k, f[1] * k, f[2] * k}; }
bool positive(const Bern& f) { return f[0] > 0 && f[1] > 0 && f[2] > 0; }
/// a b + c d > 0 by the coefficients of degree 4.
bool positive(const Bern& a, const Bern& b, const Bern& c, const Bern& d) {
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
      const signed char basis[3] = {from.basis.a, from.basis.b, from.basis.c};
      double sum = 0;
      for (int k = 0; k < from.count; ++k) sum += from.y[k];
      for (int k = 0; k < from.count; ++k) y[basis[k]] = from.y[k] / sum;
    };
    spread(m, y0);
    spread(n, y1);
    for (const double u : {-1.0, 1.0})
      for (const double w : {-1.0, 1.0}) {
        Cubic f;
        for (int k = 0; k < count; ++k)
          if (y0[k] != 0 || y1[k] != 0)
            f.add((row[k].one + row[k].u * u + row[k].w * w) * -1, t, length, y0[k], y1[k]);
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

/// How far beyond t the mode stays infeasible by the multipliers of m.
double reach_of_multipliers(const LineRows& rows, double t, const Margin& m) {
  Form<Quadratic> sum;
  const signed char basis[3] = {m.basis.a, m.basis.b, m.basis.c};
  for (int k = 0; k < m.count; ++k) {
    const Form<Quadratic>& f = rows.row[basis[k]];
    sum = {sum.u + f.u * m.y[k], sum.one + f.one * m.y[k], sum.w + f.w * m.y[k]};
  }
  double reach = HUGE_VAL;
  for (const double u : {-1.0, 1.0})
    for (const double w : {-1.0, 1.0}) {
      const Quadratic at = (sum.one + sum.u * u + sum.w * w).about(t);
      reach = std::min(reach, at.c0 < 0 ? first_root(at) : 0);
    }
  return reach;
}

/// How far beyond t the wrench of m remains a witness.
double reach_of_witness(const LineRows& rows, double t, const Margin& m) {
  double reach = HUGE_VAL;
  for (int k = 0; k < rows.count; ++k) {
    const Form<Quadratic>& f = rows.row[k];
    const Quadratic at = (f.one + f.u * m.u + f.w * m.w).about(t) * -1;
    reach = std::min(reach, at.c0 < 0 ? first_root(at) : 0);
  }
  return reach;
}

/// One stretch of a line on which D keeps its sign.
class March {
 public:
  March(const RegionMode& mode, int index, double s, double sign, double step, LineSet& found)
      : rows_(mode, s, sign), index_(index), step_(step), found_(found) {}

  /// `begin` is the curve the stretch begins on: an interval that begins there is bounded by it.
  void run(double from, double to, bool was_feasible, const CurveId& begin) {
    double t = from, leap = 0.5 * (to - from);
    Margin m = rows_.margin_at(t);
    feasible_ = was_feasible;
    if ((m.value > 0) != feasible_) cross(from, begin);
    double stuck = 0;  // length of the blind step, doubled while the march does not get ahead
    for (int steps = 0; steps < most_steps; ++steps) {
      const double reach = m.value > 0 ? reach_of_witness(rows_, t, m) : reach_of_multipliers(rows_, t, m);
      const double end = t + reach;
      if (!(end < to)) return;
      if (reach < step_) {
        stuck = stuck == 0 ? step_ : 2 * stuck;
        t = end + stuck;
        if (!(t < to)) return;
      } else {
        stuck = 0;
        leap = std::min(std::max(leap, 3 * reach), 0.999 * (to - t));
        if (leap > 2 * reach && leaps(t, leap, m)) continue;
        t = end;
      }
      const Margin next = rows_.margin_at(t);
      if ((next.value > 0) != feasible_) cross(end, next.basis);
      m = next;
    }
    found_.uncertain = true;
  }

  bool feasible() const { return feasible_; }

 private:
  /// The mode starts or ends to be feasible at t. What came and went within one step is forgotten.
  void cross(double t, CurveId curve) {
    if (curve.kind != CurveId::denominator && curve.kind != CurveId::edge) curve.mode = static_cast<signed char>(index_);
    feasible_ = !feasible_;
    if (!found_.crossings.empty() && t - found_.crossings.back().t < 4 * step_)
      found_.crossings.pop_back();
    else
      found_.crossings.push_back({t, curve, feasible_});
  }

  /// Where one wrench or one set of multipliers does not last (two rows that are nearly opposite), one that moves on a
  /// straight line from its value at t to that at t + leap may: what has to keep its sign is then a cubic.
  bool leaps(double& t, double& leap, Margin& m) {
    const bool channel = m.basis.kind == CurveId::side && rows_.channel_between(t, leap, m);
    const Margin far = rows_.margin_at(t + leap);
    const bool holds = (far.value > 0) == (m.value > 0) &&
                       (channel || (m.value > 0 ? rows_.witnessed_between(t, leap, m, far)
                                                : rows_.excluded_between(t, leap, m, far)));
    if (holds) {
      t += leap;
      m = far;
    }
    leap *= holds ? 4 : 0.25;
    return holds;
  }

  LineRows rows_;
  int index_;
  double step_;
  LineSet& found_;
  bool feasible_ = false;
};

/// Roots of D inside the interval, ascending.
int sign_changes(const Quadratic& d, double from, double to, std::array<double, 2>& root) {
  int count = 0;
  const auto offer = [&](double t) {
    if (t > from && t < to) root[count++] = t;
  };
  if (d.c2 == 0) {
    if (d.c1 != 0) offer(-d.c0 / d.c1);
    return count;
  }
  const double half = 0.5 * d.c1, discriminant = half * half - d.c2 * d.c0;
  if (!(discriminant > 0)) return 0;
  const double far = -(half + std::copysign(std::sqrt(discriminant), half));
  const double one = far / d.c2, two = far != 0 ? d.c0 / far : 0;
  offer(std::min(one, two));
  offer(std::max(one, two));
  return count;
}

}  // namespace

void solve_line(const RegionMode& mode, int index, double s, double from, double to, LineSet& found) {
  found.at_begin = false;
  found.crossings.clear();
  found.uncertain = false;
  constexpr double rounding = 1e-13;  // of coordinates: how well a place on the line is known
  const double step = std::max(line_step * (to - from), rounding * (std::abs(s) + std::abs(from) + std::abs(to)));
  std::array<double, 2> root;
  const Quadratic d = mode.has_denominator ? on_line(mode.denominator, s) : Quadratic{1, 0, 0};
  const int changes = mode.has_denominator ? sign_changes(d, from, to, root) : 0;
  CurveId begin{CurveId::edge, -1, -1, -1, -1, 0};
  double t = from;
  bool feasible = false;
  for (int k = 0; k <= changes; ++k) {
    const double end = k < changes ? root[k] : to;
    const double middle = d.at(0.5 * (t + end));
    March march(mode, index, s, middle < 0 ? -1 : 1, step, found);
    // On D = 0 itself all that counts is the sign beyond: the stretch begins a step inside.
    march.run(k == 0 ? t : t + step, end, feasible, begin);
    feasible = march.feasible();
    begin = {CurveId::denominator, static_cast<signed char>(index), -1, -1, -1, 0};
    t = end;
  }
  // What was recorded at `from` is no crossing but the state there.
  if (!found.crossings.empty() && found.crossings.front().curve.kind == CurveId::edge) {
    found.at_begin = true;
    found.crossings.erase(found.crossings.begin());
  }
}

double polish(const RegionModes& modes, const CurveId& curve, double s, double t, double reach, double* slope) {
  Form<Quadratic> row[3];
  Quadratic line;
  const bool direct = curve.kind == CurveId::edge || curve.kind == CurveId::denominator;
  if (direct) {
    line = on_line(curve.kind == CurveId::edge ? modes.edges()[curve.a] : modes.modes()[curve.mode].denominator, s);
  } else {
    const signed char index[3] = {curve.a, curve.b, curve.c};
    for (int k = 0; k < 3 && index[k] >= 0; ++k) {
      const Form<Poly2>& f = modes.modes()[curve.mode].row[index[k]].form;
      row[k] = {on_line(f.u, s), on_line(f.one, s), on_line(f.w, s)};
    }
  }
  const auto value = [&](double at) {
    if (direct) return line.jet(at);
    return curve_value<Jet>(curve, [&](int k) {
      const Form<Quadratic>& f = row[k == curve.a ? 0 : k == curve.b ? 1 : 2];
      return Form<Jet>{f.u.jet(at), f.one.jet(at), f.w.jet(at)};
    });
  };
  const double start = t;
  constexpr int most_iterations = 12;  // quadratic convergence from a close start takes 2 to 4
  for (int k = 0; k < most_iterations; ++k) {
    const Jet f = value(t);
    if (slope != nullptr) *slope = f.d;
    if (f.v == 0) return t;
    const double move = f.v / f.d;
    t -= move;
    if (!(std::abs(t - start) <= reach)) return NAN;
    if (std::abs(move) <= 1e-14 * std::max(reach, std::abs(t))) return t;
  }
  return NAN;
}

}  // namespace surefoot::stability
