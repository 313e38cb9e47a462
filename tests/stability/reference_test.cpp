// The references against cases computed by hand, and against each other. Nothing here touches the code under test.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/lp_reference.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::testing;

namespace {

SamplePosture posture(std::vector<Contact> contacts, Eigen::Vector2d com, double rho, DisturbanceBox box) {
  SamplePosture sample;
  sample.contacts = std::move(contacts);
  sample.com = com;
  sample.rho = rho;
  sample.box = box;
  return sample;
}

std::vector<std::string> lp_modes(const SamplePosture& sample) {
  const LpReference lp(sample);
  std::vector<std::string> names;
  for (const ModeStructure& mode : lp.structure().modes) {
    if (lp.mode_margin(sample.com, mode) > lp_feasible_above) names.push_back(mode.mode.name());
  }
  return names;
}

const std::vector<Contact> level{{{0, 0}, {0, 1}, 0.5}, {{1, 0}, {0, 1}, 0.5}};

}  // namespace

TEST_CASE("On level ground both references give tipping and sliding limits computed by hand", "[reference]") {
  // Tipping: 0 < x - p h + q < 1; sliding: |p| < mu.
  const double height = 0.4;
  for (const auto& [kappa, nu] : {std::pair{0.17, 0.1}, {0.17, 0.02}, {0.0, 0.1}, {0.1, 0.0}, {0.3, 0.3}}) {
    const SamplePosture sample = posture(level, {0.4, height}, 0.2, {kappa, nu});
    const double tipping = 0.4 / (kappa * height + nu), sliding = 0.5 / kappa;
    const double expected = std::min(tipping, sliding);
    CHECK(LpReference(sample).equilibrium_factor(sample.com) == Approx(expected).epsilon(1e-9));
    CHECK(DirectReference<double>(sample).equilibrium_factor(sample.com).value == Approx(expected).epsilon(1e-12));
    CHECK(DirectReference<Rational>(sample).equilibrium_factor(sample.com).value == Approx(expected).epsilon(1e-12));
    // rho^2 = 0.04 < 0.4 * 0.6: lifting off by rotation alone needs q = rho^2 / 0.4 at least, on one side only, never
    // FF.
    CHECK(LpReference(sample).safety_factor(sample.com).value == Approx(expected).epsilon(1e-9));
    CHECK(DirectReference<Rational>(sample).safety_factor(sample.com).value == Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("Pushed beyond its friction a body on level ground slides at both feet and does nothing else",
          "[reference]") {
  // p = f_x / f_y with f_y = -1: p < -mu is a push to the right. kappa = 0.6, mu = 0.5; both directions occur.
  const SamplePosture sample = posture(level, {0.5, 0.1}, 0.5, {0.6, 0});
  const std::vector<std::string> expected{"UU", "WW"};
  CHECK(lp_modes(sample) == expected);
  CHECK(DirectReference<Rational>(sample).feasible_modes(sample.com) == expected);
  CHECK(DirectReference<double>(sample).feasible_modes(sample.com) == expected);
}

TEST_CASE("A body in free fall breaks away where its centre of mass is beyond every foot", "[reference]") {
  // One foot, COM 0.3 beside it, no friction: N = (0, 1, -0.3), phi = 1 / (1 + 0.09 / rho^2) > 0. It slips: the foot
  // moves to the other side of the falling COM. a_x = 0, alpha = -0.3 phi / rho^2, a . t = -r_y alpha with r_y = -0.5.
  const SamplePosture sample = posture({{{0, 0}, {0, 1}, 0}}, {0.3, 0.5}, 0.2, {0, 0});
  CHECK(lp_modes(sample) == std::vector<std::string>{"W"});
  CHECK(DirectReference<Rational>(sample).feasible_modes(sample.com) == std::vector<std::string>{"W"});
}

TEST_CASE("A frictionless foot that falls away from the body breaks away", "[reference]") {
  // An overhanging foot, normal down: a . n = +1 > 0 under gravity alone. F is the only mode.
  const SamplePosture sample = posture({{{0, 1}, {0, -1}, 0.7}}, {0, 0}, 0.2, {0, 0});
  CHECK(lp_modes(sample) == std::vector<std::string>{"F"});
  CHECK(DirectReference<Rational>(sample).feasible_modes(sample.com) == std::vector<std::string>{"F"});
}

TEST_CASE("Torque throws a body of small inertia out of a vee, from the bound computed by hand", "[reference]") {
  // Feet at (-+0.5, 0), normals leaning 45 degrees inwards, COM at (0, h): N_1 = (s, s, r x n) with r = (-0.5, -h),
  // n = (1, 1): r x n = h - 0.5; N_2: r = (0.5, -h), n = (-1, 1): r x n = 0.5 - h. FF needs
  // -1 - p - (h - 0.5) q / rho^2 > 0 and -1 + p + (h - 0.5) q / rho^2 > 0: their sum is -2. Never.
  const std::vector<Contact> vee{{{-0.5, 0}, {1, 1}, 0.3}, {{0.5, 0}, {-1, 1}, 0.3}};
  const SamplePosture both = posture(vee, {0, 1.5}, 0.05, {0.1, 0.2});
  CHECK(LpReference(both).mode_margin(both.com, LpReference(both).structure().modes[0]) < 0);
  // COM at (0, 0) off to the left by d: N_1 = (1, 1, d - 0.5), N_2 = (-1, 1, d + 0.5) with r = (-+0.5 + d, 0)... at
  // d = 1: (1, 1, 0.5), (-1, 1, 1.5): FF iff -1 - 0.5 q / rho^2 > 0 and -1 - 1.5 q / rho^2 > 0, that is q < -2 rho^2 (p
  // = 0).
  for (const double rho : {0.05, 0.2}) {
    const SamplePosture off = posture(vee, {-1, 0}, rho, {0, 1});
    const DirectReference<Rational> exact(off);
    const ReferenceFactor factor = exact.mode_factor(off.com, exact.structure().modes[0]);
    CHECK(factor.value == Approx(2 * rho * rho).epsilon(1e-12));
    CHECK(factor.witness.q == Approx(-2 * rho * rho).epsilon(1e-12));
    bool decided = true;
    CHECK(LpReference(off).mode_factor(off.com, exact.structure().modes[0], decided) ==
          Approx(2 * rho * rho).epsilon(1e-9));
  }
}

TEST_CASE("Rolling over one foot starts where the line of gravity leaves it", "[reference]") {
  // R at foot 1 (0, 0), foot 2 at (1, 0) breaks: alpha (rho^2 + r^2) = -q - x + p h > 0 at p = 0 iff q < -x.
  const SamplePosture sample = posture(level, {0.2, 0.3}, 0.5, {0, 0.5});
  const DirectReference<Rational> exact(sample);
  for (const ModeStructure& mode : exact.structure().modes) {
    if (mode.mode.name() != "RF") continue;
    CHECK(exact.mode_factor(sample.com, mode).value == Approx(0.2 / 0.5).epsilon(1e-12));
    bool decided = true;
    CHECK(LpReference(sample).mode_factor(sample.com, mode, decided) == Approx(0.4).epsilon(1e-9));
  }
}

TEST_CASE("A floor and a ceiling foot brace against every wrench, level feet and single feet do not", "[reference]") {
  const std::vector<Contact> brace{{{0, 0}, {0, 1}, 0.5}, {{0, 1}, {0, -1}, 0.5}};
  const SamplePosture sample = posture(brace, {3, -2}, 0.3, {2, 5});
  CHECK(DirectReference<Rational>(sample).structure().facets.empty());
  CHECK(DirectReference<Rational>(sample).equilibrium(sample.com));
  CHECK(LpReference(sample).equilibrium_margin(sample.com) > 0);
  const SamplePosture single = posture({level[0]}, {0, 0.5}, 0.3, {0, 0});
  CHECK_FALSE(DirectReference<Rational>(single).equilibrium(single.com));
  CHECK(LpReference(single).equilibrium_margin(single.com) < 0);
  SamplePosture frictionless = posture(level, {0.5, 0.5}, 0.3, {0, 0});
  for (Contact& contact : frictionless.contacts) contact.friction = 0;
  CHECK_FALSE(DirectReference<Rational>(frictionless).equilibrium(frictionless.com));
}

TEST_CASE("LP, rational and double references agree on postures of every kind", "[reference]") {
  const std::uint64_t seed = 11;
  Sampler sampler(seed);
  int compared = 0, feasible = 0, finite = 0;
  for (int round = 0; round < surefoot::test::rounds(25); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " kind " << name(kind) << "\n" << sample.json());
      const LpReference lp(sample);
      const DirectReference<Rational> exact(sample);
      const DirectReference<double> direct(sample);
      for (const ModeStructure& mode : exact.structure().modes) {
        const double margin = lp.mode_margin(sample.com, mode);
        if (margin > lp_infeasible_below && margin < lp_feasible_above) continue;
        INFO(mode.mode.name() << " margin " << margin);
        CHECK(exact.mode_feasible(sample.com, mode) == (margin > lp_feasible_above));
        ++compared;
        feasible += margin > lp_feasible_above;
      }
      const double margin = lp.equilibrium_margin(sample.com);
      if (std::abs(margin) > lp_feasible_above) CHECK(exact.equilibrium(sample.com) == (margin > 0));
      const LpReference::Factor factor = lp.safety_factor(sample.com);
      if (!factor.decided || factor.value > 1e6) continue;
      CHECK(exact.safety_factor(sample.com).value == Approx(factor.value).epsilon(1e-6).margin(1e-9));
      if (exact.safety_factor(sample.com).value > 1e-9) {
        CHECK(direct.safety_factor(sample.com).value == Approx(factor.value).epsilon(1e-6).margin(1e-9));
      }
      finite += factor.value > 0;
    }
  }
  CHECK(compared > surefoot::test::enough(3000));
  CHECK(feasible > surefoot::test::enough(300));
  CHECK(finite > surefoot::test::enough(50));
}
