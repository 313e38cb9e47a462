// R_SS(W) as half-planes and as a polygon, against membership decided by the LP of contact forces and by rationals.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/agreement.hpp"
#include "tests/support/direct_reference.hpp"

using namespace surefoot::testing;
using surefoot::stability::HalfPlane;
using surefoot::stability::RobustOracle;

namespace {

using Points = std::vector<Eigen::Vector2d>;

const Points window{{-2, -2}, {2, -2}, {2, 3}, {-2, 3}};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The least signed distance to the polygon's sides, positive inside.
double depth(const Points& polygon, const Eigen::Vector2d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d side = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (side.norm() > 0) least = std::min(least, cross(side, x - polygon[i]) / side.norm());
  }
  return polygon.size() < 3 ? -1 : least;
}

}  // namespace

TEST_CASE("The half-planes and the polygon of R_SS(W) hold exactly the points in equilibrium", "[polygon]") {
  const std::uint64_t seed = 77;
  Sampler sampler(seed);
  int inside = 0, outside = 0;
  for (int round = 0; round < 40; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " kind " << name(kind) << "\n" << sample.json());
      const RobustOracle oracle = oracle_of(sample);
      const DirectReference<double> reference(sample);
      const Points polygon = oracle.equilibrium_polygon(window);
      const std::vector<HalfPlane> half_planes = oracle.equilibrium_half_planes();
      for (int k = 0; k < 30; ++k) {
        const Eigen::Vector2d x = sampler.com_near(sample.contacts);
        const double sigma = reference.equilibrium_factor(x).value;
        const bool expected = reference.equilibrium(x);
        if (std::abs(sigma - 1) < 1e-9 || (sigma > 0 && sigma < 1e-9)) continue;
        const bool in_all = std::all_of(half_planes.begin(), half_planes.end(),
                                        [&](const HalfPlane& half) { return half.normal.dot(x) + half.offset > 0; });
        if (reference.structure().full_rank) CHECK(in_all == expected);
        if (depth(window, x) > 1e-9 && std::abs(depth(polygon, x)) > 1e-9) CHECK((depth(polygon, x) > 0) == expected);
        expected ? ++inside : ++outside;
      }
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()],
                              &c = polygon[(i + 2) % polygon.size()];
        CHECK(cross(b - a, c - b) >= -1e-12);
        CHECK(depth(window, a) >= -1e-9);
      }
    }
  }
  CHECK(inside > 1000);
  CHECK(outside > 1000);
}

TEST_CASE("On level ground R_SS(W) is the trapezium computed by hand", "[polygon]") {
  // 0 < x - p h + q < 1 at the corners of W: kappa |h| + nu < x < 1 - kappa |h| - nu.
  SamplePosture sample;
  sample.contacts = {{{0, 0}, {0, 1}, 1}, {{1, 0}, {0, 1}, 1}};
  sample.rho = 0.5;
  sample.box = {0.25, 0.125};
  const Points square{{-1, 0}, {2, 0}, {2, 1}, {-1, 1}};
  const Points polygon = oracle_of(sample).equilibrium_polygon(square);
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) area += cross(polygon[i], polygon[(i + 1) % polygon.size()]) / 2;
  CHECK(area == Approx((0.75 + 0.25) / 2 * 1).epsilon(1e-12));
  // Too much friction asked: empty.
  sample.box.kappa = 1.5;
  CHECK(oracle_of(sample).equilibrium_polygon(square).empty());
  // Bracing: the window itself.
  sample.contacts = {{{0, 0}, {0, 1}, 0.5}, {{0, 1}, {0, -1}, 0.5}};
  const Points whole = oracle_of(sample).equilibrium_polygon(square);
  double whole_area = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) whole_area += cross(whole[i], whole[(i + 1) % whole.size()]) / 2;
  CHECK(whole_area == Approx(3).epsilon(1e-12));
}
