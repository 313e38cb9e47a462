#include "stability/region_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stability/region_covector.hpp"
#include "stability/region_margin.hpp"

namespace surefoot::stability {
namespace {

using Conic = Bivariate<2>;

/// A row on the rectangle, times the sign of D.
struct LocalRow {
  Form<Conic> form;
  double error = 0;  // of the row's value anywhere on the rectangle and on W
};

Conic at_wrench(const LocalRow& row, double u, double w) {
  Conic f;
  for (int k = 0; k < f.size; ++k) f.c[k] = row.form.one.c[k] + u * row.form.u.c[k] + w * row.form.w.c[k];
  return f;
}
Form<double> at_point(const LocalRow& row, double sigma, double tau) {
  const auto value = [&](const Conic& f) {
    return f.c[0] + sigma * (f.c[1] + sigma * f.c[3] + tau * f.c[4]) + tau * (f.c[2] + tau * f.c[5]);
  };
  return {value(row.form.u), value(row.form.one), value(row.form.w)};
}

class SignedMode {
 public:
  /// `denominator`: D where it changes sign; rows then count only where sign * D > 0.
  SignedMode(const RegionMode& mode, const Rectangle& rectangle, double sign, std::span<const Conic> edges,
             const Conic* denominator)
      : edges_(edges), count_(mode.count), sign_(sign) {
    if (denominator != nullptr) denominator_ = *denominator * sign;
    for (int k = 0; k < count_; ++k) {
      const Form<Poly2>& f = mode.row[k].form;
      LocalRow& row = row_[k];
      row.form = {local(f.u, rectangle) * sign, local(f.one, rectangle) * sign, local(f.w, rectangle) * sign};
      row.error = local_error(f.u, rectangle) + local_error(f.one, rectangle) + local_error(f.w, rectangle);
    }
  }

  ModeThere decide() const {
    const Margin m = margin_at(0, 0);
    ModeThere there;
    there.feasible_in_middle = m.value > 0;
    if (m.count == 0 || (m.value > 0 && witnessed(m.u, m.w, there.strip))) {
      there.kind = ModeThere::everywhere;
      return there;
    }
    if (m.value <= 0 && (excluded(m, there.strip) || excluded_by_basis(m.basis))) {
      there.kind = ModeThere::nowhere;
      return there;
    }
    if (denominator_ && beside_denominator(there)) return there;
    const Margin at_curve = margin_on_curve(m);
    if (!single_curve(at_curve.basis, there)) there.kind = ModeThere::unknown;
    return there;
  }

 private:
  Margin margin_at(double sigma, double tau) const {
    std::array<Form<double>, 6> g;
    for (int k = 0; k < count_; ++k) g[k] = at_point(row_[k], sigma, tau);
    return margin(g.data(), count_);
  }

  /// f < 0 on the rectangle within the polygon, but for a strip along an edge.
  bool negative(const Conic& f, double error, double& strip) const {
    if (upper(f) < -error) return true;
    for (const Conic& e : edges_) {
      const double slope = e.c[1] * e.c[1] + e.c[2] * e.c[2], z = -(f.c[1] * e.c[1] + f.c[2] * e.c[2]) / slope;
      if (!(z > 0) || !(upper(f + e * z) <= error)) continue;
      const double part = error / (z * std::max(std::abs(e.c[1]), std::abs(e.c[2])));
      if (!(part < widest_strip)) continue;
      strip += part;
      return true;
    }
    return false;
  }
  static constexpr double widest_strip = 1e-6;

  bool witnessed(double u, double w, double& strip) const {
    for (int k = 0; k < count_; ++k)
      if (!negative(at_wrench(row_[k], u, w) * -1, row_[k].error, strip)) return false;
    return true;
  }

  bool excluded(const Margin& m, double& strip) const {
    LocalRow sum;
    const signed char basis[3] = {m.basis.a, m.basis.b, m.basis.c};
    for (int k = 0; k < m.count; ++k) {
      const LocalRow& row = row_[basis[k]];
      sum.form = {sum.form.u + row.form.u * m.y[k], sum.form.one + row.form.one * m.y[k], sum.form.w + row.form.w * m.y[k]};
      sum.error += row.error * m.y[k];
    }
    for (const double u : {-1.0, 1.0})
      for (const double w : {-1.0, 1.0})
        if (!negative(at_wrench(sum, u, w), sum.error, strip)) return false;
    return true;
  }

  /// The basis where the boundary is near the middle: the curve of the basis in the middle is followed to its zero.
  Margin margin_on_curve(Margin m) const {
    double sigma = 0, tau = 0;
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

  Poly2 jet(const CurveId& id, double sigma, double tau) const {
    return curve_value<Poly2>(id, [&](int k) {
      const auto poly = [&](const Conic& f) {
        return Poly2(f.c[0], f.c[1], f.c[2], f.c[3], f.c[4], f.c[5]).about(sigma, tau);
      };
      return Form<Poly2>{poly(row_[k].form.u), poly(row_[k].form.one), poly(row_[k].form.w)};
    });
  }

  // ---- one curve --------------------------------------------------------------------------------------------------

  /// On the sides that a basis lies on; or within.
  bool single_curve(const CurveId& id, ModeThere& there) const {
    switch (id.kind) {
      case CurveId::corner: return on_side(id.place & 1 ? 1 : 0, there) || on_side(id.place & 2 ? 3 : 2, there);
      case CurveId::side: return on_side(id.place, there);
      case CurveId::inside: return within(id, there);
      default: return false;
    }
  }

  /// A row on a side: e + g times the free coordinate.
  struct SideRow {
    Conic e, g, opposite;  // opposite: e on the opposite side
  };
  SideRow on_side(int k, const CurveId& id) const {
    const double end = id.place & 1 ? 1 : -1;
    const bool free_w = id.place < 2;
    const LocalRow& row = row_[k];
    return {at_wrench(row, free_w ? end : 0, free_w ? 0 : end), free_w ? row.form.w : row.form.u,
            at_wrench(row, free_w ? -end : 0, free_w ? 0 : -end)};
  }
  /// Bounds |f g| from above, for error bounds of products of rows.
  double size(int k) const {
    return magnitude(row_[k].form.u) + magnitude(row_[k].form.one) + magnitude(row_[k].form.w);
  }
  double product_error(int i, int j) const { return 4 * (row_[i].error * size(j) + row_[j].error * size(i)); }

  /// Two rows on a side, i with a rising slot, j with a falling one; none unless they are so on all of the rectangle.
  struct SidePair {
    int up = 0, down = 0;
    SideRow i, j;
    /// |g_j| row_i + |g_i| row_j, constant along the side, and the same on the opposite side
    Bivariate<4> sum, opposite;
  };
  std::optional<SidePair> side_pair(const CurveId& id) const {
    const SideRow one = on_side(id.a, id), two = on_side(id.b, id);
    const bool rising = one.g.c[0] > 0;  // row a
    SidePair pair{rising ? id.a : id.b, rising ? id.b : id.a, rising ? one : two, rising ? two : one, {}, {}};
    if (!(lower(pair.i.g) > row_[pair.up].error) || !(upper(pair.j.g) < -row_[pair.down].error)) return std::nullopt;
    pair.sum = pair.i.g * pair.j.e - pair.j.g * pair.i.e;
    pair.opposite = pair.i.g * pair.j.opposite - pair.j.g * pair.i.opposite;
    return pair;
  }
  /// On a side the rows that can vanish bound the free coordinate from below (slot g > 0) or from above: some point is
  /// left iff every bound from below is less than every bound from above, 1 and -1 among them. Of these conditions all
  /// are shown to hold but one at most, and where that fails, the rows exclude the mode on all of W.
  bool on_side(int side, ModeThere& there) const {
    SideConditions conditions(*this, side);
    if (!conditions.collect()) return false;
    there.kind = ModeThere::everywhere;
    if (!conditions.open) return true;
    there.kind = ModeThere::beyond_curve;
    there.curve = *conditions.open;
    there.sign = conditions.sign;
    return fails_everywhere(*conditions.open);
  }
  struct SideConditions {
    const SignedMode& mode;
    CurveId side;
    std::array<SideRow, 6> row{};
    std::array<int, 6> rising{}, falling{};
    int risings = 0, fallings = 0;
    std::optional<CurveId> open;  ///< the one not shown to hold
    signed char sign = 1;         ///< it holds where sign * curve > 0
    SideConditions(const SignedMode& m, int at) : mode(m), side{CurveId::side, -1, 0, 0, -1, static_cast<signed char>(at)} {}

    bool collect() {
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
    bool pair_holds(int i, int j) {
      if (mode.positive(row[i].g * row[j].e - row[j].g * row[i].e, mode.product_error(i, j))) return true;
      CurveId id = side;
      id.a = static_cast<signed char>(std::min(i, j)), id.b = static_cast<signed char>(std::max(i, j));
      return leave_open(id, i < j ? -1 : 1);
    }
    bool leave_open(const CurveId& id, signed char holds) {
      if (open) return false;
      open = id;
      sign = holds;
      return true;
    }
    CurveId corner(int k, bool high) const {
      const int end = side.place & 1, free = high ? 1 : 0;
      const int at = side.place < 2 ? end + 2 * free : free + 2 * end;
      return {CurveId::corner, -1, static_cast<signed char>(k), -1, -1, static_cast<signed char>(at)};
    }
  };
  bool fails_everywhere(const CurveId& id) const {
    if (id.kind == CurveId::corner) {
      const LocalRow& row = row_[id.a];
      return lower(row.form.u * (id.place & 1 ? 1 : -1)) >= -row.error && lower(row.form.w * (id.place & 2 ? 1 : -1)) >= -row.error;
    }
    const std::optional<SidePair> pair = side_pair(id);
    return pair && lower(pair->sum - pair->opposite) >= -product_error(pair->up, pair->down);
  }
  /// By the multipliers of the basis as functions of the COM.
  bool excluded_by_basis(const CurveId& id) const {
    if (id.kind == CurveId::inside) return excluded_inside(id);
    if (id.kind != CurveId::side) return false;
    const std::optional<SidePair> pair = side_pair(id);
    if (!pair) return false;
    const double error = product_error(pair->up, pair->down);
    return upper(pair->sum) < -error && upper(pair->opposite) < -error;
  }
  /// All determinants of two rows of a mode have the factor D: for a slide with u = M^-1 s, G_A ~ M^-1 (u x (A x N)),
  ///   G_A x G_B ~ D (N . (A x B)) s    and    G_A x G_N ~ D M (A x N),
  /// for two slides likewise D s and D M c. What is left after division is linear in the COM; where it keeps its sign,
  /// rows that close up on D = 0 leave a channel there, or none. Feasible everywhere or nowhere where D > 0.
  bool beside_denominator(ModeThere& there) const {
    CurveId tried;
    for (const double sigma : {-1.0, 0.0, 1.0})
      for (const double tau : {-1.0, 0.0, 1.0}) {
        if (!(value(*denominator_, sigma, tau) > 0)) continue;
        const CurveId id = margin_at(sigma, tau).basis;
        if (id.kind != CurveId::side || id == tried) continue;
        tried = id;
        if (beside_denominator(id, there)) return true;
      }
    return false;
  }
  bool beside_denominator(const CurveId& id, ModeThere& there) const {
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
  /// f > 0 on the rectangle; with a denominator, where that is positive.
  bool positive(const Bivariate<4>& f, double error) const {
    if (lower(f) > error) return true;
    if (!denominator_) return false;
    // f = D (a + b sigma + c tau) by least squares at nine points, then checked by coefficients
    double n00 = 0, n01 = 0, n02 = 0, n11 = 0, n12 = 0, n22 = 0, m0 = 0, m1 = 0, m2 = 0;
    for (const double sigma : {-1.0, 0.0, 1.0})
      for (const double tau : {-1.0, 0.0, 1.0}) {
        const double d = value(*denominator_, sigma, tau), v = value(f, sigma, tau), w = d * d;
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
  template <int D>
  static double value(const Bivariate<D>& f, double sigma, double tau) {
    double sum = 0;
    for (int n = D; n >= 0; --n) {  // by powers of tau
      double inner = 0;
      for (int i = D - n; i >= 0; --i) inner = inner * sigma + f.c[place(i, n)];
      sum = sum * tau + inner;
    }
    return sum;
  }
  /// Multipliers of three rows, all of one sign; 0 if they are not on all of the rectangle.
  double multipliers(const int at[3], std::array<Bivariate<4>, 3>& y) const {
    for (int k = 0; k < 3; ++k) {
      const Form<Conic>&f = row_[at[(k + 1) % 3]].form, &g = row_[at[(k + 2) % 3]].form;
      y[k] = f.u * g.w - f.w * g.u;
    }
    const double sign = y[0].c[0] > 0 ? 1 : -1;
    for (int k = 0; k < 3; ++k)
      if (!(lower(y[k] * sign) > product_error(at[(k + 1) % 3], at[(k + 2) % 3]))) return 0;
    return sign;
  }
  bool excluded_inside(const CurveId& id) const {
    const int at[3] = {id.a, id.b, id.c};
    std::array<Bivariate<4>, 3> y;
    const double sign = multipliers(at, y);
    if (sign == 0) return false;
    const Bivariate<6> sum = y[0] * row_[at[0]].form.one + y[1] * row_[at[1]].form.one + y[2] * row_[at[2]].form.one;
    const double error = product_error(at[0], at[1]) * size(at[2]) + product_error(at[1], at[2]) * size(at[0]);
    return upper(sum * sign) < -2 * error;
  }
  bool within(const CurveId& id, ModeThere& there) const {
    const int at[3] = {id.a, id.b, id.c};
    std::array<Bivariate<4>, 3> y;
    const double sign = multipliers(at, y);
    if (sign == 0) return false;
    bool free = false;
    for (int k = 0; k < 3 && !free; ++k) free = vertex_free_of_others(at, k, y[k], sign);
    if (!free) return false;
    there.kind = ModeThere::beyond_curve;
    there.curve = id;
    there.sign = static_cast<signed char>(sign * sign_);
    return true;
  }
  /// Where rows k + 1 and k + 2 of the three vanish: u = x / y_k, w = z / y_k.
  bool vertex_free_of_others(const int at[3], int k, const Bivariate<4>& given, double sign) const {
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

  std::array<LocalRow, 6> row_;
  std::span<const Conic> edges_;
  std::optional<Conic> denominator_;
  int count_;
  double sign_;
};

ModeThere known(ModeThere::Kind kind) {
  ModeThere there;
  there.kind = kind;
  return there;
}

}  // namespace

ModeThere mode_there(const RegionModes& modes, int index, const Rectangle& rectangle, std::span<const Conic> edges) {
  const RegionMode& mode = modes.modes()[index];
  if (mode.impossible) return known(ModeThere::nowhere);
  ModeThere there;
  if (!mode.has_denominator) {
    there = SignedMode(mode, rectangle, 1, edges, nullptr).decide();
  } else {
    const Conic d = local(mode.denominator, rectangle);
    const double error = local_error(mode.denominator, rectangle);
    if (lower(d) > error || upper(d) < -error) {
      there = SignedMode(mode, rectangle, d.c[0] > 0 ? 1 : -1, edges, nullptr).decide();
    } else {
      const ModeThere plus = SignedMode(mode, rectangle, 1, edges, &d).decide(),
                      minus = SignedMode(mode, rectangle, -1, edges, &d).decide();
      there.feasible_in_middle = (d.c[0] > 0 ? plus : minus).feasible_in_middle;
      const bool decided = (plus.kind == ModeThere::nowhere || plus.kind == ModeThere::everywhere) &&
                           (minus.kind == ModeThere::nowhere || minus.kind == ModeThere::everywhere);
      there.strip = plus.strip + minus.strip;
      if (decided) {
        there.kind = plus.kind;
      }
      if (decided && plus.kind != minus.kind) {
        there.kind = ModeThere::beyond_curve;
        there.curve = {CurveId::denominator, -1, -1, -1, -1, 0};
        there.sign = plus.kind == ModeThere::everywhere ? 1 : -1;
      }
    }
    if (there.kind == ModeThere::unknown && !there.feasible_in_middle && excluded_by_covector(modes, index, rectangle))
      return known(ModeThere::nowhere);
  }
  there.curve.mode = static_cast<signed char>(index);
  return there;
}

CurvePolynomial curve_there(const RegionModes& modes, const CurveId& id, const Rectangle& rectangle) {
  const auto conic = [&](const Poly2& f) { return CurvePolynomial::of(local(f, rectangle), local_error(f, rectangle)); };
  if (id.kind == CurveId::edge) return conic(modes.edges()[id.a]);
  const RegionMode& mode = modes.modes()[id.mode];
  if (id.kind == CurveId::denominator) return conic(mode.denominator);
  const auto row = [&](int k) {
    const Form<Poly2>& f = mode.row[k].form;
    return LocalRow{{local(f.u, rectangle), local(f.one, rectangle), local(f.w, rectangle)},
                    local_error(f.u, rectangle) + local_error(f.one, rectangle) + local_error(f.w, rectangle)};
  };
  const auto size = [](const LocalRow& r) { return magnitude(r.form.u) + magnitude(r.form.one) + magnitude(r.form.w); };
  const LocalRow i = row(id.a);
  if (id.kind == CurveId::corner)
    return CurvePolynomial::of(at_wrench(i, id.place & 1 ? 1 : -1, id.place & 2 ? 1 : -1), i.error);
  const LocalRow j = row(id.b);
  const double products = 4 * (i.error * size(j) + j.error * size(i));
  if (id.kind == CurveId::side) {
    const double end = id.place & 1 ? 1 : -1;
    const bool free_w = id.place < 2;
    const Conic ei = at_wrench(i, free_w ? end : 0, free_w ? 0 : end), ej = at_wrench(j, free_w ? end : 0, free_w ? 0 : end);
    const Conic &gi = free_w ? i.form.w : i.form.u, &gj = free_w ? j.form.w : j.form.u;
    return CurvePolynomial::of(ei * gj - ej * gi, products);
  }
  const LocalRow k = row(id.c);
  const auto det = i.form.one * (j.form.u * k.form.w - j.form.w * k.form.u) -
                   i.form.u * (j.form.one * k.form.w - j.form.w * k.form.one) +
                   i.form.w * (j.form.one * k.form.u - j.form.u * k.form.one);
  return CurvePolynomial::of(det, products * size(k) + 4 * k.error * size(i) * size(j));
}

int sign_there(const CurvePolynomial& curve) {
  const auto sign = [&curve](const auto& f) { return lower(f) > curve.error ? 1 : upper(f) < -curve.error ? -1 : 0; };
  const auto part = [&curve](auto f) {
    std::copy_n(curve.f.c.begin(), f.c.size(), f.c.begin());
    return f;
  };
  if (curve.degree == 2) return sign(part(Bivariate<2>{}));
  if (curve.degree == 4) return sign(part(Bivariate<4>{}));
  return sign(curve.f);
}

}  // namespace surefoot::stability
