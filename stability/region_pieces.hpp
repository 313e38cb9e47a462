// A decided rectangle cut along its curves: between the places where two curves cross or one leaves the rectangle, their
// order is fixed and the pieces between them are integrals of polynomials.
#pragma once

#include <vector>

#include "stability/region_subdivision.hpp"

namespace surefoot::stability {

/// Between two curves of a leaf (or its sides tau = -1, tau = +1) for sigma in [from, to].
struct Piece {
  static constexpr int side_below = -1, side_above = -2;
  std::uint32_t modes = 0;  ///< feasible there
  double area = 0;          ///< [m^2]
  int leaf = 0, interval = 0;
  double from = -1, to = 1;
  int lower = side_below, upper = side_above;  ///< indices into Leaf::curves
};

/// Appends the pieces of a leaf that lie in the polygon, interval by interval, in each from below. Returns the area of
/// what is too thin to be a piece.
double cut(const Leaf& leaf, int index, std::vector<Piece>& pieces);

/// Ends of a piece along tau.
double lower_end(const Leaf& leaf, const Piece& piece, double sigma);
double upper_end(const Leaf& leaf, const Piece& piece, double sigma);

/// Relative to a rectangle: curves as close as this are one.
constexpr double thinnest_piece = 1e-9;

}  // namespace surefoot::stability
