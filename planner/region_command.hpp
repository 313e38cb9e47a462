// `surefoot region`: the stability regions of a stance of a scene, or of a posture given by itself; text, JSON and SVG
// (formats in the README of the project and `surefoot region --help`).
#pragma once

#include <optional>
#include <string>

#include "gaits/region_svg.hpp"

namespace surefoot::planner {

struct RegionArguments {
  std::optional<std::string> scene, posture;  ///< exactly one; "-" is stdin
  std::optional<std::string> stance;          ///< LEG,LEG or LEG,LEG,LEG from 1; else the scene's first stance
  std::optional<std::string> svg, json;       ///< files; "-" is stdout, which then holds nothing else
  std::optional<std::string> window;          ///< xmin,ymin,xmax,ymax [m]
  std::optional<std::string> wrench;          ///< p,q: R(w) for this wrench instead of R(W)
  std::optional<double> restitution;          ///< frictional stability too; else that of the scene or posture, if any
};

int run_region(const RegionArguments& arguments);

/// The tree of formats.md, with what else is known: modes with their areas, rings that are holes, labels' tolerance.
std::string region_to_json(const gaits::RegionFigure& figure, const stability::Region& region,
                           const std::optional<stability::FrictionalRegion>& frictional);
/// For a person: areas, which modes cut how much, cells.
std::string region_to_text(const gaits::RegionFigure& figure, const stability::Region& region,
                           const std::optional<stability::FrictionalRegion>& frictional);

}  // namespace surefoot::planner
