// Scenes and a plan made by hand, whose every number follows from a line of reasoning, for the tests of gaits/.
#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits::testing {

using terrain::Chain;
using terrain::Point;

inline Chain chain(std::vector<Point> vertices, double friction = 0.6) {
  Chain result{std::move(vertices), {}};
  result.surfaces.assign(result.vertices.size() - 1, {friction, true});
  return result;
}

/// The level line y = 0 from x = -5 to x = 5 (so that s = x + 5), and whatever else is given.
inline std::vector<Chain> level_ground_and(std::vector<Chain> more = {}) {
  more.insert(more.begin(), chain({{-5, 0}, {5, 0}}));
  return more;
}

/// rho 0.12 m, reach 0.2 to 0.9 m, clearance 0.05 m, kappa 0.1, nu 0.03 m; feet 1 and 2 at x = -0.2 and 0.2, leg 3 in
/// the air; goal 0.7 <= x <= 0.9.
inline Scene scene_on(std::vector<Chain> chains) {
  Scene scene{.file = "hand.yaml",
              .name = "hand",
              .terrain = terrain::Terrain(std::move(chains)),
              .robot = {.radius_of_gyration = 0.12, .reach_min = 0.2, .reach_max = 0.9, .clearance = 0.05, .mass = {}},
              .disturbance = {0.1, 0.03},
              .criterion = Criterion::robust,
              .restitution = {},
              .start = {},
              .goal = {.com_x = std::pair(0.7, 0.9), .com_y = {}},
              .search = {}};
  scene.start.feet[0] = scene.terrain.foothold_at(0, 4.8);
  scene.start.feet[1] = scene.terrain.foothold_at(0, 5.2);
  return scene;
}

inline terrain::Foothold foot_at(const Scene& scene, double s) { return scene.terrain.foothold_at(0, s).value(); }

/// The margin of level ground. Feet at distance d or more on either side of the COM, height h: the centre of pressure
/// x - p h + q stays between them for |p| <= s kappa, |q| <= s nu up to s = d / (kappa h + nu); they do not slip up to
/// s = mu / kappa.
inline double level_factor(const Scene& scene, double d, double h) {
  return d / (scene.disturbance.kappa * h + scene.disturbance.nu);
}

/// Feet -0.2, 0.2 -> (leg 3 to 0.6, COM 0 -> 0.4, leg 1 lifted) -> 0.2, 0.6 -> (leg 1 to 1.0, COM 0.4 -> 0.8, leg 2
/// lifted)
/// -> 0.6, 1.0. COM 0.5 m above ground. The outermost feet are never nearer than 0.2 m in x: all factors are
/// 0.2 / (0.1 * 0.5 + 0.03) = 2.5. The longest legs span 0.6 m in x: sqrt(0.36 + 0.25) = 0.78 m < 0.9 m.
inline Plan plan_by_hand(const Scene& scene) {
  const auto left = foot_at(scene, 4.8), second = foot_at(scene, 5.2), third = foot_at(scene, 5.6),
             fourth = foot_at(scene, 6.0);
  const double sigma = level_factor(scene, 0.2, 0.5);
  Plan plan;
  plan.scene = scene.name;
  plan.status = Status::solved;
  plan.stances = {Stance{Feet{left, second, std::nullopt}, Point(0, 0.5), sigma, ""},
                  Stance{Feet{std::nullopt, second, third}, Point(0.4, 0.5), sigma, ""},
                  Stance{Feet{fourth, std::nullopt, third}, Point(0.8, 0.5), sigma, ""}};
  plan.transfers = {{2, third, 0, sigma, ""}, {0, fourth, 1, sigma, ""}};
  plan.safety_factor = sigma;
  return plan;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A walk along level ground, one foot every 0.4 m: feet 1 2 3 1 2 3 ... (a picture needs no verified plan).
inline Plan long_walk(const Scene& scene, int steps, double from) {
  Plan plan;
  plan.scene = scene.name;
  plan.status = Status::solved;
  plan.safety_factor = 2.5;
  const double begin = scene.terrain.segments().front().a.x();
  const auto foot = [&](int k) { return scene.terrain.foothold_at(0, from + 0.4 * k - begin).value(); };
  for (int k = 0; k <= steps; ++k) {
    Stance stance{{}, {from + 0.4 * k + 0.2, 0.5}, 2.5 + 0.01 * k, "equilibrium"};
    stance.feet[k % 3] = foot(k);
    stance.feet[(k + 1) % 3] = foot(k + 1);
    plan.stances.push_back(stance);
    if (k < steps) plan.transfers.push_back({(k + 2) % 3, foot(k + 2), k % 3, 2.5, "UFF"});
  }
  return plan;
}

inline Scene long_ground() {
  Scene scene = scene_on({chain({{-120, 0}, {120, 0}})});
  scene.start.feet = {};
  return scene;
}

}  // namespace surefoot::gaits::testing
