// Refinement: gap to the best known least safety factor of a window over time, per algorithm and evaluation budget.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "bench/error_time/items.hpp"
#include "bench/error_time/refinement_task.hpp"
#include "bench/planner_runs.hpp"

namespace surefoot::bench {
namespace {

struct Task {
  RefinementTask given;
  std::size_t problem;  ///< tasks of one problem differ in where they start
};

struct Problems {
  std::vector<std::unique_ptr<gaits::Scene>> scenes;
  std::vector<RefinementTask> windows;  ///< one per scene
};

Problems problems(int coms, bool quick) {
  std::vector<std::string> names{"vee", "stairs_up", "rubble"};
  if (quick) names = {"vee"};
  Problems made;
  for (const std::string& name : names) {
    made.scenes.push_back(
        std::make_unique<gaits::Scene>(gaits::load_scene(std::string(SUREFOOT_MAPS) + "/" + name + ".yaml")));
    const gaits::Plan plan = planned(*made.scenes.back(), "Layers", 1, 0, "steps");
    made.windows.push_back(weakest_window(*made.scenes.back(), plan, coms));
  }
  return made;
}

/// Multi-start of a global algorithm and a local one that the methods shown do not use.
double long_search(const RefinementTask& window, const std::vector<RefinementTask>& starts, bool quick) {
  double best = by_nlopt(window, "GN_CRS2_LM", quick ? 2000 : 30000);
  for (const RefinementTask& start : starts)
    best = std::max(best, by_nlopt(start, "LN_NELDERMEAD", quick ? 300 : 3000));
  return best;
}

struct Method {
  std::string name;
  std::function<double(const RefinementTask&, int)> run;
};

std::vector<Method> methods() {
  std::vector<Method> all{{"surefoot (cuts, trust region, SLSQP inside)", by_surefoot}};
  for (const char* algorithm : {"LD_SLSQP", "LD_MMA", "LD_CCSAQ", "LN_COBYLA", "LN_SBPLX", "LN_BOBYQA"})
    all.push_back({std::string("NLopt ") + algorithm, [algorithm](const RefinementTask& task, int evaluations) {
                     return by_nlopt(task, algorithm, evaluations);
                   }});
  return all;
}

void measure_window(Rows& rows, int coms, bool quick) {
  const Problems given = problems(coms, quick);
  const std::string what = coms == 1 ? "one COM" : fmt::format("{} COMs and feet", coms);
  std::vector<Task> kept, poor;
  std::vector<double> best;
  for (std::size_t k = 0; k < given.windows.size(); ++k) {
    const RefinementTask& window = given.windows[k];
    const auto starts = poor_starts(window, 10, 81 + k);
    best.push_back(coms == 1 ? by_exhaustive_grid(window, quick ? 30 : 80) : long_search(window, starts, quick));
    kept.push_back({window, k});
    for (std::size_t i = 0; i < std::min<std::size_t>(starts.size(), 3); ++i) poor.push_back({starts[i], k});
  }
  const std::vector<double> reference = best;
  struct Found {
    std::string scenario, method;
    int budget;
    std::vector<std::pair<std::size_t, double>> values;  ///< problem, least factor
    Timing time;
  };
  std::vector<Found> all;
  for (const auto& [scenario, tasks] :
       {std::pair{what + ", from the planner's plan", &kept}, {what + ", from poor starts", &poor}})
    for (const Method& method : methods())
      for (const int budget : {5, 10, 20, 40, 80, 160, 320}) {
        if (quick && budget > 80) break;
        Found found{scenario, method.name, budget, {}, {}};
        const auto run_all = [&] {
          found.values.clear();
          for (const Task& task : *tasks) found.values.emplace_back(task.problem, method.run(task.given, budget));
        };
        found.time = median_time(run_all, {quick ? 0.01 : 0.1, 3, 5}).each(tasks->size());
        for (const auto& [problem, value] : found.values) best[problem] = std::max(best[problem], value);
        all.push_back(found);
      }
  for (const Found& found : all) {
    double gap = 0;
    for (const auto& [problem, value] : found.values)
      gap += (1 - value / best[problem]) / static_cast<double>(found.values.size());
    std::string note = fmt::format("{} runs; best known", found.values.size());
    for (std::size_t k = 0; k < best.size(); ++k)
      note += fmt::format(" {} {:.6f} (reference {:.6f})", given.scenes[k]->name, best[k], reference[k]);
    constexpr double equal = 1e-7;  // the reference's own resolution
    rows.add(found.scenario, found.method, fmt::format("{}", found.budget), gap < equal ? 0 : gap, found.time, note);
  }
}

void measure(Rows& rows, bool quick) {
  for (const int coms : {1, 3}) measure_window(rows, coms, quick);
}

std::string findings(const Rows& rows) {
  std::string text =
      "Gap after 40 and after 320 evaluations (the planner's default is 40 per window), time of the latter:\n\n";
  std::vector<std::string> scenarios;
  for (const Row& row : rows.all())
    if (std::find(scenarios.begin(), scenarios.end(), row.scenario) == scenarios.end())
      scenarios.push_back(row.scenario);
  text += fmt::format("| | {} |\n|---", fmt::join(scenarios, " | "));
  for (std::size_t k = 0; k < scenarios.size(); ++k) text += "|---";
  text += "|\n";
  for (const Method& method : methods()) {
    text += "| " + method.name;
    for (const std::string& scenario : scenarios) {
      const Row *usual = rows.find(scenario, method.name, "40"), *longest = rows.find(scenario, method.name, "320");
      if (longest == nullptr) longest = usual;  // a quick run
      text += fmt::format(" | {:.1e}, {:.1e}, {:.2g} ms", usual->error, longest->error, 1e3 * longest->time.seconds);
    }
    text += " |\n";
  }
  return text;
}

}  // namespace

const Item refinement_item{"refinement",
                           "Refinement: gap to the best known safety factor against time",
                           "one COM (with the foot that only it touches): an exhaustive grid, ever finer around its "
                           "best point, to 1e-7 m; three COMs with "
                           "their feet: a long global search (CRS2, "
                           "30000 evaluations) and 10 long runs of Nelder-Mead from poor starts, neither of which is "
                           "shown; or better where a method "
                           "shown found better (column note says both)",
                           "1 - least factor / best known, mean over scenes and starts (labels: evaluations)",
                           "time per run",
                           1e-3,
                           measure,
                           findings};

}  // namespace surefoot::bench
