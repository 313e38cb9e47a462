// The oracle against the LP in the full unknowns, and against exact rational brute force, on postures of every kind.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/agreement.hpp"
#include "tests/support/lp_reference.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::testing;
using surefoot::stability::Critical;
using surefoot::stability::RobustOracle;
using surefoot::stability::SafetyFactor;

TEST_CASE("Equilibrium, every contact mode and the robust verdict equal those of the LP", "[lp]") {
  const std::uint64_t seed = 20240;
  Sampler sampler(seed);
  int feasible = 0, robust = 0, undecided = 0;
  for (int round = 0; round < surefoot::test::rounds(160); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " round " << round << " kind " << name(kind) << "\n" << sample.json());
      const RobustOracle oracle = oracle_of(sample);
      const LpReference lp(sample);
      std::vector<std::string> expected;
      bool decided = true;
      for (const ModeStructure& mode : lp.structure().modes) {
        const double margin = lp.mode_margin(sample.com, mode);
        decided = decided && !(margin > lp_infeasible_below && margin < lp_feasible_above);
        if (margin >= lp_feasible_above) expected.push_back(mode.mode.name());
      }
      if (decided) CHECK(mode_names(oracle.feasible_modes(sample.com)) == sorted(expected));
      feasible += static_cast<int>(expected.size());
      const double margin = lp.equilibrium_margin(sample.com);
      if (std::abs(margin) < lp_feasible_above) decided = false;
      undecided += !decided;
      if (!decided) continue;
      CHECK(oracle.equilibrium(sample.com) == (margin > 0));
      CHECK(oracle.robust(sample.com) == (margin > 0 && expected.empty()));
      robust += margin > 0 && expected.empty();
    }
  }
  CHECK(feasible > surefoot::test::enough(2000));
  CHECK(robust > surefoot::test::enough(200));
  CHECK(undecided < 20);
}

TEST_CASE("Safety factor and equilibrium factor equal those of the LP to 1e-6", "[lp]") {
  const std::uint64_t seed = 4711;
  Sampler sampler(seed);
  int finite = 0;
  for (int round = 0; round < 80; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " round " << round << " kind " << name(kind) << "\n" << sample.json());
      const RobustOracle oracle = oracle_of(sample);
      const LpReference lp(sample);
      const SafetyFactor found = oracle.safety_factor(sample.com);
      INFO("critical " << found.critical.name());
      const LpReference::Factor expected = lp.safety_factor(sample.com);
      if (!expected.decided) continue;
      if (expected.value > practically_infinite) {
        CHECK(found.value > 0.1 * practically_infinite);
        continue;
      }
      CHECK(found.value == Approx(expected.value).epsilon(1e-6).margin(1e-9));
      finite += expected.value > 0;
      if (expected.value > 0) {
        const double least = oracle.equilibrium_factor(sample.com).value;
        const double limit = lp.equilibrium_factor(sample.com);
        if (limit < practically_infinite) CHECK(least == Approx(limit).epsilon(1e-6));
        else CHECK(least > 0.1 * practically_infinite);
      }
    }
  }
  CHECK(finite > surefoot::test::enough(150));
}

TEST_CASE("Verdicts equal those of exact rational brute force, also where rows vanish", "[exact]") {
  const std::uint64_t seed = 99;
  Sampler sampler(seed);
  for (int round = 0; round < 40; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " round " << round << " kind " << name(kind) << "\n" << sample.json());
      const RobustOracle oracle = oracle_of(sample);
      const DirectReference<Rational> exact(sample);
      CHECK(mode_names(oracle.feasible_modes(sample.com)) == sorted(exact.feasible_modes(sample.com)));
      CHECK(oracle.equilibrium(sample.com) == exact.equilibrium(sample.com));
      CHECK(oracle.robust(sample.com) == exact.robust(sample.com));
    }
  }
}

TEST_CASE("The witness lies on the boundary of sigma W and the critical constraint fails just beyond it", "[witness]") {
  const std::uint64_t seed = 5;
  Sampler sampler(seed);
  int equilibria = 0, modes = 0;
  for (int round = 0; round < surefoot::test::rounds(150); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      const SafetyFactor found = oracle_of(sample).safety_factor(sample.com);
      if (!(found.value > 1e-6) || found.value > practically_infinite) continue;
      INFO("seed " << seed << " kind " << name(kind) << "\n" << sample.json() << "\n" << found.critical.name());
      const DirectReference<Rational> exact(sample);
      const double p = std::abs(found.witness.p), q = std::abs(found.witness.q);
      const double kappa = found.value * sample.box.kappa, nu = found.value * sample.box.nu;
      CHECK(p <= kappa * (1 + 1e-9));
      CHECK(q <= nu * (1 + 1e-9));
      CHECK(((kappa > 0 && p >= kappa * (1 - 1e-9)) || (nu > 0 && q >= nu * (1 - 1e-9))));
      const double beyond = 1 + 1e-6, within = 1 - 1e-6;
      if (found.critical.kind == Critical::Kind::equilibrium) {
        CHECK_FALSE(exact.equilibrium_at(sample.com, {beyond * found.witness.p, beyond * found.witness.q}));
        CHECK(exact.equilibrium_at(sample.com, {within * found.witness.p, within * found.witness.q}));
        ++equilibria;
        continue;
      }
      REQUIRE(found.critical.kind == Critical::Kind::mode);
      ++modes;
      for (const ModeStructure& mode : exact.structure().modes) {
        if (mode.mode != found.critical.mode) continue;
        CHECK(exact.mode_feasible(sample.com, mode, found.value * beyond));
        CHECK_FALSE(exact.mode_feasible(sample.com, mode, found.value * within));
      }
    }
  }
  CHECK(equilibria > surefoot::test::enough(100));
  CHECK(modes > surefoot::test::enough(30));
}

TEST_CASE("The gradient equals central differences of the LP's safety factor", "[gradient]") {
  const std::uint64_t seed = 31;
  Sampler sampler(seed);
  int compared = 0, by_mode = 0;
  for (int round = 0; round < surefoot::test::rounds(120); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      const SafetyFactor found = oracle_of(sample).safety_factor(sample.com);
      if (!(found.value > 1e-3) || found.value > 100) continue;
      const LpReference lp(sample);
      const double h = 1e-6;
      Eigen::Vector2d forward, backward;
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
        forward[axis] = (lp.safety_factor(sample.com + step).value - found.value) / h;
        backward[axis] = (found.value - lp.safety_factor(sample.com - step).value) / h;
      }
      // At a kink, or where sigma bends hard within h, one-sided slopes differ: no gradient to compare with.
      if ((forward - backward).norm() > 1e-2 * (1 + forward.norm())) continue;
      INFO("seed " << seed << " kind " << name(kind) << "\n" << sample.json() << "\n" << found.critical.name());
      const Eigen::Vector2d expected = (forward + backward) / 2;
      CHECK((found.gradient - expected).norm() <= 1e-4 * (1 + expected.norm() + found.value));
      ++compared;
      by_mode += found.critical.kind == Critical::Kind::mode;
    }
  }
  CHECK(compared > surefoot::test::enough(200));
  CHECK(by_mode > surefoot::test::enough(20));
}

TEST_CASE("A single contact is never robust and never an equilibrium", "[oracle]") {
  const std::uint64_t seed = 8;
  Sampler sampler(seed);
  for (int round = 0; round < surefoot::test::rounds(200); ++round) {
    SamplePosture sample = sampler.posture(all_kinds[round % all_kinds.size()], 1);
    if (round % 3 == 0) sample.com.x() = sample.contacts[0].position.x(), sample.box = {0, 0};
    INFO("seed " << seed << "\n" << sample.json());
    const RobustOracle oracle = oracle_of(sample);
    CHECK_FALSE(oracle.equilibrium(sample.com));
    CHECK_FALSE(oracle.robust(sample.com));
    CHECK(oracle.safety_factor(sample.com).value == 0);
  }
}
