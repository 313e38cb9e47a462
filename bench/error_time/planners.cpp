// Planners: how far from the fewest steps over time.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "bench/error_time/items.hpp"
#include "bench/exhaustive_grid.hpp"
#include "bench/planner_runs.hpp"
#include "gaits/verifier.hpp"

namespace surefoot::bench {
namespace {

using Random = std::mt19937_64;

constexpr int unsolved = -1;

struct Run {
  double seconds;  ///< CPU time of the process, all threads
  int steps;       ///< of a verified plan, or `unsolved`
};

Run run_of(const gaits::Scene& scene, const std::string& planner, std::uint32_t seed, double effort) {
  const double begin = cpu_time(CLOCK_PROCESS_CPUTIME_ID);
  const gaits::Plan plan = planned(scene, planner, seed, effort, "steps");
  const double seconds = cpu_time(CLOCK_PROCESS_CPUTIME_ID) - begin;
  const bool holds = plan.status == gaits::Status::solved && gaits::verify(scene, plan).holds();
  return {seconds, holds ? plan.steps() : unsolved};
}

std::vector<Run> runs_of(const gaits::Scene& scene, const std::string& planner, int seeds, double effort) {
  std::vector<Run> runs;
  for (int seed = 1; seed <= seeds; ++seed)
    runs.push_back(run_of(scene, planner, static_cast<std::uint32_t>(seed), effort));
  return runs;
}

template <class T>
std::vector<T> resampled(const std::vector<T>& from, Random& random) {
  std::vector<T> drawn;
  for (std::size_t k = 0; k < from.size(); ++k)
    drawn.push_back(from[std::uniform_int_distribution<std::size_t>(0, from.size() - 1)(random)]);
  return drawn;
}

/// Mean steps of a plan and the share of times that there is one.
struct Outcome {
  double steps = 0, solved = 0;
};

/// Runs drawn one after the other until the time is up, the best plan kept; mean over many such sequences.
Outcome restarted(const std::vector<Run>& runs, double limit, int sequences, Random& random) {
  std::uniform_int_distribution<std::size_t> any(0, runs.size() - 1);
  Outcome outcome;
  for (int k = 0; k < sequences; ++k) {
    double time = 0;
    int best = unsolved;
    for (;;) {
      const Run& run = runs[any(random)];
      time += run.seconds;
      if (time > limit) break;
      if (run.steps != unsolved && (best == unsolved || run.steps < best)) best = run.steps;
    }
    if (best == unsolved) continue;
    outcome.solved += 1, outcome.steps += best;
  }
  if (outcome.solved > 0) outcome.steps /= outcome.solved;
  outcome.solved /= sequences;
  return outcome;
}

Outcome mean(const std::vector<Run>& runs) {
  Outcome outcome;
  for (const Run& run : runs)
    if (run.steps != unsolved) outcome.solved += 1, outcome.steps += run.steps;
  if (outcome.solved > 0) outcome.steps /= outcome.solved;
  outcome.solved /= static_cast<double>(runs.size());
  return outcome;
}

/// The middle 95 % of the mean over runs drawn anew with replacement.
std::pair<double, double> confidence(const std::vector<Run>& runs,
                                     const std::function<Outcome(const std::vector<Run>&)>& of) {
  constexpr int samples = 200;
  Random random(1);
  std::vector<double> steps;
  for (int k = 0; k < samples; ++k)
    if (const Outcome outcome = of(resampled(runs, random)); outcome.solved > 0) steps.push_back(outcome.steps);
  if (steps.empty()) return {INFINITY, INFINITY};
  std::sort(steps.begin(), steps.end());
  return {steps[steps.size() / 40], steps[steps.size() - 1 - steps.size() / 40]};
}

class SceneMeasurement {
 public:
  SceneMeasurement(Rows& rows, const gaits::Scene& scene, bool quick) : rows_(rows), scene_(scene), quick_(quick) {
    const GridOptimum optimum = exhaustive_optimum(scene, {0.1, 0.1}, "steps", 10'000'000);
    if (!optimum.found || !gaits::verify(scene, optimum.plan).holds())
      throw std::runtime_error(scene.name + ": no optimum");
    grid_ = fewest_ = optimum.plan.steps();
  }

  void run() {
    const int seeds = quick_ ? 5 : 20;
    const std::vector<double> efforts = quick_ ? std::vector<double>{0, 0.05} : std::vector<double>{0, 0.05, 0.2, 1};
    std::vector<std::vector<Run>> layers;
    for (const double effort : efforts) layers.push_back(taken(runs_of(scene_, "Layers", seeds, effort)));
    std::vector<std::pair<std::string, std::vector<Run>>> others;
    for (const char* planner : {"RRT", "KPIECE1", "EST", "SST"})
      others.emplace_back(planner, taken(runs_of(scene_, planner, seeds, 0)));
    for (std::size_t k = 0; k < efforts.size(); ++k) {
      std::vector<double> times;
      for (const Run& r : layers[k]) times.push_back(r.seconds);
      add("Layers (effort)", fmt::format("effort {:g}", efforts[k]), layers[k], {median(times), seeds}, mean);
    }
    for (const auto& [planner, runs] : others)
      for (const double limit : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0})
        add(planner + " (restarts)", fmt::format("{:g} s", limit), runs, {limit, seeds},
            [limit](const std::vector<Run>& r) {
              Random random(2);
              constexpr int sequences = 200;
              return restarted(r, limit, sequences, random);
            });
  }

 private:
  std::vector<Run> taken(std::vector<Run> runs) {
    for (const Run& r : runs)
      if (r.steps != unsolved) fewest_ = std::min(fewest_, r.steps);
    return runs;
  }

  double gap(double steps) const { return steps / fewest_ - 1; }

  void add(const std::string& method, const std::string& parameter, const std::vector<Run>& runs, Timing time,
           const std::function<Outcome(const std::vector<Run>&)>& of) {
    const Outcome outcome = of(runs);
    constexpr double nearly_always = 0.95;  // of the seeds or sequences; below, a mean of those solved would flatter
    Row row{scene_.name, method, parameter, INFINITY, INFINITY, INFINITY, time, {}};
    row.note = fmt::format("solved {:.0f} %, mean steps {:.2f}; grid optimum {}, fewest known {}", 100 * outcome.solved,
                           outcome.steps, grid_, fewest_);
    if (outcome.solved >= nearly_always) {
      const auto [low, high] = confidence(runs, of);
      row.error = gap(outcome.steps), row.low = std::min(gap(low), row.error),
      row.high = std::max(gap(high), row.error);
      row.note += fmt::format(", 95 % confidence {:.2f} to {:.2f}", low, high);
    } else if (outcome.solved == 0) {
      return;  // nothing to draw: too short for any run
    }
    rows_.add(row);
  }

  Rows& rows_;
  const gaits::Scene& scene_;
  bool quick_;
  int grid_ = 0, fewest_ = 0;
};

void measure(Rows& rows, bool quick) {
  std::vector<std::string> names{"flat", "vee", "stairs_up", "gap", "stepping_stones", "chimney"};
  if (quick) names = {"flat", "stairs_up"};
  for (const std::string& name : names) {
    const gaits::Scene scene = gaits::load_scene(std::string(SUREFOOT_MAPS) + "/" + name + ".yaml");
    SceneMeasurement(rows, scene, quick).run();
  }
}

std::string findings(const Rows& rows) {
  std::string text = "Layers (numbers of the others are in the table):\n\n";
  for (const Row& row : rows.all())
    if (row.method.starts_with("Layers") && (row.parameter == "effort 0" || row.parameter == "effort 1"))
      text += fmt::format("- {}, {}, {:.2g} ms: {}.\n", row.scenario, row.parameter, 1e3 * row.time.seconds, row.note);
  const Row* best = nullptr;
  for (const Row& row : rows.all())
    if (row.parameter == "1 s" && std::isfinite(row.error) && (best == nullptr || row.error < best->error)) best = &row;
  if (best != nullptr)
    text += fmt::format("- The others after 1 s, restarts included, are {:.0f} % above the fewest at best ({}, {}).\n",
                        100 * best->error, best->method, best->scenario);
  return text;
}

}  // namespace

const Item planners_item{"planners",
                         "Planners: steps above the fewest known, against time",
                         "the optimum of an exhaustive search on a grid of 0.1 m, which shares nothing with planner/ "
                         "(bench/exhaustive_grid.hpp), or fewer "
                         "where a verified plan of this run has fewer (column note); bars: 95 % confidence over the "
                         "seeds (bootstrap); failed: below 95 % solved",
                         "mean steps over the fewest known, minus 1",
                         "CPU time of the search",
                         1e-3,
                         measure,
                         findings};

}  // namespace surefoot::bench
