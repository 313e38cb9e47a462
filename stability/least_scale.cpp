#include "stability/least_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::stability {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A row in box coordinates P = p / kappa, Q = q / nu: a . (P, Q) + b > 0. A pinned axis (kappa or nu = 0) has coefficient 0.
struct ScaledRow {
  Vec2<double> a;
  double b;
  double at(const Vec2<double>& v) const { return a.x * v.x + a.y * v.y + b; }
  double norm() const { return std::abs(a.x) + std::abs(a.y); }
};

double reach_of(const Vec2<double>& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

using ScaledRows = std::array<ScaledRow, max_rows>;

/// The point of least |.|_inf on the line of row k, within rows 0..k-1.
struct OnLine {
  bool feasible = false;
  Vec2<double> at{0, 0};
  int partner = -1;  // the other active row, if the optimum is at its end of the interval
};

/// v(t) = base + t d on the line; keeps [low, high] and which rows bound it.
struct Interval {
  double low = -infinity, high = infinity;
  int low_row = -1, high_row = -1;
};

bool restrict(Interval& interval, const ScaledRow& row, int index, const Vec2<double>& base, const Vec2<double>& d) {
  const double slope = row.a.x * d.x + row.a.y * d.y, value = row.at(base);
  if (slope == 0) return value > 0 || (value == 0 && row.norm() > 0);
  const double t = -value / slope;
  if (slope > 0 && t > interval.low) {
    interval.low = t;
    interval.low_row = index;
  } else if (slope < 0 && t < interval.high) {
    interval.high = t;
    interval.high_row = index;
  }
  return interval.low < interval.high;
}

OnLine best_on_line(const ScaledRows& rows, int k) {
  const ScaledRow& row = rows[k];
  const double norm = row.norm();
  if (!(norm > 0)) return {};
  // The nearest point of the line to the origin in |.|_inf is -b/|a|_1 (sign a); a zero component may take any value.
  const double s = -row.b / norm;
  const Vec2<double> base{row.a.x < 0 ? -s : s, row.a.y < 0 ? -s : s};
  const Vec2<double> d{-row.a.y / norm, row.a.x / norm};
  Interval interval;
  for (int j = 0; j < k; ++j)
    if (!restrict(interval, rows[j], j, base, d)) return {};
  // |.|_inf is convex along the line with its minimum at t = 0 (or on a stretch around it): the nearest end of the interval.
  OnLine best;
  best.feasible = true;
  double t = 0;
  if (interval.low > 0) {
    t = interval.low;
    best.partner = interval.low_row;
  } else if (interval.high < 0) {
    t = interval.high;
    best.partner = interval.high_row;
  }
  best.at = {base.x + t * d.x, base.y + t * d.y};
  return best;
}

/// Multipliers with sum y_k a_k = an outward normal of the box face(s) reached, faces weighted to sum 1.
void set_dual(LeastScale& result, const ScaledRows& rows, const Vec2<double>& v) {
  if (result.active == 0) return;
  const ScaledRow& first = rows[result.row[0]];
  if (result.active == 2) {
    const ScaledRow& second = rows[result.row[1]];
    const bool x_face = std::abs(v.x) >= std::abs(v.y);
    const Vec2<double> face{x_face ? std::copysign(1.0, v.x) : 0, x_face ? 0 : std::copysign(1.0, v.y)};
    const double det = cross(first.a, second.a);
    const double y0 = cross(face, second.a) / det, y1 = cross(first.a, face) / det;
    if (std::isfinite(y0) && std::isfinite(y1) && y0 >= 0 && y1 >= 0) {
      result.y = {y0, y1};
      return;
    }
    result.active = 1;  // the face is reached along the first row alone
  }
  result.y = {1 / first.norm(), 0};
}

}  // namespace

LeastScale least_scale(const RowList<double>& rows, const DisturbanceBox& box, double give_up_above) {
  ScaledRows scaled;
  LeastScale result;
  result.s = infinity;
  for (int k = 0; k < rows.count; ++k) {
    const Row<double>& row = rows.row[k];
    scaled[k] = {{row.p * box.kappa, row.q * box.nu}, row.one};
    const double norm = scaled[k].norm();
    if (row.one <= 0 && (norm == 0 || -row.one >= give_up_above * norm)) return result;
  }
  Vec2<double> v{0, 0};
  result.s = 0;
  for (int k = 0; k < rows.count; ++k) {
    if (scaled[k].at(v) >= 0) continue;
    const OnLine best = best_on_line(scaled, k);
    if (!best.feasible || reach_of(best.at) >= give_up_above) {
      result.s = infinity;
      return result;
    }
    v = best.at;
    result.s = reach_of(v);
    result.active = best.partner < 0 ? 1 : 2;
    result.row = {k, std::max(best.partner, 0)};
  }
  result.at = {v.x * box.kappa, v.y * box.nu};
  set_dual(result, scaled, v);
  return result;
}

}  // namespace surefoot::stability
