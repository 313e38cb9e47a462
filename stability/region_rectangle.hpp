// What a contact mode does in a rectangle of COMs, by certificates that hold in all of it:
//   nowhere       multipliers y >= 0 with sum y_k row_k < 0 on the rectangle and on W, or a covector of
//                 dual_certificate.hpp (where the denominator D changes sign)
//   everywhere    one wrench of W at which all rows are positive on the rectangle
//   by_curves     feasible exactly where sign * f > 0 for each of some curves f of bases (region_rows.hpp). By duality
//   a
//                 mode is infeasible iff the multipliers of one basis exclude it, so each curve must be
//                   necessary   where it fails, the multipliers of its basis, which are >= 0 on the rectangle, exclude
//                     corner      row k: its greatest value on W is at that corner everywhere
//                     side        rows i, j have slots g_i, g_j of opposite sign, so that |g_j| row_i + |g_i| row_j is
//                                 constant along the side, and it is no greater on the opposite one
//                     inside      y_i : y_j : y_k > 0 that make sum y row constant on W
//                 and all together
//                   sufficient  on a side of W some wrench is left; or on one of two sides that meet; or where two of
//                   the
//                               rows inside vanish, which lies in W, all others are positive
//                 Where the denominator D changes sign, both its signs are decided apart.
// Only the part of the rectangle in the polygon counts: where its edges e >= 0 cross the rectangle, f <= f + z e for
// z >= 0 bounds f there, so that modes which begin where the equilibrium ends (rolling over a foot) are decided.
//   unknown       none of these was found; halving the rectangle makes all of them sharper
// Rows are polynomials of degree 2: every condition is a bound of one of degree <= 6 on a rectangle. Doubles with a
// bound of their rounding error.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "stability/region_bivariate.hpp"
#include "stability/region_rows.hpp"

namespace surefoot::stability {

/// Holds where sign * curve > 0.
struct CurveCondition {
  CurveId curve;
  std::int8_t sign = 1;
};

/// A mode in a rectangle where its denominator has one sign.
struct ModePart {
  enum Kind : unsigned char { unknown, nowhere, everywhere, by_curves } kind = unknown;
  unsigned char count = 0;
  std::array<CurveCondition, 5> condition;  ///< by_curves: feasible where all hold
  std::span<const CurveCondition> conditions() const { return {condition.data(), count}; }
};

struct ModeThere {
  ModePart::Kind kind = ModePart::unknown;
  double strip = 0;                 ///< part of the rectangle, along an edge, in which `kind` is not certain: rounding
  bool feasible_in_middle = false;  ///< by doubles; meaningful for `unknown`
  bool denominator = false;         ///< D changes sign: part[0] where D > 0, part[1] where D < 0
  std::array<ModePart, 2> part;     ///< for by_curves, and what is known in part for `unknown`; one without D
  void summarise();                 ///< sets `kind` from the parts
};

/// `edges` of the polygon that cross the rectangle, in its local coordinates. Without `curves` by_curves is not tried.
ModeThere mode_there(const RegionModes& modes, int index, const Rectangle& rectangle,
                     std::span<const Bivariate<2>> edges = {}, bool curves = true);

/// A curve in the local coordinates of a rectangle.
CurvePolynomial curve_there(const RegionModes& modes, const CurveId& id, const Rectangle& rectangle);

/// -1, +1: sign of the curve on all of the rectangle; 0: not known or both.
int sign_there(const CurvePolynomial& curve);

}  // namespace surefoot::stability
