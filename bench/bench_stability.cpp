// Time per answer of the stability oracle, and of GLPK on the same postures in the same run; ends with a table
// against the targets of the project. See bench/README.md.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "bench/glpk_verdict.hpp"
#include "bench/oracle_work.hpp"

namespace {

using namespace surefoot::bench;
using surefoot::stability::RobustOracle;
using surefoot::testing::SamplePosture;

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
  const std::vector<Line> given = lines_between_robust(static_cast<int>(state.range(0)));
  std::size_t certified = 0;
  for (const Line& t : given) certified += t.oracle.line(t.from, t.to).stable();
  state.counters["certified"] = static_cast<double>(certified) / static_cast<double>(given.size());
  run(state, [&](std::size_t k) {
    const Line& t = given[k % given.size()];
    return t.oracle.line(t.from, t.to);
  });
}

void straight_line_of_plans(benchmark::State& state) {
  const std::vector<Line>& given = planned_transfers();
  std::size_t certified = 0;
  for (const Line& t : given) certified += t.oracle.line(t.from, t.to).stable();
  state.counters["certified"] = static_cast<double>(certified) / static_cast<double>(given.size());
  run(state, [&](std::size_t k) {
    const Line& t = given[k % given.size()];
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
constexpr Target targets[]{{"robust verdict, new contacts, 2", "fresh_contacts/2", 80},
                           {"robust verdict, new contacts, 3", "fresh_contacts/3", 160},
                           {"robust verdict, same contacts, 2", "same_contacts/2", 15},
                           {"robust verdict, same contacts, 3", "same_contacts/3", 30},
                           {"safety factor and gradient, 2", "safety_factor/2", 300},
                           {"safety factor and gradient, 3", "safety_factor/3", 600},
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
    const auto ours = times.find(std::string("fresh_contacts/") + contacts),
               lp = times.find(std::string("glpk/") + contacts);
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
