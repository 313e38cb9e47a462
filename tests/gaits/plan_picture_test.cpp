// The picture of a plan.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <clocale>
#include <limits>
#include <locale>
#include <map>
#include <set>

#include "fixtures.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/svg_canvas.hpp"
#include "svg_tree.hpp"

namespace {

using namespace surefoot::gaits;
using boost::property_tree::ptree;
using surefoot::gaits::testing::chain;
using surefoot::gaits::testing::each_element;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::lines_of;
using surefoot::gaits::testing::long_ground;
using surefoot::gaits::testing::long_walk;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::read_xml_text;
using surefoot::gaits::testing::scene_on;

int count_class(const ptree& tree, const std::string& css_class) {
  int count = 0;
  each_element(tree, [&](const std::string&, const ptree& element) {
    count += element.get("<xmlattr>.class", "") == css_class;
  });
  return count;
}

}  // namespace

TEST_CASE("the picture is well-formed, without scripts, and shows every stance once", "[plan_svg]") {
  const Scene scene = long_ground();
  for (const int steps : {0, 1, 8, 300, 560}) {
    const Plan plan = long_walk(scene, steps, -115);
    const std::string svg = to_svg(scene, plan);
    const ptree tree = read_xml_text(svg);
    REQUIRE(count_class(tree, "stance") == steps + 1);
    REQUIRE(count_class(tree, "support") == steps + 1);
    REQUIRE(svg.find("<script") == std::string::npos);
    REQUIRE(svg.find("href") == std::string::npos);
    REQUIRE(svg.find("nan") == std::string::npos);
    REQUIRE(svg == to_svg(scene, plan));
  }
}

TEST_CASE("a short journey fits one row, a long one is broken into rows", "[plan_svg]") {
  const Scene scene = long_ground();
  // The goal of the hand-made scene lies at x = 0.7: begin there.
  REQUIRE(count_class(read_xml_text(to_svg(scene, long_walk(scene, 8, 0))), "row") == 1);
  const ptree tree = read_xml_text(to_svg(scene, long_walk(scene, 280, 0)));
  REQUIRE(count_class(tree, "row") > 3);
  REQUIRE(tree.get<double>("svg.<xmlattr>.width") <= 1200);
}

TEST_CASE("numbers of legs that stand in a pile are inside their row", "[plan_svg]") {
  const Scene scene = long_ground();
  Plan plan = long_walk(scene, 280, -115);
  for (Stance& stance : plan.stances)  // all feet of three steps at one place
    for (auto& foot : stance.feet)
      if (foot) foot = scene.terrain.foothold_at(0, 1.2 * std::floor(foot->s / 1.2));
  const ptree tree = read_xml_text(to_svg(scene, plan));
  std::map<std::string, std::pair<double, double>> clips;  // top and bottom [px], by reference
  int numbers = 0;
  each_element(tree, [&](const std::string& name, const ptree& element) {
    if (name == "clipPath") {
      const double top = element.get<double>("rect.<xmlattr>.y");
      clips["url(#" + element.get<std::string>("<xmlattr>.id") + ")"] = {top, top + element.get<double>(
                                                                                        "rect.<xmlattr>.height")};
    }
    if (name != "g" || element.get("<xmlattr>.class", "") != "row") return;
    const auto [top, bottom] = clips.at(element.get<std::string>("<xmlattr>.clip-path"));
    each_element(element, [&, top = top, bottom = bottom](const std::string& shape, const ptree& circle) {
      const double radius = shape == "circle" ? circle.get<double>("<xmlattr>.r") : 0,
                   y = circle.get("<xmlattr>.cy", 0.0);
      if (radius < 6) return;  // not the number of a leg
      ++numbers;
      CHECK(y - radius >= top);
      CHECK(y + radius <= bottom);
    });
  });
  CHECK(numbers > 250);
}

TEST_CASE("the least factor of a plan that is refused is called stated", "[plan_svg]") {
  const Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  CHECK(to_svg(scene, plan).find(">least safety factor<") != std::string::npos);
  const std::string refused = to_svg(scene, plan, {"stance 1: not stable"});
  CHECK(refused.find(">least safety factor<") == std::string::npos);
  CHECK(refused.find(">least safety factor stated<") != std::string::npos);
}

TEST_CASE("a name with reserved characters is escaped", "[plan_svg]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.scene = "<b>&\"x\" \x01\xff</b>";
  const ptree tree = read_xml_text(to_svg(scene, plan));
  REQUIRE(tree.get<std::string>("svg.title").starts_with("<b>&\"x\"  \xef\xbf\xbd</b>: 2 steps"));
}

TEST_CASE("positions in the picture agree with the scale bar, and R_SS(W) with the closed form", "[plan_svg]") {
  const Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  const ptree tree = read_xml_text(to_svg(scene, plan));
  std::vector<Eigen::Vector2d> coms;
  std::vector<std::string> supports;
  double bar = 0, bar_metres = 0;
  each_element(tree, [&](const std::string& name, const ptree& element) {
    const auto at = [&](const char* key) { return element.get<double>(std::string("<xmlattr>.") + key); };
    if (name == "circle" && element.count("title")) coms.emplace_back(at("cx"), at("cy"));
    if (element.get("<xmlattr>.class", "") == "support")
      supports.push_back(element.get<std::string>("<xmlattr>.points"));
    if (name == "line" && bar == 0) bar = at("x2") - at("x1");  // the first line drawn
    if (name == "text" && bar_metres == 0 && element.data().ends_with(" m")) bar_metres = std::stod(element.data());
  });
  REQUIRE(coms.size() == 3);
  REQUIRE(supports.size() == 3);
  const double scale = bar / bar_metres;  // [px/m], to a hundredth of a pixel
  REQUIRE(coms[1].x() - coms[0].x() == Approx(0.4 * scale).margin(0.02));
  REQUIRE(coms[2].x() - coms[0].x() == Approx(0.8 * scale).margin(0.02));
  REQUIRE(coms[2].y() == coms[0].y());
  // Feet at -0.2 and 0.2 on level ground, COM (0, 0.5): R_SS(W) is |x| <= 0.2 - kappa h - nu at height h.
  std::istringstream points(supports[0]);
  double widest_error = 0;
  int on_edge = 0;
  for (std::string pair; points >> pair;) {
    const std::size_t comma = pair.find(',');
    const double x = (std::stod(pair.substr(0, comma)) - coms[0].x()) / scale;
    const double h = 0.5 - (std::stod(pair.substr(comma + 1)) - coms[0].y()) / scale;
    const double beyond = std::abs(x) - (0.2 - scene.disturbance.kappa * std::abs(h) - scene.disturbance.nu);
    widest_error = std::max(widest_error, beyond);
    on_edge += std::abs(beyond) < 2e-4;
  }
  REQUIRE(widest_error < 2e-4);
  REQUIRE(on_edge >= 4);
}

TEST_CASE("scenes of any size and place are drawn, and their lengths read well", "[plan_svg]") {
  for (const double factor : {1e-6, 1e6, 1e-90, 1e30})
    for (const double shift : {0.0, 1e6 * std::max(factor, 1e-6)}) {
      if (factor < 1e-6 && shift > 0) continue;  // lost in it
      Scene scene = scene_on({chain({{-5 * factor + shift, 0}, {5 * factor + shift, 0}})});
      scene.robot = {0.12 * factor, 0.2 * factor, 0.9 * factor, 0.05 * factor, {}};
      scene.disturbance.nu *= factor;
      scene.goal.com_x = {{0.7 * factor + shift, 0.9 * factor + shift}};
      Plan plan;
      plan.status = Status::solved;
      const auto foot = [&](double x) { return scene.terrain.footholds_at_x(x * factor + shift).at(0); };
      plan.stances = {Stance{Feet{foot(-0.2), foot(0.2), std::nullopt}, {shift, 0.5 * factor}, 2, "equilibrium"}};
      const ptree tree = read_xml_text(to_svg(scene, plan));
      REQUIRE(count_class(tree, "stance") == 1);
      REQUIRE(tree.get<double>("svg.<xmlattr>.height") < 2000);
      const std::string text = to_text(scene, plan);
      REQUIRE(text.find("end") != std::string::npos);
      CAPTURE(factor, shift, text);
      for (const std::string& line : lines_of(text)) CHECK(line.size() < 160);
      if (factor < 1e-6 || factor > 1e6) CHECK(text.find(fmt::format("{:.3g}", 0.5 * factor)) != std::string::npos);
      std::set<std::string> ticks;
      each_element(tree, [&](const std::string& name, const ptree& element) {
        const std::string label = element.data();
        if (name != "text" || element.get("<xmlattr>.fill", "") == "none" || !label.ends_with(" m")) return;
        CHECK(label.size() <= 24);  // ticks are 80 pixels apart at least
        ticks.insert(label);
      });
      CHECK(ticks.size() > 3);
    }
}

TEST_CASE("odd plans are drawn as far as they go", "[plan_svg]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan;  // no stance at all
  plan.reason = "start & goal";
  REQUIRE(count_class(read_xml_text(to_svg(scene, plan)), "stance") == 0);
  plan = plan_by_hand(scene);
  plan.stances[1].feet = {};           // no foot
  plan.stances[2].feet[0]->chain = 7;  // a foothold of another scene
  plan.stances[2].feet[2]->segment = 100000;
  plan.transfers.clear();
  REQUIRE(count_class(read_xml_text(to_svg(scene, plan)), "stance") == 3);
  REQUIRE_FALSE(to_text(scene, plan).empty());
}

TEST_CASE("ceilings, walls, islands and nested chains are drawn", "[plan_svg]") {
  const Scene scene =
      scene_on({chain({{-5, 0}, {5, 0}}), chain({{5, 3}, {-5, 3}}), chain({{7, -1}, {7, 4}}),
                chain({{1, 1}, {1, 1.2}, {1.5, 1.2}, {1.5, 1}, {1.01, 0.99}}), chain({{-3, 1}, {-2, 1}})});
  REQUIRE(count_class(read_xml_text(to_svg(scene, plan_by_hand(scene))), "stance") == 3);
}

TEST_CASE("a ceiling within reach of the plan is in the picture, a higher one is not", "[plan_svg]") {
  const auto page_height = [](std::vector<surefoot::terrain::Chain> more) {
    const Scene scene = scene_on(level_ground_and(std::move(more)));
    return read_xml_text(to_svg(scene, plan_by_hand(scene))).get<double>("svg.<xmlattr>.height");
  };
  const double without = page_height({});
  CHECK(page_height({chain({{5, 1.2}, {-5, 1.2}})}) > without + 50);   // [px]: 0.7 m above the COM
  CHECK(page_height({chain({{405, 42}, {-5, 0.9}})}) > without + 50);  // rises slowly
  CHECK(page_height({chain({{-5, 1.2}, {5, 1.2}})}) > without + 50);   // the wrong way round
  CHECK(page_height({chain({{5, 1.5}, {-5, 1.5}})}) == without);       // beyond reach 0.9
  CHECK(page_height({chain({{0.5, 1.2}, {0.45, 0.1}})}) == without);   // a wall that leans
  const auto rows_height = [](std::vector<surefoot::terrain::Chain> more) {
    const Scene ground = long_ground();
    more.insert(more.begin(), chain({{-120, 0}, {120, 0}}));
    return read_xml_text(to_svg(scene_on(std::move(more)), long_walk(ground, 280, 0)))
        .get<double>("svg.<xmlattr>.height");
  };
  CHECK(rows_height({chain({{120, 1.2}, {-120, 1.2}})}) > rows_height({}) + 50);
}

TEST_CASE("no locale changes what is written", "[plan_text][plan_svg][plan_io]") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
  };
  const Scene scene = long_ground();
  const Plan plan = long_walk(scene, 30, 0);
  const auto all = [&] {
    return to_text(scene, plan) + to_json(plan) + to_yaml(plan) + to_svg(scene, plan) + to_html(scene, plan);
  };
  const std::string before = all();
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new Comma));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // does nothing where it is not installed
  const std::string after = all();
  const Plan read = parse_plan(to_json(plan), "plan.json");
  std::setlocale(LC_ALL, "C");
  std::locale::global(old);
  REQUIRE(before == after);
  REQUIRE(read.stances[3].com == plan.stances[3].com);
}

TEST_CASE("clipping keeps the side asked for", "[svg_canvas]") {
  const Polyline square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  REQUIRE(clip(square, {1, 0}, -1) == Polyline{{1, 0}, {2, 0}, {2, 2}, {1, 2}});
  REQUIRE(clip(square, {1, 0}, -3).empty());
  REQUIRE(clip(square, {1, 0}, 1) == square);
  REQUIRE(clip({}, {1, 0}, 0).empty());
}

TEST_CASE("round lengths are 1, 2 or 5 times a power of ten", "[svg_canvas]") {
  REQUIRE(round_length(1) == 1);
  REQUIRE(round_length(1.99) == 1);
  REQUIRE(round_length(2) == 2);
  REQUIRE(round_length(4.99) == 2);
  REQUIRE(round_length(99) == 50);
  REQUIRE(round_length(0.03) == Approx(0.02));
}
