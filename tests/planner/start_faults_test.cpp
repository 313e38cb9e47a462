// What is said of several pairs of start feet.
#include "planner/start_faults.hpp"

#include <catch2/catch.hpp>

using namespace surefoot;

namespace {

gaits::Stance on(int one, int other) {
  gaits::Stance stance;
  stance.feet[one - 1].emplace();
  stance.feet[other - 1].emplace();
  return stance;
}

}  // namespace

TEST_CASE("Causes that differ in the pair of feet alone are said once", "[start_faults]") {
  planner::PairFaults faults;
  CHECK(faults.words().empty());
  faults.add(on(1, 2), "none on feet 1 and 2: steep");
  CHECK(faults.words() == "none on feet 1 and 2: steep");
  faults.add(on(1, 3), "none on feet 1 and 3: steep");
  faults.add(on(2, 3), "none on feet 2 and 3: far");
  CHECK(faults.words() == "none on feet 1 and 2, 1 and 3: steep; none on feet 2 and 3: far");
}

TEST_CASE("Causes that name no pair are said once, those that name another one stay", "[start_faults]") {
  planner::PairFaults faults;
  faults.add(on(1, 2), "leg 1 cuts the terrain");
  faults.add(on(1, 3), "leg 1 cuts the terrain");
  faults.add(on(2, 3), "none on feet 1 and 2");
  CHECK(faults.words() == "leg 1 cuts the terrain; none on feet 1 and 2");
}

TEST_CASE("Advice stands once, behind all causes", "[start_faults]") {
  planner::PairFaults faults;
  faults.add(on(1, 2), "none on feet 1 and 2");
  faults.advise("try less");
  faults.add(on(1, 3), "none on feet 1 and 3: far");
  faults.advise("try less");
  CHECK(faults.words() == "none on feet 1 and 2; none on feet 1 and 3: far; try less");
}
