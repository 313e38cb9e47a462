// Reads a scene file (formats.md). Whatever can be said to be wrong without asking whether a posture is stable is said
// here, at the value that is wrong. What follows from other values is asked only where these could be read, so that a
// document whose faults are kept gets no complaint that only echoes another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gaits/foothold_words.hpp"
#include "gaits/scene.hpp"
#include "gaits/start_loader.hpp"
#include "terrain/terrain_loader.hpp"

namespace surefoot::gaits {
namespace {

using terrain::Node;

const terrain::Keys scene_keys{"surefoot",  "name",  "terrain", "robot", "disturbance",
                               "stability", "start", "goal",    "search"};
const terrain::Keys robot_keys{"radius_of_gyration", "reach", "clearance", "mass"};
const terrain::Keys disturbance_keys{"kappa", "nu"}, stability_keys{"criterion", "restitution"};
const terrain::Keys goal_keys{"com_x", "com_y"}, search_keys{"seed", "time_limit", "planner", "objective"};

const terrain::KeyHomes key_homes{{"at the top level", scene_keys},
                                  {"inside \"terrain\", or an entry of \"segments\"", {"friction"}},
                                  {"inside \"terrain\"", terrain::terrain_keys},
                                  {"inside an entry of \"chains\"", terrain::chain_keys},
                                  {"inside an entry of \"segments\"", terrain::segment_keys},
                                  {"inside \"robot\"", robot_keys},
                                  {"inside \"disturbance\"", disturbance_keys},
                                  {"inside \"stability\"", stability_keys},
                                  {"inside \"start\"", start_keys},
                                  {"inside \"goal\"", goal_keys},
                                  {"inside \"search\"", search_keys}};

/// The document, told where the keys of a scene belong.
terrain::Document as_scene(terrain::Document document) {
  document.know_homes(key_homes);
  return document;
}

// Advice where a key is missing.
constexpr const char* a_version = "; add \"surefoot: 1\" at the top level";
constexpr const char* no_disturbance = "; for none add \"disturbance: {kappa: 0, nu: 0}\"";
constexpr const char* a_goal = "; add such as \"goal: {com_x: [1.5, 1.9]}\"";
constexpr const char* a_terrain = "; add such as \"terrain: {friction: 0.6, chains: [{vertices: [[-1, 0], [3, 0]]}]}\"";
constexpr const char* a_robot = "; add such as \"robot: {radius_of_gyration: 0.18, reach: [0.25, 0.9]}\"";
constexpr const char* a_start = "; add such as \"start: {feet: [{x: -0.5}, {x: 0.1}, {x: -0.2}]}\"";
constexpr const char* a_kappa = "; add such as \"kappa: 0.1\", sideways pushes borne as a share of the weight";
constexpr const char* a_nu = "; add such as \"nu: 0.03\", torques borne as a share of the weight, in metres";
constexpr const char* a_radius = "; add such as \"radius_of_gyration: 0.18\", in metres";
constexpr const char* a_reach = "; add such as \"reach: [0.25, 0.9]\", from the COM to a foot, in metres";

std::string one_of(const Node& node, std::string_view what, const std::vector<std::string>& words) {
  const std::string word = node.text(what);
  if (const std::string* known = known_word(word, words)) return *known;
  node.fail(not_known(what, word, words));
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

void read_reach(const Node& node, Robot& robot) {
  const auto& ends = node.items("reach [least, greatest]", 2);
  node.attempt_each([&] { robot.reach_min = bounded(ends[0], "least reach", ends[0].not_negative("least reach")); },
                    [&] { robot.reach_max = bounded(ends[1], "greatest reach", ends[1].positive("greatest reach")); });
  if (!(robot.reach_min < robot.reach_max)) {
    node.fail(fmt::format("reach: [{}, {}] is empty; expected the least below the greatest", robot.reach_min,
                          robot.reach_max));
  }
}

Robot read_robot(const Node& node) {
  node.allow_only(robot_keys, "robot");
  Robot robot;
  node.attempt_each(
      [&] { robot.radius_of_gyration = read_radius(node.require("radius_of_gyration", "robot", a_radius)); },
      [&] { read_reach(node.require("reach", "robot", a_reach), robot); },
      [&] {
        if (const Node* clearance = node.find("clearance"))
          robot.clearance = bounded(*clearance, "clearance", clearance->not_negative("clearance"));
      },
      [&] {
        if (const Node* mass = node.find("mass")) robot.mass = mass->positive("mass");
      });
  return robot;
}

stability::DisturbanceBox read_disturbance(const Node& node) {
  if (node.kind() != Node::Kind::map) node.refuse("disturbance", "{kappa: ..., nu: ...}");
  node.allow_only(disturbance_keys, "disturbance");
  const auto extent = [&node](std::string_view key, const char* advice) {
    const Node& value = node.require(key, "disturbance", advice);
    return bounded(value, key, value.not_negative(key));
  };
  stability::DisturbanceBox box;
  node.attempt_each([&] { box.kappa = extent("kappa", a_kappa); }, [&] { box.nu = extent("nu", a_nu); });
  return box;
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

struct Stability {
  Criterion criterion = Criterion::robust;
  std::optional<double> restitution;
};

Stability read_stability(const Node& node) {
  if (node.kind() != Node::Kind::map) node.refuse("stability", "{criterion: robust} or another criterion");
  const bool known = node.allow_only(stability_keys, "stability");
  const Node *chosen = node.find("criterion"), *e = node.find("restitution");
  Stability stability;
  node.attempt_each(
      [&] {
        if (chosen) stability.criterion = read_criterion(*chosen);
      },
      [&] {
        if (e) stability.restitution = read_restitution(*e);
      });
  if (!asks_frictional(stability.criterion) || stability.restitution) return stability;
  if (!known) throw terrain::AlreadyTold();
  chosen->fail("criterion: frictional stability needs a restitution; expected a key \"restitution\" beside it");
}

std::optional<std::pair<double, double>> read_interval(const Node& goal, std::string_view key) {
  const Node* node = goal.find(key);
  if (!node) return std::nullopt;
  if (node->kind() != Node::Kind::sequence) node->refuse(key, "[from, to], the least first");
  const auto& ends = node->items(std::string(key) + " [from, to]", 2);
  std::pair<double, double> interval;
  node->attempt_each([&] { interval.first = ends[0].number(key); }, [&] { interval.second = ends[1].number(key); });
  if (interval.first > interval.second) {
    node->fail(fmt::format("{}: [{}, {}] is empty; expected the least first", key, interval.first, interval.second));
  }
  return interval;
}

constexpr const char* goal_form = "{com_x: [from, to]}, com_y or both";

Goal read_goal(const Node& node) {
  if (node.kind() != Node::Kind::map) node.refuse("goal", goal_form);
  const bool known = node.allow_only(goal_keys, "goal");
  Goal goal;
  node.attempt_each([&] { goal.com_x = read_interval(node, "com_x"); },
                    [&] { goal.com_y = read_interval(node, "com_y"); });
  if (goal.com_x || goal.com_y) return goal;
  if (!known) throw terrain::AlreadyTold();
  node.fail(fmt::format("goal: nothing is given; expected {}", goal_form));
}

SearchDefaults read_search(const Node& node) {
  node.allow_only(search_keys, "search");
  SearchDefaults search;
  const auto read = [&node](const char* key, const auto& store) {
    const Node* value = node.find(key);
    if (value) value->attempt([&] { store(*value); });
  };
  read("seed", [&](const Node& seed) {
    const std::int64_t value = seed.integer("seed");
    if (value < 1 || value > greatest_seed)
      seed.fail(fmt::format("seed: {} is out of range; expected 1 to {}", value, greatest_seed));
    search.seed = static_cast<std::uint32_t>(value);
  });
  read("time_limit", [&](const Node& limit) { search.time_limit = limit.positive("time_limit"); });
  read("planner", [&](const Node& planner) { search.planner = one_of(planner, "planner", planner_names()); });
  read("objective",
       [&](const Node& objective) { search.objective = one_of(objective, "objective", objective_names()); });
  return search;
}

/// Start feet that all hang below their ground: said at the chain, which was most likely given the wrong way round.
void check_sides(const Node& terrain, const Start& start) {
  const std::optional<int> chain = chain_above_start(start);
  if (!chain) return;
  terrain.require("chains", "terrain")
      .items("chains")[static_cast<std::size_t>(*chain)]
      .require("vertices", "chain")
      .fail(
          fmt::format("vertices: chain {} runs from right to left under the start feet, so free space is below it and "
                      "no foot can push up; reverse its vertices?",
                      *chain));
}

/// Throws AlreadyTold rather than return a scene of which a fault has been kept.
Scene read_scene(const Node& root, const std::string& file) {
  root.entries("scene");
  if (root.find("stances") && root.find("transfers"))
    root.fail("scene: this is a plan; expected a scene (surefoot check SCENE PLAN verifies a plan)");
  if (root.find("contacts"))
    root.fail(
        "scene: this is a posture; expected a scene (surefoot region takes one with --posture, simulate without "
        "--scene)");
  if (const Node* version = root.find("surefoot"))
    check_format_version(*version);  // of another one nothing else can be said
  root.allow_only(scene_keys, "scene");
  root.attempt([&] { root.require("surefoot", "scene", a_version); });
  auto ground = root.attempt([&] { return terrain::load_terrain(root.require("terrain", "scene", a_terrain)); });
  const auto robot = root.attempt([&] { return read_robot(root.require("robot", "scene", a_robot)); });
  const auto box = root.attempt([&] { return read_disturbance(root.require("disturbance", "scene", no_disturbance)); });
  const Node *chosen_stability = root.find("stability"), *chosen_search = root.find("search"),
             *name = root.find("name");
  const auto stability =
      root.attempt([&] { return chosen_stability ? read_stability(*chosen_stability) : Stability(); });
  auto start = root.attempt([&] {
    return read_start(root.require("start", "scene", a_start), ground ? &*ground : nullptr, robot ? &*robot : nullptr);
  });
  if (ground && start) root.attempt([&] { check_sides(root.require("terrain", "scene"), *start); });
  const auto goal = root.attempt([&] { return read_goal(root.require("goal", "scene", a_goal)); });
  auto search = root.attempt([&] { return chosen_search ? read_search(*chosen_search) : SearchDefaults(); });
  auto title = root.attempt([&] { return name ? name->text("name") : std::filesystem::path(file).stem().string(); });
  if (root.faults() && root.faults()->count() > 0) throw terrain::AlreadyTold();
  return Scene{file,  *std::move(title),    *std::move(ground),     *robot,
               *box,  stability->criterion, stability->restitution, *std::move(start),
               *goal, *std::move(search)};
}

template <class Open>
std::optional<Scene> examine(const Open& open, const std::string& file, terrain::FaultList& faults) {
  try {
    const terrain::Document document = as_scene(open());
    return read_scene(document.root(), file);
  } catch (const terrain::InputError& fault) {
    faults.add(fault);
  } catch (const terrain::AlreadyTold&) {
  }
  return std::nullopt;
}

}  // namespace

Scene load_scene(const std::string& path) {
  return read_scene(as_scene(terrain::Document::read_file(path)).root(), path);
}

Scene parse_scene(std::string_view text, const std::string& name) {
  return read_scene(as_scene(terrain::Document::parse(text, name)).root(), name);
}

std::optional<Scene> load_scene(const std::string& path, terrain::FaultList& faults) {
  return examine([&] { return terrain::Document::read_file(path, &faults); }, path, faults);
}

std::optional<Scene> parse_scene(std::string_view text, const std::string& name, terrain::FaultList& faults) {
  return examine([&] { return terrain::Document::parse(text, name, &faults); }, name, faults);
}

void check_format_version(const Node& version) {
  constexpr const char* known = "1";
  version.number("surefoot");  // anything else is refused as such
  if (const std::string found = version.text("surefoot"); found != known)
    version.fail(fmt::format("surefoot: format version {} is not known; expected {}", terrain::shown(found), known));
}

bool looks_like_scene(const Node& root) { return root.find("terrain") && root.find("robot"); }

}  // namespace surefoot::gaits
