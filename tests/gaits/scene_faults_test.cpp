// All faults of a scene at once: none is lost, none is said twice, none only echoes another.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "gaits/scene.hpp"

namespace surefoot::gaits {
namespace {

const std::string sound = R"(surefoot: 1
name: sound
terrain:
  friction: 0.6
  chains:
    - vertices: [[-1, 0], [4, 0], [4, 1], [6, 1]]
      segments:
        1: {foothold: false}
    - vertices: [[-1, 5], [4, 5]]
robot:
  radius_of_gyration: 0.15
  reach: [0.2, 0.9]
  clearance: 0.1
disturbance:
  kappa: 0.1
  nu: 0.03
stability: {criterion: robust}
start:
  feet: [{x: -0.3, chain: 0}, {chain: 0, s: 1.25}, null]
  support: [1, 2]
goal: {com_x: [1.5, 2]}
search: {seed: 1}
)";

/// One fault, as an edit of the sound scene, and what has to be said of it (written by hand).
struct Fault {
  std::string piece, instead;
  std::vector<std::string> told;  // "line:column: message"
};

// No two edits touch the same place. Each is independent of all others.
const std::vector<Fault> independent{
    {"name: sound", "nmae: sound", {"2:1: scene: unknown key \"nmae\"; did you mean \"name\"?"}},
    {"friction: 0.6",
     "frictoin: 0.6",
     {"4:3: terrain: unknown key \"frictoin\"; did you mean \"friction\"?"}},  // and not that it is missing
    {"1: {foothold: false}",
     "1: {foothold: no, frction: 1}",
     {"8:23: foothold: no is given; expected true or false",
      "8:27: segment 1: unknown key \"frction\"; did you mean \"friction\"?"}},
    {"radius_of_gyration: 0.15",
     "radius_of_gyration: -1",
     {"11:23: radius_of_gyration: -1 is not positive; expected a number > 0"}},
    {"reach: [0.2, 0.9]",
     "reach: [a, b]",
     {"12:11: least reach: a is not a finite decimal number; expected a number such as 0.25 or 1e-3",
      "12:14: greatest reach: b is not a finite decimal number; expected a number such as 0.25 or 1e-3"}},
    {"clearance: 0.1", "clearance: &c 0.1", {"13:14: anchors (&c) are not accepted"}},
    {"  kappa: 0.1\n", "  kappa: !!str 0.1\n", {"15:10: tags (tag:yaml.org,2002:str) are not accepted"}},
    {"  nu: 0.03\n",
     "  # lost\n",
     {"15:3: disturbance: \"nu\" is missing; add such as \"nu: 0.03\", torques borne as a share of the weight, in "
      "metres"}},
    {"criterion: robust",
     "criterion: frictional",
     {"17:24: criterion: frictional stability needs a restitution; expected a key \"restitution\" beside it"}},
    {"support: [1, 2]", "support: [1, 3]", {"20:16: support: leg 3 starts in the air; expected a leg with a foot"}},
    {"com_x: [1.5, 2]",
     "com_x: [2, 1.5], com_x: [1, 2]",
     {"21:15: com_x: [2, 1.5] is empty; expected the least first",
      "21:25: key \"com_x\" is given twice; first at line 21"}},
    {"{seed: 1}",
     "{seed: 0, planner: RTT}",
     {"22:16: seed: 0 is out of range; expected 1 to 2147483562",
      "22:28: planner: \"RTT\" is not known; expected one of: auto, Layers, RRT, KPIECE1, EST, SST (did you mean "
      "\"RRT\"?)"}},
};

std::string edited(std::string text, const Fault& fault) {
  const auto at = text.find(fault.piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, fault.piece.size(), fault.instead);
}

std::string base() {  // the start as it can be read: the sound text above shows one fault too many on purpose
  return edited(sound, {"{x: -0.3, chain: 0}", "{x: -0.3}", {}});
}

std::vector<std::string> told_of(const std::string& text) {
  terrain::FaultList faults;
  const bool loaded = parse_scene(text, "f", faults).has_value();
  CHECK(loaded == (faults.count() == 0));
  std::vector<std::string> told;
  for (const terrain::InputError& fault : faults.kept()) told.push_back(fault.what());
  return told;
}

std::string first_of(const std::string& text) {
  try {
    parse_scene(text, "f");
  } catch (const terrain::InputError& fault) {
    return fault.what();
  }
  return "";
}

std::vector<std::string> in_file(const std::vector<std::string>& told) {
  std::vector<std::string> lines;
  for (const std::string& line : told) lines.push_back("f:" + line);
  return lines;
}

TEST_CASE("A sound scene has no fault to tell of", "[faults]") {
  // {x} over two chains is ambiguous: the second one is above the first.
  const std::string one_chain = edited(base(), {"    - vertices: [[-1, 5], [4, 5]]\n", "", {}});
  CHECK(told_of(one_chain).empty());
  CHECK(first_of(one_chain).empty());
}

TEST_CASE("Every fault alone, every two and all together are told, each once", "[faults]") {
  const std::string text = edited(base(), {"{x: -0.3}", "{chain: 0, s: 0.7}", {}});
  REQUIRE(told_of(text).empty());
  std::string all = text;
  std::vector<std::string> all_told;
  for (std::size_t i = 0; i < independent.size(); ++i) {
    const Fault& one = independent[i];
    const std::string with_one = edited(text, one);
    CHECK(told_of(with_one) == in_file(one.told));
    const std::string first = first_of(with_one);
    CHECK(std::count(one.told.begin(), one.told.end(), first.substr(2)) == 1);
    for (std::size_t j = i + 1; j < independent.size(); ++j) {
      std::vector<std::string> both = one.told;
      both.insert(both.end(), independent[j].told.begin(), independent[j].told.end());
      // Both keys of the disturbance: the place of "is missing" is the first key that is left.
      CHECK(told_of(edited(with_one, independent[j])).size() == both.size());
    }
    all = edited(all, one);
    all_told.insert(all_told.end(), one.told.begin(), one.told.end());
  }
  std::vector<std::string> expected = in_file(all_told), found = told_of(all);
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  CHECK(found == expected);
}

TEST_CASE("Faults of the ground are all told, and say nothing of the feet", "[faults]") {
  const std::string bad =
      edited(sound, {"[[-1, 0], [4, 0], [4, 1], [6, 1]]", "[[-1, 0], [4, 0], [4, 0], [6, 1], [6, 1]]", {}});
  CHECK(told_of(edited(bad, {"{x: -0.3, chain: 0}", "{x: -99}", {}})) ==
        in_file({"6:35: chain 0, vertex 2 repeats the vertex before it: a segment of zero length",
                 "6:51: chain 0, vertex 4 repeats the vertex before it: a segment of zero length"}));
  // A chain that cannot be read keeps its neighbour's faults from being asked only where both are needed.
  const std::string unread = edited(base(), {"[4, 5]]", "[4, 5], [4, 5]]", {}});
  CHECK(told_of(edited(unread, {"[6, 1]", "[6, up]", {}})) ==
        in_file({"6:47: y of a vertex: up is not a finite decimal number; expected a number such as 0.25 or 1e-3",
                 "9:35: chain 1, vertex 2 repeats the vertex before it: a segment of zero length"}));
  // Crossings do not hide what is wrong with the feet.
  const std::string crossing = edited(base(), {"[[-1, 5], [4, 5]]", "[[-1, -1], [3, 3], [3, -3]]", {}});
  CHECK(told_of(edited(crossing, {"{x: -0.3}", "{chain: 2, s: 1}", {}})) ==
        in_file({"9:18: chain 1, segment 0 crosses or touches chain 0, segment 0, which begins at f:6:18",
                 "9:28: chain 1, segment 1 crosses or touches chain 0, segment 0, which begins at f:6:18",
                 "19:18: chain: 2 does not exist; chains are 0 to 1"}));
}

TEST_CASE("What follows from a fault is not told", "[faults]") {
  const std::string text = edited(base(), {"{x: -0.3}", "{chain: 0, s: 0.7}", {}});
  // Feet 99 m apart, but only as long as the robot can be read.
  const std::string apart = edited(text, {"s: 1.25", "s: 4.9", {}});
  CHECK(told_of(apart).size() == 1);
  CHECK(told_of(edited(apart, independent[4])) == in_file(independent[4].told));
  // An alias stands for nothing that could be wrong.
  const std::string alias = edited(edited(text, independent[5]), {"nu: 0.03", "nu: *c", {}});
  CHECK(told_of(alias) == in_file({"13:14: anchors (&c) are not accepted", "16:7: aliases (*name) are not accepted"}));
  // A key that was meant for what is missing.
  CHECK(told_of(edited(text, {"goal: {com_x", "goal: {com_z", {}})) ==
        in_file({"21:8: goal: unknown key \"com_z\"; did you mean \"com_x\"?"}));
  CHECK(told_of(edited(text, {"radius_of_gyration: 0.15", "rho: 0.15", {}})) ==
        in_file({"11:3: robot: unknown key \"rho\"; did you mean \"radius_of_gyration\"?"}));
  CHECK(told_of(edited(text, {"{criterion: robust}", "{criterion: both, resitution: 0.1}", {}})) ==
        in_file({"17:30: stability: unknown key \"resitution\"; did you mean \"restitution\"?"}));
  CHECK(told_of(edited(text, {"{chain: 0, s: 0.7}", "{y: 0.7}", {}})) ==
        in_file({"19:11: foot: unknown key \"y\"; expected one of: x, chain, s"}));
  // Another version may mean anything by its keys.
  CHECK(told_of(edited(edited(text, {"surefoot: 1", "surefoot: 2", {}}), independent[0])) ==
        in_file({"1:11: surefoot: format version 2 is not known; expected 1"}));
  CHECK(told_of("[1, 2]") == in_file({"1:1: scene: a list of 2 items is given; expected a map (key: value)"}));
  CHECK(told_of("") == in_file({"1:1: nothing but white space or comments"}));
}

TEST_CASE("A text that is no YAML has one fault, that", "[faults]") {
  const std::string broken = edited(edited(base(), independent[0]), {"chains:", "chains: [", {}});
  const std::vector<std::string> told = told_of(broken);
  REQUIRE(told.size() == 1);
  CHECK(told.front() == first_of(broken));
  CHECK_THAT(told.front(), Catch::Contains("not valid YAML"));
}

TEST_CASE("Of very many faults the first are kept and the rest counted", "[faults]") {
  std::string vertices = "[[0, 0]";
  constexpr std::size_t many = 3000;
  for (std::size_t i = 1; i <= many; ++i) vertices += ", [x, 0]";
  const std::string text = edited(base(), {"[[-1, 0], [4, 0], [4, 1], [6, 1]]", vertices + "]", {}});
  terrain::FaultList faults;
  CHECK_FALSE(parse_scene(text, "f", faults));
  CHECK(faults.count() == many);
  CHECK(faults.kept().size() == terrain::FaultList::most_kept);
  for (const terrain::InputError& fault : faults.kept()) CHECK(fault.line == 6);
  // Crossings are searched for no longer than they are kept.
  std::string comb = "[[0, 0]";
  for (std::size_t i = 1; i <= many; ++i) comb += i % 2 ? ", [0, 9]" : ", [0, 0]";
  terrain::FaultList crossings;
  CHECK_FALSE(parse_scene(edited(base(), {"[[-1, 0], [4, 0], [4, 1], [6, 1]]", comb + "]", {}}), "f", crossings));
  CHECK(crossings.kept().size() == terrain::FaultList::most_kept);
}

}  // namespace
}  // namespace surefoot::gaits
