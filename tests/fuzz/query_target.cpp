#include <nlohmann/json.hpp>

#include "planner/query.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

void query(std::string_view bytes) {
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  std::string answer, again;
  planner::answer_query(answer, line, 7);
  planner::answer_query(again, line, 7);
  expect(answer == again, "the same line has the same answer");
  expect(answer.find('\n') == std::string::npos, "an answer is one line");
  const auto parsed = nlohmann::json::parse(answer, nullptr, false);
  expect(parsed.is_object(), "an answer is JSON: " + answer);
  if (parsed.contains("error")) {
    expect(parsed.at("line") == 7, "an error names its line: " + answer);
    return;
  }
  const bool robust = parsed.at("robust"), equilibrium = parsed.at("equilibrium");
  expect(!robust || equilibrium, "robust stability includes equilibrium: " + answer);
  expect(!robust || parsed.at("feasible_modes").empty(), "where it is robust no other mode is feasible: " + answer);
}

}  // namespace surefoot::fuzz
