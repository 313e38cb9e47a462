// The picture of a stance's stability regions, in the manner of [OR-P, Figs. 3-5]: ground, contacts with their friction
// cones, the cells of R_SS(W) shaded and numbered with a key that names the modes, rho and nu drawn as lengths.
#pragma once

#include <optional>
#include <string>

#include "gaits/stance_picture.hpp"
#include "stability/frictional_region.hpp"

namespace surefoot::gaits {

/// Below, where it is given, the regions of frictional stability (frictional_panel.hpp).
std::string to_svg(const RegionFigure& figure, const stability::Region& region,
                   const std::optional<stability::FrictionalRegion>& frictional = std::nullopt);

/// "R(W)" or, for a box of one wrench, "R(w)".
std::string robust_name(const stability::WrenchBox& box);
std::string equilibrium_name(const stability::WrenchBox& box);

}  // namespace surefoot::gaits
