#include "bench/error_time/refinement_task.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <nlopt.hpp>
#include <random>

#include "gaits/plan_words.hpp"
#include "planner/refine.hpp"

namespace surefoot::bench {
namespace {

using Eigen::VectorXd;
using planner::Cut;
using planner::RefineModel;
using planner::RefineWindow;
using planner::Timeline;

/// How far COMs and feet may go from the plan's [relative to reach_max]: beyond, no rule holds.
constexpr double widest = 0.8;

/// The window as a function that counts its evaluations and keeps the best legal value.
class Window {
 public:
  Window(const RefinementTask& task, int budget)
      : plan_(task.plan), timeline_(plan_), window_(*task.scene, plan_, timeline_, task.first, task.last, task.cap),
        model_(window_.model()), budget_(budget) {
    const double far = widest * task.scene->robot.reach_max;
    lower_ = model_.lower.cwiseMax((window_.start().array() - far).matrix());
    upper_ = model_.upper.cwiseMin((window_.start().array() + far).matrix());
    elements_ = 2 * (task.last - task.first + 1) + 1;
  }

  const RefineModel& model() const { return model_; }
  const VectorXd& start() const { return window_.start(); }
  const VectorXd& lower() const { return lower_; }
  const VectorXd& upper() const { return upper_; }
  Eigen::Index variables() const { return window_.variables(); }
  int elements() const { return elements_; }
  bool spent() const { return count_ >= budget_; }
  double best() const { return best_; }

  /// The value for searches without constraints: 0 where a rule is broken.
  double legal_least(const VectorXd& x) {
    at(x);
    return legal_ ? now_.least : 0;
  }
  const RefineWindow::Evaluation& at(const VectorXd& x) {
    if ((asked_.size() > 0 && x == asked_) || spent()) return now_;
    asked_ = x;
    ++count_;
    legal_ = window_.write(x.cwiseMax(lower_).cwiseMin(upper_));
    if (!legal_) return now_;
    now_ = window_.evaluate();
    legal_ = now_.in_reach && window_.rules_hold();
    if (legal_) best_ = std::max(best_, now_.least);
    return now_;
  }

 private:
  gaits::Plan plan_;
  Timeline timeline_;
  RefineWindow window_;
  RefineModel model_;
  VectorXd lower_, upper_, asked_;
  RefineWindow::Evaluation now_;
  int elements_, budget_, count_ = 0;
  bool legal_ = false;
  double best_ = 0;
};

/// What NLopt's callbacks see.
struct Callback {
  Window* window;
  nlopt::opt* problem;
  VectorXd gradient;  // scratch
  void end_if_spent() const {
    if (window->spent()) problem->force_stop();
  }
};

double greatest_t(unsigned n, const double* z, double* gradient, void*) {
  if (gradient != nullptr) std::fill(gradient, gradient + n, 0.0), gradient[n - 1] = 1;
  return z[n - 1];
}

/// t - factor <= 0 for each element, least clearance, reach; all in one call, for one evaluation.
void constraints(unsigned m, double* values, unsigned n, const double* z, double* rows, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  Window& window = *callback.window;
  const RefineModel& model = window.model();
  const Eigen::Index count = n - 1;
  const VectorXd x = Eigen::Map<const VectorXd>(z, count);
  const double t = z[n - 1];
  std::fill(values, values + m, -1.0);
  if (rows != nullptr) std::fill(rows, rows + static_cast<std::size_t>(m) * n, 0.0);
  const auto put = [&](std::size_t k, double value, const VectorXd& gradient, double t_slope) {
    values[k] = value;
    if (rows == nullptr) return;
    Eigen::Map<VectorXd>(rows + k * n, count) = gradient;
    rows[k * n + n - 1] = t_slope;
  };
  const auto& now = window.at(x);
  for (const Cut& cut : now.factors) put(static_cast<std::size_t>(cut.element), t - cut.at(x), -cut.gradient, 1);
  std::size_t k = static_cast<std::size_t>(window.elements());
  for (const Cut& cut : now.clearances)
    put(k + static_cast<std::size_t>(cut.element), model.least_clearance - cut.at(x), -cut.gradient, 0);
  k += static_cast<std::size_t>(window.elements());
  for (const planner::ReachLimit& limit : model.reach)
    for (const int sign : {1, -1}) {
      const double excess = limit.excess(sign, sign > 0 ? model.reach_max : model.reach_min, x, callback.gradient);
      put(k++, excess, callback.gradient, 0);
    }
  callback.end_if_spent();
}

double least_alone(unsigned n, const double* z, double*, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  const double least = callback.window->legal_least(Eigen::Map<const VectorXd>(z, n));
  callback.end_if_spent();
  return least;
}

std::vector<double> list(const VectorXd& x) { return {x.data(), x.data() + x.size()}; }

void run(nlopt::opt& problem, std::vector<double> z) {
  try {
    double value = 0;
    problem.set_xtol_abs(1e-9);
    problem.set_maxeval(100'000);  // of NLopt's own counting; the window ends it much sooner
    problem.optimize(z, value);
  } catch (const std::exception&) {
    // forced stops, roundoff: what was found is with the window
  }
}

}  // namespace

RefinementTask weakest_window(const gaits::Scene& scene, const gaits::Plan& plan, int coms) {
  const int stances = static_cast<int>(plan.stances.size()), first_free = scene.start.com ? 1 : 0;
  const int centre = gaits::weakest_place(plan).index;
  const int first = std::clamp(centre - coms / 2, first_free, stances - coms);
  return {&scene, plan, first, first + coms - 1, planner::factor_cap(plan.safety_factor)};
}

double least_factor(const RefinementTask& task) {
  Window window(task, 1);
  return window.legal_least(window.start());
}

std::vector<RefinementTask> poor_starts(const RefinementTask& task, std::size_t count, std::uint64_t seed) {
  constexpr std::size_t many = 40;
  constexpr int most_tries = 20'000;
  std::mt19937_64 random(seed);
  std::vector<std::pair<double, RefinementTask>> found;
  const double reach = task.scene->robot.reach_max;
  for (int k = 0; k < most_tries && found.size() < many; ++k) {
    const double radius = reach * std::uniform_real_distribution(0.02, 0.25)(random);
    RefinementTask moved = task;
    const Timeline timeline(moved.plan);
    RefineWindow window(*moved.scene, moved.plan, timeline, moved.first, moved.last, moved.cap);
    VectorXd x = window.start();
    for (double& value : x) value += std::uniform_real_distribution(-radius, radius)(random);
    const RefineModel model = window.model();
    if (!window.write(x.cwiseMax(model.lower).cwiseMin(model.upper)) || !window.rules_hold()) continue;
    if (const double least = least_factor(moved); least > 0) found.emplace_back(least, moved);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<RefinementTask> poor;
  for (std::size_t k = 0; k < std::min(count, found.size()); ++k) poor.push_back(found[k].second);
  return poor;
}

double by_surefoot(const RefinementTask& task, int evaluations) {
  RefinementTask refined = task;
  const Timeline timeline(refined.plan);
  planner::RefineOptions options;
  options.max_evaluations = evaluations;
  planner::refine_window(*refined.scene, refined.plan, timeline, refined.first, refined.last, refined.cap, options);
  return least_factor(refined);
}

double by_nlopt(const RefinementTask& task, const std::string& algorithm, int evaluations) {
  Window window(task, evaluations);
  const bool epigraph = algorithm.starts_with("LD_") || algorithm == "LN_COBYLA";
  nlopt::opt problem(algorithm.c_str(), static_cast<unsigned>(window.variables()) + (epigraph ? 1 : 0));
  Callback callback{&window, &problem, {}};
  std::vector<double> z = list(window.start()), lower = list(window.lower()), upper = list(window.upper());
  if (epigraph) {
    z.push_back(window.at(window.start()).least), lower.push_back(0), upper.push_back(task.cap);
    const std::size_t count = 2 * static_cast<std::size_t>(window.elements()) + 2 * window.model().reach.size();
    problem.set_max_objective(greatest_t, nullptr);
    problem.add_inequality_mconstraint(constraints, &callback, std::vector<double>(count, 1e-9));
  } else {
    problem.set_max_objective(least_alone, &callback);
  }
  problem.set_lower_bounds(lower);
  problem.set_upper_bounds(upper);
  run(problem, z);
  return window.best();
}

double by_exhaustive_grid(const RefinementTask& task, int n) {
  Window window(task, 1 << 30);
  const auto dimensions = window.variables();
  VectorXd low = window.lower(), high = window.upper(), best = window.start();
  double greatest = window.legal_least(best);
  constexpr double finest = 1e-7;  // [m]
  while ((high - low).maxCoeff() > finest) {
    const VectorXd step = (high - low) / n;
    const auto points = static_cast<std::int64_t>(std::pow(n + 1, dimensions));
    VectorXd x = low;
    for (std::int64_t k = 0; k < points; ++k) {
      std::int64_t digits = k;
      for (Eigen::Index i = 0; i < dimensions; ++i, digits /= n + 1)
        x[i] = low[i] + step[i] * static_cast<double>(digits % (n + 1));
      if (const double least = window.legal_least(x); least > greatest) greatest = least, best = x;
    }
    low = (best - 3 * step).cwiseMax(low), high = (best + 3 * step).cwiseMin(high);
    n = std::min(n, 20);
  }
  return greatest;
}

}  // namespace surefoot::bench
