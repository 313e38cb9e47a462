// The exact one-dimensional problem: on a straight line of COMs, where is a mode feasible for some wrench of the box?
//
// Marching. At a point t where the mode is infeasible, the multipliers y that are best at t (region_rows.hpp) make
// sum y_k row_k negative on the whole box; with y fixed that is four quadratics in t, so the mode stays infeasible up
// to their first root. At a point where it is feasible, the best wrench v stays a witness up to the first root of the
// quadratics row_k . v. Either bound touches the margin to first order, so that the steps approach an end of an
// interval quadratically, from one side, and pass none. At the end the basis names the curve, Newton's method on that
// curve gives the last digits, and the march goes on beyond it. Cost: one or two small programs for a mode that does
// not occur, four or five for each end of an interval.
//
// Intervals and gaps shorter than `line_step` of the chord are passed over. A march that does not get ahead (curves
// that coincide along the line) is given up after most_steps and reported as uncertain.
#pragma once

#include <vector>

#include "stability/region_margin.hpp"

namespace surefoot::stability {

/// Relative to the chord: steps by which the march crosses a curve.
constexpr double line_step = 1e-10;

/// A boundary point of a mode's feasible set on a line.
struct Crossing {
  double t = 0;
  CurveId curve;
  bool enter = false;  ///< the mode is feasible beyond t
};

/// Where one mode is feasible in a closed interval of a line.
struct LineSet {
  bool at_begin = false;            ///< feasible at the beginning
  std::vector<Crossing> crossings;  ///< ascending, alternately leaving and entering
  bool uncertain = false;
  int steps = 0;  ///< of the marches: a measure of the work
};

/// The mode on the line at `s`, for t in [from, to]. `index` names the mode in CurveId.
void solve_line(const RegionMode& mode, int index, double s, double from, double to, LineSet& found);

/// The root of a curve on the line at `s` near t by Newton's method; NaN if it does not settle within `reach` of t.
/// `slope` returns the curve's derivative along the line.
double polish(const RegionModes& modes, const CurveId& curve, double s, double t, double reach,
              double* slope = nullptr);

}  // namespace surefoot::stability
