// Does the open polygon {v : G_k . v > 0 for all rows k} meet the closed box W? In both directions by certificates:
//   yes  a point of W where every row is positive (the witness wrench);
//   no   multipliers y >= 0, y != 0, with (sum y_k G_k) . v negative at the four corners of W (Farkas). One or two rows
//   with the
//        box, or three rows without it, suffice: in (p, 1, q)-space a certificate needs at most three functionals, and
//        with three rows none of them is a side of the box.
// With exact rows the clipping alone decides; with doubles every certificate is checked against the rounding-error
// bound.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "stability/contact.hpp"
#include "stability/planar.hpp"

namespace surefoot::stability {

constexpr int max_rows = 4;  // one slide of three contacts: its direction, two openings, its force

template <class V>
struct RowList {
  std::array<Row<V>, max_rows> row;
  std::array<double, max_rows> error;  // of the row's value anywhere in W; not used for exact numbers
  int count = 0;
};

/// A point (x / w, y / w) of the (p, q)-plane, w > 0: clipping needs no division.
template <class K>
struct PolygonPoint {
  K x, y, w;
};

/// A convex polygon while it is being clipped.
template <class K>
struct Polygon {
  std::array<PolygonPoint<K>, 4 + max_rows> at;
  int count = 0;
};

template <class K>
Polygon<K> box_polygon(const K& kappa, const K& nu) {
  Polygon<K> polygon;
  const K one(1);
  polygon.at[0] = {-kappa, -nu, one};
  polygon.at[1] = {kappa, -nu, one};
  polygon.at[2] = {kappa, nu, one};
  polygon.at[3] = {-kappa, nu, one};
  polygon.count = 4;
  return polygon;
}

/// w times the row's value at a point.
template <class K>
K weighted_value(const Row<K>& row, const PolygonPoint<K>& at) {
  return row.p * at.x + row.one * at.w + row.q * at.y;
}

/// Keeps the part where row . (p, 1, q) >= 0.
template <class K>
Polygon<K> clipped(const Polygon<K>& polygon, const Row<K>& row) {
  Polygon<K> kept;
  std::array<K, 4 + max_rows> value;
  for (int k = 0; k < polygon.count; ++k) value[k] = weighted_value(row, polygon.at[k]);
  for (int k = 0; k < polygon.count; ++k) {
    const int next = k + 1 == polygon.count ? 0 : k + 1;
    const PolygonPoint<K>&a = polygon.at[k], &b = polygon.at[next];
    const K &va = value[k], &vb = value[next];
    const bool a_in = !(va < 0), b_in = !(vb < 0);
    if (a_in && kept.count < static_cast<int>(kept.at.size())) kept.at[kept.count++] = a;
    if (a_in == b_in || kept.count == static_cast<int>(kept.at.size())) continue;
    // (va b - vb a) / (va - vb) with the signs that make w positive
    K fa = a_in ? -vb : vb, fb = a_in ? va : -va;
    if constexpr (std::is_floating_point_v<K>) {  // keeps w = 1
      const K sum = fa + fb;
      fa /= sum, fb /= sum;
    }
    kept.at[kept.count++] = {fa * a.x + fb * b.x, fa * a.y + fb * b.y, fa * a.w + fb * b.w};
  }
  return kept;
}

/// {rows >= 0} within the box. Rows are linear: one that is positive somewhere in it is positive at one of its
/// vertices.
template <class K>
Polygon<K> feasible_polygon(const RowList<K>& rows, const K& kappa, const K& nu) {
  Polygon<K> polygon = box_polygon<K>(kappa, nu);
  for (int k = 0; k < rows.count && polygon.count > 0; ++k) polygon = clipped(polygon, rows.row[k]);
  return polygon;
}

/// sign * row . (p, 1, q) < -error on all of W.
inline bool negative_on(const DisturbanceBox& box, const Row<double>& row, double sign, double error) {
  return sign * row.one + box.kappa * std::abs(row.p) + box.nu * std::abs(row.q) < -error;
}

enum class Meeting { yes, no, uncertain };

/// Whether every row exceeds its error bound at p = q = 0 or at a corner of the box: quick, but it does not see every
/// witness.
bool has_plain_witness(const RowList<double>& rows, const DisturbanceBox& box);

/// Whether some point of the box satisfies all rows, with a witness or a certificate beyond the rows' error bounds.
Meeting meets_box(const RowList<double>& rows, const DisturbanceBox& box);

/// Whether a positive combination of two rows, times `sign`, is negative on the box for all three row lists, the
/// Bernstein coefficients of rows on an interval (the errors are those of the first list, times the factor): no point
/// of the box then satisfies all rows, times `sign`, anywhere on it.
bool two_rows_miss_box(const std::array<const RowList<double>*, 3>& coefficients, double sign,
                       const DisturbanceBox& box, double error_factor);

}  // namespace surefoot::stability
