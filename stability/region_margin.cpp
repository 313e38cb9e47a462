#include "stability/region_margin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {
namespace {

double value_at(const Form<double>& f, double u, double w) { return f.one + f.u * u + f.w * w; }

/// A slot that is nothing but rounding of a row of size 1 counts as positive, so that labels do not flicker.
double sign_of(double slot) { return slot < -equal_rows ? -1 : 1; }

Margin single(const Form<double>* g, int k) {
  Margin m;
  m.u = sign_of(g[k].u), m.w = sign_of(g[k].w);
  m.value = value_at(g[k], m.u, m.w);
  m.basis = {CurveId::corner,
             -1,
             static_cast<std::int8_t>(k),
             -1,
             -1,
             static_cast<std::int8_t>((m.u > 0 ? 1 : 0) + (m.w > 0 ? 2 : 0))};
  m.count = 1;
  m.y = {1, 0, 0};
  return m;
}

/// The best point of the box on which rows i and j are equal; false if they are not equal anywhere.
bool pair(const Form<double>* g, int i, int j, Margin& m) {
  const Form<double> h{g[i].u - g[j].u, g[i].one - g[j].one, g[i].w - g[j].w};
  bool found = false;
  const auto offer = [&](double u, double w, int side) {
    const double value = value_at(g[i], u, w);
    if (found && value <= m.value) return;
    found = true;
    m.u = u, m.w = w, m.value = value;
    m.basis.place = static_cast<std::int8_t>(side);
  };
  for (int end : {-1, 1}) {
    const double w = -(h.one + end * h.u) / h.w;
    if (std::abs(w) <= 1 + equal_rows) offer(end, w, end < 0 ? 0 : 1);
    const double u = -(h.one + end * h.w) / h.u;
    if (std::abs(u) <= 1 + equal_rows) offer(u, end, end < 0 ? 2 : 3);
  }
  if (!found) return false;
  m.basis = {CurveId::side, -1, static_cast<std::int8_t>(std::min(i, j)), static_cast<std::int8_t>(std::max(i, j)), -1,
             m.basis.place};
  m.count = 2;
  const bool free_w = m.basis.place < 2;
  const double yi = std::abs(free_w ? g[m.basis.b].w : g[m.basis.b].u);
  const double yj = std::abs(free_w ? g[m.basis.a].w : g[m.basis.a].u);
  if (!(yi + yj > 0)) return false;
  m.y = {yi / (yi + yj), yj / (yi + yj), 0};
  return true;
}

bool triple(const Form<double>* g, int i, int j, int k, Margin& m) {
  int row[3] = {i, j, k};
  std::sort(row, row + 3);
  const Form<double>&f = g[row[0]], &e = g[row[1]], &h = g[row[2]];
  double y[3] = {e.u * h.w - e.w * h.u, h.u * f.w - h.w * f.u, f.u * e.w - f.w * e.u};
  const double sum = y[0] + y[1] + y[2];
  if (!(std::abs(sum) > 0)) return false;
  for (double& part : y) part /= sum;
  if (y[0] < 0 || y[1] < 0 || y[2] < 0) return false;
  // f = e and f = h:
  const double a1 = f.u - e.u, b1 = f.w - e.w, c1 = e.one - f.one, a2 = f.u - h.u, b2 = f.w - h.w, c2 = h.one - f.one;
  const double det = a1 * b2 - a2 * b1;
  m.u = (c1 * b2 - c2 * b1) / det, m.w = (a1 * c2 - a2 * c1) / det;
  if (!(std::abs(m.u) <= 1 + equal_rows && std::abs(m.w) <= 1 + equal_rows)) return false;
  m.value = y[0] * f.one + y[1] * e.one + y[2] * h.one;
  m.basis = {CurveId::inside,
             -1,
             static_cast<std::int8_t>(row[0]),
             static_cast<std::int8_t>(row[1]),
             static_cast<std::int8_t>(row[2]),
             0};
  m.count = 3;
  m.y = {y[0], y[1], y[2]};
  return true;
}

/// The optimum of the rows of a basis and one more row that is violated at it: the new row is tight.
Margin enter(const Form<double>* g, const Margin& old, int j) {
  Margin best = old;
  double best_excess = -HUGE_VAL;
  const auto offer = [&](const Margin& m) {  // the candidate at which no other row is lower
    double least = value_at(g[j], m.u, m.w);
    for (int k = 0; k < old.count; ++k) least = std::min(least, value_at(g[old.basis.row(k)], m.u, m.w));
    const double excess = least - m.value;
    if (excess > best_excess + equal_rows || (excess > best_excess - equal_rows && m.value > best.value)) {
      best_excess = excess;
      best = m;
    }
  };
  offer(single(g, j));
  if (best_excess >= -equal_rows) return best;
  Margin m;
  for (int k = 0; k < old.count; ++k)
    if (pair(g, j, old.basis.row(k), m)) offer(m);
  for (int k = 0; k < old.count; ++k)
    for (int l = k + 1; l < old.count; ++l)
      if (triple(g, j, old.basis.row(k), old.basis.row(l), m)) offer(m);
  return best;
}

}  // namespace

Margin margin(const Form<double>* rows, int count) {
  std::array<Form<double>, 6> g;
  std::array<double, 6> size{};
  if (count == 0) return {1, {}, 0, 0, 0, {}};
  Margin m;
  m.value = HUGE_VAL;
  for (int k = 0; k < count; ++k) {
    size[k] = std::abs(rows[k].u) + std::abs(rows[k].one) + std::abs(rows[k].w);
    const double scale = size[k] > 0 ? 1 / size[k] : 0;
    g[k] = {rows[k].u * scale, rows[k].one * scale, rows[k].w * scale};
    const double own = g[k].one + std::abs(g[k].u) + std::abs(g[k].w);
    if (own < m.value - equal_rows) {
      m = single(g.data(), k);
      m.value = own;
    }
  }
  constexpr int most_pivots = 24;  // the value falls with each; ties end it
  for (int pivot = 0; pivot < most_pivots; ++pivot) {
    int worst = -1;
    double least = m.value - equal_rows;
    for (int k = 0; k < count; ++k) {
      const double value = value_at(g[k], m.u, m.w);
      if (value < least) least = value, worst = k;
    }
    if (worst < 0) break;
    m = enter(g.data(), m, worst);
  }
  // Rows that depend on each other have margin 0; rounding must not make that feasible.
  constexpr double no_margin = 1e-14;  // of rows of size 1
  if (m.value < no_margin) m.value = std::min(m.value, 0.0);
  for (int k = 0; k < m.count; ++k) m.y[k] = size[m.basis.row(k)] > 0 ? m.y[k] / size[m.basis.row(k)] : 0;
  return m;
}

}  // namespace surefoot::stability
