#include "tests/fuzz/targets.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"scene", scene},     {"plan", plan},         {"query", query},
                                       {"posture", posture}, {"simulate", simulate}, {"region", region}};
  return all;
}

void expect(bool holds, const std::string& promise) {
  if (!holds) throw Broken(promise);
}

void expect_located(std::string_view what) {
  expect(what.starts_with("input:"), "an error names its place: " + std::string(what));
  constexpr std::size_t longest = 1000;  // bytes: values are shown in part
  expect(what.size() < longest, "an error is short");
  for (const char c : what) expect(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "an error is one line of text");
  nlohmann::json(std::string(what)).dump();  // throws where it is not UTF-8
}

}  // namespace surefoot::fuzz
