// Laws that the answers obey whatever the posture: mirror, translation, scaling, order of contacts, growth of the box.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/agreement.hpp"

using namespace surefoot::testing;
using surefoot::stability::Critical;
using surefoot::stability::LineVerdict;
using surefoot::stability::RobustOracle;
using surefoot::stability::SafetyFactor;

namespace {

void for_postures(std::uint64_t seed, int rounds, const std::function<void(const SamplePosture&, Sampler&)>& law) {
  Sampler sampler(seed);
  for (int round = 0; round < rounds; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO("seed " << seed << " round " << round << " kind " << name(kind) << "\n" << sample.json());
      law(sample, sampler);
    }
  }
}

std::string swap_slides(std::string mode) {
  for (char& letter : mode) letter = letter == 'U' ? 'W' : letter == 'W' ? 'U' : letter;
  return mode;
}

std::vector<std::string> renamed(std::vector<std::string> modes,
                                 const std::function<std::string(std::string)>& rename) {
  for (std::string& mode : modes) mode = rename(mode);
  return sorted(modes);
}

struct Answer {
  bool equilibrium, robust;
  std::vector<std::string> modes;
  SafetyFactor factor;
};

Answer answer(const SamplePosture& sample) {
  const RobustOracle oracle = oracle_of(sample);
  return {oracle.equilibrium(sample.com), oracle.robust(sample.com), mode_names(oracle.feasible_modes(sample.com)),
          oracle.safety_factor(sample.com)};
}

void same_verdicts(const Answer& a, const Answer& b) {
  CHECK(a.equilibrium == b.equilibrium);
  CHECK(a.robust == b.robust);
  CHECK(a.modes == b.modes);
}

void same_factor(double a, double b, double relative) {
  if (a > practically_infinite || b > practically_infinite) {
    CHECK(std::min(a, b) > 0.1 * practically_infinite);
  } else {
    CHECK(a == Approx(b).epsilon(relative).margin(1e-9));
  }
}

}  // namespace

TEST_CASE("The mirror image has the same verdicts with U and W exchanged", "[invariance]") {
  for_postures(1, 60, [](const SamplePosture& sample, Sampler&) {
    SamplePosture mirrored = sample;
    mirrored.com.x() *= -1;
    for (Contact& contact : mirrored.contacts) contact.position.x() *= -1, contact.normal.x() *= -1;
    Answer image = answer(mirrored);
    const Answer original = answer(sample);
    image.modes = renamed(image.modes, swap_slides);
    same_verdicts(original, image);
    same_factor(original.factor.value, image.factor.value, 1e-9);
    if (original.factor.value > 1e-6 && original.factor.value < 1e3 &&
        original.factor.critical.name() == swap_slides(image.factor.critical.name()) &&
        original.factor.critical.kind == Critical::Kind::mode) {
      const Eigen::Vector2d reflected(-image.factor.gradient.x(), image.factor.gradient.y());
      const double size = 1 + original.factor.gradient.norm();
      CHECK((original.factor.gradient - reflected).norm() <= 1e-6 * size);
    }
  });
}

TEST_CASE("Lengths scaled by a power of two change no verdict, and the safety factor not at all", "[invariance]") {
  for_postures(2, 60, [](const SamplePosture& sample, Sampler& sampler) {
    const double factor = std::ldexp(1.0, sampler.integer(-12, 12));
    SamplePosture scaled = sample;
    for (Contact& contact : scaled.contacts) contact.position *= factor;
    scaled.com *= factor;
    scaled.rho *= factor;
    scaled.box.nu *= factor;
    const Answer before = answer(sample), after = answer(scaled);
    same_verdicts(before, after);
    same_factor(before.factor.value, after.factor.value, 1e-12);
  });
}

TEST_CASE("A translation by dyadic numbers changes no verdict", "[invariance]") {
  for_postures(3, 60, [](const SamplePosture& sample, Sampler& sampler) {
    // Coordinates on a dyadic grid: the shifted numbers are exact.
    const auto snap = [](double value) { return std::round(value * 0x1p20) * 0x1p-20; };
    SamplePosture here = sample;
    for (Contact& contact : here.contacts) contact.position = contact.position.unaryExpr(snap);
    here.com = here.com.unaryExpr(snap);
    SamplePosture there = here;
    const Eigen::Vector2d by(sampler.integer(-1000, 1000), 0.25 * sampler.integer(-1000, 1000));
    for (Contact& contact : there.contacts) contact.position += by;
    there.com += by;
    const Answer before = answer(here), after = answer(there);
    same_verdicts(before, after);
    same_factor(before.factor.value, after.factor.value, 1e-9);
  });
}

TEST_CASE("The length of a normal does not matter", "[invariance]") {
  for_postures(4, 60, [](const SamplePosture& sample, Sampler& sampler) {
    SamplePosture scaled = sample;
    for (Contact& contact : scaled.contacts) contact.normal *= std::ldexp(1.0, sampler.integer(-30, 30));
    const Answer before = answer(sample), after = answer(scaled);
    same_verdicts(before, after);
    same_factor(before.factor.value, after.factor.value, 1e-12);
  });
}

TEST_CASE("The order of the contacts permutes the letters of the modes and nothing else", "[invariance]") {
  for_postures(5, 60, [](const SamplePosture& sample, Sampler&) {
    SamplePosture turned = sample;
    std::rotate(turned.contacts.begin(), turned.contacts.begin() + 1, turned.contacts.end());
    const auto turn_back = [](std::string mode) {
      std::rotate(mode.begin(), mode.end() - 1, mode.end());
      return mode;
    };
    Answer after = answer(turned);
    after.modes = renamed(after.modes, turn_back);
    const Answer before = answer(sample);
    same_verdicts(before, after);
    same_factor(before.factor.value, after.factor.value, 1e-9);
  });
}

TEST_CASE("A box k times as large has a safety factor k times as small", "[monotone]") {
  for_postures(6, 60, [](const SamplePosture& sample, Sampler& sampler) {
    const double k = std::ldexp(1.0, sampler.integer(-3, 3));
    SamplePosture larger = sample;
    larger.box = {k * sample.box.kappa, k * sample.box.nu};
    same_factor(answer(sample).factor.value, k * answer(larger).factor.value, 1e-9);
  });
}

TEST_CASE("What is robust for a box is robust for every box inside it", "[monotone]") {
  int robust = 0;
  for_postures(7, 80, [&](const SamplePosture& sample, Sampler& sampler) {
    const Answer whole = answer(sample);
    SamplePosture smaller = sample;
    smaller.box = {sampler.uniform(0, 1) * sample.box.kappa, sampler.chance(0.2) ? 0 : 0.5 * sample.box.nu};
    const Answer part = answer(smaller);
    if (whole.robust) CHECK(part.robust);
    if (whole.equilibrium) CHECK(part.equilibrium);
    CHECK(std::includes(whole.modes.begin(), whole.modes.end(), part.modes.begin(), part.modes.end()));
    CHECK(part.factor.value >= whole.factor.value * (1 - 1e-9));
    robust += whole.robust;
  });
  CHECK(robust > 100);
}

TEST_CASE("Robust means: equilibrium and no feasible mode, and a safety factor above one", "[consistency]") {
  int robust = 0;
  for_postures(8, 120, [&](const SamplePosture& sample, Sampler&) {
    const Answer a = answer(sample);
    CHECK(a.robust == (a.equilibrium && a.modes.empty()));
    if (std::abs(a.factor.value - 1) > 1e-9) CHECK(a.robust == (a.factor.value > 1));
    const double least = oracle_of(sample).equilibrium_factor(sample.com).value;
    CHECK(a.factor.value <= least * (1 + 1e-12));
    if (std::abs(least - 1) > 1e-9) CHECK(a.equilibrium == (least > 1));
    robust += a.robust;
  });
  CHECK(robust > 150);
}

TEST_CASE("A line whose ends coincide has the answers of the point", "[line]") {
  for_postures(9, 60, [](const SamplePosture& sample, Sampler&) {
    const RobustOracle oracle = oracle_of(sample);
    const Answer point = answer(sample);
    CHECK(oracle.line(sample.com, sample.com).stable() == point.robust);
    CHECK(oracle.line_equilibrium(sample.com, sample.com) == point.equilibrium);
    same_factor(oracle.line_safety_factor(sample.com, sample.com).least.value, point.factor.value, 1e-6);
  });
}

TEST_CASE("A line that is stable is stable backwards and on each of its parts", "[line]") {
  int stable = 0;
  for_postures(10, 60, [&](const SamplePosture& sample, Sampler& sampler) {
    const RobustOracle oracle = oracle_of(sample);
    const Eigen::Vector2d to = sampler.com_near(sample.contacts);
    if (!oracle.line(sample.com, to).stable()) return;
    ++stable;
    CHECK(oracle.line(to, sample.com).stable());
    CHECK(oracle.robust(sample.com));
    CHECK(oracle.robust(to));
    for (int k = 1; k < 10; ++k) CHECK(oracle.robust(sample.com + k / 10.0 * (to - sample.com)));
    CHECK(oracle.line_safety_factor(sample.com, to).least.value > 1 - 1e-9);
  });
  CHECK(stable > 20);
}
