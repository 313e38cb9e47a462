#include <algorithm>

#include "gaits/scene.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

void scene(std::string_view bytes) {
  std::string first;
  try {
    gaits::parse_scene(bytes, "input");
  } catch (const terrain::InputError& fault) {
    first = fault.what();
    expect_located(first);
  }
  terrain::FaultList faults;
  const bool loaded = gaits::parse_scene(bytes, "input", faults).has_value();
  expect(loaded == first.empty(), "faults are found exactly where a scene is refused: " + first);
  expect(loaded == (faults.count() == 0), "a scene without faults is a scene");
  bool first_told = loaded || faults.full();
  std::vector<std::string> told;
  for (const terrain::InputError& fault : faults.kept()) {
    told.emplace_back(fault.what());
    expect_located(told.back());
    first_told = first_told || told.back() == first;
  }
  expect(first_told, "the first fault is among all of them: " + first);
  std::sort(told.begin(), told.end());
  expect(std::adjacent_find(told.begin(), told.end()) == told.end(), "no fault is told twice");
}

}  // namespace surefoot::fuzz
