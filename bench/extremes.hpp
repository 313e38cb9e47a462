// Asks the four judges about every case of the catalogue and counts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/support/extreme_cases.hpp"

namespace surefoot::bench {

/// One way to decide, over one group.
struct Judge {
  int wrong = 0;    ///< equilibrium, the feasible modes or the robust verdict differ from exact arithmetic
  int unsafe = 0;   ///< among them: robust where it is not
  int without = 0;  ///< cases with a number that is not finite, or an LP without an answer
  double seconds = 0;
};

/// Errors of safety factors over one group.
struct FactorErrors {
  int zero = 0, infinite = 0, finite = 0, kinks = 0, differ = 0, not_a_number = 0;
  double value = 0;     ///< greatest relative error
  double gradient = 0;  ///< greatest error over |gradient| + sigma / lever, kinks left out
  double seconds = 0;
};

struct GroupResult {
  int cases = 0, robust = 0;
  Judge plain, ours, lp, exact;
  FactorErrors factor;
};

/// A case that some judge gets wrong, as it is told on the page.
struct Telling {
  testing::ExtremeCase example;
  std::string exact, plain, lp;
};

struct Results {
  std::vector<std::string> order;
  std::map<std::string, GroupResult> groups;
  std::vector<Telling>
      telling;  ///< per group the shortest case that plain doubles get wrong, else that the LP gets wrong
};

Results judged_catalogue();

}  // namespace surefoot::bench
