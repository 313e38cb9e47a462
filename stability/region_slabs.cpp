// The sweep of region_sweep.hpp: integrals and points of curves between two events.
#include "stability/region_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {

/// Rule of Gauss and Kronrod with 7 and 15 nodes on [-1, 1]: nodes >= 0 ascending from the middle.
struct Node {
  double at, kronrod, gauss;
};
constexpr std::array<Node, 8> rule{
    {{0.000000000000000000000000000000000, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327},
     {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0},
     {0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.381830050505118944950369775488975},
     {0.586087235467691130294144691693013, 0.169004726639267902826583426598550, 0},
     {0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.279705391489276667901467771423780},
     {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0},
     {0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.129484966168869693270611432679082},
     {0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0}}};

/// s = a + (b - a) share(u): removes the square roots that curves have where they turn back at the end of a slab.
double share(double u) { return u * u * (3 - 2 * u); }
double share_slope(double u) { return 6 * u * (1 - u); }

}  // namespace

Slab Sweep::make_slab(double a, double b, const SweepLine& at_a, const SweepLine& at_m, const SweepLine& at_b) const {
  Slab slab;
  slab.a = a, slab.b = b, slab.lo_edge = at_m.lo_edge, slab.hi_edge = at_m.hi_edge;
  slab.curves = at_m.at;
  const auto all = [](const SweepLine& line) {
    std::vector<double> t{line.lo};
    for (const Crossing& crossing : line.at) t.push_back(crossing.t);
    t.push_back(line.hi);
    return t;
  };
  slab.at_a = all(at_a), slab.at_m = all(at_m), slab.at_b = all(at_b);
  std::uint32_t present = at_m.begin_modes;
  slab.modes.push_back(present);
  for (const Crossing& crossing : at_m.at) {
    present ^= 1u << crossing.curve.mode;
    slab.modes.push_back(present);
  }
  slab.integral.assign(slab.at_m.size(), 0);
  for (const Crossing& crossing : at_m.at) {
    double slope = 0;
    polish(modes_, crossing.curve, at_m.s, crossing.t, at_m.hi - at_m.lo, &slope);
    slab.slope.push_back(slope);
  }
  return slab;
}

/// t of all curves of a slab at s = a + (b - a) share(u), by Newton's method from the three lines known; false where
/// that does not keep the order of curves.
bool Sweep::curve_points(const Slab& slab, double s, double u, std::vector<double>& t) const {
  SweepLine line;
  if (!chord(s, line)) return false;
  const double low = (1 - u) * (1 - 2 * u), middle = 4 * u * (1 - u), high = u * (2 * u - 1);
  const double length = line.hi - line.lo, close = closeness(line);
  t.resize(slab.at_m.size());
  t.front() = line.lo;
  t.back() = line.hi;
  for (std::size_t k = 1; k + 1 < t.size(); ++k) {
    const double guess = low * slab.at_a[k] + middle * slab.at_m[k] + high * slab.at_b[k];
    double slope = 0;
    t[k] = polish(modes_, slab.curves[k - 1].curve, s, guess, length, &slope);
    if (!(t[k] >= t[k - 1] - close && t[k] <= line.hi + close) || slope * slab.slope[k - 1] < 0) return false;
  }
  return true;
}

bool Sweep::integrate(double a, double b, const SweepLine& at_a, const SweepLine& at_m, const SweepLine& at_b,
                      bool force) {
  Slab slab = make_slab(a, b, at_a, at_m, at_b);
  const std::size_t n = slab.at_m.size();
  std::vector<double> gauss(n, 0), t;
  bool known = true;
  const auto visit = [&](double x, const Node& node) {
    const double u = 0.5 * (1 + x), weight = 0.5 * (b - a) * share_slope(u);
    const double s = a + (b - a) * share(u);
    if (!curve_points(slab, s, u, t)) {
      SweepLine line = solve(s);
      reconcile(at_m, line);
      known &= same(line, at_m);
      if (!known) return;
      t.assign(1, line.lo);
      for (const Crossing& crossing : line.at) t.push_back(crossing.t);
      t.push_back(line.hi);
    }
    for (std::size_t k = 0; k < n; ++k) {
      slab.integral[k] += weight * node.kronrod * t[k];
      gauss[k] += weight * node.gauss * t[k];
    }
  };
  for (std::size_t i = 0; i < rule.size() && known; ++i) {
    visit(rule[i].at, rule[i]);
    if (rule[i].at > 0 && known) visit(-rule[i].at, rule[i]);
  }
  if (!known && !force) return false;
  if (!known) {
    pass_over(a, b, at_a, at_b);
    return true;
  }
  double error = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    // QUADPACK's estimate: the Kronrod rule is far better than the difference of the two.
    const double difference = std::abs(slab.integral[k] - gauss[k]), scale = (b - a) * (at_m.hi - at_m.lo);
    error += std::min(difference, scale * std::pow(200 * difference / scale, 1.5));
  }
  const double allowed = tolerance_ * area_ * std::max((b - a) / (s_end_ - s_begin_), 1e-3);
  if (error > 0.1 * allowed && !force) return false;
  error_ += error;
  slabs_.push_back(std::move(slab));
  return true;
}

/// A slab too thin to look into is taken as on one of its lines; by how much the lengths of its pieces differ on the
/// other is the error.
void Sweep::pass_over(double a, double b, const SweepLine& at_a, const SweepLine& at_b) {
  const SweepLine& longer = at_b.hi - at_b.lo > at_a.hi - at_a.lo ? at_b : at_a;
  if (!(longer.hi > longer.lo)) return;
  std::map<std::uint32_t, double> length;
  const auto count = [&length](const Slab& slab, double sign) {
    for (std::size_t k = 0; k < slab.pieces(); ++k) length[slab.modes[k]] += sign * (slab.at_m[k + 1] - slab.at_m[k]);
  };
  count(make_slab(a, b, at_a, at_a, at_a), 1);
  count(make_slab(a, b, at_b, at_b, at_b), -1);
  for (const auto& [modes, difference] : length) error_ += (b - a) * std::abs(difference);
  Slab slab = make_slab(a, b, longer, longer, longer);
  for (std::size_t k = 0; k < slab.integral.size(); ++k) slab.integral[k] = (b - a) * slab.at_m[k];
  slabs_.push_back(std::move(slab));
}

std::vector<Vector2d> Sweep::sample(const Slab& slab, std::size_t curve, double tolerance) {
  const bool edge = curve == 0 || curve + 1 == slab.at_m.size();
  if (edge || slab.at_a == slab.at_b) return {{slab.a, slab.at_a[curve]}, {slab.b, slab.at_b[curve]}};
  struct Point {
    double u;
    Vector2d at;
  };
  std::vector<double> t;
  constexpr double most_effort = 250;
  const auto point = [&](double u) {
    const double s = slab.a + (slab.b - slab.a) * share(u);
    if (curve_points(slab, s, u, t)) return Point{u, {s, t[curve]}};
    if (effort() < effort_of_run_ + most_effort) {
      const SweepLine line = solve(s);
      if (line.at.size() == slab.curves.size()) return Point{u, {s, line.at[curve - 1].t}};
    }
    const double guess = (1 - u) * (1 - 2 * u) * slab.at_a[curve] + 4 * u * (1 - u) * slab.at_m[curve] +
                         u * (2 * u - 1) * slab.at_b[curve];
    return Point{u, {s, guess}};
  };
  std::vector<Vector2d> points{{slab.a, slab.at_a[curve]}};
  constexpr int deepest_split = 10;
  const auto between = [&](const auto& self, const Point& p, const Point& q, int depth) -> void {
    const Point m = point(0.5 * (p.u + q.u));
    const Vector2d d = q.at - p.at, e = m.at - p.at;
    const double length = d.norm();
    const double off = length > 0 ? std::abs(d.x() * e.y() - d.y() * e.x()) / length : e.norm();
    if (depth < deepest_split && (off > tolerance || depth < 1)) {
      self(self, p, m, depth + 1);
      self(self, m, q, depth + 1);
    } else {
      if (off > 0.1 * tolerance) points.push_back(m.at);
      points.push_back(q.at);
    }
  };
  between(between, {0, {slab.a, slab.at_a[curve]}}, {1, {slab.b, slab.at_b[curve]}}, 0);
  return points;
}

}  // namespace surefoot::stability
