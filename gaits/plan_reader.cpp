#include <cstdint>
#include <limits>

#include "gaits/plan_io.hpp"
#include "gaits/scene.hpp"

namespace surefoot::gaits {
namespace {

using terrain::Node;

Eigen::Vector2d point(const Node& node, const char* what) {
  const auto& xy = node.items(what, 2);
  return {xy[0].number(what), xy[1].number(what)};
}

double safety_factor(const Node& node) {
  constexpr const char* what = "safety factor";
  if (node.kind() == Node::Kind::scalar && node.text(what) == "inf") return std::numeric_limits<double>::infinity();
  return node.not_negative("safety factor (a number or \"inf\")");
}

/// An integer in [least, greatest].
std::int64_t integer(const Node& node, const std::string& what, std::int64_t least, std::int64_t greatest) {
  const std::int64_t value = node.integer(what);
  if (value < least || value > greatest)
    node.fail(what + " is " + std::to_string(value) + ", expected " + std::to_string(least) + " to " +
              std::to_string(greatest));
  return value;
}

int index(const Node& node, const std::string& what) {
  return static_cast<int>(integer(node, what, 0, std::numeric_limits<int>::max()));
}

int leg(const Node& node) { return static_cast<int>(integer(node, "leg", 1, leg_count)) - 1; }

std::string optional_text(const Node& map, const char* key) {
  const Node* node = map.find(key);
  return node ? node->text(key) : std::string();
}

terrain::Foothold foothold(const Node& node) {
  constexpr const char* what = "foothold";
  node.entries(what);
  node.allow_only({"chain", "segment", "s", "x", "y", "normal", "friction"}, what);
  terrain::Foothold foot;
  foot.chain = index(node.require("chain", what), "chain");
  foot.segment = index(node.require("segment", what), "segment");
  foot.s = node.require("s", what).number("arc length s");
  foot.position = {node.require("x", what).number("x"), node.require("y", what).number("y")};
  if (const Node* normal = node.find("normal")) foot.normal = point(*normal, "normal");
  if (const Node* friction = node.find("friction")) foot.friction = friction->not_negative("friction");
  return foot;
}

Stance stance(const Node& node) {
  constexpr const char* what = "stance";
  node.entries(what);
  node.allow_only({"feet", "com", "safety_factor", "limit"}, what);
  Stance result;
  const Node& feet = node.require("feet", what);
  feet.entries("feet");
  feet.allow_only({"1", "2", "3"}, "feet");
  for (int i = 0; i < leg_count; ++i)
    if (const Node* foot = feet.find(std::to_string(i + 1))) result.feet[i] = foothold(*foot);
  result.com = point(node.require("com", what), "com");
  result.safety_factor = safety_factor(node.require("safety_factor", what));
  result.limit = optional_text(node, "limit");
  return result;
}

Transfer transfer(const Node& node) {
  constexpr const char* what = "transfer";
  node.entries(what);
  node.allow_only({"place", "lift", "safety_factor", "limit"}, what);
  const Node& place = node.require("place", what);
  place.entries("place");
  place.allow_only({"leg", "foothold"}, "place");
  Transfer result;
  result.leg = leg(place.require("leg", "place"));
  result.foothold = foothold(place.require("foothold", "place"));
  result.lift = leg(node.require("lift", what));
  result.safety_factor = safety_factor(node.require("safety_factor", what));
  result.limit = optional_text(node, "limit");
  return result;
}

LeftOut left_out(const Node& node) {
  constexpr const char* what = "entry of left_out";
  node.entries(what);
  node.allow_only({"what", "why"}, what);
  return {node.require("what", what).text("what"), node.require("why", what).text("why")};
}

template <class Item>
std::vector<Item> list(const Node& node, const char* what, Item (*read)(const Node&)) {
  std::vector<Item> result;
  for (const Node& item : node.items(what)) result.push_back(read(item));
  return result;
}

Status status(const Node& node) {
  const std::string word = node.text("status");
  std::vector<std::string> known;
  for (const Status candidate : {Status::solved, Status::no_plan_found, Status::infeasible}) {
    if (word == to_string(candidate)) return candidate;
    known.emplace_back(to_string(candidate));
  }
  node.fail(not_known("status", word, known));
}

Resolution resolution(const Node& node) {
  constexpr const char* what = "resolution";
  node.allow_only({"foothold_spacing", "com_columns", "fewest_on_lattice", "least_steps"}, what);
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  Resolution result;
  result.foothold_spacing = node.require("foothold_spacing", what).not_negative("foothold_spacing");
  result.com_columns = static_cast<int>(integer(node.require("com_columns", what), "com_columns", 0, most));
  result.fewest_on_lattice = node.require("fewest_on_lattice", what).boolean("fewest_on_lattice");
  result.least_steps = static_cast<int>(integer(node.require("least_steps", what), "least_steps", 0, most));
  return result;
}

Plan plan(const Node& root) {
  constexpr const char* what = "plan";
  root.entries(what);
  if (looks_like_scene(root)) root.fail("plan: this is a scene; expected a plan (surefoot check SCENE PLAN)");
  if (root.find("contacts")) root.fail("plan: this is a posture; expected a plan");
  root.allow_only({"surefoot", "scene", "status", "reason", "planner", "seed", "stances", "transfers", "safety_factor",
                   "safety_factor_before_refinement", "steps", "time_s", "resolution", "left_out"},
                  what);
  check_format_version(root.require("surefoot", what));
  Plan result;
  result.scene = root.require("scene", what).text("scene");
  result.status = status(root.require("status", what));
  result.reason = optional_text(root, "reason");
  result.planner = optional_text(root, "planner");
  if (const Node* seed = root.find("seed"))
    result.seed = static_cast<std::uint32_t>(integer(*seed, "seed", 0, std::numeric_limits<std::uint32_t>::max()));
  result.stances = list(root.require("stances", what), "stances", stance);
  result.transfers = list(root.require("transfers", what), "transfers", transfer);
  result.safety_factor = safety_factor(root.require("safety_factor", what));
  if (const Node* before = root.find("safety_factor_before_refinement"))
    result.safety_factor_before_refinement = safety_factor(*before);
  const Node* steps = root.find("steps");
  if (steps && steps->integer("steps") != result.steps())
    steps->fail("steps is " + std::to_string(steps->integer("steps")) + ", but there are " +
                std::to_string(result.steps()) + " transfers");
  if (const Node* time = root.find("time_s")) result.time_s = time->not_negative("time_s");
  if (const Node* reached = root.find("resolution")) result.resolution = resolution(*reached);
  if (const Node* items = root.find("left_out")) result.left_out = list(*items, "left_out", left_out);
  return result;
}

/// The first line is that of to_text.
bool is_printed_for_people(std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  for (const std::string_view key : {"{", "status:", "reason:"})
    if (first.starts_with(key)) return false;
  return first.find(": solved in ") != std::string_view::npos ||
         first.find(": no plan found") != std::string_view::npos ||
         first.find(": infeasible") != std::string_view::npos;
}

}  // namespace

Plan read_plan(const std::string& path) { return parse_plan(terrain::read_text(path), path); }

Plan parse_plan(std::string_view text, const std::string& name) {
  try {
    const terrain::Document document = terrain::Document::parse(text, name);
    return plan(document.root());
  } catch (const terrain::InputError&) {
    if (!is_printed_for_people(text)) throw;
  }
  throw terrain::InputError(name + ":1:1: plan: this is a plan printed as text; write it with -o plan.json", 1, 1);
}

}  // namespace surefoot::gaits
