// The rules of a 2-3-2 step, as the search asks them: cheap ones first, the first broken rule is the answer.
// (The verifier, verifier.hpp, asks the same rules by other means and reports all that are broken. It shares with this
// file the names of the rules, the terrain's segments and the stability oracle; nothing else.)
//
// Limits are closed: a foot at exactly reach_max is within reach. What these rules accept, the verifier accepts too:
// its slack is wider than theirs. Whoever chooses a COM should choose it for drawn_in(robot), so that no reader of the
// plan needs any slack at all.
//
// Errors: std::invalid_argument where nothing is planted (oracle_of) or the scene's criterion misses its restitution or
// its two contacts (is_stable). COMs are finite (asserted). Legs that there are not break Rule::gait.
#pragma once

#include <cstddef>
#include <optional>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::gaits {

enum class Rule {
  foothold,        ///< a foot stands inside a segment that allows it
  reach,           ///< reach_min <= |COM - foot| <= reach_max, at rest and along the line
  clearance,       ///< COM at least `clearance` from the terrain, along the line too, and never through it
  leg_visibility,  ///< the leg does not cut the terrain at lift-off and touch-down
  swing,           ///< the leg can swing from the old to the new foothold at fixed COM
  stance_stability,
  transfer_stability,
  gait,  ///< which leg is placed and lifted, continuity, start, goal
};
constexpr std::size_t rule_count = static_cast<std::size_t>(Rule::gait) + 1;
const char* to_string(Rule rule);

/// Rounding allowed at the limits of reach and clearance, relative to reach_max: a few units in the last place of a
/// distance between decimal inputs. A thousandth of what the verifier allows.
constexpr double limit_slack = 1e-12;
/// How far inside its limits a chosen COM should stay, relative to reach_max: out of reach of any rounding, nothing to
/// a robot.
constexpr double limit_margin = 1e-9;

/// The robot with reach and clearance narrowed by limit_margin: choose COMs for this one.
Robot drawn_in(const Robot& robot);

/// Disturbances a little larger than those given, which whoever chooses COMs should have them withstand: at a safety
/// factor of exactly 1 (friction kappa) nothing is left.
stability::DisturbanceBox widened(const stability::DisturbanceBox& box);

/// A planted foot is within reach at every COM of the straight line from -> to.
bool within_reach(const Robot& robot, const Eigen::Vector2d& foot, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to);
/// The same for all planted feet.
bool within_reach(const Robot& robot, const Feet& feet, const Eigen::Vector2d& from, const Eigen::Vector2d& to);
/// COM clearance along from -> to (a point if they are equal).
bool clear_of_terrain(const Scene& scene, const Eigen::Vector2d& from, const Eigen::Vector2d& to);
/// The free leg can turn about the COM from the direction of `old_foot` to that of `new_foot`, one way or the other,
/// when it may shorten to reach_min (theory: the sector of that radius holds no terrain).
bool swing_is_free(const Scene& scene, const Eigen::Vector2d& com, const Eigen::Vector2d& old_foot,
                   const Eigen::Vector2d& new_foot);
/// The angle [rad], counter-clockwise positive, by which it then turns: the shorter of the free ways; nothing if
/// neither is free.
std::optional<double> swing_turn(const Scene& scene, const Eigen::Vector2d& com, const Eigen::Vector2d& old_foot,
                                 const Eigen::Vector2d& new_foot);
/// Nothing is nearer to the COM than the shortened leg is long: swing_is_free whatever the footholds.
bool swings_any_way(const Scene& scene, const Eigen::Vector2d& com);

/// The oracle of a set of planted feet (contacts in the order of the legs).
stability::RobustOracle oracle_of(const Scene& scene, const Feet& feet);
/// The same for disturbances of another size than the scene's.
stability::RobustOracle oracle_of(const Scene& scene, const Feet& feet, const stability::DisturbanceBox& box);
/// The scene's criterion at a COM (of a stance: the frictional criteria take two contacts), and along a straight line
/// of COMs, for contacts whose oracle is at hand.
bool is_stable(const Scene& scene, const stability::RobustOracle& oracle, const Eigen::Vector2d& com);
bool is_stable(const Scene& scene, const stability::RobustOracle& oracle, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to);
/// The safety factor under the scene's criterion: of equilibrium alone, otherwise of robust stability (under criterion
/// frictional it may be 0 at a stance that holds).
stability::SafetyFactor safety_factor(const Scene& scene, const stability::RobustOracle& oracle,
                                      const Eigen::Vector2d& com);
stability::LineSafetyFactor safety_factor(const Scene& scene, const stability::RobustOracle& oracle,
                                          const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Stance rules: reach, clearance, stability of two planted feet. The first broken one, cheapest first; nothing if all
/// hold.
std::optional<Rule> broken_stance_rule(const Scene& scene, const Stance& stance);
/// The same with the oracle of stance.feet at hand.
std::optional<Rule> broken_stance_rule(const Scene& scene, const Stance& stance, const stability::RobustOracle& oracle);
/// Rules of the first stance alone: its two feet are start feet (the support, if one is given), the COM is the given
/// one if one is given, both legs are visible from it; and all stance rules.
std::optional<Rule> broken_start_rule(const Scene& scene, const Stance& stance);

/// What placing a leg asks of the COM at rest that it is placed from: foothold, reach, visibility at touch-down, swing.
std::optional<Rule> broken_placement_rule(const Scene& scene, const Eigen::Vector2d& com,
                                          const terrain::Foothold& foothold,
                                          const std::optional<terrain::Foothold>& swing_from);
/// Transfer rules between two stances that hold: reach and clearance along the line, leg visibility at touch-down
/// (from.com) and lift-off (to.com), swing from `swing_from` (if the leg has been lifted from somewhere), stability of
/// the line on three contacts.
std::optional<Rule> broken_transfer_rule(const Scene& scene, const Stance& from, const Transfer& transfer,
                                         const Eigen::Vector2d& com_to,
                                         const std::optional<terrain::Foothold>& swing_from);
/// The same with the oracle of feet_during(from, transfer) at hand.
std::optional<Rule> broken_transfer_rule(const Scene& scene, const Stance& from, const Transfer& transfer,
                                         const Eigen::Vector2d& com_to,
                                         const std::optional<terrain::Foothold>& swing_from,
                                         const stability::RobustOracle& oracle);

/// Fills in safety factors and limits of every stance and transfer, and of the plan. Throws std::invalid_argument for a
/// plan that has not one stance more than transfers, or a stance without feet; std::out_of_range for a leg that there
/// is not.
void rate(const Scene& scene, Plan& plan);

}  // namespace surefoot::gaits
