#include "planner/layers_planner.hpp"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>

#include <limits>

#include "planner/stance_space.hpp"

namespace surefoot::planner {

namespace ob = ompl::base;

namespace {

constexpr std::uint64_t slice = 20'000;  ///< work between two looks at the plan

}  // namespace

bool StepMotion::checkMotion(const ob::State* from, const ob::State* to) const {
  return proposals_->is_legal(StanceSpace::of(from).node, StanceSpace::of(to).node);
}

bool StepMotion::checkMotion(const ob::State* from, const ob::State* to,
                             std::pair<ob::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  if (last_valid.first) si_->copyState(last_valid.first, from);
  last_valid.second = 0;
  return false;
}

LayersPlanner::LayersPlanner(const ob::SpaceInformationPtr& si, StepProposals& proposals, AnytimeOptions options)
    : ob::Planner(si, "Layers"), proposals_(&proposals), options_(std::move(options)) {
  specs_.approximateSolutions = false;
  specs_.optimizingPaths = true;
  specs_.directed = true;
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
}

bool LayersPlanner::add_solution() {
  const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  ob::State* state = si_->allocState();
  for (const Node& node : search_->path()) {
    StanceSpace::of(state).node = node;
    path->append(state);
  }
  si_->freeState(state);
  ob::PlannerSolution solution(path);
  solution.setPlannerName(getName());
  const auto objective = pdef_->getOptimizationObjective();
  bool satisfied = objective == nullptr;
  if (objective) {
    const ob::Cost cost = path->cost(objective);
    satisfied = objective->isSatisfied(cost);
    solution.setOptimized(objective, cost, satisfied);
  }
  pdef_->addSolutionPath(solution);
  return satisfied;
}

ob::PlannerStatus LayersPlanner::solve(const ob::PlannerTerminationCondition& condition) {
  checkValidity();
  condition_ = &condition;
  if (!search_) {
    std::vector<Node> starts;
    while (const ob::State* state = pis_.nextStart()) starts.push_back(StanceSpace::of(state).node);
    if (starts.empty()) return ob::PlannerStatus::INVALID_START;
    options_.stop = [this] { return static_cast<bool>(*condition_); };
    search_ = std::make_unique<AnytimeSearch>(*proposals_, starts, options_);
  }
  if (!search_->find(std::numeric_limits<std::uint64_t>::max())) return ob::PlannerStatus::TIMEOUT;
  bool satisfied = false, more = true;
  for (; more && !satisfied && !condition; more = search_->improve(slice)) {
    if (search_->improvements() == added_) continue;
    added_ = search_->improvements();
    satisfied = add_solution();
  }
  if (search_->improvements() != added_) added_ = search_->improvements(), add_solution();
  return ob::PlannerStatus::EXACT_SOLUTION;
}

void LayersPlanner::clear() {
  ob::Planner::clear();
  search_.reset();
  added_ = 0;
}

void LayersPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  const auto solution = pdef_ ? pdef_->getSolutionPath() : nullptr;
  const auto* path = dynamic_cast<const ompl::geometric::PathGeometric*>(solution.get());
  if (path == nullptr || path->getStateCount() == 0) return;
  const auto vertex = [path](unsigned int i) { return ob::PlannerDataVertex(path->getState(i)); };
  data.addStartVertex(vertex(0));
  for (unsigned int i = 1; i < path->getStateCount(); ++i) {
    if (i + 1 == path->getStateCount()) data.addGoalVertex(vertex(i));
    data.addEdge(vertex(i - 1), vertex(i));
  }
}

}  // namespace surefoot::planner
