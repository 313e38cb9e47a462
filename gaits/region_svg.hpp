// The picture of a stance's stability regions, in the manner of [OR-P, Figs. 3-5]: ground, contacts with their friction
// cones, the cells of R_SS(W) shaded and numbered with a key that names the modes, rho and nu drawn as lengths.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stability/region.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

struct RegionFigure {
  std::string title;
  const terrain::Terrain* terrain = nullptr;  ///< none: a stroke of ground at each contact
  std::vector<stability::Contact> contacts;
  std::vector<std::string> contact_names;  ///< what stands beside each contact
  double radius_of_gyration = 0;
  stability::WrenchBox box;
  std::optional<Eigen::Vector2d> com;  ///< marked, if given
};

std::string to_svg(const RegionFigure& figure, const stability::Region& region);

/// "R(W)" or, for a box of one wrench, "R(w)".
std::string robust_name(const stability::WrenchBox& box);
std::string equilibrium_name(const stability::WrenchBox& box);

}  // namespace surefoot::gaits
