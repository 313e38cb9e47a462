#include "planner/ompl_search.hpp"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include "planner/com_neighbors.hpp"
#include "planner/layers_planner.hpp"
#include "planner/stance_space.hpp"

namespace surefoot::planner {

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace {

/// OMPL logs to standard output, which is for results; it also complains of every seed after the first.
class Silence {
 public:
  Silence() : previous_(ompl::msg::getOutputHandler()) { ompl::msg::noOutputHandler(); }
  ~Silence() { ompl::msg::useOutputHandler(previous_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  ompl::msg::OutputHandler* previous_;
};

class StepPropagator : public oc::StatePropagator {
 public:
  StepPropagator(const oc::SpaceInformationPtr& si, StepProposals& proposals)
      : oc::StatePropagator(si), proposals_(&proposals) {}
  void propagate(const ob::State* state, const oc::Control* control, double, ob::State* result) const override {
    const auto* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    StepCode code;
    std::copy(values, values + code.size(), code.begin());
    auto& to = StanceSpace::of(result);
    to.valid = proposals_->propose(StanceSpace::of(state).node, code, to.node);
    to.is_target = false;
  }
  bool canPropagateBackward() const override { return false; }

 private:
  StepProposals* proposals_;
};

class LegalStep : public ob::StateValidityChecker {
 public:
  using ob::StateValidityChecker::StateValidityChecker;
  bool isValid(const ob::State* state) const override { return StanceSpace::of(state).valid; }
};

/// Steps, or the way of the COM [m]. Any solution is good enough to stop at: SST would go on otherwise.
class PathCost : public ob::OptimizationObjective {
 public:
  PathCost(const ob::SpaceInformationPtr& si, bool distance) : ob::OptimizationObjective(si), distance_(distance) {
    setCostThreshold(infiniteCost());
  }
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(distance_ ? (StanceSpace::of(a).node.com - StanceSpace::of(b).node.com).norm() : 1);
  }

 private:
  bool distance_;
};

ob::PlannerPtr make_planner(const oc::SpaceInformationPtr& si, const ob::ProblemDefinitionPtr& problem,
                            const OmplRun& run, StepProposals& proposals) {
  const double reach = proposals.scene().robot.reach_max;
  if (run.planner == "Layers")
    return std::make_shared<LayersPlanner>(si, proposals, AnytimeOptions{run.seed, run.objective, {}});
  if (run.planner == "KPIECE1") {
    auto planner = std::make_shared<oc::KPIECE1>(si);
    planner->setGoalBias(run.goal_bias);
    return planner;
  }
  if (run.planner == "EST") {
    auto planner = std::make_shared<oc::EST>(si);
    planner->setGoalBias(run.goal_bias);
    planner->setRange(reach);
    return planner;
  }
  if (run.planner == "SST") {
    auto planner = std::make_shared<oc::SST>(si);
    planner->setGoalBias(run.goal_bias);
    planner->setSelectionRadius(reach / 4);
    planner->setPruningRadius(reach / 20);
    planner->setProblemDefinition(problem);  // before the next line, which sets up and asks for the objective
    planner->setNearestNeighbors<ompl::NearestNeighborsLinear>();
    return planner;
  }
  auto planner = std::make_shared<oc::RRT>(si);
  planner->setGoalBias(run.goal_bias);
  planner->setNearestNeighbors<ComNeighbors>();
  return planner;
}

oc::SpaceInformationPtr make_space(StepProposals& proposals) {
  const auto space = std::make_shared<StanceSpace>(proposals.scene());
  const auto controls = std::make_shared<CodeSpace>(space);
  ob::RealVectorBounds cube(std::tuple_size_v<StepCode>);
  cube.setLow(0);
  cube.setHigh(1);
  controls->setBounds(cube);
  controls->setControlSamplerAllocator([&proposals](const oc::ControlSpace* control_space) {
    return std::make_shared<StepSampler>(control_space, proposals);
  });
  auto si = std::make_shared<oc::SpaceInformation>(space, controls);
  si->setStatePropagator(std::make_shared<StepPropagator>(si, proposals));
  si->setStateValidityChecker(std::make_shared<LegalStep>(si));
  si->setMotionValidator(std::make_shared<StepMotion>(si, proposals));
  si->setDirectedControlSamplerAllocator([&proposals](const oc::SpaceInformation* information) {
    return std::make_shared<DirectedSteps>(information, proposals);
  });
  si->setPropagationStepSize(1);
  si->setMinMaxControlDuration(1, 1);
  si->setup();
  return si;
}

std::vector<Node> nodes_of(const ob::PathPtr& path) {
  std::vector<Node> nodes;
  auto* of_steps = dynamic_cast<oc::PathControl*>(path.get());
  const auto& states = of_steps ? of_steps->getStates() : path->as<ompl::geometric::PathGeometric>()->getStates();
  nodes.reserve(states.size());
  for (const ob::State* state : states) nodes.push_back(StanceSpace::of(state).node);
  return nodes;
}

}  // namespace

std::vector<Node> run_ompl(StepProposals& proposals, const std::vector<Node>& starts, const OmplRun& run,
                           std::uint64_t& iterations_done) {
  const Silence silence;
  ompl::RNG::setSeed(run.seed);
  const auto si = make_space(proposals);
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<StanceSpace> start(si);
  for (const Node& node : starts) {
    start->node = node;
    problem->addStartState(start);
  }
  problem->setGoal(std::make_shared<ComGoal>(si, proposals.scene()));
  problem->setOptimizationObjective(std::make_shared<PathCost>(si, run.objective == "distance"));
  const auto planner = make_planner(si, problem, run, proposals);
  planner->setProblemDefinition(problem);
  planner->setup();

  std::uint64_t iterations = 0;
  const ob::PlannerTerminationCondition stop([&] {
    return iterations++ >= run.iterations || std::chrono::steady_clock::now() >= run.deadline || run.interrupted();
  });
  planner->solve(stop);
  iterations_done += iterations;
  // An approximate solution also counts as one to OMPL: believe only an exact one.
  return problem->hasExactSolution() ? nodes_of(problem->getSolutionPath()) : std::vector<Node>{};
}

}  // namespace surefoot::planner
