// Plans written as JSON and YAML read back as they were, other parsers agree, and faults are named with their place.
#include <yaml-cpp/yaml.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "fixtures.hpp"
#include "gaits/plan_io.hpp"

namespace {

using namespace surefoot::gaits;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::scene_on;
using surefoot::terrain::Foothold;
using surefoot::terrain::InputError;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return same(a.x(), b.x()) && same(a.y(), b.y()); }

void require_same(const Foothold& a, const Foothold& b) {
  REQUIRE(a.chain == b.chain);
  REQUIRE(a.segment == b.segment);
  REQUIRE(same(a.s, b.s));
  REQUIRE(same(a.position, b.position));
  REQUIRE(same(a.normal, b.normal));
  REQUIRE(same(a.friction, b.friction));
}

void require_same(const Plan& a, const Plan& b) {
  REQUIRE(a.scene == b.scene);
  REQUIRE(a.status == b.status);
  REQUIRE(a.reason == b.reason);
  REQUIRE(a.planner == b.planner);
  REQUIRE(a.seed == b.seed);
  REQUIRE(same(a.safety_factor, b.safety_factor));
  REQUIRE(a.safety_factor_before_refinement.has_value() == b.safety_factor_before_refinement.has_value());
  if (a.safety_factor_before_refinement)
    REQUIRE(same(*a.safety_factor_before_refinement, *b.safety_factor_before_refinement));
  REQUIRE(same(a.time_s, b.time_s));
  REQUIRE(a.stances.size() == b.stances.size());
  for (std::size_t k = 0; k < a.stances.size(); ++k) {
    REQUIRE(same(a.stances[k].com, b.stances[k].com));
    REQUIRE(same(a.stances[k].safety_factor, b.stances[k].safety_factor));
    REQUIRE(a.stances[k].limit == b.stances[k].limit);
    for (int leg = 0; leg < leg_count; ++leg) {
      REQUIRE(a.stances[k].feet[leg].has_value() == b.stances[k].feet[leg].has_value());
      if (a.stances[k].feet[leg]) require_same(*a.stances[k].feet[leg], *b.stances[k].feet[leg]);
    }
  }
  REQUIRE(a.transfers.size() == b.transfers.size());
  for (std::size_t k = 0; k < a.transfers.size(); ++k) {
    REQUIRE(a.transfers[k].leg == b.transfers[k].leg);
    REQUIRE(a.transfers[k].lift == b.transfers[k].lift);
    REQUIRE(same(a.transfers[k].safety_factor, b.transfers[k].safety_factor));
    REQUIRE(a.transfers[k].limit == b.transfers[k].limit);
    require_same(a.transfers[k].foothold, b.transfers[k].foothold);
  }
  REQUIRE(a.left_out.size() == b.left_out.size());
  for (std::size_t k = 0; k < a.left_out.size(); ++k) {
    REQUIRE(a.left_out[k].what == b.left_out[k].what);
    REQUIRE(a.left_out[k].why == b.left_out[k].why);
  }
}

void require_reads_back(const Plan& plan) {
  const std::string json = to_json(plan), yaml = to_yaml(plan);
  INFO(json);
  INFO(yaml);
  require_same(plan, parse_plan(json, "plan.json"));
  require_same(plan, parse_plan(yaml, "plan.yaml"));
  REQUIRE(nlohmann::json::parse(json)["scene"].get<std::string>() == plan.scene);
  REQUIRE(YAML::Load(yaml)["scene"].as<std::string>() == plan.scene);
}

/// Any finite double with equal chance of every bit pattern, and the awkward ones.
class Doubles {
 public:
  double any() {
    static const std::vector<double> awkward{0.0,
                                             -0.0,
                                             1.0,
                                             -1.0,
                                             0.1,
                                             1e-7,
                                             1e22,
                                             1e23,
                                             123456789012.0,
                                             5e-324,
                                             -5e-324,
                                             std::numeric_limits<double>::max(),
                                             std::numeric_limits<double>::min()};
    if (bits_() % 4 == 0) return awkward[bits_() % awkward.size()];
    for (;;)
      if (const double value = std::bit_cast<double>(bits_()); std::isfinite(value)) return value;
  }
  double not_negative() { return std::abs(any()); }
  double factor() { return bits_() % 5 == 0 ? infinity : not_negative(); }
  int below(int n) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 bits_{20240607};
};

Plan random_plan(Doubles& random) {
  const auto foothold = [&] {
    return Foothold{random.below(1000),           random.below(1000000),        random.any(),
                    {random.any(), random.any()}, {random.any(), random.any()}, random.not_negative()};
  };
  const auto limit = [&] { return std::vector<std::string>{"", "equilibrium", "UF", "none", "FWR"}[random.below(5)]; };
  Plan plan;
  plan.scene = "random";
  plan.status = static_cast<Status>(random.below(3));
  plan.seed = static_cast<std::uint32_t>(random.below(1 << 30)) * 4 + 3;
  for (int k = random.below(4); k >= 0; --k) {
    Stance stance{{}, {random.any(), random.any()}, random.factor(), limit()};
    const int lifted = random.below(3);
    for (int leg = 0; leg < leg_count; ++leg)
      if (leg != lifted) stance.feet[leg] = foothold();
    plan.stances.push_back(stance);
    if (k > 0) plan.transfers.push_back({random.below(3), foothold(), random.below(3), random.factor(), limit()});
  }
  plan.safety_factor = random.factor();
  if (random.below(2) == 0) plan.safety_factor_before_refinement = random.factor();
  plan.time_s = random.not_negative();
  return plan;
}

const std::vector<std::string> nasty_strings{"",
                                             " ",
                                             "yes",
                                             "No",
                                             "null",
                                             "~",
                                             "true",
                                             "y",
                                             "n",
                                             "on",
                                             "1e3",
                                             "0x1f",
                                             "010",
                                             "1_000",
                                             ".inf",
                                             ".nan",
                                             "inf",
                                             "nan",
                                             "=",
                                             "<<",
                                             "2024-01-01",
                                             "12:30:45",
                                             "a: b",
                                             "a #b",
                                             "- a",
                                             "? a",
                                             "{a}",
                                             "[a",
                                             "*a",
                                             "&a",
                                             "!a",
                                             "%a",
                                             "@a",
                                             "`a",
                                             "|",
                                             ">",
                                             "'",
                                             "\"",
                                             "it's \"so\"",
                                             "back\\slash",
                                             "\\n",
                                             "line\nfeed",
                                             "\n",
                                             "tab\tcr\r\n",
                                             " lead",
                                             "trail ",
                                             "_",
                                             "stairs up (2)",
                                             "\xc3\xa9t\xc3\xa9 \xe2\x86\x92 \xf0\x9f\xa6\xbf",
                                             std::string("nul\0inside", 10),
                                             "\x01\x1b[31m\x7f",
                                             "\xc2\x85\xc2\x9f\xe2\x80\xa8\xe2\x80\xa9\xef\xbb\xbf\xef\xbf\xbe",
                                             "---",
                                             "...",
                                             "# no",
                                             "key",
                                             "stances"};

}  // namespace

TEST_CASE("a plan made by hand reads back from JSON and YAML", "[plan_io]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.planner = "RRT";
  plan.left_out = {{"frictional stability", "no restitution is given"}};
  require_reads_back(plan);
}

TEST_CASE("every finite double, and infinite safety factors, read back bit for bit", "[plan_io]") {
  Doubles random;
  for (int i = 0; i < 500; ++i) require_reads_back(random_plan(random));
}

TEST_CASE("strings that look like something else read back as they were", "[plan_io]") {
  for (const std::string& text : nasty_strings) {
    Plan plan;
    plan.scene = plan.planner = plan.reason = text;
    plan.left_out = {{text, text}};
    Stance stance;
    stance.limit = text;
    plan.stances = {stance};
    require_reads_back(plan);
    REQUIRE(YAML::Load(to_yaml(plan))["left_out"][0]["why"].as<std::string>() == text);
  }
}

TEST_CASE("bytes that are not UTF-8 become replacement characters", "[plan_io]") {
  Plan plan;
  plan.scene = "a\xff\xc3(b";
  REQUIRE(parse_plan(to_json(plan), "p").scene == "a\xef\xbf\xbd\xef\xbf\xbd(b");
  REQUIRE(parse_plan(to_yaml(plan), "p").scene == "a\xef\xbf\xbd\xef\xbf\xbd(b");
}

TEST_CASE("plans without a solution read back", "[plan_io]") {
  for (const Status status : {Status::no_plan_found, Status::infeasible}) {
    Plan plan;
    plan.scene = "gap";
    plan.status = status;
    plan.reason = "the gap is wider than two reaches";
    require_reads_back(plan);
  }
}

TEST_CASE("the JSON tree has the shape and the order of keys of the contract", "[plan_io]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.stances[1].safety_factor = infinity;
  const auto tree = nlohmann::ordered_json::parse(to_json(plan));
  std::vector<std::string> keys;
  for (const auto& entry : tree.items()) keys.push_back(entry.key());
  REQUIRE(keys == std::vector<std::string>{"surefoot", "scene", "status", "planner", "seed", "stances", "transfers",
                                           "safety_factor", "steps", "time_s", "left_out"});
  REQUIRE(tree["surefoot"] == 1);
  REQUIRE(tree["status"] == "solved");
  REQUIRE(tree["steps"] == 2);
  REQUIRE(tree["stances"].size() == 3);
  REQUIRE(tree["stances"][1]["safety_factor"] == "inf");
  REQUIRE(tree["stances"][0]["com"] == nlohmann::ordered_json::array({0.0, 0.5}));
  REQUIRE(tree["stances"][0]["feet"].size() == 2);
  REQUIRE(tree["stances"][0]["feet"]["1"]["x"].get<double>() == Approx(-0.2));
  REQUIRE(tree["stances"][0]["feet"]["2"]["s"].get<double>() == 5.2);
  REQUIRE(tree["transfers"][0]["place"]["leg"] == 3);
  REQUIRE(tree["transfers"][0]["place"]["foothold"]["s"].get<double>() == 5.6);
  REQUIRE(tree["transfers"][0]["lift"] == 1);
  const YAML::Node yaml = YAML::Load(to_yaml(plan));
  REQUIRE(yaml["transfers"][1]["place"]["foothold"]["s"].as<double>() == 6.0);
  REQUIRE(yaml["stances"][1]["safety_factor"].as<std::string>() == "inf");
}

TEST_CASE("numbers are written in their shortest form, always with a point", "[plan_io]") {
  Plan plan;
  Stance stance;
  const auto written = [&](double x) {
    stance.com = {x, 0};
    plan.stances = {stance};
    const std::string text = to_json(plan);
    const std::size_t at = text.find("\"com\": [") + 8;
    return text.substr(at, text.find(',', at) - at);
  };
  REQUIRE(written(0.1) == "0.1");
  REQUIRE(written(0) == "0.0");
  REQUIRE(written(-0.0) == "-0.0");
  REQUIRE(written(3) == "3.0");
  REQUIRE(written(1e-7) == "1.0e-07");  // YAML 1.1 takes 1e-07 for a string
  REQUIRE(written(1e23) == "1.0e+23");
  REQUIRE(written(0.1 + 0.2) == "0.30000000000000004");
}

TEST_CASE("numbers that are not finite are refused, not written", "[plan_io]") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    Plan plan;
    plan.stances.resize(1);
    plan.stances[0].com.x() = bad;
    REQUIRE_THROWS_AS(to_json(plan), std::invalid_argument);
    REQUIRE_THROWS_AS(to_yaml(plan), std::invalid_argument);
  }
  Plan plan;
  plan.safety_factor = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_THROWS_AS(to_json(plan), std::invalid_argument);
}

namespace {

const std::vector<std::string> good_lines{
    "surefoot: 1",
    "scene: s",
    "status: solved",
    "stances:",
    "  - {feet: {1: {chain: 0, segment: 0, s: 1, x: 0, y: 0}}, com: [0, 1], safety_factor: 2}",
    "transfers:",
    "  - {place: {leg: 3, foothold: {chain: 0, segment: 0, s: 2, x: 1, y: 0}}, lift: 1, safety_factor: inf}",
    "safety_factor: 2"};

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// One fault put into the good plan: `from` of line `line` (from 1) becomes `to`; the message must stand at `at` in
/// that line.
struct Slip {
  int line;
  std::string from, to;
  std::string at;  ///< text whose beginning is the place of the fault; empty: anywhere
  std::vector<std::string> said;
};

}  // namespace

TEST_CASE("a plan without its optional keys is read", "[plan_io]") {
  const Plan plan = parse_plan(join(good_lines), "plan.yaml");
  REQUIRE(plan.steps() == 1);
  REQUIRE(plan.transfers[0].leg == 2);
  REQUIRE(plan.transfers[0].lift == 0);
  REQUIRE(plan.transfers[0].safety_factor == infinity);
  REQUIRE(plan.planner.empty());
  REQUIRE_FALSE(plan.stances[0].feet[1]);
}

TEST_CASE("faults in a plan are named with their place", "[plan_io]") {
  const std::vector<Slip> slips{
      {1, "1", "2", "2", {"version", "2", "1"}},
      {1, "surefoot: 1", "planner: p", "", {"surefoot"}},
      {2, "scene", "sceen", "sceen", {"sceen", "scene"}},
      {3, "solved", "sloved", "sloved", {"sloved", "did you mean \"solved\""}},
      {3, "status: solved", "seed: 1", "", {"status"}},
      {3, "status: solved", "status: solved\nseed: -1", "", {"seed", "-1"}},
      {3, "status: solved", "status: solved\nseed: 4294967296", "", {"seed", "4294967296"}},
      {3, "status: solved", "status: solved\nsteps: 3", "", {"steps is 3", "1 transfer"}},
      {3, "status: solved", "status: solved\ntime_s: -1", "", {"time_s", "-1"}},
      {3, "status: solved", "status: solved\nleft_out: [{what: w}]", "", {"why"}},
      {5, "feet", "foot", "foot", {"foot", "feet"}},
      {5, "1: {", "4: {", "4: {", {"4"}},
      {5, "s: 1", "s: .nan", ".nan", {".nan"}},
      {5, "s: 1, ", "", "{chain", {"s"}},
      {5, "s: 1", "t: 1", "t: 1", {"t"}},
      {5, "chain: 0", "chain: -1", "-1", {"chain", "-1"}},
      {5, "chain: 0", "chain: 0.5", "0.5", {"chain", "0.5"}},
      {5, "[0, 1]", "[0, 1, 2]", "[0, 1, 2]", {"com", "2"}},
      {5, "[0, 1]", "[0, up]", "up", {"up"}},
      {5, "safety_factor: 2", "safety_factor: -2", "-2", {"safety factor", "-2"}},
      {5, "safety_factor: 2", "safety_factor: infinite", "infinite", {"safety factor", "infinite", "inf"}},
      {5, "safety_factor: 2", "safety_factor: 2, limits: UF", "limits", {"limits", "limit"}},
      {5, "  - {", "  - 7 #", "7", {"stance"}},
      {7, "leg: 3", "leg: 0", "0, f", {"leg", "0", "1", "3"}},
      {7, "lift: 1", "lift: 4", "4", {"leg", "4", "1", "3"}},
      {7, "lift: 1, ", "", "{place", {"lift"}},
      {7, "leg: 3, ", "", "{foothold", {"leg"}},
      {8, "safety_factor: 2", "", "", {"safety_factor"}}};
  for (const Slip& slip : slips) {
    std::vector<std::string> lines = good_lines;
    std::string& line = lines[slip.line - 1];
    REQUIRE(line.find(slip.from) != std::string::npos);
    line.replace(line.find(slip.from), slip.from.size(), slip.to);
    INFO(line);
    std::string message;
    try {
      parse_plan(join(lines), "plan.yaml");
    } catch (const InputError& error) {
      message = error.what();
    }
    INFO(message);
    REQUIRE(message.starts_with("plan.yaml:"));
    REQUIRE(message.find('\n') == std::string::npos);
    if (!slip.at.empty()) {
      const std::size_t column = line.find(slip.at) + 1;
      REQUIRE(message.starts_with("plan.yaml:" + std::to_string(slip.line) + ":" + std::to_string(column) + ":"));
    }
    for (const std::string& word : slip.said) REQUIRE(message.find(word) != std::string::npos);
  }
}

TEST_CASE("what is no plan file but could have been meant as one is called what it is", "[plan_io]") {
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      parse_plan(text, "p");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  const std::string printed = "p:1:1: plan: this is a plan printed as text; write it with -o plan.json";
  CHECK(error_of(to_text(scene, plan)) == printed);
  for (const Status status : {Status::no_plan_found, Status::infeasible}) {
    plan.status = status;
    plan.reason = "for a reason";
    CHECK(error_of(to_text(scene, plan)) == printed);
  }
  CHECK(error_of("surefoot: 1\nterrain: {}\nrobot: {}\n") ==
        "p:1:1: plan: this is a scene; expected a plan (surefoot check SCENE PLAN)");
  // The same words in a plan that only has another fault are none of that.
  CHECK_THAT(error_of("{\"scene\": \"a: solved in 3 steps\", \"x\": 1}"), Catch::Contains("unknown key \"x\""));
  CHECK_THAT(error_of("scene: 'a'\nx: 1\nreason: 'b: infeasible'\n"), Catch::Contains("unknown key \"x\""));
}

TEST_CASE("every truncation of a plan file is refused or read, never worse", "[plan_io]") {
  const Scene scene = scene_on(level_ground_and());
  const std::string json = to_json(plan_by_hand(scene));
  for (std::size_t length = 0; length + 2 < json.size(); ++length)
    REQUIRE_THROWS_AS(parse_plan(json.substr(0, length), "plan.json"), InputError);
}
