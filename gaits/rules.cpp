#include "gaits/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "stability/frictional.hpp"
#include "stability/given.hpp"

namespace surefoot::gaits {

using Eigen::Vector2d;
using stability::RobustOracle;
using terrain::Foothold;

namespace {

constexpr bool is_leg(int leg) { return leg >= 0 && leg < leg_count; }

int planted(const Feet& feet) {
  return static_cast<int>(std::count_if(feet.begin(), feet.end(), [](const auto& foot) { return foot.has_value(); }));
}

/// Squared distance of a point from the straight line a -> b.
double squared_distance(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  if (length2 == 0) return (point - a).squaredNorm();
  const double lambda = std::clamp((point - a).dot(d) / length2, 0.0, 1.0);
  return (a + lambda * d - point).squaredNorm();
}

bool stands_where_it_may(const Scene& scene, const Foothold& foot) {
  return foot.chain >= 0 && foot.chain < scene.terrain.chain_count() &&
         scene.terrain.foothold_at(foot.chain, foot.s).has_value();
}

/// Transfer rules that need no oracle.
std::optional<Rule> broken_transfer_geometry(const Scene& scene, const Stance& from, const Transfer& transfer,
                                             const Vector2d& com_to, const std::optional<Foothold>& swing_from) {
  if (!is_leg(transfer.leg) || !is_leg(transfer.lift) || planted(from.feet) != 2 ||
      from.feet[static_cast<std::size_t>(transfer.leg)]) {
    return Rule::gait;
  }
  const Feet feet = feet_during(from, transfer);
  if (!within_reach(scene.robot, feet, from.com, com_to)) return Rule::reach;
  if (const auto rule = broken_placement_rule(scene, from.com, transfer.foothold, swing_from)) return rule;
  if (!clear_of_terrain(scene, from.com, com_to)) return Rule::clearance;
  if (!scene.terrain.leg_is_free(com_to, *feet[static_cast<std::size_t>(transfer.lift)])) return Rule::leg_visibility;
  return std::nullopt;
}

std::optional<Rule> broken_stance_geometry(const Scene& scene, const Stance& stance) {
  if (planted(stance.feet) != 2) return Rule::gait;
  if (!within_reach(scene.robot, stance.feet, stance.com, stance.com)) return Rule::reach;
  if (!clear_of_terrain(scene, stance.com, stance.com)) return Rule::clearance;
  return std::nullopt;
}

}  // namespace

const char* to_string(Rule rule) {
  switch (rule) {
    case Rule::foothold: return "foothold";
    case Rule::reach: return "reach";
    case Rule::clearance: return "clearance";
    case Rule::leg_visibility: return "leg visibility";
    case Rule::swing: return "swing";
    case Rule::stance_stability: return "stance stability";
    case Rule::transfer_stability: return "transfer stability";
    case Rule::gait: return "gait";
  }
  return "";
}

Robot drawn_in(const Robot& robot) {
  const double margin = limit_margin * robot.reach_max;
  Robot inner = robot;
  inner.reach_min += margin;
  inner.reach_max -= margin;
  inner.clearance += margin;
  return inner;
}

stability::DisturbanceBox widened(const stability::DisturbanceBox& box) {
  return {(1 + limit_margin) * box.kappa, (1 + limit_margin) * box.nu};
}

// Distance to a fixed foot is convex along the line: it is greatest at an end.
bool within_reach(const Robot& robot, const Vector2d& foot, const Vector2d& from, const Vector2d& to) {
  const double slack = limit_slack * robot.reach_max;
  const double least = robot.reach_min - slack, greatest = robot.reach_max + slack;
  if (std::max((from - foot).squaredNorm(), (to - foot).squaredNorm()) > greatest * greatest) return false;
  return least <= 0 || squared_distance(foot, from, to) >= least * least;
}

bool within_reach(const Robot& robot, const Feet& feet, const Vector2d& from, const Vector2d& to) {
  return std::all_of(feet.begin(), feet.end(),
                     [&](const auto& foot) { return !foot || within_reach(robot, foot->position, from, to); });
}

bool clear_of_terrain(const Scene& scene, const Vector2d& from, const Vector2d& to) {
  const double required = scene.robot.clearance - limit_slack * scene.robot.reach_max;
  if (required > 0) return scene.terrain.distance(from, to, scene.robot.clearance) >= required;
  return !scene.terrain.blocks(from, to);
}

bool swings_any_way(const Scene& scene, const Vector2d& com) {
  const double radius = scene.robot.reach_min;
  // distance() looks no further than it is told: a little beyond the radius, so that "further" can be told from "at".
  return radius == 0 || scene.terrain.distance(com, 1.001 * radius) > radius;
}

bool swing_is_free(const Scene& scene, const Vector2d& com, const Vector2d& old_foot, const Vector2d& new_foot) {
  if (swings_any_way(scene, com)) return true;
  const double radius = scene.robot.reach_min;
  const Vector2d from = old_foot - com, to = new_foot - com;
  return scene.terrain.sector_is_free(com, radius, from, to) || scene.terrain.sector_is_free(com, radius, to, from);
}

std::optional<double> swing_turn(const Scene& scene, const Vector2d& com, const Vector2d& old_foot,
                                 const Vector2d& new_foot) {
  const double radius = scene.robot.reach_min;
  const Vector2d from = old_foot - com, to = new_foot - com;
  const bool any_way = swings_any_way(scene, com);
  const bool left = any_way || scene.terrain.sector_is_free(com, radius, from, to);
  const bool right = any_way || scene.terrain.sector_is_free(com, radius, to, from);
  const double angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  if (angle >= 0 ? left : right) return angle;  // the shorter way
  if (left) return angle + 2 * std::numbers::pi;
  if (right) return angle - 2 * std::numbers::pi;
  return std::nullopt;
}

RobustOracle oracle_of(const Scene& scene, const Feet& feet) { return oracle_of(scene, feet, scene.disturbance); }

RobustOracle oracle_of(const Scene& scene, const Feet& feet, const stability::DisturbanceBox& box) {
  std::array<stability::Contact, leg_count> contacts;
  std::size_t count = 0;
  for (const auto& foot : feet) {
    if (foot) contacts[count++] = contact_at(*foot);
  }
  return RobustOracle(std::span<const stability::Contact>(contacts.data(), count), scene.robot.radius_of_gyration, box);
}

bool is_stable(const Scene& scene, const RobustOracle& oracle, const Vector2d& com) {
  switch (scene.criterion) {
    case Criterion::robust: return oracle.robust(com);
    case Criterion::equilibrium: return oracle.equilibrium(com);
    case Criterion::frictional: break;
    case Criterion::both:
      if (!oracle.robust(com)) return false;
  }
  stability::require(scene.restitution.has_value(), "scene: the criterion needs a restitution");
  return stability::frictionally_stable(oracle.posture(), com, *scene.restitution);
}

bool is_stable(const Scene& scene, const RobustOracle& oracle, const Vector2d& from, const Vector2d& to) {
  return scene.criterion == Criterion::equilibrium ? oracle.line_equilibrium(from, to) : oracle.line(from, to).stable();
}

stability::SafetyFactor safety_factor(const Scene& scene, const RobustOracle& oracle, const Vector2d& com) {
  return scene.criterion == Criterion::equilibrium ? oracle.equilibrium_factor(com) : oracle.safety_factor(com);
}

stability::LineSafetyFactor safety_factor(const Scene& scene, const RobustOracle& oracle, const Vector2d& from,
                                          const Vector2d& to) {
  return scene.criterion == Criterion::equilibrium ? oracle.line_equilibrium_factor(from, to)
                                                   : oracle.line_safety_factor(from, to);
}

std::optional<Rule> broken_stance_rule(const Scene& scene, const Stance& stance, const RobustOracle& oracle) {
  if (const auto rule = broken_stance_geometry(scene, stance)) return rule;
  if (!is_stable(scene, oracle, stance.com)) return Rule::stance_stability;
  return std::nullopt;
}

std::optional<Rule> broken_stance_rule(const Scene& scene, const Stance& stance) {
  if (const auto rule = broken_stance_geometry(scene, stance)) return rule;
  if (!is_stable(scene, oracle_of(scene, stance.feet), stance.com)) return Rule::stance_stability;
  return std::nullopt;
}

std::optional<Rule> broken_start_rule(const Scene& scene, const Stance& stance) {
  const Start& start = scene.start;
  for (int leg = 0; leg < leg_count; ++leg) {
    const auto& foot = stance.feet[static_cast<std::size_t>(leg)];
    const auto& given = start.feet[static_cast<std::size_t>(leg)];
    if (start.support && foot.has_value() != (leg == start.support->first || leg == start.support->second))
      return Rule::gait;
    if (foot && !(given && given->chain == foot->chain && given->s == foot->s)) return Rule::gait;
  }
  if (start.com && *start.com != stance.com) return Rule::gait;
  if (const auto rule = broken_stance_rule(scene, stance)) return rule;
  for (const auto& foot : stance.feet) {
    if (foot && !scene.terrain.leg_is_free(stance.com, *foot)) return Rule::leg_visibility;
  }
  return std::nullopt;
}

std::optional<Rule> broken_placement_rule(const Scene& scene, const Vector2d& com, const Foothold& foothold,
                                          const std::optional<Foothold>& swing_from) {
  if (!within_reach(scene.robot, foothold.position, com, com)) return Rule::reach;
  if (!stands_where_it_may(scene, foothold)) return Rule::foothold;
  if (!scene.terrain.leg_is_free(com, foothold)) return Rule::leg_visibility;
  if (swing_from && !swing_is_free(scene, com, swing_from->position, foothold.position)) return Rule::swing;
  return std::nullopt;
}

std::optional<Rule> broken_transfer_rule(const Scene& scene, const Stance& from, const Transfer& transfer,
                                         const Vector2d& com_to, const std::optional<Foothold>& swing_from,
                                         const RobustOracle& oracle) {
  if (const auto rule = broken_transfer_geometry(scene, from, transfer, com_to, swing_from)) return rule;
  if (!is_stable(scene, oracle, from.com, com_to)) return Rule::transfer_stability;
  return std::nullopt;
}

std::optional<Rule> broken_transfer_rule(const Scene& scene, const Stance& from, const Transfer& transfer,
                                         const Vector2d& com_to, const std::optional<Foothold>& swing_from) {
  if (const auto rule = broken_transfer_geometry(scene, from, transfer, com_to, swing_from)) return rule;
  if (!is_stable(scene, oracle_of(scene, feet_during(from, transfer)), from.com, com_to))
    return Rule::transfer_stability;
  return std::nullopt;
}

void rate(const Scene& scene, Plan& plan) {
  stability::require(plan.transfers.size() + (plan.stances.empty() ? 0 : 1) == plan.stances.size(),
                     "plan: expected one stance more than transfers");
  double least = std::numeric_limits<double>::infinity();
  for (Stance& stance : plan.stances) {
    const auto sigma = safety_factor(scene, oracle_of(scene, stance.feet), stance.com);
    stance.safety_factor = sigma.value;
    stance.limit = sigma.critical.name();
    least = std::min(least, sigma.value);
  }
  for (std::size_t k = 0; k < plan.transfers.size(); ++k) {
    Transfer& transfer = plan.transfers[k];
    const auto oracle = oracle_of(scene, feet_during(plan.stances[k], transfer));
    const auto sigma = safety_factor(scene, oracle, plan.stances[k].com, plan.stances[k + 1].com).least;
    transfer.safety_factor = sigma.value;
    transfer.limit = sigma.critical.name();
    least = std::min(least, sigma.value);
  }
  plan.safety_factor = plan.stances.empty() ? 0 : least;
}

}  // namespace surefoot::gaits
