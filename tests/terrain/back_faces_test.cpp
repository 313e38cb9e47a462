// Chains that turn their backs to each other, and ground in good order, drawn by hand.
#include <catch2/catch.hpp>

#include "terrain/back_faces.hpp"

using namespace surefoot::terrain;

namespace {

Chain chain(std::vector<Point> vertices, bool foothold = true) {
  const std::size_t segments = vertices.size() - 1;
  return {std::move(vertices), std::vector<Surface>(segments, Surface{0.5, foothold})};
}

const Chain ground = chain({{-1, 0}, {1, 0}, {2, 0.3}, {4, 0}});

}  // namespace

TEST_CASE("A ceiling given like ground turns its back to the ground below", "[back_faces]") {
  const auto seen = back_face_seen(Terrain({ground, chain({{-0.5, 1}, {0.5, 1}})}), 1.5, {}, 0.2);
  REQUIRE(seen);
  CHECK(seen->chain == 1);
  CHECK(seen->index == 0);
  CHECK(seen->at == Point(0, 1));  // over the middle of the first segment
  CHECK_FALSE(back_face_seen(Terrain({ground, chain({{0.5, 1}, {-0.5, 1}})}), 1.5, {}, 0.2));
  // One that no middle of the ground lies under is seen from above.
  const auto narrow = back_face_seen(Terrain({ground, chain({{0.3, 1}, {0.7, 1}})}), 1.5, {}, 0.2);
  REQUIRE(narrow);
  CHECK(narrow->chain == 1);
  CHECK(narrow->index == 0);
  CHECK(narrow->at == Point(0.5, 1));
  CHECK_FALSE(back_face_seen(Terrain({ground, chain({{0.7, 1}, {0.3, 1}})}), 1.5, {}, 0.2));
  CHECK_FALSE(back_face_seen(Terrain({ground, chain({{0.3, 1}, {0.7, 1}})}), 0.9, {}, 0.2));
}

TEST_CASE("What lies behind other ground, too far away or without footholds is not asked", "[back_faces]") {
  const Chain shelf = chain({{-0.5, 1}, {0.5, 1}}), ceiling = chain({{0.5, 0.9}, {-0.5, 0.9}});
  CHECK_FALSE(back_face_seen(Terrain({ground, shelf}), 0.999, {}, 0.2));
  CHECK_FALSE(back_face_seen(Terrain({ground, ceiling, shelf}), 1.5, {}, 0.2));  // a plate with two sides
  CHECK_FALSE(back_face_seen(Terrain({chain({{-1, 0}, {1, 0}}, false), shelf}), 1.5, {}, 0.2));
}

TEST_CASE("An obstacle that stands on the ground, open below, may show its inside", "[back_faces]") {
  const Chain floor = chain({{-1, 0}, {1, 0}});
  const std::vector<Point> box{{-0.2, 0.1}, {-0.2, 0.3}, {0.2, 0.3}, {0.2, 0.1}};
  CHECK_FALSE(back_face_seen(Terrain({floor, chain(box)}), 1.5, {}, 0.11));
  CHECK(back_face_seen(Terrain({floor, chain(box)}), 1.5, {}, 0.09));  // too high to stand
  // Who stands in it sees a vault that is given like ground.
  const std::vector<Foothold> inside{{.chain = 0, .position = Point(0.1, 0)}};
  CHECK(back_face_seen(Terrain({floor, chain(box)}), 1.5, inside, 0.11));
  // Who stands on it, or beside, does not.
  const std::vector<Foothold> on_it{{.chain = 1, .position = Point(0.1, 0.3)}, {.position = Point(0.5, 0)}};
  CHECK_FALSE(back_face_seen(Terrain({floor, chain(box)}), 1.5, on_it, 0.11));
  const std::vector<Point> wide{{-0.9, 0.1}, {-0.9, 0.3}, {0.2, 0.3}, {0.2, 0.1}};  // its middle over no middle
  CHECK_FALSE(back_face_seen(Terrain({floor, chain(wide)}), 1.5, on_it, 0.11));
}

TEST_CASE("A step down behind a gap whose near wall alone is given shows no back", "[back_faces]") {
  const Chain before = chain({{-1, 0}, {0.5, 0}, {0.5, -1}}),
              behind = chain({{1, 0}, {1.5, 0}, {1.5, -0.3}, {4, -0.3}});
  CHECK_FALSE(back_face_seen(Terrain({before, behind}), 1.8, {}, 0.2));
}

TEST_CASE("Ground given the wrong way round is told from ceilings", "[back_faces]") {
  const auto told = [](std::vector<Chain> more) {
    more.insert(more.begin(), {ground, chain({{4.6, 0}, {8, 0}})});  // up to x = 4, and on from 4.6
    return ground_upside_down(Terrain(std::move(more)), 2, 0.2);
  };
  CHECK(told({chain({{4.4, 0}, {4.2, 0}})}) == 2);                            // a stepping stone
  CHECK(told({chain({{4.4, -1}, {4.4, 0.1}, {4.2, 0.1}, {4.2, -1}})}) == 2);  // with sides
  CHECK(told({chain({{5, 1}, {3, 1}}), chain({{4.4, 0}, {4.2, 0}})}) == 3);   // under a ceiling
  CHECK_FALSE(told({}));
  CHECK_FALSE(told({chain({{4.2, 0}, {4.4, 0}})}));     // as it should be
  CHECK_FALSE(told({chain({{7, 1.5}, {-2.4, 1.5}})}));  // a ceiling over all, its middle over no gap
  CHECK_FALSE(told({chain({{4.4, 1}, {4.2, 1}})}));     // a beam over the gap
  CHECK_FALSE(told({chain({{4.55, 1}, {4.55, -5}}), chain({{4.05, -5}, {4.05, 1}})}));  // walls
  CHECK_FALSE(told({chain({{4.5, 1}, {4.4, -5}})}));                                    // one that leans
  CHECK_FALSE(told({chain({{20, 0}, {19, 0}})}));                                       // far from all ground
  CHECK_FALSE(ground_upside_down(Terrain({chain({{1, 0}, {0, 0}})}), 2, 0.2));          // no ground at all
}

TEST_CASE("A ray through a vertex does not pass through the solid behind", "[back_faces]") {
  const Chain floor = chain({{-1, 0}, {1, 0}});
  const std::vector<Point> block{{-.5, 1.5}, {.5, 1.5}, {.5, 1}, {0, 1}, {-.5, 1}, {-.5, 1.5}};
  CHECK_FALSE(back_face_seen(Terrain({floor, chain(block)}), 3, {}, 0.2));
  const auto reversed = back_face_seen(Terrain({floor, chain({block.rbegin(), block.rend()})}), 3, {}, 0.2);
  REQUIRE(reversed);
  CHECK(reversed->at == Point(0, 1));
}

TEST_CASE("A point above a ceiling without sides looks at its back, one below it or above ground does not",
          "[back_faces]") {
  const Terrain open({ground, chain({{0.5, 1}, {-0.5, 1}})});
  const std::vector<Point> points{{0, 0.5}, {-0.9, 2}, {0.2, 1.25}};
  const auto seen = back_face_over(open, points, 1);
  REQUIRE(seen);
  CHECK(seen->index == 2);
  CHECK(seen->chain == 1);
  CHECK(seen->at == Point(0.2, 1));
  CHECK_FALSE(back_face_over(open, points, 0.2));
  CHECK_FALSE(back_face_over(open, std::span(points).first(2), 10));
  CHECK_FALSE(back_face_over(open, {}, 1));
}

TEST_CASE("Ground alone, a V, a riser, an overhang, a closed block look at no back", "[back_faces]") {
  for (const auto& vertices :
       std::vector<std::vector<Point>>{{{-1, 1}, {0, 0}, {1, 1}},
                                       {{-1, 0}, {0, 0}, {0, 1}, {1, 1}},
                                       {{-1, 0}, {1, 0}, {1, 0.5}, {0, 0.5}, {0, 1}, {2, 1}},  // an overhang
                                       {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}}})  // a block, free space outside
    CHECK_FALSE(back_face_seen(Terrain({chain(vertices)}), 10, {}, 0.2));
}

TEST_CASE("Obstacles given the wrong way round are told from ceilings and from rooms that somebody lives in",
          "[back_faces]") {
  using Box = Eigen::AlignedBox2d;
  const Chain floor = chain({{-1, 0}, {6, 0}});
  const Box start(Point(0, 0)), goal(Point(5, -10), Point(5.4, 10));
  const auto told = [&](std::vector<Point> vertices, const Box& from, const Box& to) {
    return obstacles_inside_out(Terrain({floor, chain(std::move(vertices))}), {&from, 1}, to, 0.2);
  };
  const std::vector<std::vector<Point>> obstacles{
      {{1, 0.1}, {1, 0.3}, {1.4, 0.3}, {1.4, 0.1}},            // a box, as it should be
      {{0.9, 0.1}, {1, 0.3}, {1.4, 0.3}, {1.5, 0.1}},          // with walls that lean in
      {{1, 0.1}, {0.9, 0.3}, {1.5, 0.3}, {1.4, 0.1}},          // and out
      {{1, 0.1}, {1.2, 0.3}, {1.4, 0.1}},                      // a triangle
      {{1, 0.1}, {1, 0.3}, {1.4, 0.3}, {1.4, 0.1}, {1, 0.1}},  // a block, closed
      {{1, 3}, {1, 4}, {1.4, 4}, {1.4, 3}, {1, 3}},            // that floats
  };
  for (const std::vector<Point>& vertices : obstacles) {
    INFO(vertices.size() << " vertices from " << vertices.front().transpose() << " by " << vertices[1].transpose());
    const std::vector<Point> reversed(vertices.rbegin(), vertices.rend());
    CHECK(told(vertices, start, goal).empty());
    CHECK(told(reversed, start, goal) == std::vector<int>{1});
    // A room with the goal in it, which nobody can enter if it is closed; a room with the start in it.
    const bool is_closed = vertices.front() == vertices.back();
    CHECK(told(reversed, start, Box(Point(1.2, 0.1), Point(5, 5))).size() == (is_closed ? 1 : 0));
    CHECK(told(reversed, Box(Point(1.2, vertices[1].y())), goal).empty());
  }
  // A vault over a trench that both are in.
  const Chain trench = chain({{-4, 0}, {-1.5, 0}, {-1.5, -1}, {7.5, -1}, {7.5, 0}, {10, 0}});
  const Terrain vaulted({trench, chain({{8, 0.1}, {8, 2}, {-2, 2}, {-2, 0.1}})});
  const Box below(Point(0, -1));
  CHECK(obstacles_inside_out(vaulted, {&below, 1}, Box(Point(5, -0.7), Point(6, -0.3)), 0.2).empty());
  CHECK(told({{3, 2}, {3, 1}, {1, 1}, {1, 2}}, start, goal).empty());              // a ceiling with its sides
  CHECK(told({{3, 1}, {1, 1}}, start, goal).empty());                              // without
  CHECK(told({{1.4, 0.3}, {1.4, 0.5}, {1, 0.5}, {1, 0.3}}, start, goal).empty());  // ends too high over the floor
  CHECK(told({{1, 0.15}, {1.2, 0.1}, {1.4, 0.15}}, start, goal).empty());  // ground with a hollow over the floor
  // Every one is told, and what is between them is not.
  const Chain one = chain({{1, 0.5}, {1.4, 0.5}, {1.4, 1}, {1, 1}, {1, 0.5}});
  const Chain right_way = chain({{2, 0.5}, {2, 1}, {2.4, 1}, {2.4, 0.5}, {2, 0.5}});
  const Chain other = chain({{3.4, 0.1}, {3.4, 0.3}, {3, 0.3}, {3, 0.1}});
  CHECK(obstacles_inside_out(Terrain({one, floor, right_way, other}), {&start, 1}, goal, 0.2) == std::vector{0, 3});
}

TEST_CASE("An area is in solid ground if it has no ground in it and nothing but backs around", "[back_faces]") {
  const auto solid = [](std::vector<Chain> chains, const Point& low, const Point& high) {
    return solid_around(Terrain(std::move(chains)), {low, high});
  };
  const Chain ceiling = chain({{3, 2}, {3, 1}, {1, 1}, {1, 2}});
  const Chain pit = chain({{-1, 0}, {1, 0}, {1, -1}, {2, -1}, {2, 0}, {3, 0}});
  CHECK(solid({ground, ceiling}, {0, -0.2}, {0.5, -0.1}) == 0);
  CHECK(solid({ground, ceiling}, {0, -50}, {0, -50}) == 0);  // a point
  CHECK(solid({ground, ceiling}, {1.5, 1.2}, {2, 1.5}) == 1);
  CHECK(solid({pit}, {0, -0.5}, {0.5, -0.1}) == 0);
  CHECK_FALSE(solid({ground, ceiling}, {0, -10}, {0.5, 0.01}));  // the ground is in it
  CHECK_FALSE(solid({ground, ceiling}, {0, -10}, {0.5, 0}));     // at its border
  CHECK_FALSE(solid({ground, ceiling}, {0, -10}, {1.9, 0.02}));  // a slope cuts its corner
  CHECK_FALSE(solid({pit}, {0, -10}, {3, -0.1}));                // the floor of a pit is
  CHECK_FALSE(solid({pit}, {1.2, -0.5}, {1.5, -0.1}));           // in the pit
  CHECK_FALSE(solid({ground, ceiling}, {1.5, 0.5}, {2, 0.6}));   // between floor and ceiling
  CHECK_FALSE(solid({ground}, {-3, -2}, {-2, -1}));              // beside all ground
  // Under a thin shelf its back is seen above, but ground below; in a chimney with a lid, its walls.
  CHECK_FALSE(solid({ground, chain({{-0.5, 1}, {0.5, 1}})}, {0, 0.5}, {0.1, 0.6}));
  const std::vector<Chain> chimney{chain({{0, 3}, {0, 0}}), chain({{1, 0}, {1, 3}}), chain({{-1, 4}, {2, 4}})};
  CHECK_FALSE(solid(chimney, {0.4, 2}, {0.6, 2.5}));
}
