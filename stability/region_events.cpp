// The sweep of region_sweep.hpp: where the order of curves changes.
#include "stability/region_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {
// insets: where an event is known but not yet over (curves that part slowly, two events at once)
constexpr double blurred = 64;
constexpr int deepest = 60;  // splits; each halves the slab at least every other time
}  // namespace

/// Where two curves meet, or one turns back (one == other), by Newton's method from (s, t); NaN if it does not settle.
double Sweep::meeting(const CurveId& one, const CurveId& other, double s, double t) const {
  constexpr int most_iterations = 12;
  const double scale = s_end_ - s_begin_;
  for (int k = 0; k < most_iterations; ++k) {
    const Poly2 f = modes_.curve(one, s, t);
    Poly2 g = modes_.curve(other, s, t);
    if (one == other) g = Poly2(f.t, f.st, 2 * f.tt);
    const double det = f.s * g.t - f.t * g.s;
    const double ds = (f.c * g.t - f.t * g.c) / det, dt = (f.s * g.c - f.c * g.s) / det;
    s -= ds, t -= dt;
    if (!std::isfinite(s) || !std::isfinite(t)) return NAN;
    if (std::abs(ds) + std::abs(dt) < 1e-13 * scale) return s;
  }
  return NAN;
}

/// What is left of two lists of crossings when what they have in common at both ends is taken away. Curves that run
/// together count as one.
struct Sweep::Difference {
  std::vector<Crossing> x, y;
  bool head = false, tail = false;  // something was taken away there
};

Sweep::Difference Sweep::difference(const SweepLine& at_a, const SweepLine& at_b) const {
  const auto &x = at_a.at, &y = at_b.at;
  const std::size_t shorter = std::min(x.size(), y.size());
  std::size_t head = 0, tail = 0;
  while (head < shorter && same_curve(x[head], y[head])) ++head;
  while (head + tail < shorter && same_curve(x[x.size() - 1 - tail], y[y.size() - 1 - tail])) ++tail;
  Difference left{{}, {}, head > 0, tail > 0};
  const auto collapse = [&](const SweepLine& line, std::vector<Crossing>& kept) {
    for (std::size_t k = head; k + tail < line.at.size(); ++k)
      if (k == head || line.at[k].t - line.at[k - 1].t >= closeness(line)) kept.push_back(line.at[k]);
  };
  collapse(at_a, left.x);
  collapse(at_b, left.y);
  return left;
}

/// The likely place of an event between two lines that differ; NaN if there is no good guess.
double Sweep::event(double a, const SweepLine& at_a, double b, const SweepLine& at_b) const {
  const Difference left = difference(at_a, at_b);
  const auto &x = left.x, &y = left.y;
  const double middle = 0.5 * (a + b);
  if (x.size() == 1 && y.size() == 1) return meeting(x[0].curve, y[0].curve, middle, 0.5 * (x[0].t + y[0].t));
  if (x.size() >= 2 && y.size() >= 2) {
    if (x[0].curve == y[0].curve) return meeting(x[1].curve, y[1].curve, middle, 0.5 * (x[1].t + y[1].t));
    return meeting(x[0].curve, x[1].curve, middle, 0.5 * (x[0].t + x[1].t));
  }
  const bool first = x.size() > y.size();
  const SweepLine& line = first ? at_a : at_b;
  const auto& more = first ? x : y;
  const double s = first ? a : b;
  if (more.size() >= 2) return meeting(more[0].curve, more[1].curve, s, 0.5 * (more[0].t + more[1].t));
  if (more.empty()) return NAN;
  const bool low = left.head == left.tail ? more[0].t - line.lo < line.hi - more[0].t : left.tail;
  const CurveId edge{CurveId::edge, -1, static_cast<std::int8_t>(low ? line.lo_edge : line.hi_edge), -1, -1, 0};
  return meeting(more[0].curve, edge, s, more[0].t);
}

/// Where the event is at an end of the slab but the line beside it does not show it yet: one a little further does.
bool Sweep::step_over(double a, const SweepLine& at_a, double b, const SweepLine& at_b, double guess, int depth) {
  const double step = blurred * inset_;
  if (b - a < 4 * step) return false;
  if (std::abs(guess - a) <= step) {
    const SweepLine beyond = solve(a + step);
    if (same(beyond, at_a)) return false;
    pass_over(a, a + step, at_a, beyond);
    refine(a + step, beyond, b, at_b, depth + 1);
    return true;
  }
  if (std::abs(guess - b) <= step) {
    const SweepLine before = solve(b - step);
    if (same(before, at_b)) return false;
    refine(a, at_a, b - step, before, depth + 1);
    pass_over(b - step, b, before, at_b);
    return true;
  }
  return false;
}

/// On degenerate ground one curve has several names (rows that vanish together): what is named differently on two lines
/// gets the name of the first where that curve runs through the same point of the second.
void Sweep::reconcile(const SweepLine& first, SweepLine& second) const {
  if (first.at.size() != second.at.size()) return;
  const double close = closeness(second);
  for (std::size_t k = 0; k < first.at.size(); ++k) {
    const Crossing& x = first.at[k];
    Crossing& y = second.at[k];
    if (x.curve == y.curve || x.curve.mode != y.curve.mode || x.enter != y.enter) continue;
    if (std::abs(polish(modes_, x.curve, second.s, y.t, close) - y.t) <= close) y.curve = x.curve;
  }
}

/// Slabs thinner than this are not looked into; on ground where curves coincide beyond what reconcile() sees through
/// the work is limited by looking less closely, which area_error shows.
double Sweep::thinnest() const {
  constexpr int many = 250;  // lines; typical: 100
  const double spent = effort();
  const double part = spent < many ? least_slab : spent < 2 * many ? 1e-5 : spent < 4 * many ? 1e-3 : 1;
  return part * (s_end_ - s_begin_);
}

void Sweep::refine(double a, const SweepLine& at_a, double b, const SweepLine& given_b, int depth) {
  if (b - a <= thinnest() || depth > deepest) return pass_over(a, b, at_a, given_b);
  SweepLine at_b = given_b;
  reconcile(at_a, at_b);
  double middle = 0.5 * (a + b);
  if (same(at_a, at_b)) {
    SweepLine at_m = solve(middle);
    reconcile(at_a, at_m);
    const bool force = b - a <= 64 * thinnest();
    if (same(at_a, at_m) && integrate(a, b, at_a, at_m, at_b, force)) return;
    refine(a, at_a, middle, at_m, depth + 1);
    refine(middle, at_m, b, at_b, depth + 1);
    return;
  }
  const double guess = event(a, at_a, b, at_b);
  if (guess > a + 4 * inset_ && guess < b - 4 * inset_) {
    const SweepLine before = solve(guess - inset_), after = solve(guess + inset_);
    refine(a, at_a, guess, before, depth + 1);
    refine(guess, after, b, at_b, depth + 1);
    return;
  }
  if (step_over(a, at_a, b, at_b, guess, depth)) return;
  const SweepLine at_m = solve(middle);
  refine(a, at_a, middle, at_m, depth + 1);
  refine(middle, at_m, b, at_b, depth + 1);
}

}  // namespace surefoot::stability
