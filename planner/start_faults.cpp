#include "planner/start_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "gaits/foothold_words.hpp"
#include "gaits/frictional_words.hpp"
#include "planner/com_window.hpp"
#include "terrain/back_faces.hpp"

namespace surefoot::planner {

using gaits::Rule;

std::string legs_in_words(const gaits::Stance& stance) {
  std::string text;
  for (int leg = 0; leg < gaits::leg_count; ++leg)
    if (stance.feet[leg]) text += (text.empty() ? "" : " and ") + std::to_string(leg + 1);
  return text;
}

void PairFaults::add(const gaits::Stance& stance, const std::string& words) {
  const std::string legs = legs_in_words(stance);
  const std::size_t named = words.find("feet " + legs);
  Cause cause{words, "", ""};
  if (named != std::string::npos) {
    const std::size_t at = named + std::string_view("feet ").size();
    cause = {words.substr(0, at), legs, words.substr(at + legs.size())};
  }
  const auto same = std::find_if(causes_.begin(), causes_.end(), [&](const Cause& other) {
    return other.before == cause.before && other.after == cause.after;
  });
  if (same == causes_.end()) causes_.push_back(std::move(cause));
  else if (!cause.legs.empty()) same->legs += ", " + cause.legs;
}

std::string PairFaults::words() const {
  std::string text;
  for (const Cause& cause : causes_) text += (text.empty() ? "" : "; ") + cause.before + cause.legs + cause.after;
  return advice_.empty() ? text : text + "; " + advice_;
}

namespace {

/// Where the COMs that balance on two feet lie, as advice; "" if there are none within reach, or this is one.
std::string balancing_coms(const gaits::Scene& scene, const gaits::Stance& stance) {
  const Polygon window = reach_window(stance.feet, scene.robot.reach_max);
  const auto oracle = gaits::oracle_of(scene, stance.feet, box_of_stances(scene));
  if (window.empty() || oracle.equilibrium(stance.com)) return "";
  const Polygon polygon = oracle.equilibrium_polygon(window);
  if (polygon.empty()) return "";
  const auto [left, right] =
      std::minmax_element(polygon.begin(), polygon.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return fmt::format("; COMs that balance there have x between {:.4g} and {:.4g}", left->x(), right->x());
}

}  // namespace

std::string broken_rule_words(const gaits::Scene& scene, const gaits::Stance& stance, Rule rule) {
  const gaits::Robot& robot = scene.robot;
  if (rule == Rule::leg_visibility || rule == Rule::clearance)
    if (const auto chain = terrain::solid_around(scene.terrain, Eigen::AlignedBox2d(stance.com)))
      return fmt::format("the COM lies behind chain {}, in what pictures show as solid ground", *chain);
  for (int leg = 0; leg < gaits::leg_count; ++leg) {
    if (!stance.feet[leg]) continue;
    const double distance = (stance.com - stance.feet[leg]->position).norm();
    if (rule == Rule::reach && !gaits::within_reach(robot, stance.feet[leg]->position, stance.com, stance.com))
      return fmt::format("foot {} is {:.6g} m from the COM, reach is [{}, {}] m", leg + 1, distance, robot.reach_min,
                         robot.reach_max);
    if (rule == Rule::leg_visibility && !scene.terrain.leg_is_free(stance.com, *stance.feet[leg]))
      return fmt::format("leg {} cuts the terrain on its way from the COM to its foot", leg + 1);
  }
  if (rule == Rule::clearance)
    return fmt::format("the COM is {:.6g} m from the terrain, clearance is {} m",
                       scene.terrain.distance(stance.com, 2 * robot.clearance + robot.reach_max), robot.clearance);
  const auto oracle = gaits::oracle_of(scene, stance.feet);
  const auto sigma = gaits::safety_factor(scene, oracle, stance.com);
  if (gaits::asks_frictional(scene.criterion))
    if (const std::string why = gaits::frictional_fault(oracle.posture(), stance.com, *scene.restitution); !why.empty())
      return fmt::format("not frictionally stable on feet {} for restitution {}: {}{}", legs_in_words(stance),
                         *scene.restitution, why, balancing_coms(scene, stance));
  return fmt::format("not stable on feet {}: safety factor {:.4g}, limited by {}; more than 1 is needed{}",
                     legs_in_words(stance), sigma.value, sigma.critical.name(),
                     sigma.value > 0 ? "" : balancing_coms(scene, stance));
}

stability::DisturbanceBox box_of_stances(const gaits::Scene& scene) {
  if (scene.criterion != gaits::Criterion::frictional) return scene.disturbance;
  return {.kappa = 0, .nu = 0};
}

std::string friction_fault(const gaits::Scene& scene, const gaits::Stance& stance) {
  // Forces f of the feet balance a disturbance fx/fy = p only if their sum is along (p, 1), so only if that direction
  // lies inside the cone spanned by the edges n +- mu t of all friction cones. Where all edges rise these are the
  // slopes between the least and the greatest e_x / e_y. Equality does not balance (R_SS is open); it is taken for
  // sure only on level ground, where the slopes are +-mu without rounding.
  if (scene.criterion == gaits::Criterion::frictional) return "";  // stances need not bear W
  constexpr double least_rise = 1e-3;  // [1] of an edge, relative; flatter ones lose their slope to rounding
  constexpr double rounding = 1e-11;   // [1] of a slope, relative; some units in the last place over least_rise
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  bool level = true;
  for (const auto& foot : stance.feet) {
    if (!foot) continue;
    level = level && foot->normal.x() == 0;
    for (const double mu : {-foot->friction, foot->friction}) {
      const Eigen::Vector2d edge = foot->normal + mu * Eigen::Vector2d(foot->normal.y(), -foot->normal.x());
      if (!(edge.y() > least_rise * (1 + foot->friction))) return "";
      least = std::min(least, edge.x() / edge.y());
      greatest = std::max(greatest, edge.x() / edge.y());
    }
  }
  const double borne = std::min(greatest, -least) + 0.0, kappa = scene.disturbance.kappa;
  const double error = level ? 0 : rounding * (1 + std::max(greatest, -least));
  if (!(kappa > borne + error || (level && kappa >= borne))) return "";
  if (borne < -error)
    return fmt::format(
        "no COM balances on feet {}, even without disturbances: the ground is too steep for its friction",
        legs_in_words(stance));
  if (kappa == 0)
    return fmt::format("no COM balances on feet {}: without friction they bear no sideways push, however small",
                       legs_in_words(stance));
  const std::string pushes =
      std::abs(borne) <= error ? "no sideways push" : fmt::format("sideways pushes below {:.6g} of the weight", borne);
  return fmt::format("no COM balances on feet {}: friction bears {}, kappa is {}", legs_in_words(stance), pushes,
                     kappa);
}

namespace {

/// Proof that no COM within reach of two feet balances every disturbance of a box: limits of reach and balance are
/// drawn out by more than any rounding, so that a single COM at the very limit is not denied.
bool no_com_balances(const gaits::Scene& scene, const gaits::Feet& feet, const stability::DisturbanceBox& box) {
  constexpr double margin = gaits::limit_margin;
  double extent = scene.robot.reach_max, steepest = 0;
  for (const auto& foot : feet)
    if (foot) extent = std::max(extent, foot->position.cwiseAbs().maxCoeff());
  const auto planes = gaits::oracle_of(scene, feet, box).equilibrium_half_planes();
  for (const auto& plane : planes) steepest = std::max(steepest, plane.normal.norm());
  Polygon left = reach_window(feet, scene.robot.reach_max + margin * extent);
  for (const auto& plane : planes)
    left = clip_to_half_plane(left, -plane.normal, plane.offset + margin * extent * steepest);
  return left.empty();
}

/// How far the two feet of a stance are apart [m].
double apart(const gaits::Stance& stance) {
  const auto& one = stance.feet[0] ? stance.feet[0] : stance.feet[1];
  const auto& other = stance.feet[2] ? stance.feet[2] : stance.feet[1];
  return (one->position - other->position).norm();
}

std::string near_feet(const gaits::Scene& scene, const gaits::Stance& stance) {
  return apart(stance) < scene.robot.reach_max / 10 ? fmt::format(" for feet {:.3g} m apart", apart(stance)) : "";
}

}  // namespace

std::string hanging_feet(const gaits::Scene& scene) {
  std::string text;
  for (int leg = 0; leg < gaits::leg_count; ++leg) {
    const auto& foot = scene.start.feet[leg];
    if (!gaits::may_carry(scene.start, leg) || !gaits::cannot_push_up(*foot)) continue;
    text += fmt::format("; foot {} hangs below chain {}, which runs from right to left there: reverse its vertices?",
                        leg + 1, foot->chain);
  }
  return text;
}

BalanceFault balance_fault(const gaits::Scene& scene, const gaits::Stance& stance) {
  const auto [kappa, nu] = box_of_stances(scene);
  const std::string nobody = fmt::format("no COM within reach of feet {} ", legs_in_words(stance));
  const auto impossible = [&](double push_of, double turn_of) {
    return no_com_balances(scene, stance.feet, {push_of, turn_of});
  };
  if (!impossible(kappa, nu)) return {false, nobody + "was found to balance every disturbance"};
  if (impossible(0, 0))
    return {true,
            nobody + "balances, even without disturbances" + (apart(stance) == 0 ? ": they stand at one point" : "")};
  const bool push = impossible(kappa, 0), turn = impossible(0, nu);
  std::string cause = fmt::format("kappa = {} and nu = {} together are too much", kappa, nu);
  if (push != turn)
    cause = push ? fmt::format("kappa = {} alone is too much", kappa)
                 : fmt::format("nu = {} m alone is too much", nu) + near_feet(scene, stance);
  if (push && turn) cause = fmt::format("kappa = {} alone is too much, and so is nu = {} m", kappa, nu);
  return {true, nobody + "balances every disturbance: " + cause};
}

std::string no_com_words(const gaits::Scene& scene, const gaits::Stance& stance) {
  if (std::string slips = friction_fault(scene, stance); !slips.empty()) return slips;
  const BalanceFault fault = balance_fault(scene, stance);
  return fault.proven ? fault.words : "";
}

}  // namespace surefoot::planner
