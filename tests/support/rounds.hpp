// How many of a test's random rounds are run: all of them, or a fifth under the sanitizers, which look for other faults
// than wrong results and are ten times slower.
#pragma once

namespace surefoot::test {

constexpr int rounds(int all) {
#ifdef __SANITIZE_ADDRESS__
  return (all + 4) / 5;
#else
  return all;
#endif
}

/// How many of something a test must have met to have tested it: less in a fifth of the rounds.
constexpr int enough(int in_all) { return rounds(in_all) / (rounds(2) == 2 ? 1 : 2); }

}  // namespace surefoot::test
