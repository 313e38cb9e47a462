// Chains, segments, arc length, footholds, and what makes a terrain unsound.
#include "terrain/terrain.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/terrain/lattice_terrain.hpp"

namespace surefoot::terrain {
namespace {

Chain chain_of(std::vector<Point> vertices) {
  Chain chain{std::move(vertices), {}};
  chain.surfaces.assign(chain.vertices.empty() ? 0 : chain.vertices.size() - 1, Surface{0.5, true});
  return chain;
}

TEST_CASE("segments carry arc length and a right-handed frame", "[terrain]") {
  const Terrain terrain({chain_of({{0, 0}, {3, 4}, {3, 10}, {-2, 10}}), chain_of({{0, 20}, {1, 20}})});
  CHECK(terrain.chain_length(0) == 16);
  CHECK(terrain.chain_length(1) == 1);
  const Segment& slope = terrain.segment(0, 0);
  CHECK(slope.length == 5);
  CHECK(slope.tangent.isApprox(Point(0.6, 0.8), 1e-15));
  CHECK(slope.normal.isApprox(Point(-0.8, 0.6), 1e-15));
  CHECK(terrain.segment(0, 2).s_begin == 11);
  CHECK(terrain.segment(0, 2).normal.isApprox(Point(0, -1), 1e-15));
  CHECK(terrain.segment(1, 0).s_begin == 0);
  CHECK(terrain.segments()[3].chain == 1);
  CHECK(terrain.bounds().min() == Point(-2, 0));
  CHECK(terrain.bounds().max() == Point(3, 20));
  CHECK_THROWS_AS(terrain.segment(0, 3), std::out_of_range);
  CHECK_THROWS_AS(terrain.segment(2, 0), std::out_of_range);
  CHECK_THROWS_AS(terrain.segment(-1, 0), std::out_of_range);
  CHECK_THROWS_AS(terrain.chain_length(2), std::out_of_range);
  Foothold nowhere;
  nowhere.chain = 7;
  CHECK_THROWS_AS(terrain.leg_is_free(Point(0, 1), nowhere), std::out_of_range);
}

TEST_CASE("footholds stand inside segments that allow them", "[terrain]") {
  Chain chain = chain_of({{0, 0}, {3, 4}, {3, 10}});
  chain.surfaces[0].friction = 0.25;
  chain.surfaces[1].foothold = false;
  const Terrain terrain({chain});
  const auto foot = terrain.foothold_at(0, 2.5);
  REQUIRE(foot);
  CHECK(foot->position.isApprox(Point(1.5, 2), 1e-15));
  CHECK(foot->segment == 0);
  CHECK(foot->s == 2.5);
  CHECK(foot->friction == 0.25);
  CHECK(foot->normal == terrain.segment(0, 0).normal);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double s : {-1.0, 0.0, 5.0, 7.0, 11.0, 12.0, infinity, -infinity, std::nan("")}) {
    CAPTURE(s);
    CHECK_FALSE(terrain.foothold_at(0, s));
  }
  CHECK_FALSE(terrain.foothold_at(1, 2.5));
  CHECK_FALSE(terrain.foothold_at(-1, 2.5));
  CHECK(terrain.foothold_at(0, std::nextafter(5.0, 0)).has_value());
}

TEST_CASE("a foothold that rounds onto a vertex is none", "[terrain]") {
  const Terrain terrain({chain_of({{1e6, 1}, {1e6 + 1, 2}})});
  CHECK_FALSE(terrain.foothold_at(0, 1e-17));
  CHECK(terrain.foothold_at(0, 1e-6).has_value());
}

TEST_CASE("arc length does not drift over a long chain", "[terrain]") {
  std::vector<Point> vertices;
  for (int i = 0; i <= 100000; ++i) vertices.emplace_back(0.1 * i, i % 2 ? 0.1 : 0.0);
  const Terrain terrain({chain_of(vertices)});
  CHECK(terrain.chain_length(0) == Approx(10000 * std::numbers::sqrt2).epsilon(1e-14));
}

struct Unsound {
  std::vector<Chain> chains;
  int chain, vertex, other_chain, other_segment;
};

TEST_CASE("unsound chains are refused with the place of the fault", "[terrain]") {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  Chain missing = chain_of({{0, 0}, {1, 0}}), negative = missing, undefined = missing;
  missing.surfaces.clear();
  negative.surfaces[0].friction = -1;
  undefined.surfaces[0].friction = nan;
  const std::vector<Unsound> cases{
      {{}, -1, -1, -1, -1},
      {{Chain{}}, 0, -1, -1, -1},
      {{chain_of({{0, 0}})}, 0, -1, -1, -1},
      {{missing}, 0, -1, -1, -1},
      {{negative}, 0, 0, -1, -1},
      {{undefined}, 0, 0, -1, -1},
      {{chain_of({{0, 0}, {1, infinity}})}, 0, 1, -1, -1},
      {{chain_of({{0, nan}, {1, 0}})}, 0, 0, -1, -1},
      {{chain_of({{0, 0}, {1, 1e200}})}, 0, 1, -1, -1},
      {{chain_of({{0, 0}, {1, 0}, {1, -0.0}})}, 0, 2, -1, -1},
      {{chain_of({{0, 0}, {2, 0}, {1, 0}})}, 0, 1, 0, 0},                  // folds back
      {{chain_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}})}, 0, 3, 0, 0},  // touches
      {{chain_of({{0, 0}, {2, 0}, {2, 2}, {0, 0}, {2, 0}})}, 0, 2, 0, 0},
      {{chain_of({{0, 0}, {3, 0}, {1, 1}, {-1, 0}, {0, 0}, {1, -1}})}, 0, 3, 0, 0},  // passes its begin
      {{chain_of({{0, 0}, {1, 0}, {1, 1}, {2, 0}, {0, 0}})}, 0, 3, 0, 0},            // closes by folding back
      {{chain_of({{0, 0}, {1, 0}}), chain_of({{0.5, 1}, {0.5, -1}})}, 1, 0, 0, 0},
      {{chain_of({{0, 0}, {1, 0}}), chain_of({{0.5, 1}, {0.5, 0}})}, 1, 0, 0, 0},
      {{chain_of({{0, 0}, {1, 0}}), chain_of({{1, 0}, {2, 0}})}, 1, 0, 0, 0},
      {{chain_of({{0, 0}, {1, 0}}), chain_of({{0, 5}, {1, 5}}), chain_of({{2, 6}, {0.5, 6}, {0.5, -9}})}, 2, 1, 0, 0}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CAPTURE(i);
    try {
      const Terrain terrain(cases[i].chains);
      FAIL_CHECK("was accepted");
    } catch (const TerrainFault& fault) {
      CAPTURE(fault.what());
      CHECK(fault.chain == cases[i].chain);
      CHECK(fault.vertex == cases[i].vertex);
      CHECK(fault.other_chain == cases[i].other_chain);
      CHECK(fault.other_segment == cases[i].other_segment);
    }
  }
}

TEST_CASE("closed chains are boulders and caves", "[terrain]") {
  const Terrain boulder({chain_of({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}})});  // clockwise: free outside
  CHECK(boulder.is_closed(0));
  CHECK(boulder.chain_length(0) == 4);
  CHECK(boulder.leg_is_free(Point(0.5, 2), *boulder.foothold_at(0, 1.5)));
  CHECK_FALSE(boulder.leg_is_free(Point(0.5, 0.5), *boulder.foothold_at(0, 1.5)));
  const Terrain cave({chain_of({{0, 0}, {1, 0}, {0, 1}, {0, 0}})});  // counter-clockwise: free inside
  CHECK(cave.leg_is_free(Point(0.2, 0.2), *cave.foothold_at(0, 0.5)));
  CHECK_FALSE(cave.leg_is_free(Point(0.2, -0.2), *cave.foothold_at(0, 0.5)));
  CHECK_FALSE(Terrain({chain_of({{0, 0}, {1, 0}})}).is_closed(0));
}

TEST_CASE("of random chains those are refused that integers find crossing, and at the first crossing", "[terrain]") {
  lattice::Generator generator(21);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    lattice::LatticeTerrain plan;
    for (int c = 0; c < 2; ++c) {
      const std::int64_t extent = i % 2 ? 6 : 40;
      std::vector<lattice::Vertex> chain{generator.vertex(extent)};
      for (std::int64_t k = generator.integer(1, 4); k > 0;) {
        const auto next = generator.vertex(extent);
        if (next != chain.back()) chain.push_back(next), --k;
      }
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        plan.edges.push_back({chain[k], chain[k + 1], c, static_cast<int>(k)});
      }
      plan.surfaces.emplace_back(chain.size() - 1);
      plan.chains.push_back(std::move(chain));
    }
    // Segments may share just the vertex in which one ends and the next begins; closed chains do not arise.
    const lattice::Edge *later = nullptr, *earlier = nullptr;
    bool closed = false;
    for (const auto& chain : plan.chains) closed = closed || chain.front() == chain.back();
    if (closed) continue;
    for (std::size_t j = 0; j < plan.edges.size() && !later; ++j) {
      for (std::size_t k = 0; k < j && !later; ++k) {
        const auto &e = plan.edges[k], &f = plan.edges[j];
        const bool neighbours = e.chain == f.chain && e.index + 1 == f.index;
        const bool wrong = neighbours ? lattice::on_segment(f.b, e.a, e.b) || lattice::on_segment(e.a, f.a, f.b)
                                      : lattice::meet(e.a, e.b, f.a, f.b);
        if (wrong) later = &f, earlier = &e;
      }
    }
    CAPTURE(i);
    try {
      const Terrain terrain = plan.build();
      REQUIRE(later == nullptr);
      ++accepted;
    } catch (const TerrainFault& fault) {
      REQUIRE(later != nullptr);
      REQUIRE(fault.chain == later->chain);
      REQUIRE(fault.vertex == later->index);
      REQUIRE(fault.other_chain == earlier->chain);
      REQUIRE(fault.other_segment == earlier->index);
      ++refused;
    }
  }
  CHECK(refused > 500);
  CHECK(accepted > 500);
}

TEST_CASE("one crossing among a hundred thousand segments is found", "[terrain]") {
  constexpr int count = 100000;
  std::vector<Point> vertices;
  for (int i = 0; i <= count; ++i) vertices.emplace_back(0.1 * i, i % 2 ? 0.05 : 0.0);
  CHECK_NOTHROW(Terrain({chain_of(vertices)}));
  // A second chain whose last segment dips to a peak of the first.
  const Chain second = chain_of({{0, 1}, {vertices[77777].x() - 1, 1}, {vertices[77777].x(), 0.05}});
  try {
    const Terrain terrain({chain_of(vertices), second});
    FAIL("was accepted");
  } catch (const TerrainFault& fault) {
    CHECK(fault.chain == 1);
    CHECK(fault.vertex == 1);
    CHECK(fault.other_segment == 77776);
  }
}

TEST_CASE("a terrain answers alike when it is scaled and shifted by powers of two", "[terrain]") {
  lattice::Generator generator(22);
  for (int i = 0; i < 100; ++i) {
    const auto plan = generator.terrain(2, 12, 20, 12);
    const Terrain terrain = plan.build();
    for (const double scale : {0x1p-20, 0x1p20, 0x1p-200, 0x1p200}) {
      std::vector<Chain> scaled;
      for (std::size_t c = 0; c < plan.chains.size(); ++c) {
        scaled.push_back({{}, plan.surfaces[c]});
        for (const auto v : plan.chains[c]) scaled.back().vertices.push_back(scale * lattice::to_point(v));
      }
      const Terrain other(std::move(scaled));
      for (int query = 0; query < 10; ++query) {
        const Point p = lattice::to_point(generator.vertex(40)), q = lattice::to_point(generator.vertex(40));
        const Point from = q - p + Point(0.001, 0), to(1, 2);
        CHECK(other.blocks(scale * p, scale * q) == terrain.blocks(p, q));
        CHECK(other.distance(scale * p, scale * 10) == scale * terrain.distance(p, 10));
        CHECK(other.sector_is_free(scale * p, scale * 0.3, from, to) == terrain.sector_is_free(p, 0.3, from, to));
        const auto here = terrain.stretches_within(p, 0.1, 0.5);
        const auto there = other.stretches_within(scale * p, scale * 0.1, scale * 0.5);
        REQUIRE(here.size() == there.size());
        for (std::size_t k = 0; k < here.size(); ++k) {
          CHECK(there[k].s_begin == scale * here[k].s_begin);
          CHECK(there[k].s_end == scale * here[k].s_end);
        }
      }
    }
  }
}

}  // namespace
}  // namespace surefoot::terrain
