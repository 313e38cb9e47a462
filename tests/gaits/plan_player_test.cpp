// The page that plays a plan: what it is given to play, and that it needs nothing else. (Whether it plays is asked in a
// browser: tests/browser/.)
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "fixtures.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"

namespace {

using namespace surefoot::gaits;
using Eigen::Vector2d;
using nlohmann::json;
using surefoot::gaits::testing::chain;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::scene_on;

int count(const std::string& text, const std::string& piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

/// As a browser finds it: from the tag to the first end tag, whatever stands between.
std::string data_text(const std::string& page) {
  const std::string tag = "<script type=\"application/json\" id=\"data\">";
  REQUIRE(count(page, tag) == 1);
  const std::size_t begin = page.find(tag) + tag.size();
  return page.substr(begin, page.find("</script", begin) - begin);
}

bool inside(const json& rings, const Vector2d& p) {
  bool odd = false;
  for (const json& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double xi = ring[i][0], yi = ring[i][1], xj = ring[j][0], yj = ring[j][1];
      if ((yi > p.y()) != (yj > p.y()) && p.x() < xi + (xj - xi) * (p.y() - yi) / (yj - yi)) odd = !odd;
    }
  return odd;
}

}  // namespace

TEST_CASE("the page holds every number of the plan", "[plan_player]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.stances[0].limit = "equilibrium";
  plan.transfers[1].limit = "UFF";
  plan.transfers[1].safety_factor = 1.0 / 3;
  plan.stances[2].safety_factor = std::numeric_limits<double>::infinity();
  const json data = json::parse(data_text(to_html(scene, plan)));
  json expected = json::parse(to_json(plan));
  expected.erase("time_s");
  REQUIRE(data["plan"] == expected);
  REQUIRE(data["stances"].size() == 3);
  REQUIRE(data["transfers"].size() == 2);
  REQUIRE(data["stances"][0]["factor"] == "2.50");
  REQUIRE(data["stances"][0]["why"] == "the feet cannot balance a larger disturbance");
  REQUIRE(data["stances"][2]["factor"] == "inf");
  REQUIRE(data["transfers"][1]["factor"] == "0.333");
  REQUIRE(data["transfers"][1]["why"] == "foot 1 slides along +t while feet 2 and 3 break away");
  REQUIRE(data["weakest"]["index"] == 1);
  REQUIRE(data["weakest"]["in_transfer"] == true);
  // Leg 3 has never stood; leg 1 comes from x = -0.2, leg 2 from x = 0.2.
  REQUIRE(data["stances"][0]["free"]["leg"] == 3);
  REQUIRE(data["stances"][0]["free"]["from"].is_null());
  REQUIRE(data["stances"][1]["free"]["leg"] == 1);
  REQUIRE(data["stances"][1]["free"]["from"]["x"].get<double>() == Approx(-0.2));
  REQUIRE(data["stances"][2]["free"]["from"]["x"].get<double>() == Approx(0.2));
  // About the COM at (0.4, 0.5): from (-0.2, 0) to (1, 0) past straight down.
  REQUIRE_FALSE(data["transfers"][0].contains("turn"));
  REQUIRE(data["transfers"][1]["turn"].get<double>() == Approx(2 * std::atan(0.6 / 0.5)));
}

TEST_CASE("the same plan gives the same page, whatever time it took", "[plan_player]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  const std::string page = to_html(scene, plan);
  plan.time_s = 12.5;
  REQUIRE(to_html(scene, plan) == page);
}

TEST_CASE("the page refers to nothing outside itself", "[plan_player]") {
  const Scene scene = scene_on(level_ground_and());
  const std::string page = to_html(scene, plan_by_hand(scene));
  const auto refers = [](const std::string& text) {
    static const std::regex outside(R"(https?:|\bsrc\s*=|href\s*=|@import|url\s*\(|\bimport\b|)"
                                    R"(fetch\s*\(|XMLHttpRequest|<link|<iframe)",
                                    std::regex::icase);
    return std::regex_search(text, outside);
  };
  REQUIRE(refers("<img src='x'>"));
  REQUIRE(refers("@import 'x'"));
  REQUIRE_FALSE(refers(page));
  REQUIRE(page.find("default-src 'none'") != std::string::npos);  // the browser sees to it
}

TEST_CASE("no name, reason or fault can leave its place in the page", "[plan_player]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  const int scripts = count(to_html(scene, plan), "<script"), ends = count(to_html(scene, plan), "</script");
  for (const std::string name :
       {"</script><script>alert(1)</script>", "<!--<script>", "]]>-->", "@DATA@ @TITLE@", "\"';\\u003c\\", "&lt;b&gt;",
        "</title><b>", "a\nb\tc", "\u2028\u2029 \u00fc \U0001f9be"}) {
    INFO(name);
    plan.scene = plan.reason = plan.planner = plan.stances[0].limit = name;
    const std::string page = to_html(scene, plan, {name});
    REQUIRE(count(page, "<script") == scripts);
    REQUIRE(count(page, "</script") == ends);
    REQUIRE(count(page, "<!--") == 0);
    REQUIRE(count(page, "</title") == 1);
    const json data = json::parse(data_text(page));
    REQUIRE(data["plan"]["scene"] == name);
    REQUIRE(data["plan"]["reason"] == name);
    REQUIRE(data["plan"]["stances"][0]["limit"] == name);
    REQUIRE(data["faults"] == json::array({name}));
    REQUIRE(data["title"].get<std::string>().starts_with(name));
  }
  plan.scene = "\xff\xfe\x01";  // no UTF-8
  REQUIRE(json::parse(data_text(to_html(scene, plan)))["plan"]["scene"] == "\ufffd\ufffd\x01");
}

TEST_CASE("the region of a stance is where the oracle says so, by criterion", "[plan_player]") {
  // Feet on slopes that rise outwards at 45 degrees: much of what can be balanced is not robust.
  Scene scene = scene_on({chain({{-3, 3}, {0, 0}, {3, 3}}, 0.4)});
  scene.robot.radius_of_gyration = 0.05;
  Plan plan;
  plan.status = Status::solved;
  const auto foot = [&](double x) { return scene.terrain.footholds_at_x(x).at(0); };
  plan.stances = {Stance{Feet{foot(-0.3), foot(0.4), std::nullopt}, {0, 0.6}, 1, "equilibrium"}};
  for (const Criterion criterion : {Criterion::robust, Criterion::equilibrium, Criterion::both}) {
    scene.criterion = criterion;
    scene.restitution = 0.1;
    const json data = json::parse(data_text(to_html(scene, plan)));
    const bool robust = criterion == Criterion::robust;
    REQUIRE(data["scene"]["stance_region"] == (robust ? "R(W)" : "R_SS(W)"));
    REQUIRE(data["scene"]["region"] == (criterion == Criterion::equilibrium ? "R_SS(W)" : "R(W)"));
    const json& rings = data["stances"][0]["region"];
    const auto oracle = oracle_of(scene, plan.stances[0].feet);
    int in = 0, balanced = 0, wrong = 0, points = 0;
    for (double x = -0.5; x < 0.6; x += 0.0173)
      for (double y = -0.4; y < 1.2; y += 0.0211, ++points) {
        const bool stable = robust ? oracle.robust({x, y}) : oracle.equilibrium({x, y});
        in += stable;
        balanced += oracle.equilibrium({x, y});
        wrong += stable != inside(rings, {x, y});
      }
    CAPTURE(in, balanced, points);
    CHECK(in > 50);
    CHECK(in < points);
    if (robust) CHECK(balanced > in);
    CHECK(wrong <= 0.01 * points);  // on the edges, which are drawn to region_detail
  }
}

TEST_CASE("the free leg turns the way that holds no terrain, the shorter of two", "[plan_player][rules]") {
  // A post from the ground up to y = 0.42 at x = 0.4, beneath the COM (0.4, 0.5): it stands in the leg's way from the
  // left foot to the right one, but for radii below 0.08.
  const Vector2d com(0.4, 0.5), left(-0.2, 0), right(1, 0);
  const double past_below = 2 * std::atan(0.6 / 0.5);
  Scene scene = scene_on(level_ground_and());
  REQUIRE(swing_turn(scene, com, left, right).value() == Approx(past_below));
  REQUIRE(swing_turn(scene, com, right, left).value() == Approx(-past_below));
  REQUIRE(swing_turn(scene, com, left, left).value() == 0);
  const auto post = chain({{-5, 0}, {0.399, 0}, {0.399, 0.42}, {0.401, 0.42}, {0.401, 0}, {5, 0}});
  scene = scene_on({post});
  REQUIRE(swing_turn(scene, com, left, right).value() == Approx(past_below - 2 * std::numbers::pi));
  REQUIRE(swing_turn(scene, com, right, left).value() == Approx(2 * std::numbers::pi - past_below));
  scene.robot.reach_min = 0.07;
  REQUIRE(swing_turn(scene, com, left, right).value() == Approx(past_below));
  scene = scene_on({post, chain({{5, 0.6}, {-5, 0.6}})});  // and a ceiling above
  REQUIRE_FALSE(swing_turn(scene, com, left, right).has_value());
  Plan plan = plan_by_hand(scene_on(level_ground_and()));
  REQUIRE(json::parse(data_text(to_html(scene, plan)))["transfers"][1]["turn"].is_null());
}

TEST_CASE("odd plans make a page too", "[plan_player]") {
  const Scene scene = scene_on({chain({{-5, 0}, {5, 0}}), chain({{5, 3}, {-5, 3}}), chain({{7, -1}, {7, 4}}),
                                chain({{1, 1}, {1, 1.2}, {1.5, 1.2}, {1.5, 1}, {1.01, 0.99}})});
  Plan plan;
  plan.reason = "no way";
  REQUIRE(json::parse(data_text(to_html(scene, plan)))["stances"].empty());
  plan = plan_by_hand(scene);
  plan.stances[1].feet = {};
  plan.stances[2].feet[0]->chain = 7;
  plan.stances[2].feet[2]->segment = 100000;
  const json data = json::parse(data_text(to_html(scene, plan)));
  REQUIRE(data["stances"].size() == 3);
  REQUIRE(data["stances"][2]["region"].empty());
  plan.transfers.push_back(plan.transfers[0]);  // one too many
  REQUIRE(json::parse(data_text(to_html(scene, plan)))["transfers"].size() == 3);
  plan.stances[0].com.x() = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_THROWS_AS(to_html(scene, plan), std::invalid_argument);
}

TEST_CASE("feet exactly two reaches apart leave a point for the COM, and no region", "[plan_player]") {
  const Scene scene = scene_on(level_ground_and());  // criterion robust
  Plan plan = plan_by_hand(scene);
  plan.stances[0].feet[0]->position = {0, 0};
  plan.stances[0].feet[1]->position = {2 * scene.robot.reach_max, 0};
  const json data = json::parse(data_text(to_html(scene, plan)));
  CHECK(data["stances"][0]["region"].empty());
  CHECK_FALSE(data["stances"][1]["region"].empty());
}

TEST_CASE("of long terrain the page holds what may be seen", "[plan_player]") {
  std::vector<surefoot::terrain::Point> vertices;
  for (int k = -20000; k <= 20000; ++k) vertices.emplace_back(k, 0);
  Scene scene = scene_on({chain(vertices)});
  scene.start.feet = {};
  Plan plan;
  plan.status = Status::solved;
  const auto foot = [&](double x) { return scene.terrain.footholds_at_x(x).at(0); };
  plan.stances = {Stance{Feet{foot(-0.2), foot(0.2), std::nullopt}, {0, 0.5}, 2.5, "equilibrium"}};
  const std::string page = to_html(scene, plan);
  const json surface = json::parse(data_text(page))["terrain"]["surface"];
  REQUIRE(surface.size() == 1);
  REQUIRE(surface[0]["points"].size() > 10);
  REQUIRE(surface[0]["points"].size() < 60);
}
