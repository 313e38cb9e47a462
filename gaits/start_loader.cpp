#include "gaits/start_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gaits/foothold_words.hpp"
#include "gaits/rules.hpp"

namespace surefoot::gaits {

using terrain::Foothold;
using terrain::Node;
using terrain::Terrain;

double bounded(const Node& node, std::string_view what, double value) {
  if (std::abs(value) > terrain::greatest_coordinate) {
    node.fail(fmt::format("{}: {} is too large; expected at most {} in magnitude", what, value,
                          terrain::greatest_coordinate));
  }
  return value;
}

namespace {

// Advice where a key is missing.
constexpr const char* three_feet = "; add such as \"feet: [{x: -0.5}, {x: 0.1}, {x: -0.2}]\"";
constexpr const char* foot_forms = "; expected {x: number} or {chain: number, s: number}";

Eigen::Vector2d read_point(const Node& node, const std::string& what) {
  const auto& xy = node.items(what + " [x, y]", 2);
  Eigen::Vector2d point;
  node.attempt_each([&] { point.x() = bounded(xy[0], what, xy[0].number("x of " + what)); },
                    [&] { point.y() = bounded(xy[1], what, xy[1].number("y of " + what)); });
  return point;
}

/// The segment of a chain that arc length s falls inside of; nullptr on a vertex.
const terrain::Segment* segment_around(const Terrain& ground, int chain, double s) {
  for (const terrain::Segment& segment : ground.segments()) {
    if (segment.chain == chain && s > segment.s_begin && s < segment.s_begin + segment.length) return &segment;
  }
  return nullptr;
}

Foothold read_foot_by_arc_length(const Node& node, const Terrain* ground) {
  const Node& chain_node = node.require("chain", "foot", foot_forms);
  const Node& s_node = node.require("s", "foot", foot_forms);
  std::int64_t chain = 0;
  double s = 0;
  node.attempt_each([&] { chain = chain_node.integer("chain"); }, [&] { s = s_node.number("s"); });
  if (!ground) throw terrain::AlreadyTold();
  if (chain < 0 || chain >= ground->chain_count()) {
    const int last = ground->chain_count() - 1;
    chain_node.fail(fmt::format("chain: {} does not exist; {}", chain,
                                last == 0 ? "the only chain is 0" : fmt::format("chains are 0 to {}", last)));
  }
  const int c = static_cast<int>(chain);
  const double length = ground->chain_length(c);
  if (s < 0 || s > length) {
    s_node.fail(fmt::format("s: {} is outside chain {}; expected 0 to {:.6g}", s, c, length));
  }
  if (auto foothold = ground->foothold_at(c, s)) return *foothold;
  const terrain::Segment* segment = segment_around(*ground, c, s);
  if (segment && !segment->surface.foothold) {
    s_node.fail(fmt::format("s: {} is on segment {} of chain {}, where no foot may stand; expected a foothold", s,
                            segment->index, c));
  }
  s_node.fail(fmt::format("s: {} is on a vertex of chain {}; expected a point inside a segment", s, c));
}

Foothold read_foot_by_x(const Node& node, const Terrain* ground) {
  const Node& x_node = node.require("x", "foot");
  const double x = x_node.number("x");
  if (!ground) throw terrain::AlreadyTold();
  std::vector<Foothold> found = ground->footholds_at_x(x);
  if (found.size() == 1) return found.front();
  if (found.empty()) x_node.fail(no_foothold_at_x(*ground, x));
  std::stable_partition(found.begin(), found.end(), [](const Foothold& foothold) { return foothold.normal.y() >= 0; });
  std::vector<std::string> list;
  list.reserve(found.size());
  for (const Foothold& foothold : found) {
    list.push_back(fmt::format("{{chain: {}, s: {:.9g}}}{}", foothold.chain, foothold.s,
                               foothold.normal.y() < 0 ? " (a ceiling)" : ""));
  }
  x_node.fail(fmt::format("x: {} is ambiguous; expected one of: {}", x, fmt::join(list, ", ")));
}

constexpr const char* foot_form = "{x: number}, {chain: number, s: number} or null";

std::optional<Foothold> read_foot(const Node& node, const Terrain* ground) {
  if (node.is_null()) return std::nullopt;
  if (node.kind() != Node::Kind::map) node.refuse("foot", foot_form);
  if (const Node* y = node.find("y"); y && node.find("x"))
    y->fail("y: the height of a foot follows from the terrain; expected {x} alone, or {chain, s}");
  if (!node.allow_only({"x", "chain", "s"}, "foot")) throw terrain::AlreadyTold();
  if (node.entries("foot").empty()) node.fail(fmt::format("foot: nothing is given; expected {}", foot_form));
  if (!node.find("x")) return read_foot_by_arc_length(node, ground);
  if (node.find("chain") || node.find("s"))
    node.fail("foot: x is given besides chain and s; expected {x} or {chain, s}");
  return read_foot_by_x(node, ground);
}

/// `feet` may be missing where that has been told.
std::pair<int, int> read_support(const Node& node, const std::vector<Node>* feet) {
  const auto& legs = node.items("support [leg, leg]", 2);
  std::array<int, 2> support{};
  const auto read_leg = [&](std::size_t k) {
    const std::int64_t leg = legs[k].integer("leg of support");
    if (leg < 1 || leg > leg_count)
      legs[k].fail(fmt::format("support: leg {} does not exist; expected 1 to {}", leg, leg_count));
    support[k] = static_cast<int>(leg) - 1;
    if (feet && (*feet)[static_cast<std::size_t>(support[k])].is_null()) {
      legs[k].fail(fmt::format("support: leg {} starts in the air; expected a leg with a foot", leg));
    }
  };
  node.attempt_each([&] { read_leg(0); }, [&] { read_leg(1); });
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
  constexpr double far = 100;  // greatest reaches: millimetres, most likely
  if (least_gap > 2 * robot.reach_max * (1 + limit_slack)) {
    node.require("feet", "start")
        .fail(fmt::format("feet: {:.6g} m apart, out of reach of any COM; expected at most {}{}", least_gap,
                          2 * robot.reach_max, least_gap > far * robot.reach_max ? " (are all in metres?)" : ""));
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

void read_feet(const Node& node, const std::vector<Node>& legs, const Terrain* ground, Start& start) {
  const auto read_leg = [&](std::size_t leg) { start.feet[leg] = read_foot(legs[leg], ground); };
  node.attempt_each([&] { read_leg(0); }, [&] { read_leg(1); }, [&] { read_leg(2); },
                    [&] {
                      const auto planted =
                          std::count_if(legs.begin(), legs.end(), [](const Node& leg) { return !leg.is_null(); });
                      if (planted < 2) node.fail(fmt::format("feet: {} given; expected at least 2", planted));
                    });
}

}  // namespace

Start read_start(const Node& node, const Terrain* ground, const Robot* robot) {
  node.allow_only(start_keys, "start");
  Start start;
  start.place = node.where();
  const std::vector<Node>* legs = nullptr;
  node.attempt_each(
      [&] {
        const Node& feet = node.require("feet", "start", three_feet);
        if (feet.kind() != Node::Kind::sequence || feet.items("feet").size() != leg_count)
          feet.refuse("feet", fmt::format("a list of {}, one for each leg (null: in the air)", leg_count));
        legs = &feet.items("feet");
        read_feet(feet, *legs, ground, start);
      },
      [&] {
        if (const Node* support = node.find("support")) start.support = read_support(*support, legs);
      },
      [&] {
        const Node* com = node.find("com");
        if (com == nullptr) return;
        start.com = read_point(*com, "com");
        start.com_place = com->where();
      });
  if (!robot) throw terrain::AlreadyTold();
  check_start_reach(node, start, *robot);
  return start;
}

}  // namespace surefoot::gaits
