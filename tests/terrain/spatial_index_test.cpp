// The box tree against a plain loop over all pieces.
#include "terrain/spatial_index.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace surefoot::terrain {
namespace {

using Box = SpatialIndex::Box;
using Piece = SpatialIndex::Piece;

std::vector<Piece> random_pieces(std::mt19937& random, int count, bool uneven) {
  std::uniform_real_distribution<double> at(-10, 10), size(-3, uneven ? 3 : -1);
  std::vector<Piece> pieces;
  for (int i = 0; i < count; ++i) {
    const double length = std::pow(10.0, size(random));
    const Eigen::Vector2d a(at(random), at(random));
    pieces.push_back({a, a + length * Eigen::Vector2d(at(random), at(random)) / 10});
  }
  return pieces;
}

TEST_CASE("the index hands out exactly the pieces of the boxes that are entered", "[index]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-12, 12), size(0, 4);
  for (const int count : {1, 2, 3, 4, 5, 6, 7, 8, 9, 31, 100, 1000}) {
    for (const bool uneven : {false, true}) {
      const auto pieces = random_pieces(random, count, uneven);
      const SpatialIndex index(pieces);
      for (int query = 0; query < 50; ++query) {
        const double x = at(random), y = at(random);
        const Box window{x, y, x + size(random), y + size(random)};
        std::multiset<int> found, expected;
        const bool stopped = index.any([&](const Box& box) { return box.meets(window); },
                                       [&](std::int32_t id, const Piece& piece) {
                                         REQUIRE(piece.a == pieces[id].a);
                                         REQUIRE(piece.b == pieces[id].b);
                                         if (piece.box().meets(window)) found.insert(id);
                                         return false;
                                       });
        CHECK_FALSE(stopped);
        for (int i = 0; i < count; ++i) {
          const auto& [a, b] = pieces[i];
          const bool outside = std::fmax(a.x(), b.x()) < window.min_x || std::fmin(a.x(), b.x()) > window.max_x ||
                               std::fmax(a.y(), b.y()) < window.min_y || std::fmin(a.y(), b.y()) > window.max_y;
          if (!outside) expected.insert(i);
        }
        REQUIRE(found == expected);
      }
    }
  }
}

TEST_CASE("the nearest piece is found though boxes are left out", "[index]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> at(-15, 15);
  long visited = 0, queries = 0;
  for (const bool uneven : {false, true}) {
    const auto pieces = random_pieces(random, 500, uneven);
    const SpatialIndex index(pieces);
    for (int query = 0; query < 500; ++query, ++queries) {
      const Eigen::Vector2d p(at(random), at(random));
      const auto squared = [&](const Piece& piece) { return (piece.a - p).squaredNorm(); };
      double expected = std::numeric_limits<double>::infinity(), least = expected;
      for (const Piece& piece : pieces) expected = std::min(expected, squared(piece));
      index.nearest(
          least, [&](const Box& box) { return box.squared_distance(p.x(), p.y()); },
          [&](std::int32_t, const Piece& piece) {
            ++visited;
            least = std::min(least, squared(piece));
          });
      REQUIRE(least == expected);
    }
  }
  CHECK(visited < 100 * queries);  // of 500 pieces each
}

TEST_CASE("a visit that returns true ends the walk", "[index]") {
  std::mt19937 random(3);
  const SpatialIndex index(random_pieces(random, 300, false));
  int visits = 0;
  CHECK(index.any([](const Box&) { return true; }, [&](std::int32_t, const Piece&) { return ++visits == 7; }));
  CHECK(visits == 7);
}

TEST_CASE("thousands of identical pieces do not unbalance the index", "[index]") {
  const std::vector<Piece> pieces(20000, Piece{{0, 0}, {1, 1}});
  const SpatialIndex index(pieces);
  int visits = 0;
  index.any([](const Box&) { return true; }, [&](std::int32_t, const Piece&) { return ++visits, false; });
  CHECK(visits == 20000);
}

}  // namespace
}  // namespace surefoot::terrain
