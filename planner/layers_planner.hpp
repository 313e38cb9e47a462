// The planner "Layers" as an OMPL planner, to stand beside OMPL's own in ompl::tools::Benchmark and under its
// termination conditions. States are stances (stance_space.hpp); a solution is a geometric::PathGeometric of stances,
// since two stances tell the step between them; StepMotion checks such a path.
// Only ompl_search.cpp, benchmarks and tests include this.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/Planner.h>

#include <memory>
#include <vector>

#include "planner/anytime_search.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

/// A motion is a legal step.
class StepMotion : public ompl::base::MotionValidator {
 public:
  StepMotion(const ompl::base::SpaceInformationPtr& si, StepProposals& proposals)
      : ompl::base::MotionValidator(si), proposals_(&proposals) {}
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override;
  /// Steps have no inside: the last valid state is `from`.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  StepProposals* proposals_;
};

class LayersPlanner : public ompl::base::Planner {
 public:
  /// `options.stop` is replaced by the termination condition.
  LayersPlanner(const ompl::base::SpaceInformationPtr& si, StepProposals& proposals, AnytimeOptions options);

  /// Goes on from where the last call ended. Adds every better plan to the problem's solutions; ends when the objective
  /// is satisfied with one, when nothing is left to better, or by the condition.
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& condition) override;
  void clear() override;
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  bool add_solution();

  StepProposals* proposals_;
  AnytimeOptions options_;
  const ompl::base::PlannerTerminationCondition* condition_ = nullptr;  ///< of the call that is running
  std::unique_ptr<AnytimeSearch> search_;
  int added_ = 0;  ///< the plan, counted by improvements, that was added last
};

}  // namespace surefoot::planner
