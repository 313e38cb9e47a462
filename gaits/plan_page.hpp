// Lays a journey out on a page: one row if it fits at a readable size, else rows of equal length like the lines of a
// page. Every stance has its home in exactly one row, which shows all of it.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"
#include "gaits/svg_canvas.hpp"

namespace surefoot::gaits {

struct PageRow {
  double x_from = 0, x_to = 0;  ///< [m] home stretch
  Eigen::AlignedBox2d window;   ///< [m] what is shown
  View view;
  std::vector<int> stances;  ///< whose COM lies in the home stretch
  double bottom() const { return view(window.min()).y(); }
};

struct Page {
  double width = 0, height = 0;  ///< [px]
  double scale = 0;              ///< [px/m]
  std::vector<PageRow> rows;
  int row_of(double x) const;
};

/// Everything that has to be seen [m]; of a journey that is not made, the ground it would cross.
Eigen::AlignedBox2d contents(const Scene& scene, const Plan& plan);

/// `top` [px] is left free above the first row.
Page lay_out(const Scene& scene, const Plan& plan, double top);

}  // namespace surefoot::gaits
