// A scene: everything the user gives. Plain data, validated once, when it is loaded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "gaits/robot.hpp"
#include "stability/contact.hpp"
#include "terrain/document.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

enum class Criterion {
  robust,       ///< R(W): no mode but rest anywhere in W
  equilibrium,  ///< R_SS(W) only: a robot that braces actively
};

/// Start feet by leg (index 0..2 is leg 1..3); a leg that is absent starts in the air.
struct Start {
  std::array<std::optional<terrain::Foothold>, leg_count> feet;
  std::optional<std::pair<int, int>> support;  ///< legs (0..2, first < second) that carry the first stance
  std::optional<Eigen::Vector2d> com;          ///< [m]
};

/// COM intervals [m], ends included; at least one is given.
struct Goal {
  std::optional<std::pair<double, double>> com_x, com_y;
  bool contains(const Eigen::Vector2d& com) const;
  double distance(const Eigen::Vector2d& com) const;  ///< [m]; 0 inside
};

struct SearchDefaults {
  std::uint32_t seed = 1;
  double time_limit = 10;  ///< [s]
  std::string planner = "auto";
  std::string objective = "steps";
};

struct Scene {
  std::string file;  ///< as given on the command line
  std::string name;  ///< `name`, or the file's stem
  terrain::Terrain terrain;
  Robot robot;
  stability::DisturbanceBox disturbance;
  Criterion criterion = Criterion::robust;
  std::optional<double> restitution;
  Start start;
  Goal goal;
  SearchDefaults search;
};

/// Throws terrain::InputError with file:line:column.
Scene load_scene(const std::string& path);
Scene parse_scene(std::string_view text, const std::string& name);

stability::Contact contact_at(const terrain::Foothold& foothold);

}  // namespace surefoot::gaits
