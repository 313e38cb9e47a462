#include "stability/region_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {
constexpr int strip_count = 32;       // of the polygon along the sweep, for the search for modes
constexpr int deepest_rectangle = 4;  // halvings of a strip's length in that search
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
  const double from = graded ? std::asinh(s_begin_ / core_) : s_begin_,
               to = graded ? std::asinh(s_end_ / core_) : s_end_;
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
  if (there.kind == ModePart::nowhere) return;
  const bool feasible = there.kind != ModePart::unknown || there.feasible_in_middle;
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
  const auto after =
      std::partition_point(strips_.begin(), strips_.end(), [s](const Strip& strip) { return strip.b < s; });
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
    if (q.x() > p.x()) line.lo = t, line.lo_edge = static_cast<int>(k);
    else line.hi = t, line.hi_edge = static_cast<int>(k);
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
    steps_ += set.steps;
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

// ---- the sweep ------------------------------------------------------------------------------------------------

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
  effort_of_run_ = effort();
}

}  // namespace surefoot::stability
