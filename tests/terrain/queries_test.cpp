// Every geometric query against a plain loop over all segments, by formulas of its own.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "terrain/terrain.hpp"
#include "tests/terrain/lattice_terrain.hpp"

namespace surefoot::terrain {
namespace {

using lattice::Edge;
using lattice::Generator;
using lattice::LatticeTerrain;
using lattice::Vertex;
using Real = long double;

struct Setting {
  LatticeTerrain plan;
  Terrain terrain;
};

/// Small and crowded, so that lines touch vertices and run along segments; or wide.
Setting random_setting(Generator& generator, int i) {
  LatticeTerrain plan = i % 3 == 0   ? generator.terrain(3, 8, 8, 6)
                        : i % 3 == 1 ? generator.terrain(4, 25, 64, 24)
                                     : generator.terrain(1, 60, 20, 300);
  Terrain terrain = plan.build();
  return {std::move(plan), std::move(terrain)};
}

Vertex any_vertex(Generator& generator, const LatticeTerrain& plan, std::int64_t margin) {
  const auto& edge = plan.edges[generator.integer(0, static_cast<std::int64_t>(plan.edges.size()) - 1)];
  return {edge.a.x + generator.integer(-margin, margin), edge.a.y + generator.integer(-margin, margin)};
}

Point off_lattice(Generator& generator, Vertex v) {
  return to_point(v) + Point(generator.real(-0.2, 0.2), generator.real(-0.2, 0.2));
}

TEST_CASE("a straight line is blocked exactly when integers say it meets a segment", "[queries]") {
  Generator generator(11);
  int blocked = 0, open = 0;
  for (int i = 0; i < 900; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    for (int query = 0; query < 40; ++query) {
      const Vertex p = any_vertex(generator, plan, 12);
      const Vertex q = query % 5 == 0 ? p : any_vertex(generator, plan, 12);
      const bool expected = std::any_of(plan.edges.begin(), plan.edges.end(),
                                        [&](const Edge& e) { return lattice::meet(p, q, e.a, e.b); });
      ++(expected ? blocked : open);
      CAPTURE(i, query, p.x, p.y, q.x, q.y);
      REQUIRE(terrain.blocks(to_point(p), to_point(q)) == expected);
      if (expected) REQUIRE(terrain.distance(to_point(p), to_point(q), 1) < 1e-15);
    }
  }
  CHECK(blocked > 3000);
  CHECK(open > 3000);
}

TEST_CASE("a leg is free exactly when it arrives from the free side and meets no other segment", "[queries]") {
  Generator generator(12);
  int free = 0, behind = 0, cut = 0;
  for (int i = 0; i < 900; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    for (int query = 0; query < 40; ++query) {
      const Edge own = plan.edges[generator.integer(0, static_cast<std::int64_t>(plan.edges.size()) - 1)];
      const Vertex middle{(own.a.x + own.b.x) / 2, (own.a.y + own.b.y) / 2};
      const Vertex com = any_vertex(generator, plan, 20);
      Foothold foot;
      foot.chain = own.chain;
      foot.segment = own.index;
      foot.position = to_point(middle);
      const bool faces = lattice::cross(own.b - own.a, com - own.a) > 0;
      const bool meets = std::any_of(plan.edges.begin(), plan.edges.end(), [&](const Edge& e) {
        return !(e.chain == own.chain && e.index == own.index) && lattice::meet(com, middle, e.a, e.b);
      });
      ++(!faces ? behind : meets ? cut : free);
      CAPTURE(i, query, com.x, com.y, middle.x, middle.y);
      REQUIRE(terrain.leg_is_free(to_point(com), foot) == (faces && !meets));
    }
  }
  CHECK(free > 1000);
  CHECK(behind > 1000);
  CHECK(cut > 1000);
}

/// Least distance from points of p-q to a-b, which is convex along p-q: by ternary search.
Real searched_distance(const Point& p, const Point& q, const Point& a, const Point& b) {
  const auto to_segment = [&](Real t) {
    const Real x = p.x() + t * (Real(q.x()) - p.x()) - a.x(), y = p.y() + t * (Real(q.y()) - p.y()) - a.y();
    const Real ex = Real(b.x()) - a.x(), ey = Real(b.y()) - a.y();
    // Turn the segment onto the x axis.
    const Real length = std::hypot(ex, ey);
    const Real along = (x * ex + y * ey) / length, across = (ex * y - ey * x) / length;
    return std::hypot(std::max({-along, along - length, Real(0)}), across);
  };
  Real low = 0, high = 1;
  for (int k = 0; k < 150; ++k) {
    const Real left = low + (high - low) / 3, right = high - (high - low) / 3;
    if (to_segment(left) <= to_segment(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return std::min({to_segment(low), to_segment(0), to_segment(1)});
}

TEST_CASE("the distance of points and lines is the least over all segments", "[queries]") {
  Generator generator(13);
  for (int i = 0; i < 150; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    for (int query = 0; query < 8; ++query) {
      const Point p = off_lattice(generator, any_vertex(generator, plan, 30));
      const Point q = query % 2 ? p : Point(p + Point(generator.real(-1, 1), generator.real(-1, 1)));
      Real expected = std::numeric_limits<Real>::infinity();
      for (const Edge& e : plan.edges) {
        expected = std::min(expected, searched_distance(p, q, to_point(e.a), to_point(e.b)));
      }
      const double exact = static_cast<double>(expected);
      constexpr double tolerance = 1e-12;  // [m]; the search ends far below it
      CAPTURE(i, query, p, q, exact);
      REQUIRE(terrain.distance(p, q, std::numeric_limits<double>::infinity()) == Approx(exact).margin(tolerance));
      REQUIRE(terrain.distance(q, p, exact + 0.01) == Approx(exact).margin(tolerance));
      REQUIRE(terrain.distance(p, q, exact / 2) >= exact / 2 - tolerance);
      if (p == q) REQUIRE(terrain.distance(p, 1e3) == Approx(exact).margin(tolerance));
    }
  }
}

TEST_CASE("stretches within reach hold exactly the footholds at a legal distance on a facing side", "[queries]") {
  Generator generator(14);
  int inside = 0, outside = 0;
  for (int i = 0; i < 600; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    const Point centre = off_lattice(generator, any_vertex(generator, plan, 40));
    const double least = i % 4 == 0 ? 0 : generator.real(0, 0.4), greatest = least + generator.real(0, 0.8);
    const auto stretches = terrain.stretches_within(centre, least, greatest);
    for (std::size_t k = 1; k < stretches.size(); ++k) {
      const auto &l = stretches[k - 1], &r = stretches[k];
      REQUIRE((l.segment->chain < r.segment->chain || (l.segment->chain == r.segment->chain && l.s_end <= r.s_begin)));
    }
    for (const Stretch& stretch : stretches) {
      const Segment& own = *stretch.segment;
      REQUIRE(own.surface.foothold);
      REQUIRE(stretch.s_begin < stretch.s_end);
      REQUIRE(stretch.s_begin >= own.s_begin);
      REQUIRE(stretch.s_end <= own.s_begin + own.length);
    }
    for (const Segment& segment : terrain.segments()) {
      const bool faces = Real(segment.b.x() - segment.a.x()) * (Real(centre.y()) - segment.a.y()) >
                         Real(segment.b.y() - segment.a.y()) * (Real(centre.x()) - segment.a.x());
      for (int k = 0; k < 25; ++k) {
        const double s = segment.s_begin + segment.length * generator.real(0, 1);
        const bool listed = std::any_of(stretches.begin(), stretches.end(), [&](const Stretch& stretch) {
          return stretch.segment == &segment && stretch.s_begin < s && s < stretch.s_end;
        });
        const auto foot = terrain.foothold_at(segment.chain, s);
        REQUIRE(foot.has_value() == segment.surface.foothold);
        if (!foot) {
          REQUIRE_FALSE(listed);
          continue;
        }
        const double distance = std::hypot(foot->position.x() - centre.x(), foot->position.y() - centre.y());
        CAPTURE(i, centre, least, greatest, s, distance);
        if (listed) {
          REQUIRE(distance >= least);  // without tolerance: stretches are shrunk by their rounding errors
          REQUIRE(distance <= greatest);
          REQUIRE(faces);
          ++inside;
        } else {
          constexpr double shrunk = 1e-12;  // [m], above the rounding slack
          REQUIRE_FALSE((faces && distance > least + shrunk && distance < greatest - shrunk));
          ++outside;
        }
      }
    }
  }
  CHECK(inside > 10000);
  CHECK(outside > 10000);
}

TEST_CASE("the ends of a stretch are where the closed form says", "[queries]") {
  const Terrain terrain({Chain{{{-5, 0}, {5, 0}}, {{0.5, true}}}});
  const auto stretches = terrain.stretches_within(Point(1, 0.6), 1, 1.5);  // sqrt(1 - 0.36) = 0.8
  REQUIRE(stretches.size() == 2);
  const double outer = std::sqrt(2.25 - 0.36);
  CHECK(stretches[0].s_begin == Approx(6 - outer).epsilon(1e-13));
  CHECK(stretches[0].s_end == Approx(5.2).epsilon(1e-13));
  CHECK(stretches[1].s_begin == Approx(6.8).epsilon(1e-13));
  CHECK(stretches[1].s_end == Approx(6 + outer).epsilon(1e-13));
  CHECK(terrain.stretches_within(Point(1, 0.6), 0.59, 1.5).size() == 1);
  CHECK(terrain.stretches_within(Point(1, 0.6), 0, std::numeric_limits<double>::infinity()).size() == 1);
  CHECK(terrain.stretches_within(Point(1, -0.6), 0, 1.5).empty());  // from behind
  CHECK(terrain.stretches_within(Point(1, 0), 0, 1.5).empty());     // from the surface itself
  CHECK(terrain.stretches_within(Point(1, 0.6), 0, 0.6).empty());   // a single point is no stretch
  CHECK(terrain.stretches_within(Point(1, 0.6), 1, 0.5).empty());
}

/// Whether a-b meets the sector, by angles; nothing when that hangs on less than the margin.
std::optional<bool> meets_sector(const Point& centre, double radius, Real begin, Real sweep, const Point& a,
                                 const Point& b) {
  constexpr Real margin = 1e-9L, turn = 2 * std::numbers::pi_v<Real>;
  const Real ax = Real(a.x()) - centre.x(), ay = Real(a.y()) - centre.y();
  const Real ex = Real(b.x()) - a.x(), ey = Real(b.y()) - a.y();
  const Real length = std::hypot(ex, ey), foot = -(ax * ex + ay * ey) / length, height = (ex * ay - ey * ax) / length;
  const Real nearest = std::hypot(height, std::max({-foot, foot - length, Real(0)}));
  if (std::abs(nearest - radius) < margin || nearest < margin) return std::nullopt;
  if (nearest > radius) return false;
  const Real half = std::sqrt(std::max(radius * Real(radius) - height * height, Real(0)));
  const Real from = std::max(foot - half, Real(0)), to = std::min(foot + half, length);
  const auto angle = [&](Real s) { return std::atan2(ay + s / length * ey, ax + s / length * ex); };
  // Seen from the centre the piece spans less than half a turn, from `first` on, counter-clockwise.
  Real first = angle(from), span = std::remainder(angle(to) - first, turn);
  if (span < 0) first += span, span = -span;
  if (turn / 2 - span < 1e-6L) return std::nullopt;
  Real offset = std::fmod(first - begin, turn);
  if (offset < 0) offset += turn;
  for (const Real doubtful : {offset, offset - turn, offset - sweep, offset + span - turn}) {
    if (std::abs(doubtful) < margin) return std::nullopt;
  }
  return offset <= sweep || offset + span >= turn;
}

TEST_CASE("a sector is free exactly when no segment reaches into it, whatever its opening", "[queries]") {
  Generator generator(15);
  int free = 0, taken = 0, doubtful = 0;
  for (int i = 0; i < 1200; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    for (int query = 0; query < 12; ++query) {
      const Point centre = off_lattice(generator, any_vertex(generator, plan, 30));
      const Point from(generator.real(-1, 1), generator.real(-1, 1)), to(generator.real(-9, 9), generator.real(-9, 9));
      const double radius = generator.real(0, 1);
      constexpr Real turn = 2 * std::numbers::pi_v<Real>;
      const Real begin = std::atan2(Real(from.y()), Real(from.x()));
      Real sweep = std::fmod(std::atan2(Real(to.y()), Real(to.x())) - begin, turn);
      if (sweep < 0) sweep += turn;
      bool meets = false, sure = true;
      for (const Edge& e : plan.edges) {
        const auto answer = meets_sector(centre, radius, begin, sweep, to_point(e.a), to_point(e.b));
        if (answer) meets = meets || *answer;
        sure = sure && answer;
      }
      if (!meets && !sure) {
        ++doubtful;
        continue;
      }
      ++(meets ? taken : free);
      CAPTURE(i, query, centre, radius, from, to);
      REQUIRE(terrain.sector_is_free(centre, radius, from, to) == !meets);
    }
  }
  CHECK(free > 1000);
  CHECK(taken > 1000);
  CHECK(doubtful < 100);
}

TEST_CASE("a sector knows its degenerate openings and that touching is not free", "[queries]") {
  const Terrain terrain({Chain{{{-5, 0}, {5, 0}}, {{0.5, true}}}});
  const Point centre(0, 1), right(1, 0), left(-1, 0), down(0, -1), up(0, 1);
  CHECK_FALSE(terrain.sector_is_free(centre, 1, left, right));  // half disc, touches below
  CHECK(terrain.sector_is_free(centre, 0.99, left, right));
  CHECK(terrain.sector_is_free(centre, 3, right, left));       // the half disc above
  CHECK_FALSE(terrain.sector_is_free(centre, 1, down, down));  // one ray, its end touches
  CHECK(terrain.sector_is_free(centre, 0.99, down, down));
  CHECK(terrain.sector_is_free(centre, 3, up, 7 * up));         // one ray
  CHECK_FALSE(terrain.sector_is_free(centre, 1.5, up, right));  // the long way round, over left and down
  CHECK(terrain.sector_is_free(centre, 1.5, right, up));
  CHECK_FALSE(terrain.sector_is_free(Point(0, 0), 0, right, right));  // the centre touches
  CHECK_FALSE(terrain.sector_is_free(Point(0, 0), 0.1, up, up));
  CHECK(terrain.sector_is_free(Point(0, 0.25), 0, down, down));
  CHECK(terrain.sector_is_free(Point(4.5, 0.5), 0.6, right, up));
  CHECK_FALSE(terrain.sector_is_free(Point(4.5, 0.5), 0.6, Point(1, -2), up));
}

TEST_CASE("footholds at x are all points of walkable segments above and below, by height", "[queries]") {
  Generator generator(16);
  std::size_t several = 0;
  for (int i = 0; i < 600; ++i) {
    const auto [plan, terrain] = random_setting(generator, i);
    const double x = to_point(any_vertex(generator, plan, 20)).x() + (i % 2 ? 0 : generator.real(-0.01, 0.01));
    const auto found = terrain.footholds_at_x(x);
    std::size_t expected = 0;
    for (const Segment& g : terrain.segments()) expected += g.surface.foothold && (g.a.x() - x) * (g.b.x() - x) < 0;
    REQUIRE(found.size() == expected);
    several += found.size() > 1;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Foothold& foot = found[k];
      CHECK(foot.position.x() == x);
      if (k > 0) CHECK(found[k - 1].position.y() <= foot.position.y());
      const auto same = terrain.foothold_at(foot.chain, foot.s);
      REQUIRE(same);
      CHECK(same->segment == foot.segment);
      CHECK((same->position - foot.position).norm() < 1e-13);
      CHECK(same->normal == foot.normal);
      CHECK(same->friction == foot.friction);
    }
  }
  CHECK(several > 100);
}

TEST_CASE("a long terrain answers as a short piece of it does", "[queries]") {
  constexpr int count = 100000;
  Chain chain;
  for (int i = 0; i <= count; ++i) chain.vertices.emplace_back(0.1 * i, 0.01 * static_cast<int>(i * 7919LL % 13));
  chain.surfaces.assign(count, Surface{0.6, true});
  const Terrain terrain({chain});
  REQUIRE(terrain.segments().size() == count);
  for (const int at : {50, 31234, 99900}) {
    Chain piece{{chain.vertices.begin() + at - 30, chain.vertices.begin() + at + 31}, {}};
    piece.surfaces.assign(60, Surface{0.6, true});
    const Terrain part({piece});
    const Point com = chain.vertices[at] + Point(0.03, 0.5);
    CHECK(terrain.distance(com, 1) == part.distance(com, 1));
    const auto all = terrain.stretches_within(com, 0.2, 0.8), some = part.stretches_within(com, 0.2, 0.8);
    REQUIRE(all.size() == some.size());
    for (std::size_t k = 0; k < all.size(); ++k) CHECK(all[k].segment->index == some[k].segment->index + at - 30);
    const auto middle = [](const Segment& segment) { return segment.s_begin + segment.length / 2; };
    CHECK(terrain.leg_is_free(com, *terrain.foothold_at(0, middle(*all.front().segment))) ==
          part.leg_is_free(com, *part.foothold_at(0, middle(*some.front().segment))));
  }
  CHECK(terrain.blocks(Point(0, 1), Point(0.1 * count, -1)));
  CHECK_FALSE(terrain.blocks(Point(0, 0.2), Point(0.1 * count, 0.13)));
}

}  // namespace
}  // namespace surefoot::terrain
