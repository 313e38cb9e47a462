#include "terrain/terrain_loader.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::terrain {
namespace {

// Advice where a key is missing.
constexpr const char* a_friction =
    "; add such as \"friction: 0.6\", the coefficient of every segment that gives none itself";
constexpr const char* some_chains = "; add such as \"chains: [{vertices: [[-1, 0], [3, 0]]}]\"";
constexpr const char* some_vertices = "; add such as \"vertices: [[-1, 0], [3, 0]]\"";

double coordinate(const Node& node, std::string_view what) {
  const double value = node.number(what);
  if (std::abs(value) > greatest_coordinate) {
    node.fail(std::string(what) + ": " + shown(node.text(what)) + " is too large; expected at most 1e100 in magnitude");
  }
  return value;
}

Point load_vertex(const Node& node) {
  const auto& xy = node.items("vertex [x, y]", 2);
  Point vertex;
  node.attempt_each([&] { vertex.x() = coordinate(xy[0], "x of a vertex"); },
                    [&] { vertex.y() = coordinate(xy[1], "y of a vertex"); });
  return vertex;
}

void load_override(const Node& key, const Node& value, std::vector<Surface>& surfaces, std::vector<bool>& given) {
  const std::int64_t index = key.integer_key("segment index");
  if (index < 0 || index >= static_cast<std::int64_t>(surfaces.size())) {
    key.fail("segment index: " + std::to_string(index) + " is out of range; expected 0 to " +
             std::to_string(surfaces.size() - 1));
  }
  if (given[index]) key.fail("segment index: " + std::to_string(index) + " is given twice");
  given[index] = true;
  const std::string name = "segment " + std::to_string(index);
  if (value.kind() != Node::Kind::map) value.refuse(name, "{friction: number}, {foothold: false} or both");
  value.allow_only(segment_keys, name);
  Surface& surface = surfaces[index];
  if (const Node* friction = value.find("friction")) {
    friction->attempt([&] { surface.friction = friction->not_negative("friction"); });
  }
  if (const Node* foothold = value.find("foothold")) {
    foothold->attempt([&] { surface.foothold = foothold->boolean("foothold"); });
  }
}

/// The overrides of a chain whose segments all have the terrain's surface so far.
void load_overrides(const Node& node, std::vector<Surface>& surfaces) {
  std::vector<bool> given(surfaces.size(), false);
  for (const auto& entry : node.entries("segments")) {
    node.attempt([&] { load_override(entry.first, entry.second, surfaces, given); });
  }
}

Chain load_chain(const Node& node, const Surface& surface) {
  if (node.kind() != Node::Kind::map) node.refuse("chain", "vertices: [[x, y], [x, y], ...]");
  node.allow_only(chain_keys, "chain");
  const Node& vertices = node.require("vertices", "chain", some_vertices);
  const auto& items = vertices.items("vertices");
  if (items.size() < 2) {
    vertices.fail("vertices: " + std::to_string(items.size()) + " given; expected at least 2");
  }
  Chain chain;
  chain.vertices.reserve(items.size());
  bool whole = true;
  for (const Node& item : items) {
    whole = item.attempt([&] { chain.vertices.push_back(load_vertex(item)); }) && whole;
  }
  chain.surfaces.assign(items.size() - 1, surface);
  if (const Node* overrides = node.find("segments")) {
    overrides->attempt([&] { load_overrides(*overrides, chain.surfaces); });
  }
  if (!whole) throw AlreadyTold();
  return chain;
}

/// The node of a vertex that load_chain has read already.
const Node& vertex_node(const Node& chains, int chain, int vertex) {
  return chains.items("chains")[chain].require("vertices", "chain").items("vertices")[vertex];
}

/// Says what Terrain found in the words of the file: at the vertex that is wrong or begins the wrong segment.
[[noreturn]] void fail_at(const Node& chains, const TerrainFault& fault) {
  if (fault.chain < 0 || fault.vertex < 0) chains.fail(fault.what());
  const Node& at = vertex_node(chains, fault.chain, fault.vertex);
  if (fault.other_chain < 0) at.fail(fault.what());
  at.fail(
      std::string(fault.what()) + ", which begins at " +
      vertex_node(chains, fault.other_chain, fault.other_segment).where() +
      (fault.chains_touch ? "; ground that touches is one chain (\"segments\" tells where its surface changes)" : ""));
}

}  // namespace

Terrain load_terrain(const Node& node) {
  node.allow_only(terrain_keys, "terrain");
  Surface surface;
  node.attempt([&] { surface.friction = node.require("friction", "terrain", a_friction).not_negative("friction"); });
  const Node& list = node.require("chains", "terrain", some_chains);
  if (list.kind() == Node::Kind::map) list.refuse("chains", "a list, - vertices: [[x, y], [x, y], ...]");
  std::vector<Chain> chains;
  std::vector<bool> unread;
  for (const Node& item : list.items("chains")) {
    std::optional<Chain> chain = item.attempt([&] { return load_chain(item, surface); });
    unread.push_back(!chain);
    chains.push_back(chain ? *std::move(chain) : Chain());
  }
  if (chains.empty()) list.fail("chains: an empty list; expected at least one chain");
  std::optional<Terrain> ground = Terrain::examine(std::move(chains), [&](const TerrainFault& fault) {
    if (fault.chain < 0 || !unread[fault.chain]) list.attempt([&] { fail_at(list, fault); });
    return !(list.faults() && list.faults()->full());
  });
  if (!ground) throw AlreadyTold();
  return *std::move(ground);
}

}  // namespace surefoot::terrain
