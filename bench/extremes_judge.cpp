#include <chrono>

#include "bench/extremes.hpp"
#include "stability/robust_oracle.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/extreme_exact.hpp"
#include "tests/support/extreme_factor.hpp"
#include "tests/support/extreme_lp.hpp"
#include "tests/support/extreme_plain.hpp"

namespace surefoot::bench {
namespace {

using testing::ExactVerdict;
using testing::ExtremeCase;

template <class Work>
auto timed(double& seconds, Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

template <class Verdict>
bool differs(const Verdict& verdict, const ExactVerdict& exact) {
  return verdict.equilibrium != exact.equilibrium || verdict.robust != exact.robust || verdict.modes != exact.modes;
}

template <class Verdict>
bool count(Judge& judge, const Verdict& verdict, const ExactVerdict& exact, bool without) {
  const bool wrong = differs(verdict, exact);
  judge.wrong += wrong;
  judge.unsafe += verdict.robust && !exact.robust;
  judge.without += without;
  return wrong;
}

ExactVerdict our_verdict(const stability::RobustOracle& oracle, const Eigen::Vector2d& com) {
  return {oracle.equilibrium(com), oracle.robust(com), testing::mode_names(oracle.feasible_modes(com))};
}

template <class Verdict>
std::string told(const Verdict& verdict) {
  std::string text = verdict.robust ? "robust" : verdict.equilibrium ? "equilibrium, not robust" : "no equilibrium";
  if (verdict.modes.empty()) return text + ", no mode";
  text += ", modes";
  for (const std::string& mode : verdict.modes) text += " " + mode;
  return text;
}

void judge_factor(const ExtremeCase& example, const stability::RobustOracle& oracle, FactorErrors& errors) {
  const auto found = timed(errors.seconds, [&] { return oracle.safety_factor(example.sample.com); });
  const testing::ExactFactor exact = testing::exact_safety_factor(example.sample);
  const testing::FactorComparison comparison = testing::compared(example.sample, found, exact);
  (!exact.value ? errors.infinite : *exact.value == 0 ? errors.zero : errors.finite) += 1;
  errors.kinks += exact.kink;
  errors.not_a_number += comparison.not_a_number;
  if (!(comparison.value_error < 1)) ++errors.differ;
  else errors.value = std::max(errors.value, comparison.value_error);
  errors.gradient = std::max(errors.gradient, comparison.gradient_error);
}

/// Keeps the case with the shortest text for each group and each kind of failure.
void keep_telling(Results& results, const Telling& candidate) {
  for (Telling& kept : results.telling) {
    if (kept.example.group != candidate.example.group) continue;
    const bool worse = (candidate.plain == candidate.exact) > (kept.plain == kept.exact);
    const bool better = (candidate.plain == candidate.exact) < (kept.plain == kept.exact);
    if (better || (!worse && candidate.example.sample.json().size() < kept.example.sample.json().size()))
      kept = candidate;
    return;
  }
  results.telling.push_back(candidate);
}

}  // namespace

Results judged_catalogue() {
  Results results;
  for (const ExtremeCase& example : testing::extreme_catalogue()) {
    if (!results.groups.contains(example.group)) results.order.push_back(example.group);
    GroupResult& group = results.groups[example.group];
    const auto exact = timed(group.exact.seconds, [&] { return testing::exact_verdict(example.sample); });
    ++group.cases;
    group.robust += exact.robust;
    const auto plain = timed(group.plain.seconds, [&] { return testing::plain_verdict(example.sample); });
    const auto lp = timed(group.lp.seconds, [&] { return testing::lp_verdict(example.sample); });
    const stability::RobustOracle oracle = testing::oracle_of(example.sample);
    const auto ours = timed(group.ours.seconds, [&] { return our_verdict(oracle, example.sample.com); });
    count(group.ours, ours, exact, false);
    bool wrong = count(group.plain, plain, exact, plain.not_a_number);
    wrong |= count(group.lp, lp, exact, lp.unanswered);
    if (wrong) keep_telling(results, {example, told(exact), told(plain), told(lp)});
    judge_factor(example, oracle, group.factor);
  }
  return results;
}

}  // namespace surefoot::bench
