#include "planner/step_proposals.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::planner {

using Eigen::Vector2d;
using gaits::Rule;

namespace {

/// Share of proposals that put the foot just placed back into the air: the COM moves, the support stays.
constexpr double keep_support_share = 0.08;
/// Share of proposals that aim at the goal where the next stance can reach it.
constexpr double goal_share = 0.7;
/// Weight of the feet in progress_point. Measured: without it stairs and rubble take some ten times as long.
constexpr double feet_share = 0.3;
/// COMs tried per polygon: cheap beside the polygon itself.
constexpr int com_tries = 4;
/// Steps of the additive recurrence R2 (powers of the plastic number): COMs tried in turn spread evenly.
constexpr double r2_u = 0.7548776662466927, r2_v = 0.5698402909980532;

double fraction(double value) { return value - std::floor(value); }

int lifted_leg(double u, int placed) {
  if (u < keep_support_share) return placed;
  const bool second = u >= (1 + keep_support_share) / 2;
  return (placed + (second ? 2 : 1)) % gaits::leg_count;
}

}  // namespace

Eigen::Vector2d progress_point(const Node& node) {
  const auto [a, b] = node.support();
  return (1 - feet_share) * node.com + feet_share / 2 * (node.feet[a]->position + node.feet[b]->position);
}

StepProposals::StepProposals(const gaits::Scene& scene, const stability::DisturbanceBox& box)
    : scene_(&scene), robot_(gaits::drawn_in(scene.robot)), box_(box) {}

void StepProposals::prepare(const Node& from) {
  if (from.id != 0 && from.id == source_) return;
  source_ = from.id;
  const terrain::Terrain& terrain = scene_->terrain;
  stretches_ = terrain.stretches_within(from.com, robot_.reach_min, robot_.reach_max);
  stretch_total_ = 0;
  for (const auto& stretch : stretches_) stretch_total_ += stretch.s_end - stretch.s_begin;
  // With nothing nearer than the least reach the free leg, shortened to it, turns any way.
  swings_freely_ = !from.feet[from.free_leg] || terrain.distance(from.com, robot_.reach_min) > scene_->robot.reach_min;
}

std::optional<terrain::Foothold> StepProposals::landing(double u) const {
  double left = u * stretch_total_;
  for (const auto& stretch : stretches_) {
    const double length = stretch.s_end - stretch.s_begin;
    if (left <= length) return scene_->terrain.foothold_at(stretch.segment->chain, stretch.s_begin + left);
    left -= length;
  }
  return std::nullopt;
}

bool StepProposals::placement_is_legal(const Node& from, const terrain::Foothold& foothold) {
  if (!gaits::within_reach(robot_, foothold.position, from.com, from.com)) return refuse(Rule::reach);
  if (!scene_->terrain.leg_is_free(from.com, foothold)) return refuse(Rule::leg_visibility);
  ++counts_.swings_asked;
  if (swings_freely_) {
    ++counts_.swings_skipped;
    return true;
  }
  return gaits::swing_is_free(*scene_, from.com, from.feet[from.free_leg]->position, foothold.position) ||
         refuse(Rule::swing);
}

bool StepProposals::com_is_legal(const Node& from, const Node& to, const gaits::Feet& three) {
  const terrain::Terrain& terrain = scene_->terrain;
  if (!terrain.leg_is_free(to.com, *three[to.free_leg])) return refuse(Rule::leg_visibility);
  if (terrain.distance(from.com, to.com, robot_.clearance) < robot_.clearance) return refuse(Rule::clearance);
  return gaits::is_stable(*scene_, gaits::oracle_of(*scene_, three, box_), from.com, to.com) ||
         refuse(Rule::transfer_stability);
}

bool StepProposals::propose(const Node& from, const StepCode& code, Node& to, const Target* target,
                            double nearer_than) {
  ++counts_.proposed;
  prepare(from);
  const auto foothold = landing(code[0]);
  if (!foothold) return refuse(stretches_.empty() ? Rule::reach : Rule::foothold);

  Node next;
  next.free_leg = lifted_leg(code[1], from.free_leg);
  next.feet = from.feet;
  next.feet[from.free_leg] = foothold;
  const gaits::Feet three = next.feet;
  gaits::Feet two = three;
  two[next.free_leg].reset();

  // Geometry of the landing first, unless nothing could follow it anyway.
  const Polygon window = reach_window(three, robot_.reach_max);
  if (window.empty()) return refuse(Rule::reach);
  if (!placement_is_legal(from, *foothold)) return false;
  const auto oracle = gaits::oracle_of(*scene_, two, box_);
  Polygon polygon = oracle.equilibrium_polygon(window);
  if (polygon.empty()) return refuse(Rule::stance_stability);
  if (code[4] < goal_share)
    if (Polygon in_goal = clip_to_goal(polygon, scene_->goal); !in_goal.empty()) polygon = std::move(in_goal);

  std::optional<Rule> broken;
  for (int k = 0; k < com_tries; ++k) {
    next.com = point_in(polygon, fraction(code[2] + k * r2_u), fraction(code[3] + k * r2_v));
    if (target && target->distance(progress_point(next)) >= nearer_than) continue;
    broken = Rule::reach;
    if (!gaits::within_reach(robot_, three, from.com, next.com)) continue;
    broken = Rule::stance_stability;
    if (!gaits::is_stable(*scene_, oracle, next.com)) continue;
    if (!com_is_legal(from, next, three)) return false;
    next.id = next_id();
    ++counts_.legal;
    to = next;
    return true;
  }
  return broken ? refuse(*broken) : false;
}

bool StepProposals::is_legal(const Node& from, const Node& to) {
  ++counts_.proposed;
  prepare(from);
  gaits::Feet three = from.feet;
  three[from.free_leg] = to.feet[from.free_leg];
  if (!gaits::within_reach(robot_, three, from.com, to.com)) return refuse(Rule::reach);
  if (!placement_is_legal(from, *three[from.free_leg])) return false;
  gaits::Feet two = three;
  two[to.free_leg].reset();
  if (!gaits::is_stable(*scene_, gaits::oracle_of(*scene_, two, box_), to.com)) return refuse(Rule::stance_stability);
  if (!com_is_legal(from, to, three)) return false;
  ++counts_.legal;
  return true;
}

std::string summary(const ProposalCounts& counts) {
  const std::string refused = shares(counts.blocked);
  return std::to_string(counts.legal) + " legal steps among " + std::to_string(counts.proposed) + " proposals" +
         (refused.empty() ? "" : "; refused for " + refused);
}

}  // namespace surefoot::planner
