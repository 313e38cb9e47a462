#include "planner/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "planner/refine_model.hpp"
#include "planner/refine_window.hpp"
#include "stability/given.hpp"

namespace surefoot::planner {

namespace {

using Eigen::VectorXd;
using gaits::Plan;
using gaits::Scene;

constexpr double first_radius = 0.1;     // of the trust region [relative to reach_max]
constexpr double greatest_radius = 0.3;  // likewise: beyond, cuts say little
constexpr double least_radius = 1e-3;    // likewise: below, a safety factor changes by less than a percent
constexpr double least_gain = 1e-4;      // relative: a smaller promise is not worth an evaluation
constexpr double weak_place = 1.25;      // later sweeps only treat what is below this multiple of the least factor
constexpr std::size_t most_cuts_per_element = 6;

bool better(const RefineWindow::Evaluation& a, const RefineWindow::Evaluation& b) {
  return a.least > b.least || (a.least == b.least && a.sum > b.sum);
}

/// Takes over the newest cuts, drops the oldest of each element.
void add_cuts(std::vector<Cut>& cuts, const std::vector<Cut>& fresh) {
  for (const Cut& cut : fresh) {
    const auto same = [&cut](const Cut& other) { return other.element == cut.element; };
    if (std::count_if(cuts.begin(), cuts.end(), same) >= static_cast<std::ptrdiff_t>(most_cuts_per_element))
      cuts.erase(std::find_if(cuts.begin(), cuts.end(), same));
    cuts.push_back(cut);
  }
}

/// Factors are not concave: a cut that denies what was found at the best point is raised until it admits it.
void admit(std::vector<Cut>& cuts, const std::vector<Cut>& best, const VectorXd& x) {
  for (Cut& cut : cuts)
    for (const Cut& known : best)
      if (known.element == cut.element) cut.offset += std::max(0.0, known.at(x) - cut.at(x));
}

struct Factors {
  std::vector<double> of_com;  // least over the stance and the transfers that touch it, of those that can rise
  double least = std::numeric_limits<double>::infinity();
  bool all_infinite = true, none_can_rise = true;
};

Factors factors_of(const Scene& scene, const Plan& plan) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Factors out;
  out.of_com.assign(plan.stances.size(), infinity);
  const auto add = [&out](const Factor& factor, std::size_t from, std::size_t to) {
    out.least = std::min(out.least, factor.value);
    out.all_infinite = out.all_infinite && std::isinf(factor.value);
    if (factor.bound || std::isinf(factor.value)) return;
    out.none_can_rise = false;
    out.of_com[from] = std::min(out.of_com[from], factor.value);
    out.of_com[to] = std::min(out.of_com[to], factor.value);
  };
  for (std::size_t k = 0; k < plan.stances.size(); ++k)
    add(stance_factor(scene, plan.stances[k].feet, plan.stances[k].com), k, k);
  for (std::size_t k = 0; k < plan.transfers.size(); ++k)
    add(transfer_factor(scene, gaits::feet_during(plan.stances[k], plan.transfers[k]), plan.stances[k].com,
                        plan.stances[k + 1].com),
        k, k + 1);
  return out;
}

enum class Swept { unchanged, changed, out_of_work, out_of_time };

/// One pass in windows over the COMs whose factors are below `limit`, the weakest first.
Swept sweep(const Scene& scene, Plan& plan, const Timeline& timeline, const Factors& factors, double limit,
            int& windows_left, const RefineOptions& options) {
  const int coms = static_cast<int>(plan.stances.size()), first_free = scene.start.com ? 1 : 0;
  const int half = std::max(options.window, 1) / 2;
  std::vector<int> order(coms - first_free);
  std::iota(order.begin(), order.end(), first_free);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return factors.of_com[a] < factors.of_com[b]; });
  std::vector<char> done(coms, 0);
  bool changed = false;
  for (const int centre : order) {
    if (done[centre] || factors.of_com[centre] > limit) continue;
    if (std::chrono::steady_clock::now() >= options.deadline) return Swept::out_of_time;
    if (windows_left-- <= 0) return Swept::out_of_work;
    const int first = std::max(first_free, std::min(centre - half, coms - std::max(options.window, 1)));
    const int last = std::min(coms - 1, first + std::max(options.window, 1) - 1);
    changed = refine_window(scene, plan, timeline, first, last, factor_cap(factors.least), options) || changed;
    // The outermost COMs of a window had neighbours that could not move: they get a turn of their own.
    for (int k = first; k <= last; ++k)
      if (k == centre || ((k > first || first == first_free) && (k < last || last == coms - 1))) done[k] = 1;
  }
  return changed ? Swept::changed : Swept::unchanged;
}

std::string why_nothing_can_rise(const Factors& factors) {
  if (factors.all_infinite) return "every safety factor is infinite";
  return "every safety factor is at a bound set by friction alone, which no COM changes";
}

}  // namespace

bool refine_window(const Scene& scene, Plan& plan, const Timeline& timeline, int first, int last, double cap,
                   const RefineOptions& options) {
  RefineWindow window(scene, plan, timeline, first, last, cap);
  RefineModel model = window.model();
  VectorXd best_x = window.start();
  RefineWindow::Evaluation best = window.evaluate();
  if (best.factors.empty() && options.leave_out) return false;
  add_cuts(model.factors, best.factors);
  add_cuts(model.clearances, best.clearances);
  bool changed = false;
  double radius = first_radius * scene.robot.reach_max;
  for (int i = 1; i < options.max_evaluations && radius > least_radius * scene.robot.reach_max; ++i) {
    model.sum_gradient = best.sum_gradient;
    double gain = 0;
    const VectorXd x = maximise(model, best_x, best.least, radius, gain);
    const double sum_gain = best.sum_gradient.dot(x - best_x);
    if (gain < least_gain * best.least && sum_gain < least_gain * best.sum) {
      radius *= 0.25;
      continue;
    }
    const bool written = window.write(x);
    const RefineWindow::Evaluation now = written ? window.evaluate() : best;
    if (written) {
      add_cuts(model.factors, now.factors);
      add_cuts(model.clearances, now.clearances);
    }
    if (written && now.in_reach && better(now, best) && window.rules_hold()) {
      const double kept = now.least - best.least;
      if (kept > 0.5 * gain) radius = std::min(2 * radius, greatest_radius * scene.robot.reach_max);
      if (kept < 0.1 * gain) radius *= 0.5;
      best = now, best_x = x, changed = true;
    } else {
      radius *= 0.5;
      window.write(best_x);
    }
    admit(model.factors, best.factors, best_x);
    admit(model.clearances, best.clearances, best_x);
  }
  return changed;
}

Plan refine_unverified(const Scene& scene, const Plan& plan, const RefineOptions& options) {
  if (plan.status != gaits::Status::solved || plan.stances.empty()) return plan;
  stability::require(plan.stances.size() == plan.transfers.size() + 1, "plan: expected one stance more than transfers");
  stability::require(options.window >= 1, "window: expected at least one COM");
  Plan out = plan;
  Factors factors = factors_of(scene, plan);
  out.safety_factor_before_refinement = factors.least;
  if (factors.none_can_rise && options.leave_out) {
    out.left_out.push_back({"refinement", why_nothing_can_rise(factors)});
    return out;
  }
  const Timeline timeline(out);
  int windows_left = options.max_windows;
  for (int i = 0; i < options.sweeps; ++i) {
    const double limit = i == 0 ? std::numeric_limits<double>::infinity() : weak_place * factors.least;
    const Swept swept = sweep(scene, out, timeline, factors, limit, windows_left, options);
    if (swept == Swept::out_of_work)
      out.left_out.push_back(
          {"refinement of the safer places", fmt::format("the plan is long: the {} weakest windows of it "
                                                         "had their turn",
                                                         options.max_windows)});
    if (swept == Swept::out_of_time) out.left_out.push_back({"part of the refinement", "the time limit was reached"});
    if (swept != Swept::changed) break;
    factors = factors_of(scene, out);
  }
  gaits::rate(scene, out);
  if (out.safety_factor >= *out.safety_factor_before_refinement) return out;
  out = plan;
  out.safety_factor_before_refinement = plan.safety_factor;
  return out;
}

Plan refine(const Scene& scene, const Plan& plan, const RefineOptions& options) {
  if (plan.status != gaits::Status::solved || plan.stances.empty()) return plan;
  Plan out = refine_unverified(scene, plan, options);
  if (gaits::verify(scene, out).holds()) return out;
  out = plan;
  out.safety_factor_before_refinement = plan.safety_factor;
  return out;
}

}  // namespace surefoot::planner
