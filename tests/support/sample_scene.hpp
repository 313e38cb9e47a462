// Random scenes as YAML text, many of them near the limit of what can be walked: for properties that hold for every
// scene. Lengths are drawn in units of the greatest reach, so that gaps, steps and walls come out both passable and
// not.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace surefoot::testing {

enum class SceneKind {
  rubble,    ///< short pieces, heights at random
  stairs,    ///< treads and risers, up or down
  slope,     ///< an incline near its friction
  gap,       ///< two chains, a gap between them, a difference in height
  vee,       ///< a valley or a ridge
  overhang,  ///< level ground under a ceiling
  chimney,   ///< between two walls, upwards
  ice,       ///< level ground with slippery pieces
  barred,    ///< level ground with pieces where no foot may stand
  wall,      ///< a wall or a ditch across level ground
};
constexpr int scene_kinds = 10;
const char* to_string(SceneKind kind);

/// The same seed gives the same scene.
std::string sample_scene(SceneKind kind, std::uint32_t seed);

/// One parameter, all else as in the canned scenes (reach 0.9): a family to look for the limit in.
enum class Family {
  gap_width,       ///< [m] a gap between two level chains
  step_height,     ///< [m] a step up
  drop_depth,      ///< [m] a step down
  slope_friction,  ///< friction of 3 m of slope at 20 degrees: the limit is a least value
  ice_length,      ///< [m] of friction below kappa
  bar_length,      ///< [m] where no foot may stand
  wall_height,     ///< [m] of a wall 0.2 m thick
  ceiling_height,  ///< [m] of a tunnel 2.4 m long: the limit is a least value
};
constexpr int families = 8;
const char* to_string(Family family);
/// Values between which the limit surely lies: one that is easy, one that is out of the question.
std::pair<double, double> easy_and_hopeless(Family family);
std::string family_scene(Family family, double value);

}  // namespace surefoot::testing
