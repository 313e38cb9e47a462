// Does the open polygon {v : G_k . v > 0 for all rows k} meet the closed box W? In both directions by certificates:
//   yes  a point of W where every row is positive (the witness wrench);
//   no   multipliers y >= 0, y != 0, with (sum y_k G_k) . v negative at the four corners of W (Farkas). One or two rows with the
//        box, or three rows without it, suffice: in (p, 1, q)-space a certificate needs at most three functionals, and with
//        three rows none of them is a side of the box.
// With rational rows the clipping alone decides; with doubles every certificate is checked against the rounding-error bound.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "stability/contact.hpp"
#include "stability/planar.hpp"

namespace surefoot::stability {

constexpr int max_rows = 6;

template <class V>
struct RowList {
  std::array<Row<V>, max_rows> row;
  std::array<double, max_rows> error{};  // of the row's value anywhere in W; not used for rationals
  int count = 0;
};

/// A convex polygon in the (p, q)-plane while it is being clipped.
template <class K>
struct Polygon {
  std::array<Vec2<K>, 4 + max_rows> at;
  int count = 0;
};

template <class K>
Polygon<K> box_polygon(const K& kappa, const K& nu) {
  Polygon<K> polygon;
  polygon.at[0] = {-kappa, -nu};
  polygon.at[1] = {kappa, -nu};
  polygon.at[2] = {kappa, nu};
  polygon.at[3] = {-kappa, nu};
  polygon.count = 4;
  return polygon;
}

/// Keeps the part where row . (p, 1, q) >= 0.
template <class K>
Polygon<K> clipped(const Polygon<K>& polygon, const Row<K>& row) {
  Polygon<K> kept;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec2<K>&a = polygon.at[k], &b = polygon.at[k + 1 == polygon.count ? 0 : k + 1];
    const K va = value_at(row, a.x, a.y), vb = value_at(row, b.x, b.y);
    const bool a_in = va >= 0, b_in = vb >= 0;
    if (a_in && kept.count < static_cast<int>(kept.at.size())) kept.at[kept.count++] = a;
    if (a_in != b_in && kept.count < static_cast<int>(kept.at.size())) {
      const K part = va / (va - vb);
      kept.at[kept.count++] = {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part};
    }
  }
  return kept;
}

/// The mean of the vertices of {rows >= 0} within the box; every row is positive there if any point of the box has that
/// property, since the rows are linear and not negative on the polygon.
template <class K>
std::optional<Vec2<K>> middle(const RowList<K>& rows, const K& kappa, const K& nu) {
  Polygon<K> polygon = box_polygon<K>(kappa, nu);
  for (int k = 0; k < rows.count && polygon.count > 0; ++k) polygon = clipped(polygon, rows.row[k]);
  if (polygon.count == 0) return std::nullopt;
  Vec2<K> sum{K(0), K(0)};
  for (int k = 0; k < polygon.count; ++k) sum = {sum.x + polygon.at[k].x, sum.y + polygon.at[k].y};
  return Vec2<K>{sum.x / K(polygon.count), sum.y / K(polygon.count)};
}

/// Multipliers of up to three rows.
struct Certificate {
  int count = 0;
  std::array<int, 3> row{};
  std::array<double, 3> y{};
};

/// Offers certificates that no point of the box satisfies all rows (each checked with the rows' error bounds) to `accept`
/// until it returns true; whether it did.
bool any_certificate(const RowList<double>& rows, const DisturbanceBox& box,
                     const std::function<bool(const Certificate&)>& accept);

/// A point of the box at which every row exceeds its error bound.
std::optional<Vec2<double>> find_witness(const RowList<double>& rows, const DisturbanceBox& box);

}  // namespace surefoot::stability
