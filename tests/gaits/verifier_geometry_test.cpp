// The verifier's own geometry: cases that can be checked by eye, and sectors against a fan of rays.
#include "gaits/verifier_geometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace surefoot::gaits::bare;

TEST_CASE("lines that touch meet, lines that nearly touch do not", "[verifier]") {
  CHECK(meet({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  CHECK(meet({0, 0}, {2, 2}, {1, 1}, {3, 0}));          // an end on the other line
  CHECK(meet({0, 0}, {1, 0}, {1, 0}, {1, 1}));          // a common end
  CHECK(meet({0, 0}, {2, 0}, {1, 0}, {3, 0}));          // overlapping on one line
  CHECK(meet({1, 0}, {1, 0}, {0, 0}, {2, 0}));          // a point on a line
  CHECK_FALSE(meet({0, 0}, {1, 0}, {1.5, 0}, {3, 0}));  // apart on one line
  CHECK_FALSE(meet({0, 0}, {2, 2}, {1.0000001, 1}, {3, 0}));
  CHECK_FALSE(meet({0, 0}, {1, 0}, {0, 1e-300}, {1, 1e-300}));
  CHECK_FALSE(meet({1, 1}, {1, 1}, {0, 0}, {2, 0}));
}

TEST_CASE("distances of points and lines are those of school geometry", "[verifier]") {
  CHECK(distance({0, 0}, {4, 0}, {2, 3}, {2, 5}) == 3);
  CHECK(distance({0, 0}, {4, 0}, {7, 4}, {9, 9}) == 5);  // 3-4-5 from the end
  CHECK(distance({0, 0}, {4, 0}, {2, -1}, {2, 1}) == 0);
  const Distances along = distances_along({1, 2}, {0, 0}, {4, 0});
  CHECK(along.least == 2);
  CHECK(along.lambda_least == 0.25);
  CHECK(along.greatest == std::hypot(3.0, 2.0));
  CHECK(along.lambda_greatest == 1);
  const Distances point = distances_along({3, 4}, {0, 0}, {0, 0});
  CHECK(point.least == 5);
  CHECK(point.greatest == 5);
}

TEST_CASE("a bar meets a sector that it only sweeps across, whichever way it runs", "[verifier]") {
  // The quarter from -45 to 45 degrees about the origin, radius 2; the bar x = 1 ends outside it on both sides.
  const Point from(1, -1), to(1, 1);
  CHECK(meets_sector({0, 0}, 2, from, to, {1, -1.5}, {1, 1.5}));
  CHECK(meets_sector({0, 0}, 2, from, to, {1, 1.5}, {1, -1.5}));
  // The complement holds the bar's ends; the bar beyond the radius meets neither.
  CHECK(meets_sector({0, 0}, 2, to, from, {1, -1.5}, {1, 1.5}));
  CHECK_FALSE(meets_sector({0, 0}, 0.75, from, to, {1, -1.5}, {1, 1.5}));
  CHECK_FALSE(meets_sector({0, 0}, 0.75, to, from, {1, -1.5}, {1, 1.5}));
  // Behind the quarter, only the complement is met.
  CHECK_FALSE(meets_sector({0, 0}, 2, from, to, {-1, -1.5}, {-1, 1.5}));
  CHECK(meets_sector({0, 0}, 2, to, from, {-1, 1.5}, {-1, -1.5}));
  // Inside the circle altogether.
  CHECK(meets_sector({0, 0}, 2, from, to, {0.5, 0}, {0.75, 0.25}));
  CHECK_FALSE(meets_sector({0, 0}, 2, from, to, {-0.5, 0}, {-0.75, 0.25}));
}

TEST_CASE("a sector is met iff one of many points of the bar lies in it", "[verifier]") {
  std::mt19937 random(11);
  const auto dice = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  int met = 0, missed = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Point a(dice(-2, 2), dice(-2, 2)), b(dice(-2, 2), dice(-2, 2)), centre(dice(-1, 1), dice(-1, 1));
    const double radius = dice(0.2, 1.5), begin = dice(-3, 3), opening = dice(0.1, 6);
    // Points at most 2.9 mm apart and 0.1 m from the centre: the bar turns by less than 0.03 rad between two of them.
    const auto holds_a_point = [&](double margin, double angle_margin) {
      for (int i = 0; i <= 2000; ++i) {
        const Point p = a + (i / 2000.0) * (b - a) - centre;
        const double angle = std::remainder(std::atan2(p.y(), p.x()) - begin - opening / 2, 2 * std::numbers::pi);
        if (p.norm() <= radius + margin && std::abs(angle) <= opening / 2 + angle_margin) return true;
      }
      return false;
    };
    const bool larger = holds_a_point(0.003, 0.03), smaller = holds_a_point(-0.003, -0.03);
    if (distances_along(centre, a, b).least < 0.1 || larger != smaller) continue;
    const Point from(std::cos(begin), std::sin(begin)), to(std::cos(begin + opening), std::sin(begin + opening));
    INFO("trial " << trial);
    CHECK(meets_sector(centre, radius, from, to, a, b) == larger);
    (larger ? met : missed)++;
  }
  CHECK(met > 300);
  CHECK(missed > 300);
}

TEST_CASE("terrain near a box is all that reaches into it", "[verifier]") {
  const surefoot::terrain::Terrain terrain(
      {{{{0, 0}, {1, 0}, {2, 1}, {3, 1}}, {{0.5, true}, {0.5, true}, {0.5, true}}}});
  CHECK(Strips(terrain).near({{0.5, 0.5}}, 0.4).empty());
  CHECK(Strips(terrain).near({{0.5, 0.5}}, 0.5).size() == 2);
  CHECK(Strips(terrain).near({{-1, -1}, {4, 4}}, 0).size() == 3);
}
