// What the oracle is asked in bench_stability and in the targets of surefoot-bench: the same postures and lines in
// both.
#pragma once

#include <vector>

#include "stability/robust_oracle.hpp"
#include "tests/support/sample_posture.hpp"

namespace surefoot::bench {

constexpr std::size_t batch =
    1024;  // postures per pass: more than branch predictors and caches of the first level remember

struct Work {
  std::vector<testing::SamplePosture> postures;
  std::vector<Eigen::Vector2d> to;  // far ends of lines, and further COMs
};
/// Random postures of the kinds of the terrain: gentle, any, flat, vee, stairs in turn. Kept.
const Work& work(int contacts);
std::vector<stability::RobustOracle> oracles(const Work& given);

struct Line {
  stability::RobustOracle oracle;
  Eigen::Vector2d from, to;
};
/// Between robust COMs: the lines a planner asks about, and the longest to decide.
std::vector<Line> lines_between_robust(int contacts);
/// Every transfer of the stored plans of the canned scenes that ask for robust stability. Kept.
const std::vector<Line>& planned_transfers();

}  // namespace surefoot::bench
