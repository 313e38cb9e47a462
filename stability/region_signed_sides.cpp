// Certificates on the sides of W.
#include "stability/region_signed_mode.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {

SignedMode::SideRow SignedMode::on_side(int k, const CurveId& id) const {
  const double end = id.place & 1 ? 1 : -1;
  const bool free_w = id.place < 2;
  const LocalRow& row = row_[k];
  return {at_wrench(row, free_w ? end : 0, free_w ? 0 : end), free_w ? row.form.w : row.form.u,
          at_wrench(row, free_w ? -end : 0, free_w ? 0 : -end)};
}

double SignedMode::size(int k) const {
  return magnitude(row_[k].form.u) + magnitude(row_[k].form.one) + magnitude(row_[k].form.w);
}

std::optional<SignedMode::SidePair> SignedMode::side_pair(const CurveId& id) const {
  const SideRow one = on_side(id.a, id), two = on_side(id.b, id);
  const bool rising = one.g.c[0] > 0;  // row a
  SidePair pair{rising ? id.a : id.b, rising ? id.b : id.a, rising ? one : two, rising ? two : one, {}, {}};
  if (!(lower(pair.i.g) > row_[pair.up].error) || !(upper(pair.j.g) < -row_[pair.down].error)) return std::nullopt;
  pair.sum = pair.i.g * pair.j.e - pair.j.g * pair.i.e;
  pair.opposite = pair.i.g * pair.j.opposite - pair.j.g * pair.i.opposite;
  return pair;
}

bool SignedMode::by_curves(const CurveId& id, ModePart& part) const {
  if (id.kind == CurveId::inside) return within(id, part);
  if (id.kind != CurveId::corner && id.kind != CurveId::side) return false;
  const int first = id.kind == CurveId::side ? id.place : id.place & 1 ? 1 : 0;
  std::optional<SideConditions> one, other;
  if (by_side(first, one, part)) return true;
  int second = id.place & 2 ? 3 : 2;
  if (id.kind == CurveId::side) {
    const int corner = one ? one->corner_in_doubt() : -1;
    if (corner < 0) return false;
    second = first >= 2 ? corner & 1 : corner & 2 ? 3 : 2;
  }
  return by_side(second, other, part) || (one && other && by_two_sides(*one, *other, part));
}

int SignedMode::SideConditions::corner_in_doubt() const {
  int corner = -1;
  for (const Open& condition : listed()) {
    if (condition.necessary) continue;
    if (condition.curve.kind != CurveId::corner || (corner >= 0 && condition.curve.place != corner)) return -1;
    corner = condition.curve.place;
  }
  return corner;
}

bool SignedMode::by_side(int side, std::optional<SideConditions>& conditions, ModePart& part) const {
  conditions.emplace(*this, side);
  if (!conditions->collect()) {
    conditions.reset();
    return false;
  }
  ModePart found;
  std::optional<Box> box;
  for (int k = 0; k < conditions->opens; ++k) {
    SideConditions::Open& open = conditions->open[k];
    open.necessary = necessary(open.curve, {});
    if (!open.necessary && !box) box = remaining_box();
    open.necessary |= box && necessary(open.curve, *box);
    if (open.necessary) found.condition[found.count++] = open;
  }
  if (found.count < conditions->opens) return false;
  found.kind = found.count == 0 ? ModePart::everywhere : ModePart::by_curves;
  part = found;
  return true;
}

bool SignedMode::by_two_sides(const SideConditions& one, const SideConditions& other, ModePart& part) const {
  if (one.corner_in_doubt() < 0 || one.corner_in_doubt() != other.corner_in_doubt()) return false;
  const auto has_pair = [](const SideConditions& side, int i, int j) {
    const auto listed = side.listed();
    return std::any_of(listed.begin(), listed.end(), [&](const SideConditions::Open& open) {
      return open.necessary && open.curve.kind == CurveId::side && open.curve.a == std::min(i, j) &&
             open.curve.b == std::max(i, j);
    });
  };
  for (const SideConditions::Open& f : one.listed())
    for (const SideConditions::Open& g : other.listed()) {
      if (f.necessary || g.necessary) continue;
      const int i = f.curve.a, j = g.curve.a;
      if (i == j || (!has_pair(one, i, j) && !has_pair(other, i, j))) return false;
    }
  ModePart found;
  found.kind = ModePart::by_curves;
  for (const SideConditions* side : {&one, &other})
    for (const SideConditions::Open& open : side->listed()) {
      if (!open.necessary) continue;
      if (found.count == found.condition.size()) return false;
      found.condition[found.count++] = open;
    }
  if (found.count == 0) return false;
  part = found;
  return true;
}

bool SignedMode::necessary(const CurveId& id, const Box& box) const {
  if (id.kind == CurveId::corner) {
    const LocalRow& row = row_[id.a];
    const Conic here = at_wrench(row, id.place & 1 ? 1 : -1, id.place & 2 ? 1 : -1);
    for (const double u : box.u)
      for (const double w : box.w) {
        const Conic there = at_wrench(row, u, w);
        if (!(lower(here - there) >= -row.error) && !positive(there * -1, row.error)) return false;
      }
    return true;
  }
  const std::optional<SidePair> pair = side_pair(id);
  if (!pair) return false;
  const double error = product_error(pair->up, pair->down);
  return lower(pair->sum - pair->opposite) >= -error || upper(pair->opposite) < -error;
}

bool SignedMode::beside_denominator(ModePart& part) const {
  CurveId tried;
  constexpr double place[5][2] = {{0, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}};
  for (const auto& [sigma, tau] : place) {
    if (!(value_at(*denominator_, sigma, tau) > 0)) continue;
    const CurveId id = margin_at(sigma, tau).basis;
    if (id.kind != CurveId::side || id == tried) continue;
    tried = id;
    if (beside_denominator(id, part)) return true;
  }
  return false;
}

bool SignedMode::beside_denominator(const CurveId& id, ModePart& part) const {
  const std::optional<SidePair> pair = side_pair(id);
  if (!pair) return false;
  const double error = product_error(pair->up, pair->down);
  if (positive(pair->sum * -1, error) && positive(pair->opposite * -1, error)) {
    part.kind = ModePart::nowhere;
    return true;
  }
  SideConditions conditions(*this, id.place);
  if (!conditions.collect() || conditions.opens > 0) return false;
  part.kind = ModePart::everywhere;
  return true;
}

bool SignedMode::positive(const Bivariate<4>& f, double error) const {
  if (lower(f) > error) return true;
  if (!denominator_) return false;
  // f = D (a + b sigma + c tau) by least squares at nine points, then checked by coefficients
  double n00 = 0, n01 = 0, n02 = 0, n11 = 0, n12 = 0, n22 = 0, m0 = 0, m1 = 0, m2 = 0;
  for (const double sigma : {-1.0, 0.0, 1.0})
    for (const double tau : {-1.0, 0.0, 1.0}) {
      const double d = value_at(*denominator_, sigma, tau), v = value_at(f, sigma, tau), w = d * d;
      n00 += w, n01 += w * sigma, n02 += w * tau, n11 += w * sigma * sigma, n12 += w * sigma * tau,
          n22 += w * tau * tau;
      m0 += d * v, m1 += d * v * sigma, m2 += d * v * tau;
    }
  const double c00 = n11 * n22 - n12 * n12, c01 = n12 * n02 - n01 * n22, c02 = n01 * n12 - n11 * n02;
  const double det = n00 * c00 + n01 * c01 + n02 * c02;
  const double c11 = n00 * n22 - n02 * n02, c12 = n01 * n02 - n00 * n12, c22 = n00 * n11 - n01 * n01;
  const Bivariate<1> q{{(c00 * m0 + c01 * m1 + c02 * m2) / det, (c01 * m0 + c11 * m1 + c12 * m2) / det,
                        (c02 * m0 + c12 * m1 + c22 * m2) / det}};
  constexpr double rounding = 1e-11;  // of coefficients after division
  Bivariate<4> rest = f;
  const Bivariate<3> product = *denominator_ * q;
  for (int k = 0; k < product.size; ++k) rest.c[k] -= product.c[k];
  return magnitude(rest) <= rounding * magnitude(f) + error && lower(q) > rounding * magnitude(q);
}

bool SignedMode::SideConditions::collect() {
  const auto of_rows = static_cast<std::int8_t>(mode.sign_);
  for (int k = 0; k < mode.count_; ++k) {
    row[k] = mode.on_side(k, side);
    const double error = mode.row_[k].error;
    const bool low_holds = mode.positive(row[k].e - row[k].g, error),
               high_holds = mode.positive(row[k].e + row[k].g, error);
    if (low_holds && high_holds) continue;
    if (!low_holds && !high_holds && magnitude(row[k].g) <= error) {  // the same on all of the side
      if (!leave_open(corner(k, true), of_rows)) return false;
      continue;
    }
    // A row that holds at an end holds on all of the side where its slope has the other sign.
    if (high_holds || (!low_holds && lower(row[k].g) >= -error && leave_open(corner(k, true), of_rows)))
      rising[risings++] = k;
    else if (low_holds || (upper(row[k].g) <= error && leave_open(corner(k, false), of_rows))) falling[fallings++] = k;
    else return false;
  }
  for (int i = 0; i < risings; ++i)
    for (int j = 0; j < fallings; ++j)
      if (!pair_holds(rising[i], falling[j])) return false;
  return true;
}

bool SignedMode::SideConditions::pair_holds(int i, int j) {
  if (mode.positive(row[i].g * row[j].e - row[j].g * row[i].e, mode.product_error(i, j))) return true;
  CurveId id = side;
  id.a = static_cast<std::int8_t>(std::min(i, j)), id.b = static_cast<std::int8_t>(std::max(i, j));
  return leave_open(id, i < j ? -1 : 1);
}

}  // namespace surefoot::stability
