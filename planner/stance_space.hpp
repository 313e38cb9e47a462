// Stances and steps as OMPL sees them: a state is a stance (or a mere target for the COM), a control is a step code of
// the unit cube, and propagating is decoding. A code that stands for no legal step leaves a state that is not valid.
// Only ompl_search.cpp includes this.
#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/control/DirectedControlSampler.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <limits>
#include <tuple>

#include "planner/node.hpp"
#include "planner/pool.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

/// Distance is that of the COMs, and between two stances that of the feet as well; with a target, only the coordinates
/// the target fixes count. Not a metric.
class StanceSpace : public ompl::base::StateSpace {
 public:
  struct StateType : ompl::base::State {
    Node node;
    Target target;           ///< meaningful where is_target
    bool is_target = false;  ///< drawn by a sampler: no stance
    bool valid = true;       ///< false: no legal step led here
  };

  explicit StanceSpace(const gaits::Scene& scene);

  unsigned int getDimension() const override { return 2; }
  double getMaximumExtent() const override { return extent_; }
  double getMeasure() const override { return extent_ * extent_; }
  void enforceBounds(ompl::base::State*) const override {}
  bool satisfiesBounds(const ompl::base::State*) const override { return true; }
  void copyState(ompl::base::State* destination, const ompl::base::State* source) const override;
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override;
  bool equalStates(const ompl::base::State* a, const ompl::base::State* b) const override;
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  bool isMetricSpace() const override { return false; }
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;
  ompl::base::State* allocState() const override {
    StateType* state = states_.take();
    state->node = {}, state->target = {};
    state->is_target = false, state->valid = true;
    return state;
  }
  void freeState(ompl::base::State* state) const override { states_.give_back(static_cast<StateType*>(state)); }
  void registerProjections() override;

  static const StateType& of(const ompl::base::State* state) { return *static_cast<const StateType*>(state); }
  static StateType& of(ompl::base::State* state) { return *static_cast<StateType*>(state); }

 private:
  const gaits::Scene* scene_;
  double extent_;  ///< [m]
  mutable Pool<StateType> states_;
};

/// The unit cube of step codes.
class CodeSpace : public ompl::control::RealVectorControlSpace {
 public:
  explicit CodeSpace(const ompl::base::StateSpacePtr& space)
      : ompl::control::RealVectorControlSpace(space, std::tuple_size_v<StepCode>) {}
  ompl::control::Control* allocControl() const override { return codes_.take(); }
  void freeControl(ompl::control::Control* control) const override { codes_.give_back(static_cast<Code*>(control)); }

 private:
  struct Code : ControlType {
    Code() { values = storage.data(); }
    StepCode storage{};
  };
  mutable Pool<Code> codes_;
};

/// How far a node stands back each time it has been chosen, in reach_max: at once to where nodes some steps behind get
/// their turn. Measured: below 0.5 dead ends hold the search for seconds, from 1 to 4 it makes no difference.
constexpr double choice_penalty_share = 1.5;
double choice_penalty(const gaits::Robot& robot);  ///< [m]

/// COM in the goal interval.
class ComGoal : public ompl::base::GoalSampleableRegion {
 public:
  ComGoal(const ompl::base::SpaceInformationPtr& si, const gaits::Scene& scene)
      : ompl::base::GoalSampleableRegion(si), goal_(&scene.goal), choice_penalty_(choice_penalty(scene.robot)) {}
  bool isSatisfied(const ompl::base::State* state) const override;
  bool isSatisfied(const ompl::base::State* state, double* distance) const override;
  double distanceGoal(const ompl::base::State* state) const override;
  void sampleGoal(ompl::base::State* state) const override;
  unsigned int maxSampleCount() const override { return std::numeric_limits<unsigned int>::max(); }

 private:
  const gaits::Goal* goal_;
  double choice_penalty_;  ///< [m]
  mutable ompl::RNG rng_;
};

/// What planners that direct their steps (RRT, EST) call: of several codes the one whose step gets nearest the target.
class DirectedSteps : public ompl::control::DirectedControlSampler {
 public:
  DirectedSteps(const ompl::control::SpaceInformation* si, StepProposals& proposals)
      : ompl::control::DirectedControlSampler(si), proposals_(&proposals) {}
  unsigned int sampleTo(ompl::control::Control* control, const ompl::base::State* source,
                        ompl::base::State* destination) override;
  unsigned int sampleTo(ompl::control::Control* control, const ompl::control::Control*, const ompl::base::State* source,
                        ompl::base::State* destination) override {
    return sampleTo(control, source, destination);
  }

 private:
  StepProposals* proposals_;
  ompl::RNG rng_;
};

/// Blind codes for planners that ask for no more (SST); given a state (KPIECE1), a code that stands for a legal step if
/// one is found soon.
class StepSampler : public ompl::control::ControlSampler {
 public:
  StepSampler(const ompl::control::ControlSpace* space, StepProposals& proposals)
      : ompl::control::ControlSampler(space), proposals_(&proposals) {}
  void sample(ompl::control::Control* control) override;
  void sampleNext(ompl::control::Control* control, const ompl::control::Control*,
                  const ompl::base::State* state) override;

 private:
  StepProposals* proposals_;
};

}  // namespace surefoot::planner
