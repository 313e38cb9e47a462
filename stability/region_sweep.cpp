#include "stability/region_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

constexpr int strip_count = 32;      // of the polygon along the sweep, for the search for modes
constexpr int deepest_rectangle = 4;  // halvings of a strip's length in that search
constexpr double inset = 1e-8;        // of the extent: how far beside an event lines are solved
constexpr double least_slab = 4 * inset;
constexpr double blurred = 64;        // insets: where an event is known but not yet over (curves that part slowly, two events at once)
constexpr int deepest = 60;          // splits; each halves the slab at least every other time

/// Rule of Gauss and Kronrod with 7 and 15 nodes on [-1, 1]: nodes >= 0 ascending from the middle.
struct Node {
  double at, kronrod, gauss;
};
constexpr std::array<Node, 8> rule{{{0.000000000000000000000000000000000, 0.209482141084727828012999174891714, 0.417959183673469387755102040816327},
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
bool same_curve(const Crossing& x, const Crossing& y) { return x.curve == y.curve && x.enter == y.enter; }

bool same(const SweepLine& x, const SweepLine& y) {
  return x.begin_modes == y.begin_modes && x.lo_edge == y.lo_edge && x.hi_edge == y.hi_edge &&
         x.at.size() == y.at.size() && std::equal(x.at.begin(), x.at.end(), y.at.begin(), same_curve);
}

}  // namespace

Sweep::Sweep(const RegionModes& modes, std::vector<Vector2d> polygon, double tolerance, double core)
    : modes_(modes), polygon_(std::move(polygon)), tolerance_(tolerance), core_(core) {
  s_begin_ = HUGE_VAL, s_end_ = -HUGE_VAL;
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Vector2d a = polygon_[k] - polygon_[0], b = polygon_[(k + 1) % polygon_.size()] - polygon_[0];
    area_ += 0.5 * (a.x() * b.y() - a.y() * b.x());
    s_begin_ = std::min(s_begin_, polygon_[k].x());
    s_end_ = std::max(s_end_, polygon_[k].x());
  }
  inset_ = inset * (s_end_ - s_begin_);
  make_strips();
}

// ---- where modes can occur --------------------------------------------------------------------------------------

/// Strips of equal width, or, where the polygon is much longer than the place of the contacts, growing with the
/// distance from there.
void Sweep::make_strips() {
  const bool graded = s_end_ - s_begin_ > 8 * core_;
  const double from = graded ? std::asinh(s_begin_ / core_) : s_begin_, to = graded ? std::asinh(s_end_ / core_) : s_end_;
  for (int k = 0; k < strip_count; ++k) {
    const auto border = [&](int i) {
      if (i == 0) return s_begin_;
      if (i == strip_count) return s_end_;
      const double at = from + (to - from) * i / strip_count;
      return graded ? core_ * std::sinh(at) : at;
    };
    Strip strip{border(k), border(k + 1), HUGE_VAL, -HUGE_VAL, 0};
    const auto extend = [&strip](double t) { strip.lo = std::min(strip.lo, t), strip.hi = std::max(strip.hi, t); };
    for (const Vector2d& v : polygon_)
      if (v.x() >= strip.a && v.x() <= strip.b) extend(v.y());
    SweepLine line;
    for (const double s : {strip.a, strip.b})
      if (chord(s, line)) extend(line.lo), extend(line.hi);
    strips_.push_back(strip);
  }
  for (int mode = 0; mode < static_cast<int>(modes_.modes().size()); ++mode)
    classify(mode, 0, strip_count, -HUGE_VAL, HUGE_VAL, 0);
}

/// Excludes the mode in rectangles over strips first..last-1, halving those where it cannot.
void Sweep::classify(int mode, int first, int last, double lo, double hi, int t_depth) {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  bool settled = true;
  for (int k = first; k < last; ++k) {
    least = std::min(least, strips_[k].lo), greatest = std::max(greatest, strips_[k].hi);
    settled &= (strips_[k].active >> mode) & 1;
  }
  lo = std::max(lo, least), hi = std::min(hi, greatest);
  if (settled || !(lo <= hi)) return;
  const double a = strips_[first].a, b = strips_[last - 1].b;
  const ModeThere there = mode_there(modes_, mode, {a, b, lo, hi});
  if (there.kind == ModeThere::nowhere) return;
  const bool feasible = there.kind != ModeThere::unknown || there.feasible_in_middle;
  const bool one_strip = last - first == 1;
  if (one_strip && (feasible || t_depth == deepest_rectangle)) {
    strips_[first].active |= 1u << mode;
    return;
  }
  if (!one_strip && (b - a >= hi - lo || t_depth == deepest_rectangle)) {
    const int middle = (first + last) / 2;
    classify(mode, first, middle, lo, hi, t_depth);
    classify(mode, middle, last, lo, hi, t_depth);
    return;
  }
  const double middle = 0.5 * (lo + hi);
  classify(mode, first, last, lo, middle, t_depth + 1);
  classify(mode, first, last, middle, hi, t_depth + 1);
}

std::uint32_t Sweep::active_at(double s) const {
  const auto after = std::partition_point(strips_.begin(), strips_.end(), [s](const Strip& strip) { return strip.b < s; });
  return after == strips_.end() ? strips_.back().active : after->active;
}

// ---- lines ------------------------------------------------------------------------------------------------------

/// The ends of the line at s in the polygon; false where it only touches.
bool Sweep::chord(double s, SweepLine& line) const {
  line.lo_edge = line.hi_edge = -1;
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Vector2d &p = polygon_[k], &q = polygon_[(k + 1) % polygon_.size()];
    if (!((p.x() <= s && s < q.x()) || (q.x() <= s && s < p.x()))) continue;
    const double t = p.y() + (q.y() - p.y()) * ((s - p.x()) / (q.x() - p.x()));
    if (q.x() > p.x())
      line.lo = t, line.lo_edge = static_cast<int>(k);
    else
      line.hi = t, line.hi_edge = static_cast<int>(k);
  }
  return line.lo_edge >= 0 && line.hi_edge >= 0 && line.lo < line.hi;
}

double Sweep::closeness(const SweepLine& line) const {
  constexpr double rounding = 1e-12;  // of coordinates: where curves that run along an edge are found
  return tie * (line.hi - line.lo) + rounding * (std::abs(line.s) + std::abs(line.lo) + std::abs(line.hi) + core_);
}

SweepLine Sweep::solve(double s) {
  ++lines_;
  SweepLine line;
  line.s = s;
  if (!chord(s, line)) {
    line.hi = line.lo;
    return line;
  }
  const std::uint32_t active = active_at(s);
  LineSet set;
  for (int k = 0; k < static_cast<int>(modes_.modes().size()); ++k) {
    if (!((active >> k) & 1)) continue;
    solve_line(modes_.modes()[k], k, s, line.lo, line.hi, set);
    if (set.at_begin) line.begin_modes |= 1u << k;
    line.uncertain |= set.uncertain;
    line.at.insert(line.at.end(), set.crossings.begin(), set.crossings.end());
  }
  const double reach = 1e-6 * (line.hi - line.lo), close = closeness(line);
  for (Crossing& crossing : line.at) {
    const double exact = polish(modes_, crossing.curve, s, crossing.t, reach);
    if (exact > line.lo && exact < line.hi) crossing.t = exact;
    if (crossing.t - line.lo < close) line.begin_modes ^= 1u << crossing.curve.mode;
  }
  // Some modes begin where the equilibrium ends (rolling over a foot): such curves run along the polygon and are no
  // crossings.
  std::erase_if(line.at, [&](const Crossing& c) { return c.t - line.lo < close || line.hi - c.t < close; });
  std::sort(line.at.begin(), line.at.end(), [](const Crossing& x, const Crossing& y) { return x.t < y.t; });
  // Curves that run together come in the order of their names.
  for (std::size_t k = 0; k < line.at.size();) {
    std::size_t end = k + 1;
    while (end < line.at.size() && line.at[end].t - line.at[end - 1].t < close) ++end;
    std::sort(line.at.begin() + static_cast<std::ptrdiff_t>(k), line.at.begin() + static_cast<std::ptrdiff_t>(end),
              [](const Crossing& x, const Crossing& y) { return x.curve < y.curve; });
    k = end;
  }
  uncertain_ |= line.uncertain;
  return line;
}

// ---- events -----------------------------------------------------------------------------------------------------

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
  const CurveId edge{CurveId::edge, -1, static_cast<signed char>(low ? line.lo_edge : line.hi_edge), -1, -1, 0};
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
  constexpr int many = 400;  // lines; typical: 100
  const double part = lines_ < many ? least_slab : lines_ < 2 * many ? 1e-5 : lines_ < 4 * many ? 1e-3 : 1;
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

// ---- slabs ------------------------------------------------------------------------------------------------------

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

bool Sweep::integrate(double a, double b, const SweepLine& at_a, const SweepLine& at_m, const SweepLine& at_b, bool force) {
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

void Sweep::run() {
  std::vector<double> borders;
  for (const Vector2d& v : polygon_) borders.push_back(v.x());
  std::sort(borders.begin(), borders.end());
  std::vector<double> looks;  // one line at least in every strip in which a mode may occur
  for (const Strip& strip : strips_)
    if (strip.active != 0) looks.push_back(0.5 * (strip.a + strip.b));
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    const double a = borders[k], b = borders[k + 1];
    if (b - a <= least_slab * (s_end_ - s_begin_)) {
      const SweepLine line = solve(0.5 * (a + b));
      if (b > a) pass_over(a, b, line, line);
      continue;
    }
    double from = a;
    SweepLine at_from = solve(a + inset_);
    for (const double look : looks) {
      if (look <= from + least_slab * (s_end_ - s_begin_) || look >= b - least_slab * (s_end_ - s_begin_)) continue;
      const SweepLine line = solve(look);
      if (same(line, at_from)) continue;
      refine(from, at_from, look, line, 0);
      from = look;
      at_from = line;
    }
    refine(from, at_from, b, solve(b - inset_), 0);
  }
}

std::vector<Vector2d> Sweep::sample(const Slab& slab, std::size_t curve, double tolerance) {
  const bool edge = curve == 0 || curve + 1 == slab.at_m.size();
  if (edge || slab.at_a == slab.at_b) return {{slab.a, slab.at_a[curve]}, {slab.b, slab.at_b[curve]}};
  struct Point {
    double u;
    Vector2d at;
  };
  std::vector<double> t;
  const auto point = [&](double u) {
    const double s = slab.a + (slab.b - slab.a) * share(u);
    if (curve_points(slab, s, u, t)) return Point{u, {s, t[curve]}};
    SweepLine line = solve(s);
    if (line.at.size() == slab.curves.size()) return Point{u, {s, line.at[curve - 1].t}};
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
