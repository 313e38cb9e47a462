// What a contact mode does in a rectangle of COMs, by certificates that hold in all of it:
//   nowhere       multipliers y >= 0 with sum y_k row_k < 0 on the rectangle and on W, or a covector of
//                 dual_certificate.hpp (where the denominator D changes sign)
//   everywhere    one wrench of W at which all rows are positive on the rectangle
//   beyond_curve  feasible exactly where sign * curve > 0. With f the curve of a basis (region_rows.hpp):
//                   corner   row k is greatest on W at one corner everywhere; there all other rows are positive
//                   side     rows i, j have slots g_i, g_j of opposite sign, so that |g_j| row_i + |g_i| row_j is
//                            constant along the side, and no greater on the opposite one; at the wrench of the side
//                            where row i vanishes, which lies in W, all other rows are positive
//                   inside   y_i : y_j : y_k > 0 that make sum y row constant on W; where two of the rows vanish, which
//                            lies in W, all others are positive
//                   D        one sign of D excluded, the other feasible everywhere
// Only the part of the rectangle in the polygon counts: where its edges e >= 0 cross the rectangle, f <= f + z e for
// z >= 0 bounds f there, so that modes which begin where the equilibrium ends (rolling over a foot) are decided.
//   unknown       none of these was found; halving the rectangle makes all of them sharper
// Rows are polynomials of degree 2: every condition is a bound of one of degree <= 6 on a rectangle. Doubles with a
// bound of their rounding error.
#pragma once

#include <span>

#include "stability/region_bivariate.hpp"
#include "stability/region_rows.hpp"

namespace surefoot::stability {

struct ModeThere {
  enum Kind : unsigned char { unknown, nowhere, everywhere, beyond_curve } kind = unknown;
  double strip = 0;  ///< part of the rectangle, along an edge, in which `kind` is not certain: rounding
  bool feasible_in_middle = false;  ///< by doubles; meaningful for `unknown`
  CurveId curve;                    ///< beyond_curve
  signed char sign = 1;
};

/// `edges` of the polygon that cross the rectangle, in its local coordinates.
ModeThere mode_there(const RegionModes& modes, int index, const Rectangle& rectangle,
                     std::span<const Bivariate<2>> edges = {});

/// A curve in the local coordinates of a rectangle.
CurvePolynomial curve_there(const RegionModes& modes, const CurveId& id, const Rectangle& rectangle);

/// -1, +1: sign of the curve on all of the rectangle; 0: not known or both.
int sign_there(const CurvePolynomial& curve);

}  // namespace surefoot::stability
