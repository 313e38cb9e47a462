#include "stability/region_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stability/polynomial_frame.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

/// Takes rows of rows.hpp as polynomials, with the centre of the box moved to (0, 0) and its sides scaled to 1.
class PolySink {
 public:
  PolySink(RegionMode& mode, const WrenchBox& box) : mode_(mode), box_(box) {}
  void denominator(const Poly2& d) {
    mode_.has_denominator = true;
    mode_.denominator = d;
  }
  bool add(const Row<Poly2>& row) {
    const Poly2 one = row.one + row.p * box_.centre.p + row.q * box_.centre.q;
    const double given = std::max({row.p.size(), row.one.size(), row.q.size()});
    if (!(given > 0)) {  // theory section 4: a row that vanishes is dropped
      mode_.row[mode_.count++] = {};
      return false;
    }
    mode_.row[mode_.count++].form = {row.p * box_.kappa, one, row.q * box_.nu};
    const Form<Poly2>& scaled = mode_.row[mode_.count - 1].form;
    if (!(std::max({scaled.u.size(), scaled.one.size(), scaled.w.size()}) > 0))
      mode_.impossible = true;  // 0 > 0 on all of W
    return false;
  }
  bool add_length(const Row<Poly2>& row) { return add(row); }

 private:
  RegionMode& mode_;
  const WrenchBox& box_;
};

/// Meanings in the order in which emit_rows hands out rows.
void name_rows(RegionMode& mode, int contacts) {
  int k = 0;
  const auto name = [&](RowMeaning meaning, int contact) {
    mode.row[k].meaning = meaning;
    mode.row[k++].contact = static_cast<std::int8_t>(contact);
  };
  const ModeSpec& spec = mode.spec;
  switch (spec.kind) {
    case ModeSpec::Kind::all_break:
      for (int l = 0; l < contacts; ++l) name(RowMeaning::lifts, l);
      return;
    case ModeSpec::Kind::roll:
      if (spec.sense != 0) name(RowMeaning::turns, spec.i);
      name(RowMeaning::cone_w, spec.i);
      name(RowMeaning::cone_u, spec.i);
      return;
    case ModeSpec::Kind::slide:
      name(RowMeaning::slides, spec.i);
      for (int l = 0; l < contacts; ++l)
        if (l != spec.i && !spec.row_vanishes[l]) name(RowMeaning::lifts, l);
      name(RowMeaning::pushes, spec.i);
      return;
    case ModeSpec::Kind::two_slides:
      if (spec.sense != 0) name(RowMeaning::moves, spec.i);
      name(RowMeaning::pushes, spec.i);
      name(RowMeaning::pushes, spec.j);
      return;
  }
}

double size_of(const Form<Poly2>& f) { return std::max({f.u.size(), f.one.size(), f.w.size()}); }

bool nearly_equal(const Poly2& a, const Poly2& b) { return (a - b).size() <= equal_rows; }

/// Rows scaled to size 1; those that vanish identically or repeat an earlier one are left out. Two rows that are
/// opposite everywhere exclude the mode for every COM.
void tidy(RegionMode& mode) {
  int kept = 0;
  for (int k = 0; k < mode.count; ++k) {
    RegionRow row = mode.row[k];
    const double size = size_of(row.form);
    if (!(size > 0)) continue;
    row.form = {row.form.u * (1 / size), row.form.one * (1 / size), row.form.w * (1 / size)};
    const auto same = [&](const RegionRow& other) {
      return nearly_equal(row.form.u, other.form.u) && nearly_equal(row.form.one, other.form.one) &&
             nearly_equal(row.form.w, other.form.w);
    };
    if (std::any_of(mode.row.begin(), mode.row.begin() + kept, same)) continue;
    const auto opposite = [&](const RegionRow& other) {
      return nearly_equal(row.form.u, -other.form.u) && nearly_equal(row.form.one, -other.form.one) &&
             nearly_equal(row.form.w, -other.form.w);
    };
    if (std::any_of(mode.row.begin(), mode.row.begin() + kept, opposite)) mode.impossible = true;
    mode.row[kept++] = row;
  }
  mode.count = kept;
}

}  // namespace

// ---- modes ------------------------------------------------------------------------------------------------------

RegionModes::RegionModes(const Posture& posture, const WrenchBox& box, const Vector2d& origin, const Vector2d& e_t)
    : posture_(posture), box_(box), line_(posture_, {box.kappa, box.nu}, 0), origin_(origin), e_s_(e_t.y(), -e_t.x()),
      e_t_(e_t) {
  const Frame<Poly2> frame = frame_around(posture, origin, e_s_, e_t_);
  modes_.reserve(posture.modes().size());
  for (const ModeSpec& spec : posture.modes()) {
    add(frame, spec, posture.contacts());
    certificates_.emplace_back(line_, spec);
  }
}

void RegionModes::add(const Frame<Poly2>& frame, const ModeSpec& spec, int contacts) {
  RegionMode& mode = modes_.emplace_back();
  mode.spec = spec;
  mode.mode = contact_mode(spec, contacts);
  PolySink sink(mode, box_);
  emit_rows(frame, spec, sink);
  name_rows(mode, contacts);
  tidy(mode);
}

Poly2 RegionModes::curve(const CurveId& id, double s, double t) const {
  if (id.kind == CurveId::edge) return edges_[id.a].about(s, t);
  const RegionMode& mode = modes_[id.mode];
  if (id.kind == CurveId::denominator) return mode.denominator.about(s, t);
  return curve_value<Poly2>(id, [&](int k) {
    const Form<Poly2>& f = mode.row[k].form;
    return Form<Poly2>{f.u.about(s, t), f.one.about(s, t), f.w.about(s, t)};
  });
}

}  // namespace surefoot::stability
