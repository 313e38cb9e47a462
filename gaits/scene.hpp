// A scene: everything the user gives. Plain data, validated once, when it is loaded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gaits/robot.hpp"
#include "stability/contact.hpp"
#include "terrain/document.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

enum class Criterion {
  robust,       ///< R(W): no mode but rest anywhere in W
  equilibrium,  ///< R_SS(W) only: a robot that braces actively
  frictional,   ///< stances frictionally stable [OR-H, Theorem 3], transfers robust; needs a restitution
  both,         ///< stances robust and frictionally stable, transfers robust; needs a restitution
};
/// The criterion asks stances for frictional stability.
constexpr bool asks_frictional(Criterion criterion) {
  return criterion == Criterion::frictional || criterion == Criterion::both;
}

/// Start feet by leg (index 0..2 is leg 1..3); a leg that is absent starts in the air.
struct Start {
  std::array<std::optional<terrain::Foothold>, leg_count> feet;
  std::optional<std::pair<int, int>> support;  ///< legs (0..2, first < second) that carry the first stance
  std::optional<Eigen::Vector2d> com;          ///< [m]
  std::string place;                           ///< where the file gives it, "file:line:column"; for messages
  std::string com_place;                       ///< the same of the COM; empty where none is given
};

/// COM intervals [m], ends included; at least one is given.
struct Goal {
  std::optional<std::pair<double, double>> com_x, com_y;
  bool contains(const Eigen::Vector2d& com) const;
  double distance(const Eigen::Vector2d& com) const;  ///< [m]; 0 inside
};

constexpr std::uint32_t greatest_seed = 2147483562;  ///< of OMPL's generator; 0 acts as 1 there, so it is refused
const std::vector<std::string>& planner_names();     ///< "auto", "Layers", "RRT", "KPIECE1", "EST", "SST"
const std::vector<std::string>& objective_names();   ///< "steps", "safety", "distance"
/// The one of `words` that is meant, upper or lower case alike; nullptr if it is none of them.
const std::string* known_word(std::string_view word, const std::vector<std::string>& words);
/// The message for a word that is none of `words`: names all, and the nearest.
std::string not_known(std::string_view what, std::string_view word, const std::vector<std::string>& words);

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
  std::optional<double> restitution;  ///< in (0, 1)
  Start start;
  Goal goal;
  SearchDefaults search;
};

/// Throws terrain::InputError with file:line:column.
Scene load_scene(const std::string& path);
Scene parse_scene(std::string_view text, const std::string& name);
/// Without throwing: all faults go to the list, and there is a scene only if there are none.
std::optional<Scene> load_scene(const std::string& path, terrain::FaultList& faults);
std::optional<Scene> parse_scene(std::string_view text, const std::string& name, terrain::FaultList& faults);

/// For messages about a file in another one's place: whether a document has what only scenes have.
bool looks_like_scene(const terrain::Node& root);

/// Of scenes and plans: the value of their key "surefoot". Throws terrain::InputError.
void check_format_version(const terrain::Node& version);

stability::Contact contact_at(const terrain::Foothold& foothold);

}  // namespace surefoot::gaits
