// The oracle against exact decisions, case by case and in blocks that can be spread over threads. Shared by the command
// bench/exact_comparison.cpp and by the tests.
#pragma once

#include <cstdint>
#include <string>

#include "tests/support/exact_cases.hpp"

namespace surefoot::testing {

/// What was counted; sums of such are counts of all.
struct ComparisonCounts {
  long cases = 0;
  long robust = 0;  ///< robust COMs, stable lines, by the exact decision
  long differences = 0;
  long uncertain = 0;         ///< lines the oracle leaves undecided
  long uncertain_stable = 0;  ///< of these, exactly stable
  long inside = 0;            ///< lines between robust ends that are not stable
  double exact_seconds = 0;   ///< spent on exact decisions (of points: including the preparation of contacts)
  ComparisonCounts& operator+=(const ComparisonCounts& other);
};

/// Receives one line of text for every difference; called from several threads at a time unless it locks.
using Report = std::function<void(const std::string&)>;

/// equilibrium, feasible modes and robust at every COM of the family.
ComparisonCounts compare_points(const PointFamily& family, const Report& report);
/// A line called stable must be stable; one called unstable must be so at the lambda and for the cause named.
ComparisonCounts compare_lines(const LineFamily& family, const Report& report);

/// At least `cases` cases of a kind, from a seed of their own.
ComparisonCounts compare_block(PointKind kind, std::uint64_t seed, long cases, const Report& report);
ComparisonCounts compare_block(LineKind kind, std::uint64_t seed, long cases, const Report& report);

}  // namespace surefoot::testing
