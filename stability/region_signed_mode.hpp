// The rows of a mode on a rectangle with the sign of D given, and the certificates of region_rectangle.hpp on them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "stability/region_margin.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {

using Conic = Bivariate<2>;

/// A row on the rectangle, times the sign of D.
struct LocalRow {
  Form<Conic> form;
  double error = 0;  // of the row's value anywhere on the rectangle and on W
};

inline Conic at_wrench(const LocalRow& row, double u, double w) {
  Conic f;
  for (int k = 0; k < f.size; ++k) f.c[k] = row.form.one.c[k] + u * row.form.u.c[k] + w * row.form.w.c[k];
  return f;
}
inline Form<double> at_point(const LocalRow& row, double sigma, double tau) {
  const auto value = [&](const Conic& f) {
    return f.c[0] + sigma * (f.c[1] + sigma * f.c[3] + tau * f.c[4]) + tau * (f.c[2] + tau * f.c[5]);
  };
  return {value(row.form.u), value(row.form.one), value(row.form.w)};
}

template <int D>
double value_at(const Bivariate<D>& f, double sigma, double tau) {
  double sum = 0;
  for (int n = D; n >= 0; --n) {  // by powers of tau
    double inner = 0;
    for (int i = D - n; i >= 0; --i) inner = inner * sigma + f.c[place(i, n)];
    sum = sum * tau + inner;
  }
  return sum;
}

class SignedMode {
 public:
  /// `denominator`: D where it changes sign; rows then count only where sign * D > 0.
  SignedMode(const RegionMode& mode, const Rectangle& rectangle, double sign, std::span<const Conic> edges,
             const Conic* denominator);

  /// In the middle of the rectangle, or of that part of it where the denominator is positive.
  Margin margin_in_middle() const { return margin_at(sigma_, tau_); }
  void decide(const Margin& in_middle, bool curves, ModePart& part, double& strip) const;

 private:
  Margin margin_at(double sigma, double tau) const;

  /// f > 0 on the rectangle; with a denominator, where that is positive: there f >= f - z D for z >= 0.
  bool positive(const Conic& f, double error) const;
  /// f < 0 on the rectangle within the polygon, but for a strip along an edge; with a denominator, where that is
  /// positive.
  bool negative(const Conic& f, double error, double& strip) const;
  static constexpr double widest_strip = 1e-6;

  bool witnessed(double u, double w, double& strip) const;

  /// Part of W.
  struct Box {
    std::array<double, 2> u{-1, 1}, w{-1, 1};
    bool empty = false;
  };
  /// W without what one row alone excludes on all of the rectangle.
  Box remaining_box() const;
  bool excluded(const Margin& m, const Box& box, double& strip) const;

  /// The basis where the boundary is near the middle: the curve of the basis in the middle is followed to its zero.
  Margin margin_on_curve(Margin m) const;

  Poly2 jet(const CurveId& id, double sigma, double tau) const;

  // ---- curves -----------------------------------------------------------------------------------------------------

  /// By the curves of a side that a basis lies on, or of two sides that meet there; or within W.
  bool by_curves(const CurveId& id, ModePart& part) const;

  /// A row on a side: e + g times the free coordinate.
  struct SideRow {
    Conic e, g, opposite;  // opposite: e on the opposite side
  };
  SideRow on_side(int k, const CurveId& id) const;
  /// Bounds |f g| from above, for error bounds of products of rows.
  double size(int k) const;
  double product_error(int i, int j) const { return 4 * (row_[i].error * size(j) + row_[j].error * size(i)); }

  /// Two rows on a side, i with a rising slot, j with a falling one; none unless they are so on all of the rectangle.
  struct SidePair {
    int up = 0, down = 0;
    SideRow i, j;
    /// |g_j| row_i + |g_i| row_j, constant along the side, and the same on the opposite side
    Bivariate<4> sum, opposite;
  };
  std::optional<SidePair> side_pair(const CurveId& id) const;
  /// On a side the rows that can vanish bound the free coordinate from below (slot g > 0) or from above: some point is
  /// left iff every bound from below is less than every bound from above, 1 and -1 among them. `open` are those of
  /// these conditions that are not shown to hold; together they are sufficient.
  struct SideConditions {
    static constexpr int most = 4;
    struct Open : CurveCondition {
      bool necessary = false;
    };
    const SignedMode& mode;
    CurveId side;
    std::array<SideRow, 6> row;
    std::array<int, 6> rising, falling;
    int risings = 0, fallings = 0, opens = 0;
    std::array<Open, most> open;
    SideConditions(const SignedMode& m, int at)
        : mode(m), side{CurveId::side, -1, 0, 0, -1, static_cast<std::int8_t>(at)} {}

    bool collect();
    bool pair_holds(int i, int j);
    bool leave_open(const CurveId& id, std::int8_t holds) {
      if (opens == most) return false;
      open[opens++] = {{id, holds}, false};
      return true;
    }
    CurveId corner(int k, bool high) const {
      const int end = side.place & 1, free = high ? 1 : 0;
      const int at = side.place < 2 ? end + 2 * free : free + 2 * end;
      return {CurveId::corner, -1, static_cast<std::int8_t>(k), -1, -1, static_cast<std::int8_t>(at)};
    }
    /// The corner of W to which all conditions belong that are not necessary; -1: there are others, or none.
    int corner_in_doubt() const;
    std::span<const Open> listed() const { return {open.data(), static_cast<std::size_t>(opens)}; }
  };
  /// If all conditions of the side are necessary. Otherwise kept in `conditions`, if they are known.
  bool by_side(int side, std::optional<SideConditions>& conditions, ModePart& part) const;
  /// Two sides of W that meet in a corner: neither may hold only where rows i and j are both <= 0 at the corner, and
  /// then their sum that is constant along one side is, too, if that is necessary.
  bool by_two_sides(const SideConditions& one, const SideConditions& other, ModePart& part) const;
  /// Where the condition fails, the multipliers of its basis exclude all of `box`.
  bool necessary(const CurveId& id, const Box& box) const;
  /// By the multipliers of the basis as functions of the COM.
  bool excluded_by_basis(const CurveId& id) const;
  /// All determinants of two rows of a mode have the factor D: for a slide with u = M^-1 s, G_A ~ M^-1 (u x (A x N)),
  ///   G_A x G_B ~ D (N . (A x B)) s    and    G_A x G_N ~ D M (A x N),
  /// for two slides likewise D s and D M c. What is left after division is linear in the COM; where it keeps its sign,
  /// rows that close up on D = 0 leave a channel there, or none. Feasible everywhere or nowhere where D > 0.
  bool beside_denominator(ModePart& part) const;
  bool beside_denominator(const CurveId& id, ModePart& part) const;
  /// f > 0 on the rectangle; with a denominator, where that is positive.
  bool positive(const Bivariate<4>& f, double error) const;
  /// Multipliers of three rows, all of one sign; 0 if they are not on all of the rectangle.
  double multipliers(const int at[3], std::array<Bivariate<4>, 3>& y) const;
  bool excluded_inside(const CurveId& id) const;
  bool within(const CurveId& id, ModePart& part) const;
  /// Where rows k + 1 and k + 2 of the three vanish: u = x / y_k, w = z / y_k.
  bool vertex_free_of_others(const int at[3], int k, const Bivariate<4>& given, double sign) const;

  std::array<LocalRow, 6> row_;
  std::span<const Conic> edges_;
  std::optional<Conic> denominator_;
  double sigma_ = 0, tau_ = 0;
  int count_;
  double sign_;
};

}  // namespace surefoot::stability
