// Signs against integer arithmetic: every finite double is an integer times 2^-1074.
#include "terrain/predicates.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "tests/terrain/lattice_terrain.hpp"

namespace surefoot::terrain {
namespace {

using boost::multiprecision::cpp_int;
using Eigen::Vector2d;

cpp_int scaled(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  const cpp_int digits = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + 1074;
  return shift >= 0 ? cpp_int(digits << shift) : cpp_int(digits / (cpp_int(1) << -shift));  // the division is exact
}

int reference_sign(const Vector2d& a0, const Vector2d& a1, const Vector2d& b0, const Vector2d& b1) {
  const cpp_int ax = scaled(a1.x()) - scaled(a0.x()), ay = scaled(a1.y()) - scaled(a0.y());
  const cpp_int bx = scaled(b1.x()) - scaled(b0.x()), by = scaled(b1.y()) - scaled(b0.y());
  const cpp_int det = ax * by - ay * bx;
  return det.sign();
}

double nudged(double value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, std::numeric_limits<double>::infinity());
  for (; steps < 0; ++steps) value = std::nextafter(value, -std::numeric_limits<double>::infinity());
  return value;
}

TEST_CASE("the orientation of points near a line is that of exact arithmetic, whatever the scale", "[predicates]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1), along(-2, 3);
  std::uniform_int_distribution<int> steps(-3, 3);
  std::map<detail::Precision, int> decided;
  for (const double scale : {1.0, 1e-6, 1e6, 1e-100, 1e100, 1e-160, 1e-310, 1e150, 1e300}) {
    for (const double offset : {0.0, 1.0, 1e6}) {
      for (int i = 0; i < 400; ++i) {
        const Vector2d origin(offset * unit(random), offset * unit(random));
        const Vector2d a = scale * (origin + Vector2d(unit(random), unit(random)));
        const Vector2d b = scale * (origin + Vector2d(unit(random), unit(random)));
        const double t = along(random);
        const Vector2d near = i % 5 == 0 ? Vector2d(b.x(), a.y()) : Vector2d(a + t * (b - a));
        const Vector2d c(nudged(near.x(), steps(random)), nudged(near.y(), steps(random)));
        if (!c.allFinite() || !a.allFinite() || !b.allFinite()) continue;
        detail::Precision by;
        const int sign = detail::cross_sign(a, b, a, c, by);
        ++decided[by];
        CAPTURE(scale, offset, a, b, c, static_cast<int>(by));
        REQUIRE(sign == reference_sign(a, b, a, c));
        REQUIRE(orientation(b, c, a) == sign);
        REQUIRE(orientation(c, a, b) == sign);
        REQUIRE(orientation(b, a, c) == -sign);
      }
    }
  }
  CHECK(decided[detail::Precision::factor_signs] > 100);
  CHECK(decided[detail::Precision::filter] > 100);
  CHECK(decided[detail::Precision::expansion] > 100);
  CHECK(decided[detail::Precision::rational] > 100);
}

TEST_CASE("points exactly on a slanted line are found to be on it", "[predicates]") {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> whole(-1000, 1000);
  for (int i = 0; i < 2000; ++i) {
    const Vector2d origin(whole(random) * 1048576.0, whole(random) * 0.125);
    const Vector2d step(whole(random) / 64.0, whole(random) / 32.0);
    const auto on_line = [&] { return Vector2d(origin + whole(random) * step); };
    const Vector2d a = on_line(), b = on_line(), c = on_line();
    REQUIRE(orientation(a, b, c) == 0);
    REQUIRE(reference_sign(a, b, a, c) == 0);
  }
}

TEST_CASE("the cross product of free vectors of mixed magnitudes has the exact sign", "[predicates]") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> exponent(-1074, 1023), close(-60, 60);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const auto any = [&](auto& e) { return std::ldexp(mantissa(random), e(random)); };
    std::array<Vector2d, 4> v;
    for (Vector2d& p : v) p = i % 2 ? Vector2d(any(exponent), any(exponent)) : Vector2d(any(close), any(close));
    CAPTURE(v[0], v[1], v[2], v[3]);
    REQUIRE(cross_sign(v[0], v[1], v[2], v[3]) == reference_sign(v[0], v[1], v[2], v[3]));
    REQUIRE(cross_sign(v[0], v[1], v[0], v[1]) == 0);
  }
}

TEST_CASE("cancelling products that differ in the last bit of their exact values are told apart", "[predicates]") {
  // (1 + e)(1 - e) = 1 - e^2 rounds to 1, and e^2 alone decides.
  const double e = 0x1p-30;
  const Vector2d zero = Vector2d::Zero();
  CHECK(cross_sign(zero, Vector2d(1 + e, 1), zero, Vector2d(1, 1 - e)) == -1);
  CHECK(cross_sign(zero, Vector2d(1, 1 + e), zero, Vector2d(1 - e, 1)) == 1);
  // (1 + f)(1 - f) = 1 - f^2 is a double here, and so is the next one below it.
  const double f = 0x1p-26, product = 1 - 0x1p-52;
  CHECK(cross_sign(zero, Vector2d(1 + f, product), zero, Vector2d(1, 1 - f)) == 0);
  CHECK(cross_sign(zero, Vector2d(1 + f, nudged(product, -1)), zero, Vector2d(1, 1 - f)) == 1);
  CHECK(cross_sign(zero, Vector2d(1 + f, nudged(product, 1)), zero, Vector2d(1, 1 - f)) == -1);
}

TEST_CASE("segments meet as integers say, for every kind of touching", "[predicates]") {
  lattice::Generator generator(4);
  int met = 0, apart = 0;
  for (int i = 0; i < 40000; ++i) {
    const std::int64_t extent = i % 3 == 0 ? 2 : i % 3 == 1 ? 5 : 200;
    const auto p = generator.vertex(extent), q = generator.vertex(extent);
    const auto a = generator.vertex(extent), b = generator.vertex(extent);
    const bool expected = lattice::meet(p, q, a, b);
    ++(expected ? met : apart);
    const Point P = to_point(p), Q = to_point(q), A = to_point(a), B = to_point(b);
    CAPTURE(p.x, p.y, q.x, q.y, a.x, a.y, b.x, b.y);
    REQUIRE(segments_meet(P, Q, A, B) == expected);
    REQUIRE(segments_meet(B, A, P, Q) == expected);
  }
  CHECK(met > 5000);
  CHECK(apart > 5000);
}

TEST_CASE("a segment that ends one rounding step short of another does not meet it", "[predicates]") {
  const Vector2d a(0, 0), b(3, 1);
  const Vector2d on(1.5, 0.5);
  CHECK(segments_meet(Vector2d(1.5, 2), on, a, b));
  CHECK_FALSE(segments_meet(Vector2d(1.5, 2), Vector2d(1.5, std::nextafter(0.5, 1)), a, b));
  CHECK(segments_meet(Vector2d(1.5, 2), Vector2d(1.5, std::nextafter(0.5, 0)), a, b));
}

}  // namespace
}  // namespace surefoot::terrain
