#include "planner/refine_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gaits/rules.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::planner {

using Eigen::Vector2d;
using Eigen::VectorXd;
using gaits::leg_count;

namespace {

/// Feet keep this far from the ends of their segment [m], or a twentieth of its length where that is less.
constexpr double vertex_margin = 0.005;
/// Step of the central differences for feet and clearance [relative to reach_max]: the cube root of the relative
/// error of a safety factor (1e-12) is 1e-4; smaller, because kinks are near and first order is enough.
constexpr double difference_step = 1e-6;
/// Relative difference of two factors that are equal but for rounding (their error is about 1e-12).
constexpr double bound_tolerance = 1e-11;
/// Factors are followed by foot derivatives only below this multiple of the least one.
constexpr double near_least = 3;

/// Equilibrium bounds every safety factor from above. One of its facets depends on the COM through z_3 x alone (theory
/// section 3), so a zero gradient means z_3 = 0: that facet gives the same number at every COM, and a factor that has
/// reached it cannot rise, whatever mode shares the place of being least.
Factor factor_of(const stability::RobustOracle& oracle, const stability::SafetyFactor& safety, const Vector2d& com) {
  const stability::SafetyFactor limit = oracle.equilibrium_factor(com);
  const bool reached = std::isfinite(limit.value) && safety.value >= limit.value * (1 - bound_tolerance);
  return {.value = safety.value, .bound = reached && limit.gradient.isZero(0)};
}

}  // namespace

Factor stance_factor(const gaits::Scene& scene, const gaits::Feet& feet, const Vector2d& com) {
  const auto oracle = gaits::oracle_of(scene, feet);
  const stability::SafetyFactor safety =
      scene.criterion == gaits::Criterion::equilibrium ? oracle.equilibrium_factor(com) : oracle.safety_factor(com);
  Factor factor = factor_of(oracle, safety, com);
  factor.from_gradient = safety.gradient;
  return factor;
}

Factor transfer_factor(const gaits::Scene& scene, const gaits::Feet& feet, const Vector2d& from, const Vector2d& to) {
  const auto oracle = gaits::oracle_of(scene, feet);
  const stability::LineSafetyFactor line = scene.criterion == gaits::Criterion::equilibrium
                                               ? oracle.line_equilibrium_factor(from, to)
                                               : oracle.line_safety_factor(from, to);
  Factor factor = factor_of(oracle, line.least, from + line.lambda * (to - from));
  factor.lambda = line.lambda;
  factor.from_gradient = (1 - line.lambda) * line.least.gradient;  // envelope theorem: lambda stays where it is
  factor.to_gradient = line.lambda * line.least.gradient;
  return factor;
}

double factor_cap(double least) { return std::max(10.0, 10 * least); }

Timeline::Timeline(const gaits::Plan& plan) {
  const int steps = plan.steps();
  std::array<int, leg_count> now{-1, -1, -1}, last{-1, -1, -1};
  const auto place = [&](int leg, int transfer) {
    now[leg] = last[leg] = static_cast<int>(placements.size());
    placements.push_back({.leg = leg, .placed_by = transfer, .lifted_by = steps});
  };
  for (int leg = 0; leg < leg_count; ++leg)
    if (plan.stances.front().feet[leg]) place(leg, -1);
  stances.push_back(now);
  for (int k = 0; k < steps; ++k) {
    const gaits::Transfer& transfer = plan.transfers[k];
    swing_from.push_back(last[transfer.leg]);
    place(transfer.leg, k);
    transfers.push_back(now);
    placements[now[transfer.lift]].lifted_by = k;
    now[transfer.lift] = -1;
    stances.push_back(now);
  }
}

RefineWindow::RefineWindow(const gaits::Scene& scene, gaits::Plan& plan, const Timeline& timeline, int first, int last,
                           double cap)
    : scene_(scene), plan_(plan), timeline_(timeline), first_(first), last_(last), cap_(cap) {
  for (int id = 0; id < static_cast<int>(timeline.placements.size()); ++id) {
    const Placement& p = timeline.placements[id];
    // Wholly inside: whatever the foot touches is evaluated here.
    const bool inside = p.placed_by >= 0 && p.placed_by >= first_transfer() &&
                        (p.lifted_by < plan.steps() ? p.lifted_by <= last_transfer() : last == plan.steps());
    if (inside) foot_variables_.push_back(id);
  }
  const Eigen::Index count = 2 * (last - first + 1) + static_cast<Eigen::Index>(foot_variables_.size());
  start_.setZero(count), lower_.setZero(count), upper_.setZero(count);
  add_com_variables();
  add_foot_variables();
}

void RefineWindow::add_com_variables() {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  for (int k = first_; k <= last_; ++k) {
    const Eigen::Index at = 2 * (k - first_);
    start_.segment<2>(at) = plan_.stances[k].com;
    lower_.segment<2>(at).setConstant(-unbounded);
    upper_.segment<2>(at).setConstant(unbounded);
    if (k != plan_.steps()) continue;
    const auto bound = [&](Eigen::Index i, const std::optional<std::pair<double, double>>& interval) {
      if (interval) lower_[i] = interval->first, upper_[i] = interval->second;
    };
    bound(at, scene_.goal.com_x);
    bound(at + 1, scene_.goal.com_y);
  }
}

void RefineWindow::add_foot_variables() {
  Eigen::Index at = 2 * (last_ - first_ + 1);
  for (const int id : foot_variables_) {
    const terrain::Foothold& here = foothold(id);
    const terrain::Segment& segment = scene_.terrain.segment(here.chain, here.segment);
    const double margin = std::min(vertex_margin, segment.length / 20);
    start_[at] = here.s;
    lower_[at] = std::min(here.s, segment.s_begin + margin);
    upper_[at] = std::max(here.s, segment.s_begin + segment.length - margin);
    feet_.push_back({.base = here.position - here.s * segment.tangent,
                     .first = static_cast<int>(at),
                     .count = 1,
                     .direction = segment.tangent});
    ++at;
  }
}

const terrain::Foothold& RefineWindow::foothold(int placement) const {
  const Placement& p = timeline_.placements[placement];
  return p.placed_by < 0 ? *plan_.stances.front().feet[p.leg] : plan_.transfers[p.placed_by].foothold;
}

MovingPoint RefineWindow::com(int stance) const {
  if (stance < first_ || stance > last_) return {.base = plan_.stances[stance].com};
  return {.first = 2 * (stance - first_), .count = 2};
}

MovingPoint RefineWindow::foot(int placement) const {
  const auto found = std::find(foot_variables_.begin(), foot_variables_.end(), placement);
  if (found == foot_variables_.end()) return {.base = foothold(placement).position};
  return feet_[found - foot_variables_.begin()];
}

RefineModel RefineWindow::model() const {
  RefineModel model;
  const gaits::Robot inner = gaits::drawn_in(gaits::drawn_in(scene_.robot));  // twice: NLopt's tolerance is inside too
  model.reach_min = inner.reach_min;
  model.reach_max = inner.reach_max;
  model.least_clearance = inner.clearance;
  model.lower = lower_;
  model.upper = upper_;
  model.sum_gradient = VectorXd::Zero(variables());
  for (int k = first_transfer(); k <= last_transfer(); ++k)
    for (const int id : timeline_.transfers[k])
      if (id >= 0) model.reach.push_back({.from = com(k), .to = com(k + 1), .foot = foot(id)});
  if (plan_.steps() == 0)
    for (const int id : timeline_.stances[0])
      if (id >= 0) model.reach.push_back({.from = com(0), .to = com(0), .foot = foot(id)});
  return model;
}

bool RefineWindow::write(const VectorXd& x) {
  for (int k = first_; k <= last_; ++k) plan_.stances[k].com = x.segment<2>(2 * (k - first_));
  for (std::size_t i = 0; i < foot_variables_.size(); ++i) {
    const Placement& p = timeline_.placements[foot_variables_[i]];
    gaits::Transfer& placing = plan_.transfers[p.placed_by];
    if (x[feet_[i].first] == placing.foothold.s) continue;
    const auto moved = scene_.terrain.foothold_at(placing.foothold.chain, x[feet_[i].first]);
    if (!moved || moved->segment != placing.foothold.segment) return false;
    placing.foothold = *moved;
    for (int k = p.placed_by + 1; k <= p.lifted_by; ++k) plan_.stances[k].feet[p.leg] = *moved;
  }
  return true;
}

VectorXd RefineWindow::values() const {
  VectorXd x = start_;
  for (int k = first_; k <= last_; ++k) x.segment<2>(2 * (k - first_)) = plan_.stances[k].com;
  for (std::size_t i = 0; i < feet_.size(); ++i) x[feet_[i].first] = foothold(foot_variables_[i]).s;
  return x;
}

std::vector<RefineWindow::Element> RefineWindow::elements() const {
  std::vector<Element> out;
  for (int k = first_; k <= last_; ++k)
    out.push_back({k, false, stance_factor(scene_, plan_.stances[k].feet, plan_.stances[k].com)});
  for (int k = first_transfer(); k <= last_transfer(); ++k)
    out.push_back({k, true, transfer_factor(scene_, feet_of(k), plan_.stances[k].com, plan_.stances[k + 1].com)});
  return out;
}

/// By differences at the point of the line where the factor is least (envelope theorem: that point stays).
double RefineWindow::foot_slope(const Element& element, int placement) const {
  const MovingPoint moving = foot(placement);
  const double step = difference_step * scene_.robot.reach_max;
  gaits::Feet feet = element.transfer ? feet_of(element.stance) : plan_.stances[element.stance].feet;
  Vector2d com = plan_.stances[element.stance].com;
  if (element.transfer) com += element.factor.lambda * (plan_.stances[element.stance + 1].com - com);
  terrain::Foothold& moved = *feet[timeline_.placements[placement].leg];
  const Vector2d here = moved.position;
  moved.position = here + step * moving.direction;
  const double above = stance_factor(scene_, feet, com).value;
  moved.position = here - step * moving.direction;
  const double below = stance_factor(scene_, feet, com).value;
  const double slope = (above - below) / (2 * step);
  return std::isfinite(slope) ? slope : 0;
}

Cut RefineWindow::cut_of(const Element& element, int number, bool with_feet) const {
  Cut cut{.element = number, .offset = element.factor.value, .gradient = VectorXd::Zero(variables())};
  com(element.stance).add_gradient(element.factor.from_gradient, cut.gradient);
  if (element.transfer) com(element.stance + 1).add_gradient(element.factor.to_gradient, cut.gradient);
  if (!with_feet) return cut;
  const auto& standing = element.transfer ? timeline_.transfers[element.stance] : timeline_.stances[element.stance];
  for (const int id : standing)
    if (id >= 0)
      if (const MovingPoint moving = foot(id); moving.count == 1) cut.gradient[moving.first] = foot_slope(element, id);
  return cut;
}

RefineWindow::Evaluation RefineWindow::evaluate() const {
  Evaluation out;
  out.least = cap_;
  out.sum_gradient = VectorXd::Zero(variables());
  out.in_reach = within_reach();
  const std::vector<Element> all = elements();
  const auto steers = [this](const Element& e) { return !e.factor.bound && e.factor.value < cap_; };
  for (const Element& e : all) {
    out.sum += std::min(e.factor.value, cap_);
    if (steers(e)) out.least = std::min(out.least, e.factor.value);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!steers(all[i])) continue;
    out.factors.push_back(cut_of(all[i], static_cast<int>(i), all[i].factor.value < near_least * out.least));
    out.sum_gradient += out.factors.back().gradient;
  }
  add_clearances(out);
  const VectorXd x = values();
  for (Cut& cut : out.factors) cut.offset -= cut.gradient.dot(x);
  for (Cut& cut : out.clearances) cut.offset -= cut.gradient.dot(x);
  return out;
}

void RefineWindow::add_clearances(Evaluation& out) const {
  const double greatest = scene_.robot.clearance + 0.25 * scene_.robot.reach_max;  // farther is out of the trust region
  const double step = difference_step * scene_.robot.reach_max;
  const int lines = plan_.steps() == 0 ? 1 : last_transfer() - first_transfer() + 1;
  for (int i = 0; i < lines; ++i) {
    const int ends[2] = {first_transfer() + i, std::min(first_transfer() + i + 1, plan_.steps())};
    Vector2d points[2] = {plan_.stances[ends[0]].com, plan_.stances[ends[1]].com};
    const double here = scene_.terrain.distance(points[0], points[1], greatest);
    if (here >= greatest) continue;
    Cut cut{.element = i, .offset = here, .gradient = VectorXd::Zero(variables())};
    for (int end = 0; end < 2; ++end) {
      Vector2d slope;
      for (int axis = 0; axis < 2; ++axis) {
        const double kept = points[end][axis];
        points[end][axis] = kept + step;
        const double above = scene_.terrain.distance(points[0], points[1], greatest);
        points[end][axis] = kept - step;
        const double below = scene_.terrain.distance(points[0], points[1], greatest);
        points[end][axis] = kept;
        slope[axis] = (std::min(above, greatest) - std::min(below, greatest)) / (2 * step);
      }
      com(ends[end]).add_gradient(slope, cut.gradient);
    }
    out.clearances.push_back(std::move(cut));
  }
}

bool RefineWindow::within_reach() const {
  const gaits::Robot robot = gaits::drawn_in(scene_.robot);
  for (int k = first_; k <= last_; ++k)
    if (!gaits::within_reach(robot, plan_.stances[k].feet, plan_.stances[k].com, plan_.stances[k].com)) return false;
  for (int k = first_transfer(); k <= last_transfer(); ++k)
    if (!gaits::within_reach(robot, feet_of(k), plan_.stances[k].com, plan_.stances[k + 1].com)) return false;
  return true;
}

bool RefineWindow::rules_hold() const {
  for (int k = first_; k <= last_; ++k) {
    const gaits::Stance& stance = plan_.stances[k];
    if (k == 0 ? gaits::broken_start_rule(scene_, stance) : gaits::broken_stance_rule(scene_, stance)) return false;
  }
  // One transfer more: a foot that was moved and lifted is where the next swing begins.
  for (int k = first_transfer(); k <= std::min(last_transfer() + 1, plan_.steps() - 1); ++k) {
    const gaits::Transfer& transfer = plan_.transfers[k];
    const int before = timeline_.swing_from[k];
    const auto from = before >= 0 ? std::optional(foothold(before)) : scene_.start.feet[transfer.leg];
    if (gaits::broken_transfer_rule(scene_, plan_.stances[k], transfer, plan_.stances[k + 1].com, from)) return false;
  }
  return true;
}

}  // namespace surefoot::planner
