// Frictional stability of two-contact postures against a brute force that solves all seven unknowns of every mode, the
// formulas as printed in [OR-H], and closed forms of level ground.
#include "stability/frictional.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/mode_brute_force.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sample_posture.hpp"

using namespace surefoot::stability;
using Eigen::Vector2d;
using surefoot::test::enough;
using surefoot::test::rounds;
using surefoot::testing::SamplePosture;
using surefoot::testing::Sampler;

namespace {

/// (10) as printed, for psi as printed.
double printed_threshold(double e) { return (std::cbrt(e) + std::cbrt(e * e)) / (1 + e); }

std::array<double, 2> printed_psi(const std::vector<Contact>& contacts, const Vector2d& com, double rho) {
  std::array<double, 2> b, result;
  std::array<Vector2d, 2> n;
  for (int i : {0, 1}) {
    n[i] = contacts[i].normal.normalized();
    b[i] = Vector2d(n[i].y(), -n[i].x()).dot(contacts[i].position - com);
  }
  for (int i : {0, 1}) result[i] = -(b[0] * b[1] + n[0].dot(n[1]) * rho * rho) / (b[i] * b[i] + rho * rho);
  return result;
}

constexpr double gentle = 0.9, steep = 3.1;  // [rad]

/// Normals within `spread` [rad] of up; half of the COMs balanced or nearly so.
SamplePosture random_posture(Sampler& sampler, double spread) {
  SamplePosture sample;
  for (int i = 0; i < 2; ++i) {
    const double lean = sampler.uniform(-spread, spread), size = sampler.uniform(0.1, 5);
    sample.contacts.push_back({{sampler.uniform(-1, 1), sampler.uniform(-1, 1)},
                               size * Vector2d(std::sin(lean), std::cos(lean)),
                               sampler.uniform(0, 1.5)});
  }
  sample.com = sampler.chance(0.5) ? sampler.com_near(sample.contacts)
                                   : Vector2d(sampler.uniform(-1, 1), sampler.uniform(-1, 2));
  sample.rho = std::exp(sampler.uniform(-4, 1));
  return sample;
}

std::vector<Contact> level_feet(double left, double right, double mu) {
  return {{{left, 0}, {0, 1}, mu}, {{right, 0}, {0, 1}, mu}};
}

/// A low body between its feet, where frictional stability is not rare.
SamplePosture random_stance(Sampler& sampler) {
  SamplePosture sample = random_posture(sampler, gentle);
  for (int i : {0, 1}) {
    sample.contacts[i].position = {(i ? 1 : -1) * sampler.uniform(0.3, 1), sampler.uniform(-0.2, 0.2)};
    sample.contacts[i].friction = sampler.uniform(0.2, 1.5);
  }
  sample.com = {sampler.uniform(-0.2, 0.2), sampler.uniform(-0.1, 0.6)};
  sample.rho = sampler.uniform(0.02, 0.4);
  return sample;
}

double below(double x) { return std::nextafter(x, -HUGE_VAL); }
double above(double x) { return std::nextafter(x, HUGE_VAL); }

}  // namespace

TEST_CASE("kinematic-strong is what solving every mode for all its unknowns says", "[frictional]") {
  Sampler sampler(501);
  int strong = 0, balanced = 0, unclear = 0;
  const int all = rounds(120000);
  for (int k = 0; k < all; ++k) {
    const SamplePosture sample = random_posture(sampler, k % 2 ? gentle : steep);
    surefoot::testing::ModeBruteForce brute(sample.contacts, sample.com, sample.rho);
    const bool equilibrium = brute.equilibrium(), expected = equilibrium && brute.every_mode_leads_back();
    if (brute.near()) {
      ++unclear;
      continue;
    }
    const Posture posture(sample.contacts, sample.rho);
    INFO(sample.json());
    const FrictionalVerdict verdict = frictional_verdict(posture, sample.com, 0.1);
    REQUIRE(kinematic_strong(posture, sample.com) == expected);
    REQUIRE(verdict.kinematic_strong == expected);
    REQUIRE(verdict.equilibrium == equilibrium);
    REQUIRE(verdict.failed_mode.has_value() == (equilibrium && !expected));
    balanced += equilibrium, strong += expected;
  }
  CHECK(balanced > enough(20000));
  CHECK(strong > enough(500));
  CHECK(unclear < all / 100);
}

TEST_CASE("clattering dies out exactly where (10) as printed holds", "[frictional]") {
  Sampler sampler(502);
  int holds = 0;
  const int all = rounds(30000);
  for (int k = 0; k < all; ++k) {
    const SamplePosture sample = random_posture(sampler, k % 2 ? gentle : steep);
    const Posture posture(sample.contacts, sample.rho);
    const auto expected = printed_psi(sample.contacts, sample.com, sample.rho), got = psi(posture, sample.com);
    const double e = k % 3 ? sampler.uniform(0.001, 0.999) : std::exp(sampler.uniform(-40, -1));
    INFO(sample.json() << " e " << e);
    for (int i : {0, 1}) REQUIRE(got[i] == Approx(expected[i]).epsilon(1e-10).margin(1e-10));
    const double excess = std::sqrt(std::max(0.0, expected[0] * expected[1])) - printed_threshold(e);
    if (std::abs(excess) < 1e-10 || std::abs(expected[0]) < 1e-10) continue;
    const bool converges = expected[0] > 0 && expected[1] > 0 && excess > 0;
    REQUIRE(clattering_converges(posture, sample.com, e) == converges);
    holds += converges;
  }
  CHECK(holds > enough(2000));
}

TEST_CASE("the threshold is (10) as printed and ends at 0 and 1", "[frictional]") {
  for (const double e : {1e-300, 1e-30, 1e-9, 0.001, 0.1, 0.125, 0.5, 0.9, 1 - 1e-9})
    CHECK(clattering_threshold(e) == Approx(printed_threshold(e)).epsilon(1e-14));
  CHECK(clattering_threshold(0.125) == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(clattering_threshold(1) == 1);
  CHECK(greatest_restitution(2.0 / 3) == Approx(0.125).epsilon(1e-14));
  CHECK(greatest_restitution(0) == 0);
  CHECK(greatest_restitution(-0.5) == 0);
  CHECK(greatest_restitution(1) == 1);
}

TEST_CASE("the symmetric rod has psi = (L^2 - rho^2) / (L^2 + rho^2) at any height", "[frictional]") {
  for (const double half : {0.01, 0.3, 1.0, 25.0})
    for (const double rho : {0.001, 0.2, 1.0, 7.0})
      for (const double height : {-0.4, 0.0, 0.5, 30.0}) {
        const Posture posture(level_feet(-half, half, 0.5), rho);
        const double expected = (half * half - rho * rho) / (half * half + rho * rho);
        for (const double got : psi(posture, {0, height})) CHECK(got == Approx(expected).epsilon(1e-14).margin(1e-15));
      }
}

// Feet at distance b on both sides, height h. A rolling foot carries the horizontal share b h / (rho^2 + h^2) of its
// pressure; with both feet sliding against friction mu the pressures are (1 -+ mu h / b) / 2.
TEST_CASE("a level rod is kinematic-strong for b h / (rho^2 + h^2) < mu < b / h", "[frictional]") {
  Sampler sampler(503);
  int strong = 0;
  for (int k = 0; k < rounds(2000); ++k) {
    const double b = sampler.uniform(0.05, 2), h = sampler.uniform(0.05, 2), rho = sampler.uniform(0.05, 2);
    const double low = b * h / (rho * rho + h * h), high = b / h;
    const double mu = high * std::exp(sampler.uniform(-2, 0.5));
    if (std::abs(mu / low - 1) < 1e-10 || std::abs(mu / high - 1) < 1e-10) continue;
    const Posture posture(level_feet(-b, b, mu), rho);
    INFO("b " << b << " h " << h << " rho " << rho << " mu " << mu);
    REQUIRE(kinematic_strong(posture, {0, h}) == (low < mu && mu < high));
    strong += low < mu && mu < high;
  }
  CHECK(strong > enough(300));
}

TEST_CASE("friction exactly at either limit counts as not strong, the next number within as strong", "[frictional]") {
  const auto strong = [](double h, double mu) { return kinematic_strong(Posture(level_feet(-1, 1, mu), 1), {0, h}); };
  // rho = b = 1. h = 1: 1/2 < mu < 1. h = 2: 2/5 < mu < 1/2.
  CHECK_FALSE(strong(1, 0.5));
  CHECK(strong(1, above(0.5)));
  CHECK(strong(1, below(1)));
  CHECK_FALSE(strong(1, 1));
  CHECK(strong(2, below(0.5)));
  CHECK_FALSE(strong(2, 0.5));
}

TEST_CASE("a COM exactly above a foot counts as not stable", "[frictional]") {
  const Posture posture(level_feet(0, 1, 0.5), 0.25);
  CHECK_FALSE(kinematic_strong(posture, {0, 0.125}));
  CHECK_FALSE(frictional_verdict(posture, {1, 0.125}, 0.1).equilibrium);
  CHECK_FALSE(frictionally_stable(posture, {1, 0.125}, 0.1));
}

// With rho = 1 and the COM at the origin N = (n, r x n) is (1, 2, 2) and (-4, 1, -8): lengths 3 and 9, inner product
// -18, thus sqrt(psi_1 psi_2) = 2/3, the threshold of e = 1/8.
TEST_CASE("(10) with equality counts as not stable, the next number below as stable", "[frictional]") {
  const std::vector<Contact> contacts{{{1, 0}, {1, 2}, 1}, {{0, -2}, {-4, 1}, 1}};
  const Posture posture(contacts, 1);
  CHECK_FALSE(clattering_converges(posture, {0, 0}, 0.125));
  CHECK_FALSE(clattering_converges(posture, {0, 0}, above(0.125)));
  CHECK(clattering_converges(posture, {0, 0}, below(0.125)));
  CHECK_FALSE(frictional_verdict(posture, {0, 0}, 0.125).clattering);
  CHECK(frictional_margins(posture, {0, 0}, 0.1).restitution == Approx(0.125).epsilon(1e-13));
}

TEST_CASE("psi of exactly 0 does not converge for any restitution", "[frictional]") {
  const Posture posture(level_feet(-1, 1, 0.75), 1);  // L = rho
  for (const double e : {1e-300, 0.1, 0.9}) CHECK_FALSE(clattering_converges(posture, {0, 1}, e));
  CHECK(frictional_margins(posture, {0, 1}, 0.1).restitution == 0);
  CHECK(kinematic_strong(posture, {0, 1}));
  CHECK_FALSE(frictionally_stable(posture, {0, 1}, 0.1));
}

TEST_CASE("ground that is upright or overhangs is not frictionally stable", "[frictional]") {
  const Posture upright(std::vector<Contact>{{{-1, 0}, {1, 0}, 2}, {{1, 0}, {-1, 0}, 2}}, 0.2);
  CHECK_FALSE(faces_upward(upright));
  CHECK_FALSE(frictional_verdict(upright, {0, 0}, 0.1).stable());
  CHECK_FALSE(frictionally_stable(upright, {0, 0}, 0.1));
  CHECK(faces_upward(Posture(std::vector<Contact>{{{-1, 0}, {1, 5e-324}, 2}, {{1, 0}, {-1, 1}, 2}}, 0.2)));
}

TEST_CASE("the greatest restitution is where (10) as printed turns", "[frictional]") {
  Sampler sampler(504);
  int met = 0;
  for (int k = 0; k < rounds(3000); ++k) {
    const SamplePosture sample = random_posture(sampler, k % 2 ? gentle : steep);
    const auto [first, second] = printed_psi(sample.contacts, sample.com, sample.rho);
    const double root = std::copysign(std::sqrt(first * second), first);
    const FrictionalMargins margins = frictional_margins(Posture(sample.contacts, sample.rho), sample.com, 0.1);
    INFO(sample.json());
    REQUIRE(margins.psi == Approx(root - printed_threshold(0.1)).epsilon(1e-10).margin(1e-10));
    if (first < -1e-12) REQUIRE(margins.restitution == 0);
    if (root < 0.01 || root > 0.999) continue;
    double low = 0, high = 1;
    while (high - low > 1e-16) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (root > printed_threshold(middle) ? low : high) = middle;
    }
    REQUIRE(margins.restitution == Approx(low).epsilon(1e-7));
    ++met;
  }
  CHECK(met > enough(300));
}

TEST_CASE("every COM within the frictional radius is stable, and the radius is not far below what is so",
          "[frictional]") {
  Sampler sampler(505);
  std::vector<double> shares;
  for (int k = 0; k < rounds(30000); ++k) {
    const SamplePosture sample = random_stance(sampler);
    const Posture posture(sample.contacts, sample.rho);
    const double e = std::exp(sampler.uniform(-9, -0.7));
    if (!frictionally_stable(posture, sample.com, e)) {
      if (k % 20 == 0) REQUIRE(frictional_margins(posture, sample.com, e).com == 0);
      continue;
    }
    INFO(sample.json() << " e " << e);
    const FrictionalMargins margins = frictional_margins(posture, sample.com, e);
    REQUIRE(margins.com > 0);
    REQUIRE(margins.psi > 0);
    REQUIRE(margins.restitution > e);
    double nearest = HUGE_VAL;  // unstable COM, in radii
    for (int j = 0; j < 32; ++j) {
      const double angle = 2 * std::numbers::pi * j / 32;
      const auto stable = [&](double radii) {
        const Vector2d away = radii * margins.com * Vector2d(std::cos(angle), std::sin(angle));
        return frictionally_stable(posture, sample.com + away, e);
      };
      for (const double radii : {0.5, 1 - 1e-9}) REQUIRE(stable(radii));
      for (double radii = 1; radii < std::min(nearest, 64.0); radii *= 1.1)
        if (!stable(radii)) nearest = radii;
    }
    shares.push_back(1 / nearest);
  }
  REQUIRE(int(shares.size()) > enough(100));
  std::nth_element(shares.begin(), shares.begin() + shares.size() / 2, shares.end());
  CHECK(shares[shares.size() / 2] > 0.5);
}
