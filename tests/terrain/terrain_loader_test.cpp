// The terrain block of a scene: what it means, and every fault with its exact place and words.
#include "terrain/terrain_loader.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::terrain {
namespace {

std::string error_of(const std::string& text) {
  try {
    const Document document = Document::parse(text, "s.yaml");
    load_terrain(document.root());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// A block with one chain, its vertices on line 4 from column 18 on.
std::string with_vertices(const std::string& vertices, const std::string& rest = "") {
  return "friction: 0.6\nchains:\n  # one\n  - vertices:   " + vertices + "\n" + rest;
}

TEST_CASE("a terrain block is read with its overrides", "[loader]") {
  const Document document = Document::parse(
      "friction: 0.6\n"
      "chains:\n"
      "  - vertices: [[-1, 0], [0.5, 0], [0.5, 0.15], [0.9, 0.15]]\n"
      "    segments:\n"
      "      1: {foothold: false}\n"
      "      2: {friction: 0.3, foothold: true}\n"
      "  - vertices:\n"
      "      - [5, 1]\n"
      "      - [4, 1]\n",
      "s.yaml");
  const Terrain terrain = load_terrain(document.root());
  REQUIRE(terrain.chain_count() == 2);
  REQUIRE(terrain.segments().size() == 4);
  CHECK(terrain.segment(0, 0).surface.friction == 0.6);
  CHECK(terrain.segment(0, 0).surface.foothold);
  CHECK(terrain.segment(0, 1).surface.friction == 0.6);
  CHECK_FALSE(terrain.segment(0, 1).surface.foothold);
  CHECK(terrain.segment(0, 2).surface.friction == 0.3);
  CHECK(terrain.segment(0, 2).surface.foothold);
  CHECK(terrain.segment(1, 0).normal == Point(0, -1));  // a ceiling
  CHECK(terrain.segment(0, 1).normal == Point(-1, 0));  // a riser
  CHECK(terrain.segment(0, 2).s_begin == Approx(1.65).epsilon(1e-15));
}

TEST_CASE("every fault of a terrain block has its place and words", "[loader]") {
  struct Fault {
    std::string text, message;
  };
  const std::string crossing_end = " crosses or touches chain 0, segment 0, which begins at s.yaml:4:18";
  const std::vector<Fault> faults{
      {"[1]", "1:1: terrain: a list of 1 item is given; expected a map (key: value)"},
      {"chains: []",
       "1:1: terrain: \"friction\" is missing; add such as \"friction: 0.6\", the coefficient of every segment that "
       "gives none itself"},
      {"friction: 0.6", "1:1: terrain: \"chains\" is missing; add such as \"chains: [{vertices: [[-1, 0], [3, 0]]}]\""},
      {"friction: -0.3\nchains: []", "1:11: friction: -0.3 is negative; expected a number >= 0"},
      {"friction: .nan\nchains: []",
       "1:11: friction: .nan is not a finite decimal number; expected a number such as 0.25 or 1e-3"},
      {"friction: 0.6\nchains: []", "2:9: chains: an empty list; expected at least one chain"},
      {"friction: 0.6\nchains: {vertices: []}",
       "2:9: chains: a map is given; expected a list, - vertices: [[x, y], [x, y], ...]"},
      {"friction: 0.6\nchains: 5", "2:9: chains: 5 is given; expected a list"},
      {"friction: 0.6\nchains:", "2:1: chains: nothing is given; expected a list"},
      {"fricton: 0.6\nchains: []", "1:1: terrain: unknown key \"fricton\"; did you mean \"friction\"?"},
      {"friction: 0.6\nchains: [[0, 1]]",
       "2:10: chain: a list of 2 items is given; expected vertices: [[x, y], [x, y], ...]"},
      {"friction: 0.6\nchains: [{vertex: []}]",
       "2:11: chain: unknown key \"vertex\"; expected one of: vertices, segments"},
      {"friction: 0.6\nchains: [{segments: {}}]",
       "2:10: chain: \"vertices\" is missing; add such as \"vertices: [[-1, 0], [3, 0]]\""},
      {with_vertices("[]"), "4:17: vertices: 0 given; expected at least 2"},
      {with_vertices("[[1, 2]]"), "4:17: vertices: 1 given; expected at least 2"},
      {with_vertices("[[1, 2], 3]"),
       "4:26: vertex [x, y]: 3 is given; expected a list of 2 items in square brackets, [a, b]"},
      {with_vertices("[[1, 2], [3]]"), "4:26: vertex [x, y]: a list of 1 item is given; expected a list of 2 items"},
      {with_vertices("[[1, 2], [3, 4, 5]]"),
       "4:26: vertex [x, y]: a list of 3 items is given; expected a list of 2 items"},
      {with_vertices("[[1, 2], [3, .inf]]"),
       "4:30: y of a vertex: .inf is not a finite decimal number; expected a number such as 0.25 or 1e-3"},
      {with_vertices("[[1, 2], [NaN, 4]]"),
       "4:27: x of a vertex: NaN is not a finite decimal number; expected a number such as 0.25 or 1e-3"},
      {with_vertices("[[1, 2], [1e101, 4]]"),
       "4:27: x of a vertex: 1e101 is too large; expected at most 1e100 in magnitude"},
      {with_vertices("[[1, 2], [3, 4], [3.0, 4], [5, 6]]"),
       "4:34: chain 0, vertex 2 repeats the vertex before it: a segment of zero length"},
      {with_vertices("[[0, 0], [1e-101, 0]]"),
       "4:26: chain 0, vertex 1 is less than 1e-100 m from the vertex before it"},
      {with_vertices("[[0, 0], [4, 0], [4, 1], [2, 1], [2, -1]]"), "4:42: chain 0, segment 3" + crossing_end},
      {with_vertices("[[0, 0], [4, 0], [4, 1], [2, 1], [2, 0]]"), "4:42: chain 0, segment 3" + crossing_end},
      {with_vertices("[[0, 0], [4, 0], [2, 0]]"), "4:26: chain 0, segment 1" + crossing_end},
      {with_vertices("[[0, 0], [4, 0], [0, 0]]"), "4:26: chain 0, segment 1" + crossing_end},
      {with_vertices("[[0, 0], [4, 0], [4, 4], [0, 0], [0, 4]]"), "4:34: chain 0, segment 2" + crossing_end},
      {with_vertices("[[0, 0], [4, 0]]", "  - vertices: [[5, 5], [2, 2], [2, -1]]"),
       "5:24: chain 1, segment 1" + crossing_end},
      {with_vertices("[[0, 0], [4, 0]]", "  - vertices: [[4, 0], [5, 0]]"),
       "5:16: chain 1, segment 0" + crossing_end +
           "; ground that touches is one chain (\"segments\" tells where its surface "
           "changes)"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {1: {friction: 1}}"),
       "5:16: segment index: 1 is out of range; expected 0 to 0"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {-1: {friction: 1}}"),
       "5:16: segment index: -1 is out of range; expected 0 to 0"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {first: {friction: 1}}"),
       "5:16: segment index: first is not an integer; expected a whole number such as 7"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: {}, 0: {}}"),
       "5:23: key \"0\" is given twice; first at line 5"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: {}, +0: {}}"), "5:23: segment index: 0 is given twice"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: {mu: 1}}"),
       "5:20: segment 0: unknown key \"mu\"; did you mean \"friction\"?"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: {friction: -1}}"),
       "5:30: friction: -1 is negative; expected a number >= 0"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: false}"),
       "5:19: segment 0: false is given; expected {friction: number}, {foothold: false} or both"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: {0: {foothold: no}}"),
       "5:30: foothold: no is given; expected true or false"},
      {with_vertices("[[0, 0], [4, 0]]", "    segments: [1]"),
       "5:15: segments: a list of 1 item is given; expected a map (key: value)"},
  };
  for (const auto& [text, message] : faults) {
    CAPTURE(text);
    CHECK(error_of(text) == "s.yaml:" + message);
  }
}

TEST_CASE("chains may turn back, close and stand alone", "[loader]") {
  CHECK(error_of(with_vertices("[[0, 0], [4, 0], [4, 4], [0, 0]]")) == "no error");                    // closed
  CHECK(error_of(with_vertices("[[0, 0], [1, 0], [2, 0], [3, 1e-9], [2, 1e-9]]")) == "no error");      // overhang
  CHECK(error_of(with_vertices("[[0, 0], [4, 0]]", "  - vertices: [[4, 1], [0, 1]]")) == "no error");  // ceiling
  CHECK(error_of(with_vertices("[[0, 0], [4, 0]]", "    segments: {}")) == "no error");
}

TEST_CASE("the canned scenes have sound terrains", "[loader]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS)) {
    if (entry.path().extension() != ".yaml") continue;
    CAPTURE(entry.path());
    const Document document = Document::read_file(entry.path().string());
    CHECK_NOTHROW(load_terrain(document.root().require("terrain", "scene")));
    ++scenes;
  }
  CHECK(scenes >= 10);
}

TEST_CASE("Segments are counted by keys in quotes too, as JSON writes them", "[terrain_loader]") {
  const auto friction_of_first = [](const std::string& key) {
    const Document document =
        Document::parse(R"({"friction": 0.6, "chains": [{"vertices": [[0, 0], [1, 0]], "segments": {)" + key +
                            R"(: {"friction": 0.4}}}]})",
                        "s.json");
    return load_terrain(document.root()).segments().front().surface.friction;
  };
  CHECK(friction_of_first("\"0\"") == 0.4);
  CHECK(friction_of_first("0") == 0.4);
  CHECK_THROWS_WITH(friction_of_first("\"first\""), Catch::Contains("segment index: \"first\" is not an integer"));
  CHECK_THROWS_WITH(friction_of_first("\"1\""), Catch::Contains("segment index: 1 is out of range"));
}

}  // namespace
}  // namespace surefoot::terrain
