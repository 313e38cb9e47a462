// Names and numbers in the picture of a plan keep off each other and off waypoints.
#include <boost/property_tree/ptree.hpp>
#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "fixtures.hpp"
#include "gaits/plan_io.hpp"
#include "svg_tree.hpp"

namespace {

using namespace surefoot::gaits;
using boost::property_tree::ptree;
using surefoot::gaits::testing::each_element;
using surefoot::gaits::testing::level_ground_and;
using surefoot::gaits::testing::plan_by_hand;
using surefoot::gaits::testing::read_xml_text;
using surefoot::gaits::testing::scene_on;

struct Box {
  double left, right, above, below;  // [px]
};

Box box_of_letters(double x, double y, double width) { return {x - width / 2, x + width / 2, y - 8, y}; }

}  // namespace

TEST_CASE("the name of the goal covers neither a waypoint nor its labels", "[plan_svg]") {
  Scene scene = scene_on(level_ground_and());
  const Plan plan = plan_by_hand(scene);  // from (0, 0.5) to (0.8, 0.5)
  const auto [x, low, high] = GENERATE(table<double, double, double>({{0.8, 0.05, 0.48},
                                                                      {0.8, 0.05, 0.5},
                                                                      {0.8, 0.05, 0.52},
                                                                      {0.8, 0.05, 0.55},
                                                                      {0.8, 0.05, 0.6},
                                                                      {0.8, 0.05, 0.7},
                                                                      {0.8, 0.05, 0.8},
                                                                      {0.8, 0.48, 0.52},
                                                                      {0.8, 0.45, 0.55},
                                                                      {0.8, 0.49, 0.62},
                                                                      {0.8, 0.5, 0.5},
                                                                      {0.0, 0.05, 0.6},
                                                                      {0.0, 0.05, 0.65},
                                                                      {0.0, 0.05, 0.7},
                                                                      {0.0, 0.4, 0.66},
                                                                      {0.4, 0.48, 0.6}}));
  CAPTURE(x, low, high);
  scene.goal.com_x = {x - 0.05, x + 0.05};
  scene.goal.com_y = {low, high};
  std::vector<Box> goals, others;
  each_element(read_xml_text(to_svg(scene, plan)), [&](const std::string& name, const ptree& element) {
    const auto at = [&](const char* key) { return element.get<double>(std::string("<xmlattr>.") + key); };
    const double radius = name == "circle" ? at("r") : 0;
    if (name == "circle" && element.count("title"))
      others.push_back({at("cx") - radius, at("cx") + radius, at("cy") - radius, at("cy") + radius});
    if (name != "text" || element.get("<xmlattr>.text-anchor", "") != "middle") return;
    const std::string words = element.data();
    if (words == "goal") goals.push_back(box_of_letters(at("x"), at("y"), 26));
    if (words == "start") others.push_back(box_of_letters(at("x"), at("y"), 26));
    if (words == "1" || words == "2" || words == "end") others.push_back(box_of_letters(at("x"), at("y"), 16));
  });
  REQUIRE(goals.size() == 1);
  REQUIRE(others.size() >= 7);  // three dots, their numbers, the start (and badges of legs)
  const Box& goal = goals.front();
  for (const Box& other : others)
    CHECK((other.right < goal.left || goal.right < other.left || other.below < goal.above || goal.below < other.above));
}

TEST_CASE("numbers, start and goal keep off each other and off waypoints that lie close", "[plan_svg]") {
  Scene scene = scene_on(level_ground_and());
  Plan plan = plan_by_hand(scene);
  using Coms = std::pair<Eigen::Vector2d, Eigen::Vector2d>;  // of stances 2 and 3; stance 1 is at (0, 0.5)
  const auto [second, third] =
      GENERATE(Coms({0, 0.56}, {0.8, 0.5}), Coms({0, 0.53}, {0.8, 0.5}), Coms({0.02, 0.52}, {0.04, 0.54}),
               Coms({0.4, 0.5}, {0.4, 0.55}), Coms({0.1, 0.5}, {0.05, 0.55}));
  plan.stances[1].com = second;
  plan.stances[2].com = third;
  scene.goal.com_x = std::pair(third.x() - 0.05, third.x() + 0.05);
  scene.goal.com_y = std::pair(0.3, third.y() + 0.03);
  std::vector<Box> names, dots;
  each_element(read_xml_text(to_svg(scene, plan)), [&](const std::string& name, const ptree& element) {
    const auto at = [&](const char* key) { return element.get<double>(std::string("<xmlattr>.") + key); };
    if (name == "circle" && element.count("title"))
      dots.push_back({at("cx") - 3, at("cx") + 3, at("cy") - 3, at("cy") + 3});
    const std::string words = name == "text" ? element.data() : "";
    const bool number = (words == "1" || words == "2") && element.get("<xmlattr>.font-size", "") == "10";
    if (number || words == "end") names.push_back(box_of_letters(at("x"), at("y"), number ? 8 : 20));  // with a gap
    if ((words == "start" || words == "goal") && element.get("<xmlattr>.text-anchor", "") == "middle")
      names.push_back(box_of_letters(at("x"), at("y"), 26));
  });
  REQUIRE(dots.size() == 3);
  REQUIRE(names.size() >= 4);  // where there is no room a number is left out
  const auto apart = [](const Box& l, const Box& r) {
    return l.right < r.left || r.right < l.left || l.below < r.above || r.below < l.above;
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) CHECK(apart(names[i], names[k]));
    for (const Box& dot : dots) CHECK(apart(names[i], dot));
  }
}

TEST_CASE("the name of the goal keeps off that of the start, without a plan, too", "[plan_svg]") {
  Scene scene = scene_on(level_ground_and());
  scene.start.com = {-0.05, 0.5};
  scene.goal.com_x = {-0.1, 0};
  scene.goal.com_y = {0.3, GENERATE(0.6, 0.63, 0.66)};
  std::vector<Box> names;
  each_element(read_xml_text(to_svg(scene, Plan())), [&](const std::string& name, const ptree& element) {
    if (name == "text" && element.get("<xmlattr>.text-anchor", "") == "middle" &&
        (element.data() == "goal" || element.data() == "start"))
      names.push_back(box_of_letters(element.get<double>("<xmlattr>.x"), element.get<double>("<xmlattr>.y"), 26));
  });
  REQUIRE(names.size() == 2);
  const Box &one = names[0], &other = names[1];
  CHECK((other.right < one.left || one.right < other.left || other.below < one.above || one.below < other.above));
}
