// What is legal but most likely not meant.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "planner/commands.hpp"
#include "terrain/back_faces.hpp"

namespace surefoot::planner {

namespace {

/// A terrain whose vertices are in millimetres while feet, goal and robot are in metres: what is a twentieth of a leg
/// becomes 50 legs. A riser between two others betrays it: plains may be as long, and single slopes.
std::string scale_remark(const gaits::Scene& scene) {
  constexpr double legs = 50;  // greatest reaches
  double least = std::numeric_limits<double>::infinity();
  bool riser = false;
  const auto& segments = scene.terrain.segments();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    least = std::min(least, segments[i].length);
    const bool inner = i > 0 && i + 1 < segments.size() && segments[i - 1].chain == segments[i].chain &&
                       segments[i + 1].chain == segments[i].chain;
    riser = riser || (inner && std::abs(segments[i].normal.x()) > std::abs(segments[i].normal.y()));
  }
  if (!riser || least < legs * scene.robot.reach_max) return "";
  return fmt::format(
      "no segment of the terrain is shorter than {:.6g} m, and the greatest reach is {:.6g} m: are the vertices in "
      "metres?",
      least, scene.robot.reach_max);
}

/// Height [m] of a gap that nobody walks through: what stands so little above ground stands on it.
double too_low(const gaits::Robot& robot) { return robot.reach_max / 4; }

constexpr const char* sides =
    "Free space is on the left of a chain: ground runs from left to right, a ceiling from right to left, a wall on the "
    "left down, one on the right up";

std::string back_face_words(const terrain::BackFace& seen) {
  return fmt::format(
      "chain {} turns its back to chain {} at ({:.6g}, {:.6g}): is one of them given the wrong way round (or meant as "
      "a plate without thickness)? {}",
      seen.chain, seen.index, seen.at.x(), seen.at.y(), sides);
}

/// x in the middle of each chain [m]; nothing where there are many.
std::vector<double> middles(const terrain::Terrain& ground) {
  constexpr int many = 64;
  std::vector<Eigen::AlignedBox2d> extents(static_cast<std::size_t>(ground.chain_count()));
  if (ground.chain_count() > many) return {};
  for (const terrain::Segment& segment : ground.segments())
    extents[static_cast<std::size_t>(segment.chain)].extend(segment.a).extend(segment.b);
  std::vector<double> xs;
  xs.reserve(extents.size());
  for (const auto& extent : extents) xs.push_back(extent.center().x());
  return xs;
}

/// A goal in solid ground: only one that is bounded below and above can be seen to be. Where any x will do, it is not
/// below some of the chains alone.
std::string goal_remark(const gaits::Scene& scene) {
  if (!scene.goal.com_y) return "";
  const auto [low, high] = *scene.goal.com_y;
  const auto solid = [&, bottom = low, top = high](double left, double right) {
    return terrain::solid_around(scene.terrain, {terrain::Point(left, bottom), terrain::Point(right, top)});
  };
  std::optional<int> chain;
  if (const auto& x = scene.goal.com_x) {
    chain = solid(x->first, x->second);
  } else {
    const auto bounds = scene.terrain.bounds();
    const std::vector<double> xs = middles(scene.terrain);
    const bool all = std::all_of(xs.begin(), xs.end(), [&](double at) { return solid(at, at).has_value(); });
    if (all && !xs.empty()) chain = solid(bounds.min().x(), bounds.max().x());
  }
  if (!chain) return "";
  return fmt::format("the goal lies behind chain {}, in what pictures show as solid ground: is its place meant so?",
                     *chain);
}

std::vector<Eigen::AlignedBox2d> start_boxes(const gaits::Scene& scene) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const auto& foot : scene.start.feet)
    if (foot) boxes.emplace_back(foot->position);
  return boxes;
}

/// Unbounded where the goal is.
Eigen::AlignedBox2d goal_box(const gaits::Scene& scene) {
  constexpr double far = terrain::greatest_coordinate;
  const auto [left, right] = scene.goal.com_x.value_or(std::pair(-far, far));
  const auto [low, high] = scene.goal.com_y.value_or(std::pair(-far, far));
  return {terrain::Point(left, low), terrain::Point(right, high)};
}

std::vector<int> inside_out(const gaits::Scene& scene) {
  return terrain::obstacles_inside_out(scene.terrain, start_boxes(scene), goal_box(scene), too_low(scene.robot));
}

std::optional<terrain::BackFace> back_face(const gaits::Scene& scene) {
  std::vector<terrain::Foothold> feet;
  for (const auto& foot : scene.start.feet)
    if (foot) feet.push_back(*foot);
  return terrain::back_face_seen(scene.terrain, 2 * scene.robot.reach_max, feet, too_low(scene.robot));
}

std::string inside_out_remark(const gaits::Scene& scene) {
  constexpr std::size_t most_named = 8;
  const std::vector<int> chains = inside_out(scene);
  if (chains.empty()) return "";
  if (chains.size() == 1)
    return fmt::format(
        "the free side of chain {} is its inside, where the start does not lie: is it an obstacle given the wrong way "
        "round? {}",
        chains.front(), sides);
  const auto named = std::span(chains).first(std::min(chains.size(), most_named));
  return fmt::format(
      "the free sides of chains {}{} are their insides, where the start does not lie: are they obstacles given the "
      "wrong way round? {}",
      fmt::join(named, ", "),
      chains.size() > named.size() ? fmt::format(" and {} more", chains.size() - named.size()) : "", sides);
}

/// Whether a chain whose back is seen is given the wrong way round, rather than a ceiling without sides: it is closed,
/// has walls at both ends, or is remarked on.
bool is_wrong_way(const gaits::Scene& scene, int chain) {
  constexpr double steep = 0.7;  // |n_x| of a wall
  const auto& segments = scene.terrain.segments();
  const auto in_chain = [chain](const terrain::Segment& segment) { return segment.chain == chain; };
  const auto is_wall = [](const terrain::Segment& segment) { return std::abs(segment.normal.x()) > steep; };
  const auto first = std::find_if(segments.begin(), segments.end(), in_chain);
  const auto last = std::find_if(segments.rbegin(), segments.rend(), in_chain);
  if (scene.terrain.is_closed(chain) || (is_wall(*first) && is_wall(*last))) return true;
  const auto seen = back_face(scene);
  const std::vector<int> obstacles = inside_out(scene);
  return std::count(obstacles.begin(), obstacles.end(), chain) > 0 || (seen && seen->chain == chain);
}

/// Feet so far from the origin that what is left of their digits is coarse beside the robot.
std::string coarse_remark(const gaits::Scene& scene) {
  constexpr double coarse = 1e-6;  // relative to the greatest reach
  double farthest = 0;
  for (const auto& box : start_boxes(scene)) farthest = std::max(farthest, box.min().cwiseAbs().maxCoeff());
  const double apart = std::nextafter(farthest, std::numeric_limits<double>::infinity()) - farthest;
  if (apart <= coarse * scene.robot.reach_max) return "";
  return fmt::format(
      "the start is {:.6g} m from the origin, where numbers are {:.3g} m apart, and the greatest reach is {:.6g} m: is "
      "the origin meant to be so far away?",
      farthest, apart, scene.robot.reach_max);
}

/// A foot so far from the others that no COM reaches it and one of them.
std::string far_foot_remark(const gaits::Scene& scene) {
  const double span = 2 * scene.robot.reach_max;
  const auto& feet = scene.start.feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < feet.size(); ++other)
      if (feet[leg] && feet[other] && other != leg)
        nearest = std::min(nearest, (feet[leg]->position - feet[other]->position).norm());
    if (std::isfinite(nearest) && nearest > span)
      return fmt::format(
          "start foot {} at ({:.6g}, {:.6g}) is {:.6g} m from the nearest other one, and the greatest reach is {:.6g} "
          "m: no COM reaches both, is its place meant so?",
          leg + 1, feet[leg]->position.x(), feet[leg]->position.y(), nearest, scene.robot.reach_max);
  }
  return "";
}

std::string upside_down_remark(const gaits::Scene& scene) {
  const auto& robot = scene.robot;
  const auto chain = terrain::ground_upside_down(scene.terrain, 2 * robot.reach_max, robot.reach_min);
  const auto stands = [&](const auto& foot) { return foot && chain && foot->chain == *chain; };
  const auto& feet = scene.start.feet;
  if (!chain || std::any_of(feet.begin(), feet.end(), stands)) return "";
  return fmt::format(
      "chain {} runs from right to left, with no ground below it and other ground beside it: is it given the wrong way "
      "round? {}",
      *chain, sides);
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
  if (std::string scale = scale_remark(scene); !scale.empty()) return scale;
  constexpr double tiny = 1e-3, giant = 50;  // [m]
  if (scene.robot.reach_max < tiny || scene.robot.reach_max > giant)
    return fmt::format("the greatest reach is {:.6g} m: are all lengths, nu among them, in metres?",
                       scene.robot.reach_max);
  if (std::string coarse = coarse_remark(scene); !coarse.empty()) return coarse;
  if (std::string far_foot = far_foot_remark(scene); !far_foot.empty()) return far_foot;
  if (std::string inside_out = inside_out_remark(scene); !inside_out.empty()) return inside_out;
  if (const auto seen = back_face(scene)) return back_face_words(*seen);
  if (std::string upside_down = upside_down_remark(scene); !upside_down.empty()) return upside_down;
  return goal_remark(scene);
}

std::string behind_chain_remark(const gaits::Scene& scene, const gaits::Plan& plan) {
  std::vector<terrain::Point> coms;
  for (const gaits::Stance& stance : plan.stances) coms.push_back(stance.com);
  const auto seen = terrain::back_face_over(scene.terrain, coms, 2 * scene.robot.reach_max);
  if (!seen) return "";
  const terrain::Point& com = coms[static_cast<std::size_t>(seen->index)];
  const bool under = seen->at.y() > com.y();  // ground, rather than over a ceiling
  if (const auto chain = under ? terrain::solid_around(scene.terrain, Eigen::AlignedBox2d(com)) : std::nullopt)
    return fmt::format("the COM of stance {} lies behind chain {}, in what pictures show as solid ground",
                       seen->index + 1, *chain);
  return fmt::format(
      "the COM of stance {} looks at the back of chain {} at ({:.6g}, {:.6g}), so it is in what pictures show as "
      "solid: {}",
      seen->index + 1, seen->chain, seen->at.x(), seen->at.y(),
      is_wrong_way(scene, seen->chain) ? "is it given the wrong way round?"
                                       : "chains are lines without thickness, give a ceiling its sides");
}

}  // namespace surefoot::planner
