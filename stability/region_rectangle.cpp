#include "stability/region_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stability/region_covector.hpp"
#include "stability/region_signed_mode.hpp"

namespace surefoot::stability {
namespace {

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
