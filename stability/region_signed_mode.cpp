#include "stability/region_signed_mode.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {

SignedMode::SignedMode(const RegionMode& mode, const Rectangle& rectangle, double sign, std::span<const Conic> edges,
                       const Conic* denominator)
    : edges_(edges), count_(mode.count), sign_(sign) {
  if (denominator != nullptr) {
    denominator_ = *denominator * sign;
    const double d = denominator_->c[0], ds = denominator_->c[1], dt = denominator_->c[2];
    const double slope = ds * ds + dt * dt, steepest = std::max(std::abs(ds), std::abs(dt));
    // Along the gradient D vanishes after -d / slope and the rectangle ends after 1 / steepest; half-way between them.
    const double along = d < 0 && slope > 0 ? std::min(0.5 * (1 / steepest - d / slope), 1 / steepest) : 0;
    sigma_ = along * ds, tau_ = along * dt;
  }
  for (int k = 0; k < count_; ++k) {
    const Form<Poly2>& f = mode.row[k].form;
    LocalRow& row = row_[k];
    row.form = {local(f.u, rectangle) * sign, local(f.one, rectangle) * sign, local(f.w, rectangle) * sign};
    row.error = local_error(f.u, rectangle) + local_error(f.one, rectangle) + local_error(f.w, rectangle);
  }
}

void SignedMode::decide(const Margin& m, bool curves, ModePart& part, double& strip) const {
  const bool feasible = m.value > 0;
  double own = 0;
  const auto is_nowhere = [&] {
    if (excluded(m, {}, own) || excluded_by_basis(m.basis)) return true;
    const Box box = remaining_box();
    return box.empty || excluded(m, box, own);
  };
  if (m.count == 0 || (feasible && witnessed(m.u, m.w, own))) part.kind = ModePart::everywhere;
  else if (!feasible && is_nowhere()) part.kind = ModePart::nowhere;
  if (part.kind == ModePart::unknown && curves && !(denominator_ && beside_denominator(part))) {
    const Margin near = margin_on_curve(m);
    own = 0;
    if (!feasible && !(near.value > 0) && !(near.basis == m.basis) && excluded(near, {}, own))
      part.kind = ModePart::nowhere;
    else by_curves(near.basis, part);
  }
  if (part.kind == ModePart::nowhere || part.kind == ModePart::everywhere) strip += own;
}

Margin SignedMode::margin_at(double sigma, double tau) const {
  std::array<Form<double>, 6> g;
  for (int k = 0; k < count_; ++k) g[k] = at_point(row_[k], sigma, tau);
  return margin(g.data(), count_);
}

namespace {

/// z such that f + z e has the least slope in the middle.
double balance(const Conic& f, const Conic& e) {
  return -(f.c[1] * e.c[1] + f.c[2] * e.c[2]) / (e.c[1] * e.c[1] + e.c[2] * e.c[2]);
}

}  // namespace

bool SignedMode::positive(const Conic& f, double error) const {
  if (lower(f) > error) return true;
  if (!denominator_) return false;
  constexpr double rounding = 1e-14;  // of D and of the sum
  const double z = -balance(f, *denominator_);
  return z > 0 && lower(f - *denominator_ * z) > error + rounding * z * magnitude(*denominator_);
}

bool SignedMode::negative(const Conic& f, double error, double& strip) const {
  if (positive(f * -1, error)) return true;
  for (const Conic& e : edges_) {
    const double z = balance(f, e);
    if (!(z > 0) || !(upper(f + e * z) <= error)) continue;
    const double part = error / (z * std::max(std::abs(e.c[1]), std::abs(e.c[2])));
    if (!(part < widest_strip)) continue;
    strip += part;
    return true;
  }
  return false;
}

bool SignedMode::witnessed(double u, double w, double& strip) const {
  for (int k = 0; k < count_; ++k)
    if (!negative(at_wrench(row_[k], u, w) * -1, row_[k].error, strip)) return false;
  return true;
}

SignedMode::Box SignedMode::remaining_box() const {
  Box box;
  constexpr double room = 1e-12;  // for rounding, of numbers of size 1
  for (int k = 0; k < count_; ++k) {
    const LocalRow& row = row_[k];
    const auto cut = [&](const Conic& slot, const Conic& a, const Conic& b, std::array<double, 2>& range) {
      const double least = lower(slot), greatest = upper(slot), top = std::max(upper(a), upper(b)) + row.error;
      const double weakest =
          top > 0 ? std::min(std::abs(least), std::abs(greatest)) : std::max(std::abs(least), std::abs(greatest));
      const double end = -top / weakest;  // of what is excluded, in the sense in which the row grows
      if ((least > 0 || greatest < 0) && end > 1 + room) box.empty = true;
      if (top < 0 && top + std::max(std::abs(least), std::abs(greatest)) < 0) box.empty = true;
      if (least > 0) range[0] = std::clamp(end - room, range[0], range[1]);
      if (greatest < 0) range[1] = std::clamp(room - end, range[0], range[1]);
    };
    cut(row.form.u, at_wrench(row, 0, -1), at_wrench(row, 0, 1), box.u);
    cut(row.form.w, at_wrench(row, -1, 0), at_wrench(row, 1, 0), box.w);
  }
  return box;
}

bool SignedMode::excluded(const Margin& m, const Box& box, double& strip) const {
  LocalRow sum;
  for (int k = 0; k < m.count; ++k) {
    const LocalRow& row = row_[m.basis.row(k)];
    sum.form = {sum.form.u + row.form.u * m.y[k], sum.form.one + row.form.one * m.y[k],
                sum.form.w + row.form.w * m.y[k]};
    sum.error += row.error * m.y[k];
  }
  for (const double u : box.u)
    for (const double w : box.w)
      if (!negative(at_wrench(sum, u, w), sum.error, strip)) return false;
  return true;
}

Margin SignedMode::margin_on_curve(Margin m) const {
  double sigma = sigma_, tau = tau_;
  constexpr int attempts = 2;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (m.basis.kind == CurveId::denominator || m.basis.kind == CurveId::edge) break;
    const Poly2 f = jet(m.basis, sigma, tau);
    const double slope = f.s * f.s + f.t * f.t;
    if (!(slope > 0)) break;
    sigma = std::clamp(sigma - f.c * f.s / slope, -1.0, 1.0);
    tau = std::clamp(tau - f.c * f.t / slope, -1.0, 1.0);
    const Margin there = margin_at(sigma, tau);
    const bool settled = there.basis == m.basis;
    m = there;
    if (settled) break;
  }
  return m;
}

Poly2 SignedMode::jet(const CurveId& id, double sigma, double tau) const {
  return curve_value<Poly2>(id, [&](int k) {
    const auto poly = [&](const Conic& f) {
      return Poly2(f.c[0], f.c[1], f.c[2], f.c[3], f.c[4], f.c[5]).about(sigma, tau);
    };
    return Form<Poly2>{poly(row_[k].form.u), poly(row_[k].form.one), poly(row_[k].form.w)};
  });
}

bool SignedMode::excluded_by_basis(const CurveId& id) const {
  if (id.kind == CurveId::inside) return excluded_inside(id);
  if (id.kind != CurveId::side) return false;
  const std::optional<SidePair> pair = side_pair(id);
  if (!pair) return false;
  const double error = product_error(pair->up, pair->down);
  return upper(pair->sum) < -error && upper(pair->opposite) < -error;
}

double SignedMode::multipliers(const int at[3], std::array<Bivariate<4>, 3>& y) const {
  for (int k = 0; k < 3; ++k) {
    const Form<Conic>&f = row_[at[(k + 1) % 3]].form, &g = row_[at[(k + 2) % 3]].form;
    y[k] = f.u * g.w - f.w * g.u;
  }
  const double sign = y[0].c[0] > 0 ? 1 : -1;
  for (int k = 0; k < 3; ++k)
    if (!(lower(y[k] * sign) > product_error(at[(k + 1) % 3], at[(k + 2) % 3]))) return 0;
  return sign;
}

bool SignedMode::excluded_inside(const CurveId& id) const {
  const int at[3] = {id.a, id.b, id.c};
  std::array<Bivariate<4>, 3> y;
  const double sign = multipliers(at, y);
  if (sign == 0) return false;
  const Bivariate<6> sum = y[0] * row_[at[0]].form.one + y[1] * row_[at[1]].form.one + y[2] * row_[at[2]].form.one;
  const double error = product_error(at[0], at[1]) * size(at[2]) + product_error(at[1], at[2]) * size(at[0]);
  return upper(sum * sign) < -2 * error;
}

bool SignedMode::within(const CurveId& id, ModePart& part) const {
  const int at[3] = {id.a, id.b, id.c};
  std::array<Bivariate<4>, 3> y;
  const double sign = multipliers(at, y);
  if (sign == 0) return false;
  bool free = false;
  for (int k = 0; k < 3 && !free; ++k) free = vertex_free_of_others(at, k, y[k], sign);
  if (!free) return false;
  part.kind = ModePart::by_curves, part.count = 1;
  part.condition[0] = {id, static_cast<std::int8_t>(sign * sign_)};
  return true;
}

bool SignedMode::vertex_free_of_others(const int at[3], int k, const Bivariate<4>& given, double sign) const {
  const int i = at[(k + 1) % 3], j = at[(k + 2) % 3];
  const Form<Conic>&f = row_[i].form, &g = row_[j].form;
  const Bivariate<4> y = given * sign, x = (f.w * g.one - f.one * g.w) * sign, z = (f.one * g.u - f.u * g.one) * sign;
  const double error = product_error(i, j);
  for (const auto& coordinate : {x, z})
    if (!(lower(y - coordinate) > error) || !(lower(y + coordinate) > error)) return false;
  for (int l = 0; l < count_; ++l) {
    if (l == at[0] || l == at[1] || l == at[2]) continue;
    const Form<Conic>& h = row_[l].form;
    const double of_products = error * size(l) + 4 * row_[l].error * size(i) * size(j);
    if (!(lower(y * h.one + x * h.u + z * h.w) > of_products)) return false;
  }
  return true;
}

}  // namespace surefoot::stability
