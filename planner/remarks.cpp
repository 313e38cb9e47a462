// What is legal but most likely not meant.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "planner/commands.hpp"
#include "terrain/back_faces.hpp"

namespace surefoot::planner {

namespace {

std::string upside_down_remark(const gaits::Scene& scene) {
  const auto& robot = scene.robot;
  const auto chain = terrain::ground_upside_down(scene.terrain, 2 * robot.reach_max, robot.reach_min);
  const auto stands = [&](const auto& foot) { return foot && chain && foot->chain == *chain; };
  const auto& feet = scene.start.feet;
  if (!chain || std::any_of(feet.begin(), feet.end(), stands)) return "";
  return fmt::format(
      "chain {} runs from right to left, with no ground below it and other ground beside it: is it given the wrong way "
      "round? Free space is on the left of a chain: ground runs from left to right, a ceiling from right to left",
      *chain);
}

}  // namespace

std::string scene_remark(const gaits::Scene& scene) {
  constexpr double unheard_of = 5;  // [1] rubber on rock stays below 2
  for (const terrain::Segment& segment : scene.terrain.segments())
    if (segment.surface.friction > unheard_of)
      return fmt::format("friction {:.6g} on segment {} of chain {}: is it an angle? The coefficient is its tangent",
                         segment.surface.friction, segment.index, segment.chain);
  if (scene.robot.radius_of_gyration > scene.robot.reach_max)
    return fmt::format(
        "the radius of gyration, {:.6g} m, is more than the greatest reach, {:.6g} m: are both in metres?",
        scene.robot.radius_of_gyration, scene.robot.reach_max);
  const auto seen = terrain::back_face_seen(scene.terrain, 2 * scene.robot.reach_max);
  if (!seen) return upside_down_remark(scene);
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
