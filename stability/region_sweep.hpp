// The sweep of region.hpp: a convex polygon is cut into slabs between parallel lines; in a slab the curves that bound
// the modes keep their order along the lines and are smooth. Integrals over slabs give areas, their pieces make up
// cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "stability/region_line.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {

/// A sweep line with everything that happens on it between its ends on the polygon.
struct SweepLine {
  double s = 0, lo = 0, hi = 0;
  int lo_edge = -1, hi_edge = -1;
  std::uint32_t begin_modes = 0;  ///< bit k: modes()[k] feasible at lo
  std::vector<Crossing> at;
  bool uncertain = false;
};

inline bool same_curve(const Crossing& x, const Crossing& y) { return x.curve == y.curve && x.enter == y.enter; }
inline bool same(const SweepLine& x, const SweepLine& y) {
  return x.begin_modes == y.begin_modes && x.lo_edge == y.lo_edge && x.hi_edge == y.hi_edge &&
         x.at.size() == y.at.size() && std::equal(x.at.begin(), x.at.end(), y.at.begin(), same_curve);
}

/// Curve 0 is the lower edge, 1..n the crossings, n + 1 the upper edge; piece k lies between curves k and k + 1.
struct Slab {
  double a = 0, b = 0;
  std::vector<Crossing> curves;          ///< the crossings on the middle line
  std::vector<std::uint32_t> modes;      ///< of each piece
  std::vector<double> integral;          ///< of t over [a, b], of every curve
  std::vector<double> at_a, at_m, at_b;  ///< t of every curve just inside a, in the middle, just inside b
  std::vector<double> slope;  ///< of the crossings' curves along the middle line: only its sign tells branches apart
  int lo_edge = -1, hi_edge = -1;
  std::size_t pieces() const { return modes.size(); }
};

class Sweep {
 public:
  /// `polygon` counter-clockwise in (s, t); its edges are those set in `modes`. Areas to `tolerance` relative to that
  /// of the polygon. `core` [m]: the extent around the origin in which structure is looked for most closely.
  Sweep(const RegionModes& modes, std::vector<Eigen::Vector2d> polygon, double tolerance, double core);
  void run();

  const std::vector<Slab>& slabs() const { return slabs_; }
  double error() const { return error_; }
  double area() const { return area_; }
  double extent() const { return s_end_ - s_begin_; }
  int lines() const { return lines_; }
  bool uncertain() const { return uncertain_; }

  /// Points (s, t) of a curve of a slab from a to b, ends included, within `tolerance` of the curve. Where the curve
  /// cannot be followed, by lines of their own as long as these are few.
  std::vector<Eigen::Vector2d> sample(const Slab& slab, std::size_t curve, double tolerance);
  /// Relative to the length of a line: crossings as close as this are taken for one point.
  static constexpr double tie = 1e-9;

 private:
  static constexpr double inset = 1e-8;  // of the extent: how far beside an event lines are solved
  static constexpr double least_slab = 4 * inset;
  struct Strip {
    double a = 0, b = 0, lo = 0, hi = 0;
    std::uint32_t active = 0;  // modes not excluded
  };
  void make_strips();
  void classify(int mode, int first, int last, double lo, double hi, int t_depth);
  bool chord(double s, SweepLine& line) const;
  std::uint32_t active_at(double s) const;
  /// Crossings as close as this are taken for one point.
  double closeness(const SweepLine& line) const;
  SweepLine solve(double s);
  void refine(double a, const SweepLine& at_a, double b, const SweepLine& at_b, int depth);
  void reconcile(const SweepLine& first, SweepLine& second) const;
  /// In lines of usual cost.
  double effort() const { return lines_ + static_cast<double>(steps_) / steps_of_line; }
  static constexpr double steps_of_line = 180;
  double thinnest() const;
  bool step_over(double a, const SweepLine& at_a, double b, const SweepLine& at_b, double guess, int depth);
  struct Difference;
  Difference difference(const SweepLine& at_a, const SweepLine& at_b) const;
  double event(double a, const SweepLine& at_a, double b, const SweepLine& at_b) const;
  double meeting(const CurveId& one, const CurveId& other, double s, double t) const;
  bool integrate(double a, double b, const SweepLine& at_a, const SweepLine& at_m, const SweepLine& at_b, bool force);
  bool curve_points(const Slab& slab, double s, double u, std::vector<double>& t) const;
  Slab make_slab(double a, double b, const SweepLine& at_a, const SweepLine& at_m, const SweepLine& at_b) const;
  void pass_over(double a, double b, const SweepLine& at_a, const SweepLine& at_b);

  const RegionModes& modes_;
  std::vector<Eigen::Vector2d> polygon_;
  double tolerance_, core_, area_ = 0;
  double s_begin_ = 0, s_end_ = 0, inset_ = 0;
  std::vector<Strip> strips_;
  std::vector<Slab> slabs_;
  double error_ = 0;
  int lines_ = 0;
  long steps_ = 0;
  double effort_of_run_ = 0;
  bool uncertain_ = false;
};

}  // namespace surefoot::stability
