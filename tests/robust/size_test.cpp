// Large input costs no more than its size.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "tests/planner/program.hpp"
#include "tests/robust/spoilt.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::tests;

namespace {

/// Flat ground of many vertices, ten to the metre, that spreads to the left of where flat_scene walks.
std::string long_scene(int vertices) {
  std::string list = "[";
  for (int i = vertices + 10; i > 10; --i) {
    list += fmt::format("[-{}.{}, 0], ", i / 10, i % 10);
  }
  return with("[[-1, 0]", list + "[-1, 0]");
}

}  // namespace

TEST_CASE("A terrain of very many vertices is read, and its faults are found", "[robust]") {
  const Workplace place;
  const int many = surefoot::test::rounds(50'000);
  place.write("scene.yaml", long_scene(many));
  const auto good = place.run("validate scene.yaml");
  CHECK(good.status == 0);
  CHECK_THAT(good.out, Catch::Contains(std::to_string(many + 1) + " segments"));
  place.write("scene.yaml", with("[4, 0]]", "[4, 0], [2, 0]]", long_scene(many)));
  const auto bad = place.run("plan scene.yaml");
  CHECK(bad.status == 2);
  CHECK(bad.one_error());
  CHECK_THAT(bad.err, Catch::Contains("crosses or touches"));
}

TEST_CASE("A plan of very many stances is judged", "[robust]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  const int many = surefoot::test::rounds(20'000);
  const std::string foot = R"({"chain": 0, "segment": 0, "s": 0.7, "x": -0.3, "y": 0})";
  const std::string stance = R"({"feet": {"1": )" + foot + R"(}, "com": [0, 0.4], "safety_factor": 1}, )";
  const std::string transfer = R"({"place": {"leg": 1, "foothold": )" + foot + R"(}, "lift": 2, "safety_factor": 1}, )";
  std::string stances = repeated(stance, static_cast<std::size_t>(many) + 1);
  std::string transfers = repeated(transfer, static_cast<std::size_t>(many));
  stances.resize(stances.size() - 2);
  transfers.resize(transfers.size() - 2);
  place.write("plan.json", R"({"surefoot": 1, "scene": "scene", "status": "solved", "stances": [)" + stances +
                               R"(], "transfers": [)" + transfers + R"(], "safety_factor": 1})");
  const auto run = place.run("check scene.yaml plan.json");
  CHECK(run.status == 1);
  CHECK(run.err.empty());
}
