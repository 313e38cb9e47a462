// Certificates on the sides of W.
#include "stability/region_signed_mode.hpp"

#include <algorithm>
#include <cmath>

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

bool SignedMode::on_side(int side, ModeThere& there) const {
  SideConditions conditions(*this, side);
  if (!conditions.collect()) return false;
  there.kind = ModeThere::everywhere;
  if (!conditions.open) return true;
  there.kind = ModeThere::beyond_curve;
  there.curve = *conditions.open;
  there.sign = conditions.sign;
  return fails_everywhere(*conditions.open);
}

bool SignedMode::fails_everywhere(const CurveId& id) const {
  if (id.kind == CurveId::corner) {
    const LocalRow& row = row_[id.a];
    return lower(row.form.u * (id.place & 1 ? 1 : -1)) >= -row.error && lower(row.form.w * (id.place & 2 ? 1 : -1)) >= -row.error;
  }
  const std::optional<SidePair> pair = side_pair(id);
  return pair && lower(pair->sum - pair->opposite) >= -product_error(pair->up, pair->down);
}

bool SignedMode::beside_denominator(ModeThere& there) const {
  CurveId tried;
  for (const double sigma : {-1.0, 0.0, 1.0})
    for (const double tau : {-1.0, 0.0, 1.0}) {
      if (!(value_at(*denominator_, sigma, tau) > 0)) continue;
      const CurveId id = margin_at(sigma, tau).basis;
      if (id.kind != CurveId::side || id == tried) continue;
      tried = id;
      if (beside_denominator(id, there)) return true;
    }
  return false;
}

bool SignedMode::beside_denominator(const CurveId& id, ModeThere& there) const {
  const std::optional<SidePair> pair = side_pair(id);
  if (!pair) return false;
  const double error = product_error(pair->up, pair->down);
  if (positive(pair->sum * -1, error) && positive(pair->opposite * -1, error)) {
    there.kind = ModeThere::nowhere;
    return true;
  }
  SideConditions conditions(*this, id.place);
  if (!conditions.collect() || conditions.open) return false;
  there.kind = ModeThere::everywhere;
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
      n00 += w, n01 += w * sigma, n02 += w * tau, n11 += w * sigma * sigma, n12 += w * sigma * tau, n22 += w * tau * tau;
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
  const auto of_rows = static_cast<signed char>(mode.sign_);
  for (int k = 0; k < mode.count_; ++k) {
    row[k] = mode.on_side(k, side);
    const double error = mode.row_[k].error;
    const bool low_holds = lower(row[k].e - row[k].g) > error, high_holds = lower(row[k].e + row[k].g) > error;
    if (low_holds && high_holds) continue;
    if (lower(row[k].g) >= -error && (high_holds || leave_open(corner(k, true), of_rows)))
      rising[risings++] = k;
    else if (upper(row[k].g) <= error && (low_holds || leave_open(corner(k, false), of_rows)))
      falling[fallings++] = k;
    else
      return false;
  }
  for (int i = 0; i < risings; ++i)
    for (int j = 0; j < fallings; ++j)
      if (!pair_holds(rising[i], falling[j])) return false;
  return true;
}

bool SignedMode::SideConditions::pair_holds(int i, int j) {
  if (mode.positive(row[i].g * row[j].e - row[j].g * row[i].e, mode.product_error(i, j))) return true;
  CurveId id = side;
  id.a = static_cast<signed char>(std::min(i, j)), id.b = static_cast<signed char>(std::max(i, j));
  return leave_open(id, i < j ? -1 : 1);
}

}  // namespace surefoot::stability
