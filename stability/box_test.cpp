#include "stability/box_test.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

/// Multipliers of up to three rows.
struct Certificate {
  int count = 0;
  std::array<int, 3> row{};
  std::array<double, 3> y{};
};

/// Values of a row at the corners of the box, or of each of three rows.
template <int n>
using Corners = std::array<double, n>;
template <int n>
using AllCorners = std::array<Corners<n>, max_rows>;

void set_corner_values(const Row<double>& row, const DisturbanceBox& box, double* at) {
  const double p = row.p * box.kappa, q = row.q * box.nu;
  at[0] = row.one - p - q, at[1] = row.one + p - q, at[2] = row.one + p + q, at[3] = row.one - p + q;
}

/// Whether the combination is negative at every corner by more than its error.
template <int n>
bool holds(const Certificate& c, const AllCorners<n>& at, const std::array<double, max_rows>& errors) {
  double error = 0;
  for (int k = 0; k < c.count; ++k) error += c.y[k] * errors[c.row[k]];
  for (int corner = 0; corner < n; ++corner) {
    double sum = 0;
    for (int k = 0; k < c.count; ++k) sum += c.y[k] * at[c.row[k]][corner];
    if (!(sum < -error)) return false;
  }
  return true;
}

/// theta g_i + (1 - theta) g_j < 0 at the corners: an interval of theta, whose middle is taken.
template <int n>
std::optional<Certificate> pair_certificate(int i, int j, const AllCorners<n>& at) {
  double low = 0, high = 1;
  for (int corner = 0; corner < n; ++corner) {
    const double a = at[i][corner], b = at[j][corner];
    if (a >= 0 && b >= 0) return std::nullopt;
    if (a < 0 && b < 0) continue;
    const double limit = b / (b - a);
    if (a < 0) low = std::max(low, limit);
    else high = std::min(high, limit);
    if (!(low < high)) return std::nullopt;
  }
  const double theta = 0.5 * (low + high);
  return Certificate{2, {i, j, 0}, {theta, 1 - theta, 0}};
}

template <int n>
bool pair_misses(int rows, const AllCorners<n>& at, const std::array<double, max_rows>& errors) {
  for (int i = 0; i < rows; ++i)
    for (int j = i + 1; j < rows; ++j) {
      const std::optional<Certificate> c = pair_certificate<n>(i, j, at);
      if (c && holds<n>(*c, at, errors)) return true;
    }
  return false;
}

std::optional<Certificate> triple_certificate(int i, int j, int k, const RowList<double>& rows) {
  const auto gradient = [&](int r) { return Vec2<double>{rows.row[r].p, rows.row[r].q}; };
  std::array<double, 3> y{cross(gradient(j), gradient(k)), cross(gradient(k), gradient(i)),
                          cross(gradient(i), gradient(j))};
  if (y[0] < 0 && y[1] < 0 && y[2] < 0)
    for (double& value : y) value = -value;
  if (!(y[0] > 0 && y[1] > 0 && y[2] > 0)) return std::nullopt;
  const double scale = 1 / (y[0] + y[1] + y[2]);
  if (!std::isfinite(scale)) return std::nullopt;
  return Certificate{3, {i, j, k}, {y[0] * scale, y[1] * scale, y[2] * scale}};
}

bool has_certificate(const RowList<double>& rows, const AllCorners<4>& at) {
  for (int k = 0; k < rows.count; ++k)
    if (holds<4>({1, {k, 0, 0}, {1, 0, 0}}, at, rows.error)) return true;
  if (pair_misses<4>(rows.count, at, rows.error)) return true;
  for (int i = 0; i < rows.count; ++i)
    for (int j = i + 1; j < rows.count; ++j)
      for (int k = j + 1; k < rows.count; ++k) {
        const std::optional<Certificate> c = triple_certificate(i, j, k, rows);
        if (c && holds<4>(*c, at, rows.error)) return true;
      }
  return false;
}

bool gravity_is_witness(const RowList<double>& rows) {
  for (int k = 0; k < rows.count; ++k)
    if (!(rows.row[k].one > rows.error[k])) return false;
  return true;
}

bool corner_is_witness(const RowList<double>& rows, const AllCorners<4>& at) {
  std::array<bool, 4> positive{true, true, true, true};
  for (int k = 0; k < rows.count; ++k)
    for (int corner = 0; corner < 4; ++corner) positive[corner] &= at[k][corner] > rows.error[k];
  return positive[0] || positive[1] || positive[2] || positive[3];
}

/// The mean of the vertices: every row is positive there if it is anywhere in the polygon.
bool middle_is_witness(const RowList<double>& rows, const DisturbanceBox& box) {
  const Polygon<double> polygon = feasible_polygon(rows, box.kappa, box.nu);
  if (polygon.count == 0) return false;
  Vec2<double> sum{0, 0};
  for (int k = 0; k < polygon.count; ++k) sum = {sum.x + polygon.at[k].x, sum.y + polygon.at[k].y};
  const double x = sum.x / polygon.count, y = sum.y / polygon.count;
  for (int k = 0; k < rows.count; ++k)
    if (!(value_at(rows.row[k], x, y) > rows.error[k])) return false;
  return true;
}

}  // namespace

bool has_plain_witness(const RowList<double>& rows, const DisturbanceBox& box) {
  if (gravity_is_witness(rows)) return true;
  AllCorners<4> at;
  for (int k = 0; k < rows.count; ++k) set_corner_values(rows.row[k], box, at[k].data());
  return corner_is_witness(rows, at);
}

Meeting meets_box(const RowList<double>& rows, const DisturbanceBox& box) {
  if (gravity_is_witness(rows)) return Meeting::yes;
  AllCorners<4> at;
  for (int k = 0; k < rows.count; ++k) set_corner_values(rows.row[k], box, at[k].data());
  if (corner_is_witness(rows, at)) return Meeting::yes;
  if (has_certificate(rows, at)) return Meeting::no;
  return middle_is_witness(rows, box) ? Meeting::yes : Meeting::uncertain;
}

bool two_rows_miss_box(const std::array<const RowList<double>*, 3>& coefficients, double sign,
                       const DisturbanceBox& box, double error_factor) {
  const RowList<double>& first = *coefficients[0];
  AllCorners<12> at;
  std::array<double, max_rows> errors;
  for (int k = 0; k < first.count; ++k) {
    errors[k] = error_factor * first.error[k];
    for (int c = 0; c < 3; ++c) {
      const Row<double>& row = coefficients[c]->row[k];
      set_corner_values({sign * row.p, sign * row.one, sign * row.q}, box, at[k].data() + 4 * c);
    }
  }
  return pair_misses<12>(first.count, at, errors);
}

}  // namespace surefoot::stability
