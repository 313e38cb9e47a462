// Excludes a mode from a rectangle of COMs by a covector of dual_certificate.hpp. Where the denominator D of a slide
// vanishes, its rows, multiplied by D, depend on each other; the covector does not notice.
//
// In the frame of the COM the covector is Z = (X, 1, M). Proposals at the middle and at the middles of the sides give X
// and M as affine functions of the COM, and the conditions for Z are then of degree 2 at most:
//   rho^2 (1 - kappa |X|) - nu |M| > 0        concave: at the corners of the rectangle
//   rho^2 (X C_x + C_y) + M (r x C) < 0       for every loaded edge C
//   X (v_x + alpha r_y) + v_y - alpha r_x + M alpha >= 0   for the extreme twists (v, alpha) about contact i
#pragma once

#include "stability/region_rows.hpp"

namespace surefoot::stability {

/// Never for boxes that are not about gravity, nor for the mode in which all contacts break.
bool excluded_by_covector(const RegionModes& modes, int index, const Rectangle& rectangle);

}  // namespace surefoot::stability
