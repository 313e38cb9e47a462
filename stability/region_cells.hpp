// From slabs to cells: pieces with the same modes that touch across the lines between slabs are one cell; its boundary
// is made of their curves, joined where slabs meet.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stability/region_sweep.hpp"

namespace surefoot::stability {

/// In the coordinates (s, t) of the sweep.
struct SweepCell {
  std::uint32_t modes = 0;
  double area = 0;
  Eigen::Vector2d inside = Eigen::Vector2d::Zero();  ///< in the middle of its greatest piece
  std::vector<std::vector<Eigen::Vector2d>> rings;   ///< the outer one first
};

struct SweepCurve {
  CurveId curve;
  std::vector<Eigen::Vector2d> points;
};

struct SweepCells {
  std::vector<SweepCell> cells;
  std::vector<SweepCurve> curves;  ///< inside the polygon
  double dropped = 0;              ///< area of what is too small for a cell
};

/// Cells smaller than this part of the polygon are rounding where curves coincide; they are dropped.
constexpr double least_cell = 1e-9;

/// Rings and curves only with tolerance > 0 [m]; they may need further lines.
SweepCells collect_cells(Sweep& sweep, double tolerance);

}  // namespace surefoot::stability
