// Time per answer of the stability oracle, and of GLPK on the same postures in the same run; ends with a table
// against the targets of the project. See bench/README.md.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/glpk_verdict.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"
#include "gaits/scene.hpp"
#include "stability/robust_oracle.hpp"
#include "tests/support/sample_posture.hpp"

namespace {

using surefoot::bench::GlpkVerdict;
using surefoot::stability::RobustOracle;
using surefoot::testing::Kind;
using surefoot::testing::SamplePosture;
using surefoot::testing::Sampler;

constexpr std::size_t batch = 1024;  // postures per pass: more than branch predictors and caches of the first level remember

struct Work {
  std::vector<SamplePosture> postures;
  std::vector<Eigen::Vector2d> to;  // far ends of lines, and further COMs
};

// Random postures of the kinds of the terrain: gentle, any, flat, vee, stairs in turn.
const Work& work(int contacts) {
  static std::map<int, Work> cache;
  Work& made = cache[contacts];
  if (!made.postures.empty()) return made;
  Sampler sampler(2024 + static_cast<std::uint64_t>(contacts));
  constexpr Kind kinds[]{Kind::gentle, Kind::any, Kind::flat, Kind::vee, Kind::stairs};
  for (std::size_t k = 0; k < batch; ++k) {
    made.postures.push_back(sampler.posture(kinds[k % 5], contacts));
    made.to.push_back(sampler.com_near(made.postures.back().contacts));
  }
  return made;
}

std::vector<RobustOracle> oracles(const Work& given) {
  std::vector<RobustOracle> made;
  for (const SamplePosture& p : given.postures) made.emplace_back(p.contacts, p.rho, p.box);
  return made;
}

/// Calls answer(k) for k = 0, 1, ... round and round; one iteration is one answer.
template <class Answer>
void run(benchmark::State& state, Answer&& answer) {
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(answer(k));
    k = (k + 1) % batch;
  }
}

void fresh_contacts(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  run(state, [&](std::size_t k) {
    const SamplePosture& p = given.postures[k];
    return surefoot::stability::robust(p.contacts, p.rho, p.box, p.com);
  });
}

void same_contacts(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  const std::vector<RobustOracle> made = oracles(given);
  constexpr std::size_t few = 8;  // contact sets that take turns, as in a search
  run(state, [&](std::size_t k) { return made[k % few].robust(given.to[k]); });
}

void safety_factor(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  const std::vector<RobustOracle> made = oracles(given);
  run(state, [&](std::size_t k) { return made[k].safety_factor(given.postures[k].com); });
}

void straight_line(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  const std::vector<RobustOracle> made = oracles(given);
  run(state, [&](std::size_t k) { return made[k].line(given.postures[k].com, given.to[k]); });
}

// Lines whose ends are robust: the ones a planner asks about, and the longest to decide.
void straight_line_robust_ends(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  const std::vector<RobustOracle> made = oracles(given);
  Sampler sampler(7);
  std::vector<std::size_t> which;
  std::vector<Eigen::Vector2d> far_end;
  for (std::size_t k = 0; k < batch; ++k) {
    const SamplePosture& p = given.postures[k];
    if (!made[k].robust(p.com)) continue;
    for (int attempt = 0; attempt < 10; ++attempt) {
      const Eigen::Vector2d to = sampler.com_near(p.contacts);
      if (!made[k].robust(to)) continue;
      which.push_back(k);
      far_end.push_back(to);
      break;
    }
  }
  std::size_t certified = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    certified += made[which[k]].line(given.postures[which[k]].com, far_end[k]).stable();
  }
  state.counters["certified"] = static_cast<double>(certified) / static_cast<double>(which.size());
  run(state, [&](std::size_t k) {
    const std::size_t i = k % which.size();
    return made[which[i]].line(given.postures[which[i]].com, far_end[i]);
  });
}

struct PlannedTransfer {
  RobustOracle oracle;
  Eigen::Vector2d from, to;
};

// Every transfer of the stored plans of the canned scenes that ask for robust stability.
const std::vector<PlannedTransfer>& planned_transfers() {
  static const std::vector<PlannedTransfer> transfers = [] {
    namespace gaits = surefoot::gaits;
    std::vector<PlannedTransfer> made;
    for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_PLANS)) {
      const gaits::Scene scene = gaits::load_scene(SUREFOOT_MAPS "/" + entry.path().stem().string() + ".yaml");
      if (scene.criterion != gaits::Criterion::robust) continue;
      const gaits::Plan plan = gaits::read_plan(entry.path().string());
      for (std::size_t k = 0; k < plan.transfers.size(); ++k)
        made.push_back({gaits::oracle_of(scene, gaits::feet_during(plan.stances[k], plan.transfers[k])),
                        plan.stances[k].com, plan.stances[k + 1].com});
    }
    return made;
  }();
  return transfers;
}

void straight_line_of_plans(benchmark::State& state) {
  const std::vector<PlannedTransfer>& given = planned_transfers();
  std::size_t certified = 0;
  for (const PlannedTransfer& t : given) certified += t.oracle.line(t.from, t.to).stable();
  state.counters["certified"] = static_cast<double>(certified) / static_cast<double>(given.size());
  run(state, [&](std::size_t k) {
    const PlannedTransfer& t = given[k % given.size()];
    return t.oracle.line(t.from, t.to);
  });
}

void line_safety_factor(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  const std::vector<RobustOracle> made = oracles(given);
  run(state, [&](std::size_t k) { return made[k].line_safety_factor(given.postures[k].com, given.to[k]); });
}

void glpk(benchmark::State& state) {
  const Work& given = work(static_cast<int>(state.range(0)));
  GlpkVerdict verdict;
  std::size_t disagreements = 0;
  for (const SamplePosture& p : given.postures) {
    const bool ours = RobustOracle(p.contacts, p.rho, p.box).robust(p.com);
    disagreements += ours != verdict.robust(p.contacts, p.com, p.rho, p.box);
  }
  state.counters["disagreements"] = static_cast<double>(disagreements);
  run(state, [&](std::size_t k) {
    const SamplePosture& p = given.postures[k];
    return verdict.robust(p.contacts, p.com, p.rho, p.box);
  });
}

BENCHMARK(fresh_contacts)->Arg(2)->Arg(3);
BENCHMARK(same_contacts)->Arg(2)->Arg(3);
BENCHMARK(safety_factor)->Arg(2)->Arg(3);
BENCHMARK(straight_line)->Arg(2)->Arg(3);
BENCHMARK(straight_line_robust_ends)->Arg(2)->Arg(3);
BENCHMARK(straight_line_of_plans);
BENCHMARK(line_safety_factor)->Arg(2)->Arg(3);
BENCHMARK(glpk)->Arg(2)->Arg(3);

/// Prints as usual and keeps the CPU time of every benchmark [ns]; with repetitions, the least.
class Collector : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& reports) override {
    for (const Run& report : reports) {
      if (report.run_type != Run::RT_Iteration || report.error_occurred) continue;
      const double time = report.GetAdjustedCPUTime();
      const auto [entry, first] = times.try_emplace(report.benchmark_name(), time);
      if (!first && time < entry->second) entry->second = time;
    }
    ConsoleReporter::ReportRuns(reports);
  }
  std::map<std::string, double> times;
};

struct Target {
  const char *what, *benchmark;
  double nanoseconds;
};
constexpr Target targets[]{
    {"robust verdict, new contacts, 2", "fresh_contacts/2", 80}, {"robust verdict, new contacts, 3", "fresh_contacts/3", 160},
    {"robust verdict, same contacts, 2", "same_contacts/2", 15}, {"robust verdict, same contacts, 3", "same_contacts/3", 30},
    {"safety factor and gradient, 2", "safety_factor/2", 300},   {"safety factor and gradient, 3", "safety_factor/3", 600},
    {"straight line, random, 3", "straight_line/3", 600},
    {"straight line, transfers of plans", "straight_line_of_plans", 600},
    {"straight line, random robust ends, 3", "straight_line_robust_ends/3", 600}};

void print_table(const std::map<std::string, double>& times) {
  std::printf("\n%-36s %12s %12s %8s\n", "work", "target [us]", "time [us]", "ratio");
  for (const Target& target : targets) {
    const auto found = times.find(target.benchmark);
    if (found == times.end()) continue;
    std::printf("%-36s %12.3f %12.3f %8.2f\n", target.what, target.nanoseconds / 1e3, found->second / 1e3,
                found->second / target.nanoseconds);
  }
  for (const auto& [contacts, least] : {std::pair{"2", 500}, {"3", 1000}}) {
    const auto ours = times.find(std::string("fresh_contacts/") + contacts), lp = times.find(std::string("glpk/") + contacts);
    if (ours == times.end() || lp == times.end()) continue;
    std::printf("GLPK / surefoot, %s contacts: %.1f us / %.3f us = %.0f (target >= %d)\n", contacts, lp->second / 1e3,
                ours->second / 1e3, lp->second / ours->second, least);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  print_table(collector.times);
  benchmark::Shutdown();
}
