// Regions of frictional stability against closed forms, and against verdicts by brute force of all unknowns.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "stability/frictional_region.hpp"
#include "tests/support/mode_brute_force.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::stability;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using surefoot::testing::ModeBruteForce;

namespace {

std::vector<Contact> vee(double degrees, double friction) {
  const double a = degrees * M_PI / 180;
  return {{{-0.5, 0}, {std::sin(a), std::cos(a)}, friction}, {{0.5, 0}, {-std::sin(a), std::cos(a)}, friction}};
}

FrictionalRegionOptions within(double half_width, double half_height) {
  FrictionalRegionOptions options;
  options.window = AlignedBox2d(Vector2d(-half_width, -half_height), Vector2d(half_width, half_height));
  return options;
}

/// (10) as printed [OR-H], unit normals.
bool printed_clattering(const std::vector<Contact>& contacts, const Vector2d& com, double rho, double e) {
  double b[2];
  Vector2d n[2];
  for (int i : {0, 1}) {
    n[i] = contacts[i].normal.normalized();
    b[i] = Vector2d(n[i].y(), -n[i].x()).dot(contacts[i].position - com);
  }
  const double x = b[0] * b[1] + n[0].dot(n[1]) * rho * rho;
  const double first = -x / (b[0] * b[0] + rho * rho), second = -x / (b[1] * b[1] + rho * rho);
  return first > 0 && std::sqrt(first * second) > (std::cbrt(e) + std::cbrt(e * e)) / (1 + e);
}

bool contains(const RegionPolygon& polygon, const Vector2d& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * ((p.y() - a.y()) / (b.y() - a.y())))
      inside = !inside;
  }
  return inside;
}

double distance(const RegionPolygon& polygon, const Vector2d& p) {
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &a = polygon[k], way = polygon[(k + 1) % polygon.size()] - a;
    const double t = way.squaredNorm() > 0 ? std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (p - a - t * way).norm());
  }
  return least;
}

enum class Where { inside, outside, near };

/// Near: within the accuracy with which polygons follow boundaries, or in a gap where a part divides.
Where place(const FrictionalPart& part, const Vector2d& p, double accuracy) {
  bool inside = false;
  for (const RegionPolygon& polygon : part.polygons) {
    if (distance(polygon, p) < accuracy) return Where::near;
    inside = inside || contains(polygon, p);
  }
  return inside ? Where::inside : Where::outside;
}

double polygon_area(const FrictionalPart& part) {
  double twice = 0;
  for (const RegionPolygon& polygon : part.polygons)
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
  return twice / 2;
}

}  // namespace

// Level ground: with P = L^2 - x^2 (10) says P - rho^2 > theta sqrt((P - rho^2)^2 + 4 L^2 rho^2), whatever the height.
TEST_CASE("On level ground clattering converges on a strip of known width", "[frictional][region]") {
  const double half = 0.5, rho = GENERATE(0.05, 0.1, 0.2), e = GENERATE(0.01, 0.05, 0.1);
  const std::vector<Contact> contacts{{{-half, 0}, {0, 1}, 0.5}, {{half, 0}, {0, 2}, 0.7}};
  const double theta = (std::cbrt(e) + std::cbrt(e * e)) / (1 + e);
  const double square = half * half - rho * rho - 2 * half * rho * theta / std::sqrt(1 - theta * theta);
  const double expected = square > 0 ? 2 * std::sqrt(square) * 3 : 0;
  FrictionalRegionOptions options = within(2, 1.5);
  options.area_tolerance = 1e-10;
  const FrictionalRegion region = frictional_region(contacts, rho, e, options);
  CHECK(region.equilibrium_area() == Approx(3).epsilon(1e-14));
  CHECK(region.clattering.error < 1e-9);
  CHECK(std::abs(region.clattering.area - expected) < 1e-9);
}

TEST_CASE("The tradeoff of Fig. 3", "[frictional][region][paper]") {
  const auto contacts = vee(25, 0.5);
  const FrictionalRegion wide = frictional_region(contacts, 0.4, 0.1, within(2, 2));
  const FrictionalRegion narrow = frictional_region(contacts, 0.2, 0.1, within(2, 2));
  CHECK(wide.kinematic_strong.area > 2 * narrow.kinematic_strong.area);
  CHECK(wide.clattering.area < 0.7 * narrow.clattering.area);
  // With the greater radius both hold at most below the ground, whose lines meet at y = -0.5 tan 25.
  for (const RegionPolygon& polygon : wide.stable.polygons)
    for (const Vector2d& p : polygon) CHECK(p.y() < (std::abs(p.x()) - 0.5) * std::tan(25 * M_PI / 180));
  bool above = false;
  for (const RegionPolygon& polygon : narrow.stable.polygons)
    for (const Vector2d& p : polygon) above = above || p.y() > 0.1;
  CHECK(above);
  for (const FrictionalRegion& region : {wide, narrow})
    for (const FrictionalPart* part : {&region.kinematic_strong, &region.clattering, &region.stable}) {
      CHECK(part->error < 4e-6 * 1.01);
      CHECK(polygon_area(*part) == Approx(part->area).margin(1e-3));
    }
}

TEST_CASE("Inside and outside of the polygons verdicts are those of a brute force", "[frictional][region]") {
  std::mt19937_64 random(20261125);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  int asked = 0, postures = surefoot::test::rounds(60), strong = 0, clatters = 0, both = 0;
  for (int posture = 0; posture < postures; ++posture) {
    std::vector<Contact> contacts;
    for (double x : {-0.5, 0.5}) {
      const double tilt = between(-0.7, 0.7);
      contacts.push_back({{x, between(-0.2, 0.2)}, {std::sin(tilt), std::cos(tilt)}, between(0.2, 1)});
    }
    const double rho = between(0.05, 0.4), e = between(0.01, 0.2);
    const FrictionalRegion region = frictional_region(contacts, rho, e, within(1.5, 1.5));
    if (region.strip.isEmpty()) continue;
    CHECK(region.upward);
    for (int k = 0; k < 150; ++k) {
      const Vector2d com(between(region.strip.min().x(), region.strip.max().x()), between(-1.5, 1.5));
      ModeBruteForce force(contacts, com, rho);
      const bool expect_strong = force.equilibrium() && force.every_mode_leads_back();
      const bool expect_clatter = printed_clattering(contacts, com, rho, e);
      if (force.near()) continue;
      const auto check = [&](const FrictionalPart& part, bool expected) {
        const Where where = place(part, com, 2e-3);
        if (where == Where::near) return false;
        ++asked;
        CHECK((where == Where::inside) == expected);
        return where == Where::inside;
      };
      strong += check(region.kinematic_strong, expect_strong);
      clatters += check(region.clattering, expect_clatter);
      both += check(region.stable, expect_strong && expect_clatter);
    }
  }
  CHECK(asked > 300 * postures);
  CHECK(strong > 0);
  CHECK(clatters > 0);
  CHECK(both > 0);
}

// Areas by counting the brute force's verdicts on a grid of midpoints: an error of the order of boundary length times
// spacing.
TEST_CASE("Areas are those of a grid of brute-force verdicts", "[frictional][region]") {
  const auto contacts = vee(25, 0.5);
  const double rho = 0.2, e = 0.1;
  const FrictionalRegion region = frictional_region(contacts, rho, e, within(2, 1.5));
  const int columns = 120, rows = 360;
  const Vector2d cell = region.strip.sizes().cwiseQuotient(Vector2d(columns, rows));
  double strong = 0, clatters = 0, both = 0;
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const Vector2d com = region.strip.min() + Vector2d((i + 0.5) * cell.x(), (k + 0.5) * cell.y());
      ModeBruteForce force(contacts, com, rho);
      const bool is_strong = force.equilibrium() && force.every_mode_leads_back();
      const bool is_clattering = printed_clattering(contacts, com, rho, e);
      strong += is_strong, clatters += is_clattering, both += is_strong && is_clattering;
    }
  const double area = cell.x() * cell.y();
  CHECK(region.kinematic_strong.area == Approx(strong * area).margin(4e-3));
  CHECK(region.clattering.area == Approx(clatters * area).margin(4e-3));
  CHECK(region.stable.area == Approx(both * area).margin(2e-3));
}

TEST_CASE("Ground that does not face upward, and postures without equilibrium, have no region",
          "[frictional][region]") {
  std::vector<Contact> contacts{{{-0.5, 0}, {1, 0}, 0.8}, {{0.5, 0}, {-1, 0}, 0.8}};  // walls
  const FrictionalRegion walls = frictional_region(contacts, 0.2, 0.05, within(2, 2));
  CHECK_FALSE(walls.upward);
  CHECK(walls.stable.area == 0);
  CHECK(walls.stable.polygons.empty());
  contacts[0].friction = contacts[1].friction = 0;
  const FrictionalRegion ice = frictional_region(contacts, 0.2, 0.05, within(2, 2));
  CHECK(ice.strip.isEmpty());
  CHECK(ice.equilibrium_area() == 0);
  CHECK(ice.kinematic_strong.area == 0);
}
