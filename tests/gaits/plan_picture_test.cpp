// What people see of a plan: the table of steps and the picture.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <clocale>
#include <limits>
#include <locale>
#include <regex>
#include <set>
#include <sstream>

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

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A walk along level ground, one foot every 0.4 m: feet 1 2 3 1 2 3 ... (a picture needs no verified plan).
Plan long_walk(const Scene& scene, int steps, double from) {
  Plan plan;
  plan.scene = scene.name;
  plan.status = Status::solved;
  plan.safety_factor = 2.5;
  const double begin = scene.terrain.segments().front().a.x();
  const auto foot = [&](int k) { return scene.terrain.foothold_at(0, from + 0.4 * k - begin).value(); };
  for (int k = 0; k <= steps; ++k) {
    Stance stance{{}, {from + 0.4 * k + 0.2, 0.5}, 2.5 + 0.01 * k, "equilibrium"};
    stance.feet[k % 3] = foot(k);
    stance.feet[(k + 1) % 3] = foot(k + 1);
    plan.stances.push_back(stance);
    if (k < steps) plan.transfers.push_back({(k + 2) % 3, foot(k + 2), k % 3, 2.5, "UFF"});
  }
  return plan;
}

Scene long_ground() {
  Scene scene = scene_on({chain({{-120, 0}, {120, 0}})});
  scene.start.feet = {};
  return scene;
}

}  // namespace

TEST_CASE("the table has one row per step and its columns line up", "[plan_text]") {
  const Scene scene = long_ground();
  const int steps = 300;
  const std::vector<std::string> lines = lines_of(to_text(scene, long_walk(scene, steps, -20)));
  const std::regex row(R"(^ *(\d+) +([1-3]) .*)");
  std::string header;
  std::size_t rows = 0;
  std::vector<std::size_t> points;  // of the decimal points, left of the column `lifted`
  for (const std::string& line : lines) {
    REQUIRE((line.empty() || line.back() != ' '));
    if (line.starts_with("step")) header = line;
    if (header.empty() || !std::regex_match(line, row)) continue;
    ++rows;
    REQUIRE(std::stoul(line) == rows);
    const std::size_t lifted = header.find("lifted");
    REQUIRE(line[lifted] == static_cast<char>('1' + (rows - 1) % 3));
    std::vector<std::size_t> here;
    for (std::size_t i = 0; i < lifted; ++i)
      if (line[i] == '.') here.push_back(i);
    if (rows == 3) points = here;  // legs 1 and 2 have stood before, leg 3 only since the first step
    if (rows >= 3) REQUIRE(here == points);
    REQUIRE(line.substr(header.find("limit"), 11) == "equilibrium");
    REQUIRE(line.substr(header.rfind("limit")) == "UFF");
  }
  REQUIRE(rows == steps);
  REQUIRE(points.size() == 8);
}

TEST_CASE("the table says where each leg comes from and goes to", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.planner = "RRT";
  plan.seed = 7;
  plan.time_s = 0.0124;
  plan.transfers[1].safety_factor = plan.safety_factor = 1.4;
  plan.transfers[1].limit = "UFF";
  plan.safety_factor_before_refinement = 1.25;
  plan.left_out = {{"frictional stability", "no restitution is given"}};
  const std::string text = to_text(scene, plan);
  INFO(text);
  const auto says = [&](const std::string& words) { return text.find(words) != std::string::npos; };
  REQUIRE(text.starts_with("hand: solved in 2 steps\n"));
  REQUIRE(std::regex_search(
      text, std::regex(R"(\n +1 +3 +in the air +0\.600 +0\.000 +1 2 +0\.000 +0\.500 +0\.400 +0\.500 +1 +2\.50 )")));
  REQUIRE(std::regex_search(
      text,
      std::regex(
          R"(\n +2 +1 +-0\.200 +0\.000 +1\.000 +0\.000 +2 3 +0\.400 +0\.500 +0\.800 +0\.500 +2 .* 1\.40 +UFF\n)")));
  REQUIRE(std::regex_search(text, std::regex(R"(\n +end +1 3 +0\.800 +0\.500 +2\.50)")));
  REQUIRE(
      says("2 steps, COM travels 0.800 m, least safety factor 1.40 in the transfer of step 2 (UFF), 1.25 before "
           "refinement"));
  REQUIRE(says("planner RRT, seed 7, 0.012 s"));
  REQUIRE(says("frictional stability: no restitution is given"));
}

TEST_CASE("colours change nothing but colours", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);
  const std::string plain = to_text(scene, plan, {.colour = false, .explain = true});
  const std::string coloured = to_text(scene, plan, {.colour = true, .explain = true});
  REQUIRE(plain.find('\x1b') == std::string::npos);
  REQUIRE(coloured.find('\x1b') != std::string::npos);
  REQUIRE(std::regex_replace(coloured, std::regex("\x1b\\[[0-9;]*m"), "") == plain);
}

TEST_CASE("a name cannot talk to the terminal or break a line", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.scene = "a\x1b[31m\nb";
  const std::string text = to_text(scene, plan);
  REQUIRE(text.find('\x1b') == std::string::npos);
  REQUIRE(text.starts_with("a [31m b: solved"));
}

TEST_CASE("an unstable safety factor is never rounded up to 1", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  plan.safety_factor = std::nextafter(1.0, 0.0);
  REQUIRE(to_text(scene, plan).find("least safety factor <1.00") != std::string::npos);
  plan.safety_factor = 0.9994;
  REQUIRE(to_text(scene, plan).find("least safety factor 0.999") != std::string::npos);
  REQUIRE(factor_in_words(0.0123456) == "0.0123");
  REQUIRE(factor_in_words(12.345) == "12.3");
  REQUIRE(factor_in_words(1 + 1e-9) == ">1.00");
  REQUIRE(factor_in_words(1.0049) == ">1.00");
  REQUIRE(factor_in_words(1.006) == "1.01");
  REQUIRE(factor_in_words(1) == "1.00");
  REQUIRE(factor_in_words(1234.5) == "1234");
  plan.safety_factor = 1;
  REQUIRE(to_text(scene, plan).find("least safety factor 1.00") != std::string::npos);
}

TEST_CASE("no plan: the status and the reason are said", "[plan_text]") {
  const Scene scene = scene_on(level_ground_and());
  Plan plan;
  plan.scene = "gap";
  plan.status = Status::infeasible;
  plan.reason = "the gap is wider than two reaches";
  REQUIRE(to_text(scene, plan).starts_with("gap: infeasible - the gap is wider than two reaches\n"));
  plan.status = Status::no_plan_found;
  REQUIRE(to_text(scene, plan).starts_with("gap: no plan found - "));
  plan.reason = "no plan found within the time limit (auto); Layers came to COM (1, 2); 3 steps refused";
  REQUIRE(to_text(scene, plan)
              .starts_with(
                  "gap: no plan found within the time limit (auto)\n  Layers came to COM (1, 2)\n  3 steps refused\n"));
}

TEST_CASE("lengths are told in decimals, of tiny and giant robots in digits, and zero has no sign", "[plan_text]") {
  CHECK(length_in_words(-0.0004, 0.9) == "0.000");
  CHECK(length_in_words(-0.0006, 0.9) == "-0.001");
  CHECK(length_in_words(12.3456, 0.9) == "12.346");
  CHECK(length_in_words(0.0123456789, 0.05) == "0.0123");
  CHECK(length_in_words(-2.5e-7, 9e-7) == "-0.000000250");
  CHECK(length_in_words(-2.5e-10, 9e-10) == "-2.5e-10");
  CHECK(length_in_words(1.23456789e30, 9e29) == "1.23457e+30");
}

TEST_CASE("limits are spelled out with the legs they mean", "[plan_text]") {
  REQUIRE(limit_in_words("FF", {0, 2}) == "both feet break away");
  REQUIRE(limit_in_words("UF", {0, 2}) == "foot 1 slides along +t while foot 3 breaks away");
  REQUIRE(limit_in_words("RFF", {0, 1, 2}) == "foot 1 rolls or sticks while feet 2 and 3 break away");
  REQUIRE(limit_in_words("FWF", {0, 1, 2}) == "feet 1 and 3 break away while foot 2 slides along -t");
  REQUIRE(limit_in_words("UWF", {0, 1, 2}) ==
          "foot 1 slides along +t while foot 2 slides along -t while foot 3 breaks away");
  REQUIRE(limit_in_words("FFF", {0, 1, 2}) == "all feet break away");
  REQUIRE(limit_in_words("F", {1}) == "foot 2 breaks away");
  REQUIRE(limit_in_words("UF", {0}) == "UF");  // letters and legs do not match: as it is
  REQUIRE(limit_in_words("odd", {0, 1, 2}) == "odd");
  const Scene scene = long_ground();
  const std::string text = to_text(scene, long_walk(scene, 6, 0), {.colour = false, .explain = true});
  REQUIRE(text.find("UFF on legs 1 2 3: foot 1 slides along +t while feet 2 and 3 break away\n"
                    "      transfer of step 1-6\n") != std::string::npos);
  REQUIRE(text.find("equilibrium on legs 1 2: the feet cannot balance a larger disturbance\n"
                    "      stance of step 1, 4, end\n") != std::string::npos);
  Plan last = long_walk(scene, 1, 0);
  last.stances.back().limit = "FF";
  REQUIRE(to_text(scene, last, {.colour = false, .explain = true})
              .find(": both feet break away\n      the last stance\n") != std::string::npos);
}

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
