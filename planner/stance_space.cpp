#include "planner/stance_space.hpp"

#include <ompl/base/StateSampler.h>

#include <algorithm>

namespace surefoot::planner {

namespace ob = ompl::base;
namespace oc = ompl::control;

double choice_penalty(const gaits::Robot& robot) { return choice_penalty_share * robot.reach_max; }

namespace {

/// Codes tried per call, each dear test saved by the best so far.
constexpr int directed_tries = 12;
/// Share of directed steps that are merely legal: always the farthest would never rearrange the feet.
constexpr double first_legal_share = 0.3;
/// Codes tried until one is legal.
constexpr int legal_tries = 8;
/// Share of KPIECE1's steps that are chosen to get nearest the goal; the others are the first legal ones.
constexpr double greedy_share = 0.5;

/// Targets above the ground, where COMs can be: uniform over the length of the terrain, up to reach_max along the
/// normal.
class TargetSampler : public ob::StateSampler {
 public:
  TargetSampler(const ob::StateSpace* space, const gaits::Scene& scene) : ob::StateSampler(space), scene_(&scene) {
    double total = 0;
    for (const auto& segment : scene.terrain.segments()) lengths_.push_back(total += segment.length);
  }

  void sampleUniform(ob::State* state) override {
    const double s = rng_.uniform01() * lengths_.back();
    const auto at = static_cast<std::size_t>(std::lower_bound(lengths_.begin(), lengths_.end(), s) - lengths_.begin());
    const terrain::Segment& segment = scene_->terrain.segments()[std::min(at, lengths_.size() - 1)];
    const double along = segment.length - (lengths_[std::min(at, lengths_.size() - 1)] - s);
    set(state, segment.a + along * segment.tangent + rng_.uniform01() * scene_->robot.reach_max * segment.normal);
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    const Eigen::Vector2d centre = StanceSpace::of(near).node.com;
    set(state, centre + Eigen::Vector2d{rng_.uniformReal(-distance, distance), rng_.uniformReal(-distance, distance)});
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    const Eigen::Vector2d centre = StanceSpace::of(mean).node.com;
    set(state, centre + Eigen::Vector2d{rng_.gaussian(0, deviation), rng_.gaussian(0, deviation)});
  }

 private:
  void set(ob::State* state, const Eigen::Vector2d& com) const {
    auto& s = StanceSpace::of(state);
    s.target = {com, false, false, choice_penalty(scene_->robot)};
    s.is_target = s.valid = true;
  }
  const gaits::Scene* scene_;
  std::vector<double> lengths_;  ///< running sum over the segments [m]
};

/// The COM, in cells of a third of the reach.
class ComProjection : public ob::ProjectionEvaluator {
 public:
  ComProjection(const ob::StateSpace* space, double cell) : ob::ProjectionEvaluator(space) {
    setCellSizes({cell, cell});
  }
  unsigned int getDimension() const override { return 2; }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection = StanceSpace::of(state).node.com;
  }
};

void write(const StepCode& code, oc::Control* control) {
  auto* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  std::copy(code.begin(), code.end(), values);
}

StepCode random_code(ompl::RNG& rng) {
  StepCode code;
  for (double& value : code) value = rng.uniform01();
  return code;
}

}  // namespace

StanceSpace::StanceSpace(const gaits::Scene& scene)
    : scene_(&scene), extent_((scene.terrain.bounds().sizes()).norm() + 4 * scene.robot.reach_max) {
  setName("stances");
  type_ = ob::STATE_SPACE_TYPE_COUNT;
}

void StanceSpace::copyState(ob::State* destination, const ob::State* source) const {
  auto& to = of(destination);
  const auto& from = of(source);
  to.node = from.node;
  to.target = from.target;
  to.is_target = from.is_target;
  to.valid = from.valid;
}

double StanceSpace::distance(const ob::State* a, const ob::State* b) const {
  const auto &x = of(a), &y = of(b);
  if (x.is_target) return x.target.distance(y.is_target ? y.target.com : y.node.com);
  if (y.is_target) return y.target.distance(x.node.com);
  double sum = (x.node.com - y.node.com).norm();
  for (int leg = 0; leg < gaits::leg_count; ++leg)
    if (x.node.feet[leg] && y.node.feet[leg])
      sum += (x.node.feet[leg]->position - y.node.feet[leg]->position).norm() / gaits::leg_count;
  return sum + (x.node.free_leg == y.node.free_leg ? 0 : scene_->robot.reach_max / 4);
}

bool StanceSpace::equalStates(const ob::State* a, const ob::State* b) const {
  const auto &x = of(a), &y = of(b);
  return x.is_target == y.is_target && (x.is_target ? x.target.com == y.target.com : x.node.id == y.node.id);
}

// Steps are jumps: there is nothing between two stances.
void StanceSpace::interpolate(const ob::State* from, const ob::State* to, double t, ob::State* state) const {
  copyState(state, t < 1 ? from : to);
}

ob::StateSamplerPtr StanceSpace::allocDefaultStateSampler() const {
  return std::make_shared<TargetSampler>(this, *scene_);
}

void StanceSpace::registerProjections() {
  registerDefaultProjection(std::make_shared<ComProjection>(this, scene_->robot.reach_max / 3));
}

bool ComGoal::isSatisfied(const ob::State* state) const { return goal_->contains(StanceSpace::of(state).node.com); }

bool ComGoal::isSatisfied(const ob::State* state, double* distance) const {
  if (distance) *distance = distanceGoal(state);
  return isSatisfied(state);
}

double ComGoal::distanceGoal(const ob::State* state) const { return goal_->distance(StanceSpace::of(state).node.com); }

void ComGoal::sampleGoal(ob::State* state) const {
  auto& s = StanceSpace::of(state);
  s.is_target = s.valid = true;
  s.target = {Eigen::Vector2d::Zero(), !goal_->com_x, !goal_->com_y, choice_penalty_};
  if (goal_->com_x) s.target.com.x() = rng_.uniformReal(goal_->com_x->first, goal_->com_x->second);
  if (goal_->com_y) s.target.com.y() = rng_.uniformReal(goal_->com_y->first, goal_->com_y->second);
}

unsigned int DirectedSteps::sampleTo(oc::Control* control, const ob::State* source, ob::State* destination) {
  const Node from = StanceSpace::of(source).node;  // a copy: the two states may be one
  auto& to = StanceSpace::of(destination);
  const Target target = to.is_target ? to.target : Target{to.node.com};
  double best = std::numeric_limits<double>::infinity();
  const bool first_will_do = rng_.uniform01() < first_legal_share;
  bool found = false;
  Node next;
  for (int k = 0; k < directed_tries && !(found && first_will_do); ++k) {
    const StepCode code = random_code(rng_);
    if (!proposals_->propose(from, code, next, &target, best)) continue;
    best = target.distance(progress_point(next));
    found = true;
    to.node = next;
    write(code, control);
  }
  if (found) {
    to.is_target = false;
    to.valid = true;
  }
  return found ? 1 : 0;
}

void StepSampler::sample(oc::Control* control) { write(random_code(rng_), control); }

void StepSampler::sampleNext(oc::Control* control, const oc::Control*, const ob::State* state) {
  const Node& from = StanceSpace::of(state).node;
  const bool greedy = rng_.uniform01() < greedy_share;
  const gaits::Goal& goal = proposals_->scene().goal;
  double best = std::numeric_limits<double>::infinity();
  Node next;
  for (int k = 0; k < legal_tries; ++k) {
    const StepCode code = random_code(rng_);
    if (k == 0) write(code, control);
    if (!proposals_->propose(from, code, next)) continue;
    if (const double distance = goal.distance(next.com); distance < best) {
      best = distance;
      write(code, control);
    }
    if (!greedy) return;
  }
}

}  // namespace surefoot::planner
