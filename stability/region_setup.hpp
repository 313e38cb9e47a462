// What all ways to a region of one stance begin with: the posture, R_SS(W) as a polygon, the modes in coordinates (s,
// t).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "stability/region_polygon.hpp"
#include "stability/region_rows.hpp"

namespace surefoot::stability {

/// Throws std::invalid_argument for a window that is empty or not finite.
void require_window(const std::optional<Eigen::AlignedBox2d>& window);

struct RegionSetup {
  Posture posture;
  LabelledPolygon polygon;
  std::optional<Eigen::AlignedBox2d> window;
  double area = 0;      ///< of the polygon [m^2]; 0 with `problem`
  double core = 0;      ///< [m]: extent around the contacts within which all structure lies but for far ends
  std::string problem;  ///< why there is no region
  std::unique_ptr<RegionModes> modes;  ///< with the edges of the polygon
  std::vector<Eigen::Vector2d> local;  ///< the polygon in (s, t)

  RegionSetup(std::span<const Contact> contacts, double rho, const WrenchBox& box, const RegionOptions& options);
};

}  // namespace surefoot::stability
