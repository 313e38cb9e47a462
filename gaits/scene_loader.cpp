// Reads a scene file (formats.md). Whatever can be said to be wrong without asking whether a posture is stable is said
// here, at the value that is wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"
#include "terrain/terrain_loader.hpp"

namespace surefoot::gaits {
namespace {

using terrain::Foothold;
using terrain::Node;
using terrain::Terrain;

constexpr std::int64_t format_version = 1;

std::string one_of(const Node& node, std::string_view what, const std::vector<std::string>& words) {
  std::string word = node.text(what);
  if (std::find(words.begin(), words.end(), word) != words.end()) return word;
  node.fail(not_known(what, word, words));
}

/// The bound that terrain sets for coordinates holds for every length, so that no square overflows.
double bounded(const Node& node, std::string_view what, double value) {
  if (std::abs(value) > terrain::greatest_coordinate) {
    node.fail(fmt::format("{}: {} is too large; expected at most {} in magnitude", what, value,
                          terrain::greatest_coordinate));
  }
  return value;
}

Eigen::Vector2d read_point(const Node& node, const std::string& what) {
  const auto& xy = node.items(what + " [x, y]", 2);
  return {bounded(xy[0], what, xy[0].number("x of " + what)), bounded(xy[1], what, xy[1].number("y of " + what))};
}

void check_version(const Node& root) {
  const Node& version = root.require("surefoot", "scene");
  const std::int64_t found = version.integer("surefoot");
  if (found != format_version) {
    version.fail(fmt::format("surefoot: format version {} is not known; expected {}", found, format_version));
  }
}

/// Neither so large nor so small that its square leaves the range of a double.
double read_radius(const Node& node) {
  const double rho = bounded(node, "radius_of_gyration", node.positive("radius_of_gyration"));
  if (rho < 1 / terrain::greatest_coordinate) {
    node.fail(fmt::format("radius_of_gyration: {} is too small; expected at least {}", rho,
                          1 / terrain::greatest_coordinate));
  }
  return rho;
}

Robot read_robot(const Node& node) {
  node.allow_only({"radius_of_gyration", "reach", "clearance", "mass"}, "robot");
  Robot robot;
  robot.radius_of_gyration = read_radius(node.require("radius_of_gyration", "robot"));
  const Node& reach = node.require("reach", "robot");
  const auto& ends = reach.items("reach [least, greatest]", 2);
  robot.reach_min = bounded(ends[0], "least reach", ends[0].not_negative("least reach"));
  robot.reach_max = bounded(ends[1], "greatest reach", ends[1].positive("greatest reach"));
  if (!(robot.reach_min < robot.reach_max)) {
    reach.fail(fmt::format("reach: [{}, {}] is empty; expected the least below the greatest", robot.reach_min,
                           robot.reach_max));
  }
  if (const Node* clearance = node.find("clearance"))
    robot.clearance = bounded(*clearance, "clearance", clearance->not_negative("clearance"));
  if (const Node* mass = node.find("mass")) robot.mass = mass->positive("mass");
  return robot;
}

stability::DisturbanceBox read_disturbance(const Node& node) {
  node.allow_only({"kappa", "nu"}, "disturbance");
  const Node &kappa = node.require("kappa", "disturbance"), &nu = node.require("nu", "disturbance");
  return {bounded(kappa, "kappa", kappa.not_negative("kappa")), bounded(nu, "nu", nu.not_negative("nu"))};
}

Criterion read_criterion(const Node& node) {
  const std::string word = one_of(node, "criterion", {"robust", "equilibrium", "frictional", "both"});
  if (word == "robust") return Criterion::robust;
  if (word == "equilibrium") return Criterion::equilibrium;
  return word == "both" ? Criterion::both : Criterion::frictional;
}

double read_restitution(const Node& node) {
  const double e = node.number("restitution");
  if (!(e > 0 && e < 1))
    node.fail(fmt::format("restitution: {} is out of range; expected a number between 0 and 1, ends excluded", e));
  return e;
}

/// The segment of a chain that arc length s falls inside of; nullptr on a vertex.
const terrain::Segment* segment_around(const Terrain& ground, int chain, double s) {
  for (const terrain::Segment& segment : ground.segments()) {
    if (segment.chain == chain && s > segment.s_begin && s < segment.s_begin + segment.length) return &segment;
  }
  return nullptr;
}

Foothold read_foot_by_arc_length(const Node& node, const Terrain& ground) {
  const Node& chain_node = node.require("chain", "foot");
  const Node& s_node = node.require("s", "foot");
  const std::int64_t chain = chain_node.integer("chain");
  if (chain < 0 || chain >= ground.chain_count()) {
    chain_node.fail(fmt::format("chain: {} does not exist; expected 0 to {}", chain, ground.chain_count() - 1));
  }
  const int c = static_cast<int>(chain);
  const double s = s_node.number("s");
  const double length = ground.chain_length(c);
  if (s < 0 || s > length) {
    s_node.fail(fmt::format("s: {} is outside chain {}; expected 0 to {}", s, c, length));
  }
  if (auto foothold = ground.foothold_at(c, s)) return *foothold;
  const terrain::Segment* segment = segment_around(ground, c, s);
  if (segment && !segment->surface.foothold) {
    s_node.fail(fmt::format("s: {} is on segment {} of chain {}, where no foot may stand; expected a foothold", s,
                            segment->index, c));
  }
  s_node.fail(fmt::format("s: {} is on a vertex of chain {}; expected a point inside a segment", s, c));
}

Foothold read_foot_by_x(const Node& node, const Terrain& ground) {
  const Node& x_node = node.require("x", "foot");
  const double x = x_node.number("x");
  const std::vector<Foothold> found = ground.footholds_at_x(x);
  if (found.size() == 1) return found.front();
  if (found.empty())
    x_node.fail(
        fmt::format("x: there is no foothold at {}; expected a point inside a segment where a foot may stand", x));
  std::vector<std::string> list;
  list.reserve(found.size());
  for (const Foothold& foothold : found) list.push_back(fmt::format("{{chain: {}, s: {}}}", foothold.chain, foothold.s));
  x_node.fail(fmt::format("x: {} is ambiguous; expected one of: {}", x, fmt::join(list, ", ")));
}

std::optional<Foothold> read_foot(const Node& node, const Terrain& ground) {
  if (node.is_null()) return std::nullopt;
  node.allow_only({"x", "chain", "s"}, "foot");
  if (node.entries("foot").empty()) node.fail("foot: nothing is given; expected {x}, {chain, s} or null");
  if (!node.find("x")) return read_foot_by_arc_length(node, ground);
  if (node.find("chain") || node.find("s"))
    node.fail("foot: x is given besides chain and s; expected {x} or {chain, s}");
  return read_foot_by_x(node, ground);
}

std::pair<int, int> read_support(const Node& node, const Start& start) {
  const auto& legs = node.items("support [leg, leg]", 2);
  std::array<int, 2> support{};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::int64_t leg = legs[k].integer("leg of support");
    if (leg < 1 || leg > leg_count)
      legs[k].fail(fmt::format("support: leg {} does not exist; expected 1 to {}", leg, leg_count));
    support[k] = static_cast<int>(leg) - 1;
    if (!start.feet[static_cast<std::size_t>(support[k])]) {
      legs[k].fail(fmt::format("support: leg {} starts in the air; expected a leg with a foot", leg));
    }
  }
  if (support[0] == support[1])
    node.fail(fmt::format("support: leg {} is named twice; expected two different legs", support[0] + 1));
  return std::minmax(support[0], support[1]);
}

/// A foot that the given COM, or two feet that any COM, cannot reach: no choice that is left open can mend that.
void check_start_reach(const Node& node, const Start& start, const Robot& robot) {
  std::vector<int> carriers;
  for (int leg = 0; leg < leg_count; ++leg) {
    const bool may_carry = !start.support || leg == start.support->first || leg == start.support->second;
    if (may_carry && start.feet[static_cast<std::size_t>(leg)]) carriers.push_back(leg);
  }
  const auto foot = [&](int leg) { return start.feet[static_cast<std::size_t>(leg)]->position; };
  double least_gap = std::numeric_limits<double>::infinity();
  for (const int leg : carriers) {
    for (const int other : carriers) {
      if (leg < other) least_gap = std::min(least_gap, (foot(leg) - foot(other)).norm());
    }
  }
  if (least_gap > 2 * robot.reach_max * (1 + limit_slack)) {
    node.require("feet", "start")
        .fail(fmt::format("feet: {:.6g} m apart, out of reach of any COM; expected at most {}", least_gap,
                          2 * robot.reach_max));
  }
  if (!start.com) return;
  const Node& com = node.require("com", "start");
  int reached = 0;
  for (const int leg : carriers) {
    const bool within = within_reach(robot, foot(leg), *start.com, *start.com);
    reached += within;
    if (within || !start.support) continue;
    com.fail(fmt::format("com: foot {} is {:.6g} m away, out of reach; expected {} to {}", leg + 1,
                         (*start.com - foot(leg)).norm(), robot.reach_min, robot.reach_max));
  }
  if (reached < 2) {
    com.fail(fmt::format("com: feet within reach are {}; expected 2 at a distance of {} to {}", reached,
                         robot.reach_min, robot.reach_max));
  }
}

Start read_start(const Node& node, const Terrain& ground, const Robot& robot) {
  node.allow_only({"feet", "support", "com"}, "start");
  Start start;
  start.place = node.where();
  const Node& feet = node.require("feet", "start");
  const auto& legs = feet.items("feet", leg_count);
  int planted = 0;
  for (std::size_t leg = 0; leg < leg_count; ++leg) {
    start.feet[leg] = read_foot(legs[leg], ground);
    planted += start.feet[leg].has_value();
  }
  if (planted < 2) feet.fail(fmt::format("feet: {} given; expected at least 2", planted));
  if (const Node* support = node.find("support")) start.support = read_support(*support, start);
  if (const Node* com = node.find("com")) start.com = read_point(*com, "com");
  check_start_reach(node, start, robot);
  return start;
}

std::optional<std::pair<double, double>> read_interval(const Node& goal, std::string_view key) {
  const Node* node = goal.find(key);
  if (!node) return std::nullopt;
  const auto& ends = node->items(std::string(key) + " [least, greatest]", 2);
  const std::pair interval{ends[0].number(key), ends[1].number(key)};
  if (interval.first > interval.second) {
    node->fail(fmt::format("{}: [{}, {}] is empty; expected the least first", key, interval.first, interval.second));
  }
  return interval;
}

Goal read_goal(const Node& node) {
  node.allow_only({"com_x", "com_y"}, "goal");
  Goal goal{read_interval(node, "com_x"), read_interval(node, "com_y")};
  if (!goal.com_x && !goal.com_y) node.fail("goal: nothing is given; expected com_x, com_y or both");
  return goal;
}

SearchDefaults read_search(const Node& node) {
  node.allow_only({"seed", "time_limit", "planner", "objective"}, "search");
  SearchDefaults search;
  if (const Node* seed = node.find("seed")) {
    const std::int64_t value = seed->integer("seed");
    if (value < 1 || value > greatest_seed)
      seed->fail(fmt::format("seed: {} is out of range; expected 1 to {}", value, greatest_seed));
    search.seed = static_cast<std::uint32_t>(value);
  }
  if (const Node* limit = node.find("time_limit")) search.time_limit = limit->positive("time_limit");
  if (const Node* planner = node.find("planner")) {
    search.planner = one_of(*planner, "planner", planner_names());
  }
  if (const Node* objective = node.find("objective")) {
    search.objective = one_of(*objective, "objective", objective_names());
  }
  return search;
}

Scene read_scene(const Node& root, const std::string& file) {
  check_version(root);
  root.allow_only({"surefoot", "name", "terrain", "robot", "disturbance", "stability", "start", "goal", "search"},
                  "scene");
  Terrain ground = terrain::load_terrain(root.require("terrain", "scene"));
  const Robot robot = read_robot(root.require("robot", "scene"));
  const auto box = read_disturbance(root.require("disturbance", "scene"));
  Criterion criterion = Criterion::robust;
  std::optional<double> restitution;
  if (const Node* stability = root.find("stability")) {
    stability->allow_only({"criterion", "restitution"}, "stability");
    const Node* chosen = stability->find("criterion");
    if (chosen) criterion = read_criterion(*chosen);
    if (const Node* node = stability->find("restitution")) restitution = read_restitution(*node);
    if (asks_frictional(criterion) && !restitution)
      chosen->fail("criterion: frictional stability needs a restitution; expected a key \"restitution\" beside it");
  }
  Start start = read_start(root.require("start", "scene"), ground, robot);
  const Goal goal = read_goal(root.require("goal", "scene"));
  SearchDefaults search;
  if (const Node* node = root.find("search")) search = read_search(*node);
  const Node* name = root.find("name");
  return Scene{file,
               name ? name->text("name") : std::filesystem::path(file).stem().string(),
               std::move(ground),
               robot,
               box,
               criterion,
               restitution,
               std::move(start),
               goal,
               std::move(search)};
}

}  // namespace

Scene load_scene(const std::string& path) { return read_scene(terrain::Document::read_file(path).root(), path); }

Scene parse_scene(std::string_view text, const std::string& name) {
  return read_scene(terrain::Document::parse(text, name).root(), name);
}

}  // namespace surefoot::gaits
