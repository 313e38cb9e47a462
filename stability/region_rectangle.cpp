#include "stability/region_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "stability/region_covector.hpp"
#include "stability/region_signed_mode.hpp"

namespace surefoot::stability {
namespace {

ModeThere known(ModePart::Kind kind) {
  ModeThere there;
  there.kind = kind;
  return there;
}

ModeThere with_one_sign(const SignedMode& mode, bool curves) {
  ModeThere there;
  const Margin margin = mode.margin_in_middle();
  there.feasible_in_middle = margin.value > 0;
  mode.decide(margin, curves, there.part[0], there.strip);
  there.kind = there.part[0].kind;
  return there;
}

/// Where D changes its sign. A covector does not notice; otherwise both signs, that of the middle first.
ModeThere with_both_signs(const RegionModes& modes, int index, const Rectangle& rectangle, std::span<const Conic> edges,
                          const Conic& d, bool curves) {
  ModeThere there;
  there.denominator = true;
  const int middle = d.c[0] > 0 ? 0 : 1;
  for (const int k : {middle, 1 - middle}) {
    const SignedMode part(modes.modes()[index], rectangle, k == 0 ? 1 : -1, edges, &d);
    const Margin margin = part.margin_in_middle();
    if (k == middle) {
      there.feasible_in_middle = margin.value > 0;
      if (!there.feasible_in_middle && excluded_by_covector(modes, index, rectangle)) return known(ModePart::nowhere);
    }
    part.decide(margin, curves, there.part[k], there.strip);
    if (there.part[k].kind == ModePart::unknown) return there;
  }
  there.summarise();
  return there;
}

}  // namespace

void ModeThere::summarise() {
  kind = part[0].kind;
  if (!denominator) return;
  if (kind == ModePart::unknown || part[1].kind == ModePart::unknown) kind = ModePart::unknown;
  else if (kind != part[1].kind) kind = ModePart::by_curves;
}

ModeThere mode_there(const RegionModes& modes, int index, const Rectangle& rectangle, std::span<const Conic> edges,
                     bool curves) {
  const RegionMode& mode = modes.modes()[index];
  if (mode.impossible) return known(ModePart::nowhere);
  ModeThere there;
  const Conic d = mode.has_denominator ? local(mode.denominator, rectangle) : Conic{{1, 0, 0, 0, 0, 0}};
  const double error = mode.has_denominator ? local_error(mode.denominator, rectangle) : 0;
  if (lower(d) > error || upper(d) < -error) {
    there = with_one_sign(SignedMode(mode, rectangle, d.c[0] > 0 ? 1 : -1, edges, nullptr), curves);
    if (there.kind == ModePart::unknown && mode.has_denominator && !there.feasible_in_middle &&
        excluded_by_covector(modes, index, rectangle))
      return known(ModePart::nowhere);
  } else {
    there = with_both_signs(modes, index, rectangle, edges, d, curves);
  }
  for (ModePart& part : there.part)
    for (int k = 0; k < part.count; ++k) part.condition[k].curve.mode = static_cast<std::int8_t>(index);
  return there;
}

CurvePolynomial curve_there(const RegionModes& modes, const CurveId& id, const Rectangle& rectangle) {
  const auto conic = [&](const Poly2& f) {
    return CurvePolynomial::of(local(f, rectangle), local_error(f, rectangle));
  };
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
    const Conic ei = at_wrench(i, free_w ? end : 0, free_w ? 0 : end),
                ej = at_wrench(j, free_w ? end : 0, free_w ? 0 : end);
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
