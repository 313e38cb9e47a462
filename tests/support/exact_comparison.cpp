#include "tests/support/exact_comparison.hpp"

#include <charconv>
#include <chrono>

#include "tests/support/agreement.hpp"

namespace surefoot::testing {
namespace {

using Outcome = stability::LineVerdict::Outcome;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}
std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all.append(all.empty() ? "" : " ").append(name);
  return "[" + all + "]";
}
std::string at_com(SamplePosture sample, const Eigen::Vector2d& com) {
  sample.com = com;
  return sample.json();
}

struct PointAnswer {
  bool equilibrium = false, robust = false;
  std::vector<std::string> modes;
  friend bool operator==(const PointAnswer&, const PointAnswer&) = default;
  std::string text() const {
    return std::string(equilibrium ? "equilibrium " : "no equilibrium ") + (robust ? "robust " : "") + joined(modes);
  }
};

bool cause_holds(const ExactPosture& exact, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                 const stability::LineVerdict& verdict) {
  if (!(verdict.lambda >= 0 && verdict.lambda <= 1)) return false;
  const ExactFrame frame = exact.frame(ExactCom(from, to, verdict.lambda));
  if (verdict.cause.kind == stability::Critical::Kind::equilibrium) return !exact.equilibrium(frame);
  for (const ExactMode& mode : exact.modes())
    if (mode.mode == verdict.cause.mode) return exact.feasible(frame, mode);
  return false;
}

const char* name(Outcome outcome) {
  return outcome == Outcome::stable ? "stable" : outcome == Outcome::unstable ? "unstable" : "uncertain";
}

template <class K>
ComparisonCounts block_of(K kind, std::uint64_t seed, long cases, const Report& report) {
  constexpr long fruitless_families = 1000000;  // a kind that finds nothing must not run for ever
  Sampler sampler(seed);
  ComparisonCounts counts;
  for (long k = 0; counts.cases < cases && k < fruitless_families; ++k) {
    const Report named = [&](const std::string& difference) {
      report(std::string(testing::name(kind))
                 .append(" (seed ")
                 .append(std::to_string(seed))
                 .append("): ")
                 .append(difference));
    };
    if constexpr (std::is_same_v<K, PointKind>) {
      PointFamily family = point_family(kind, sampler);
      family.coms.resize(std::min<std::size_t>(family.coms.size(), cases - counts.cases));
      counts += compare_points(family, named);
    } else {
      LineFamily family = line_family(kind, sampler);
      family.lines.resize(std::min<std::size_t>(family.lines.size(), cases - counts.cases));
      counts += compare_lines(family, named);
    }
  }
  return counts;
}

}  // namespace

ComparisonCounts& ComparisonCounts::operator+=(const ComparisonCounts& other) {
  cases += other.cases;
  robust += other.robust;
  differences += other.differences;
  uncertain += other.uncertain;
  uncertain_stable += other.uncertain_stable;
  inside += other.inside;
  exact_seconds += other.exact_seconds;
  return *this;
}

ComparisonCounts compare_points(const PointFamily& family, const Report& report) {
  ComparisonCounts counts;
  if (family.coms.empty()) return counts;
  const stability::RobustOracle oracle = oracle_of(family.sample);
  auto start = Clock::now();
  const ExactPosture exact(family.sample);
  counts.exact_seconds += seconds_since(start);
  for (const Eigen::Vector2d& com : family.coms) {
    start = Clock::now();
    const ExactFrame frame = exact.frame(ExactCom(com));
    PointAnswer expected{exact.equilibrium(frame), false, exact.feasible_modes(frame)};
    expected.robust = expected.equilibrium && expected.modes.empty();
    counts.exact_seconds += seconds_since(start);
    const PointAnswer found{oracle.equilibrium(com), oracle.robust(com), mode_names(oracle.feasible_modes(com))};
    ++counts.cases;
    counts.robust += expected.robust;
    if (found == expected) continue;
    ++counts.differences;
    report("oracle " + found.text() + ", exact " + expected.text() + "\n  " + at_com(family.sample, com));
  }
  return counts;
}

ComparisonCounts compare_lines(const LineFamily& family, const Report& report) {
  ComparisonCounts counts;
  if (family.lines.empty()) return counts;
  const stability::RobustOracle oracle = oracle_of(family.sample);
  const ExactPosture exact(family.sample);
  for (const auto& [from, to] : family.lines) {
    const auto start = Clock::now();
    const bool stable = ExactLine(exact, from, to).stable();
    counts.exact_seconds += seconds_since(start);
    const stability::LineVerdict verdict = oracle.line(from, to);
    ++counts.cases;
    counts.robust += stable;
    counts.uncertain += verdict.outcome == Outcome::uncertain;
    counts.uncertain_stable += verdict.outcome == Outcome::uncertain && stable;
    counts.inside += !stable && exact.robust(exact.frame(ExactCom(from))) && exact.robust(exact.frame(ExactCom(to)));
    const bool right = verdict.outcome == Outcome::uncertain ||
                       (verdict.outcome == Outcome::stable ? stable : !stable && cause_holds(exact, from, to, verdict));
    if (right) continue;
    ++counts.differences;
    report(std::string("oracle ") + name(verdict.outcome) + " at " + text(verdict.lambda) + " by " +
           verdict.cause.name() + ", exact " + (stable ? "stable" : "unstable") + ", com_to [" + text(to.x()) + ", " +
           text(to.y()) + "]\n  " + at_com(family.sample, from));
  }
  return counts;
}

ComparisonCounts compare_block(PointKind kind, std::uint64_t seed, long cases, const Report& report) {
  return block_of(kind, seed, cases, report);
}
ComparisonCounts compare_block(LineKind kind, std::uint64_t seed, long cases, const Report& report) {
  return block_of(kind, seed, cases, report);
}

}  // namespace surefoot::testing
