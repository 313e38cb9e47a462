// Which side of the terrain pictures show as solid, and how much of it.
#include "gaits/terrain_picture.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "fixtures.hpp"
#include "gaits/plan_page.hpp"

namespace {

using namespace surefoot::gaits;
using Eigen::Vector2d;
using surefoot::gaits::testing::chain;
using surefoot::gaits::testing::scene_on;

/// Whether a ray to the right of the point crosses the borders of an odd number of times.
bool is_filled(const std::vector<Polyline>& ground, const Vector2d& p) {
  for (const Polyline& polygon : ground) {
    int crossings = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      crossings += a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x();
    }
    if (crossings % 2 == 1) return true;
  }
  return false;
}

struct Case {
  std::vector<std::vector<Vector2d>> chains;
  std::vector<Vector2d> solid, free;
};

}  // namespace

TEST_CASE("pictures fill what is solid", "[plan_svg]") {
  std::vector<Case> cases{
      {{{{0, 4}, {0, 0}, {1, 0}, {1, 4}}}, {{-0.5, 2}, {1.5, 2}, {0.5, -0.5}}, {{0.5, 2}}},  // a chimney in one piece
      {{{{1, -4}, {1, 0}, {0, 0}, {0, -4}}}, {{-0.5, -2}, {1.5, -2}, {0.5, 0.5}}, {{0.5, -2}}},  // a shaft from below
      {{{{0, 1}, {0, 0}, {5, 0}, {5, 3}}}, {{-0.5, 0.5}, {5.5, 2}, {2, -0.5}}, {{2, 0.5}}},      // unequal walls
      {{{{-2, 0}, {4, 0}, {4, 1.5}, {-2, 1.5}, {-2, 0}}}, {{1, -0.5}, {1, 2}, {4.5, 1}, {-2.5, 1}}, {{1, 1}}},  // room
      {{{{-2, 0}, {-2, 1.5}, {4, 1.5}, {4, 0}, {-2, 0}}}, {{1, 1}}, {{1, -0.5}, {1, 2}, {4.5, 1}, {-2.5, 1}}},  // block
      {{{{-2, 0}, {4, 0}}, {{4, 1}, {-2, 1}}}, {{1, -0.5}, {1, 1.5}}, {{1, 0.5}}},  // a tunnel
      {{{{-2, 0}, {4, 0}, {4, 1.5}, {-2, 1.5}, {-2, 0}}, {{1, 1}, {2, 1}, {2, 0.5}, {1, 0.5}, {1, 1}}},
       {{1, -0.5}, {1.5, 0.7}},
       {{0.5, 0.5}}},  // a block in a room
      // Rims that face each other, of two stones; a room with a door and a jar, whose openings cannot be closed.
      {{{{-1, 0.1}, {-1, 0}, {1, 0}, {1, 0.1}}, {{1.4, 0.1}, {1.4, 0}, {3, 0}, {3, 0.1}}},
       {{0, -0.5}, {2, -0.5}},
       {{0, 0.05}, {2, 0.05}, {1.2, 0.05}, {1.2, -0.5}}},
      {{{{0, 0.5}, {0, 0}, {4, 0}, {4, 2}, {0, 2}, {0, 1.7}}}, {}, {{2, 1}, {3.9, 1}, {0.1, 1.8}}},
      {{{{0.5, 1}, {0, 1}, {0, 0}, {1.5, 0}, {1.5, 1}, {1, 1}}}, {}, {{0.1, 0.5}, {1.4, 0.5}, {0.75, 0.5}}},
      {{{{-1, 0}, {6, 0}}, {{1, 0.5}, {2, 0.5}, {2, 1}, {1, 1}, {1, 0.5}}}, {{1, -0.5}}, {{1, 0.2}}},  // inside out
  };
  // A cave whose roof ends exactly above a step, and above a vertex of level ground.
  cases.push_back({{{{-1, 0}, {2, 0}, {2, -0.3}, {4, -0.3}, {4, 1.5}, {2, 1.5}}}, {}, {{3, 1}, {2.5, -0.2}, {0, 0.5}}});
  cases.push_back({{{{-1, 0}, {2, 0}, {4, 0}, {4, 1.5}, {2, 1.5}}}, {}, {{3, 1}, {0, 0.5}}});
  // A wedge that reaches farther left than the chain begins; a cave at the end of very many segments.
  cases.push_back({{{{0, 2}, {4, 2}, {4, 1.6}, {-3, 0}, {9, 0}}}, {}, {{-1, 0.2}, {1, 0.5}, {2, 3}}});
  std::vector<Vector2d> fine;
  for (int i = 0; i < 5000; ++i) fine.emplace_back(-1 + 1e-3 * i, 0);
  fine.insert(fine.end(), {{5, 0}, {5, 1.5}, {3, 1.5}});
  cases.push_back({{fine}, {}, {{4, 1}, {0, 0.5}}});
  // A room, whichever corner it begins at.
  std::vector<Vector2d> room{{-2, 0}, {4, 0}, {4, 1.5}, {-2, 1.5}};
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(room.begin(), room.begin() + 1, room.end());
    std::vector<Vector2d> closed = room;
    closed.push_back(room.front());
    cases.push_back({{closed}, {{1, -0.5}, {1, 2}, {4.5, 1}, {-2.5, 1}}, {{1, 1}}});
  }
  for (std::size_t k = 0; k < cases.size(); ++k) {
    CAPTURE(k);
    std::vector<surefoot::terrain::Chain> chains;
    for (const auto& vertices : cases[k].chains) chains.push_back(chain(vertices));
    const Scene scene = scene_on(chains);
    const auto ground = TerrainPicture(scene.terrain).ground_in(Eigen::AlignedBox2d(Vector2d(-3, -3), Vector2d(7, 5)));
    for (const Vector2d& p : cases[k].solid) CHECK(is_filled(ground, p));
    for (const Vector2d& p : cases[k].free) CHECK_FALSE(is_filled(ground, p));
  }
}

TEST_CASE("the ceiling of a tunnel is in the picture, with a plan and without", "[plan_svg]") {
  const auto top = [](double ceiling, bool with_plan) {
    const Scene scene = scene_on({chain({{-9, 0}, {9, 0}}), chain({{9, ceiling}, {-9, ceiling}})});  // reach 0.9
    Plan plan;
    if (with_plan) {
      plan.status = Status::solved;
      plan.stances = {Stance{scene.start.feet, {0, 0.5}, 2, ""}};
    }
    return contents(scene, plan).max().y();
  };
  for (const double ceiling : {0.8, 1.3}) {
    CHECK(top(ceiling, true) == Approx(ceiling));
    CHECK(top(ceiling, false) == Approx(ceiling));
  }
  CHECK(top(1.5, true) == Approx(0.5));
  CHECK(top(1.7, false) == Approx(1.7));  // of a COM 0.9 m above the feet
  CHECK(top(1.9, false) == Approx(0));
}
