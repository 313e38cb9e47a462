// What is legal but most likely not meant.
#include <fmt/format.h>

#include <vector>

#include "planner/commands.hpp"
#include "terrain/back_faces.hpp"

namespace surefoot::planner {

std::string scene_remark(const gaits::Scene& scene) {
  constexpr double unheard_of = 5;  // [1] rubber on rock stays below 2
  for (const terrain::Segment& segment : scene.terrain.segments())
    if (segment.surface.friction > unheard_of)
      return fmt::format("friction {:.6g} on segment {} of chain {}: is it an angle? The coefficient is its tangent",
                         segment.surface.friction, segment.index, segment.chain);
  const auto seen = terrain::back_face_seen(scene.terrain, 2 * scene.robot.reach_max);
  if (!seen) return "";
  return fmt::format(
      "chain {} turns its back to chain {} at ({:.6g}, {:.6g}): is one of them given the wrong way round? Free space "
      "is on the left of a chain: ground runs from left to right, a ceiling from right to left",
      seen->chain, seen->index, seen->at.x(), seen->at.y());
}

std::string behind_chain_remark(const gaits::Scene& scene, const gaits::Plan& plan) {
  std::vector<terrain::Point> coms;
  for (const gaits::Stance& stance : plan.stances) coms.push_back(stance.com);
  const auto seen = terrain::back_face_over(scene.terrain, coms, 2 * scene.robot.reach_max);
  if (!seen) return "";
  return fmt::format(
      "the COM of stance {} looks at the back of chain {} at ({:.6g}, {:.6g}), so it is in what pictures show as "
      "solid: chains are lines without thickness, give a ceiling its sides",
      seen->index + 1, seen->chain, seen->at.x(), seen->at.y());
}

}  // namespace surefoot::planner
