#include "stability/region_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stability/region_line_rows.hpp"

namespace surefoot::stability {
namespace {

constexpr int most_steps = 400;  // typical: 2 to 20

/// How far beyond t the mode stays infeasible by the multipliers of m.
double reach_of_multipliers(const LineRows& rows, double t, const Margin& m) {
  Form<Quadratic> sum;
  for (int k = 0; k < m.count; ++k) {
    const Form<Quadratic>& f = rows.row[m.basis.row(k)];
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
    for (int steps = 0; steps < most_steps; ++steps, ++found_.steps) {
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
    if (curve.kind != CurveId::denominator && curve.kind != CurveId::edge)
      curve.mode = static_cast<std::int8_t>(index_);
    feasible_ = !feasible_;
    if (!found_.crossings.empty() && t - found_.crossings.back().t < 4 * step_) found_.crossings.pop_back();
    else found_.crossings.push_back({t, curve, feasible_});
  }

  /// Where one wrench or one set of multipliers does not last (two rows that are nearly opposite), one that moves on a
  /// straight line from its value at t to that at t + leap may: what has to keep its sign is then a cubic.
  bool leaps(double& t, double& leap, Margin& m) {
    const bool channel = m.basis.kind == CurveId::side && rows_.channel_between(t, leap, m);
    const Margin far = rows_.margin_at(t + leap);
    const bool holds =
        (far.value > 0) == (m.value > 0) &&
        (channel || (m.value > 0 ? rows_.witnessed_between(t, leap, m, far) : rows_.excluded_between(t, leap, m, far)));
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
  found.steps = 0;
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
    begin = {CurveId::denominator, static_cast<std::int8_t>(index), -1, -1, -1, 0};
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
    for (int k = 0; k < 3 && curve.row(k) >= 0; ++k) {
      const Form<Poly2>& f = modes.modes()[curve.mode].row[curve.row(k)].form;
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
