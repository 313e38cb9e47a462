// The catalogue of docs/extremes.md: every verdict, factor and gradient against exact arithmetic
// (tests/support/exact_posture.hpp).
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/agreement.hpp"
#include "tests/support/extreme_cases.hpp"
#include "tests/support/extreme_factor.hpp"

using namespace surefoot::testing;
using surefoot::stability::LineSafetyFactor;
using surefoot::stability::RobustOracle;
using surefoot::stability::SafetyFactor;

namespace {

constexpr double stated_factor_error = 1e-9, stated_gradient_error = 1e-9;  // robust_oracle.hpp

const std::vector<ExtremeCase>& catalogue() {
  static const std::vector<ExtremeCase> cases = extreme_catalogue();
  return cases;
}

std::string described(const ExtremeCase& example) {
  return example.group + ": " + example.name + "\n" + example.sample.json();
}

}  // namespace

TEST_CASE("No verdict of the catalogue of extremes is wrong", "[extremes]") {
  int robust = 0, balanced = 0;
  for (const ExtremeCase& example : catalogue()) {
    INFO(described(example));
    const RobustOracle oracle = oracle_of(example.sample);
    const ExactVerdict exact = exact_verdict(example.sample);
    CHECK(oracle.equilibrium(example.sample.com) == exact.equilibrium);
    CHECK(mode_names(oracle.feasible_modes(example.sample.com)) == exact.modes);
    CHECK(oracle.robust(example.sample.com) == exact.robust);
    robust += exact.robust;
    balanced += exact.equilibrium;
  }
  CHECK(catalogue().size() > 3000);
  CHECK(robust > 800);
  CHECK(balanced - robust > 300);
}

TEST_CASE("Safety factors and gradients of the catalogue are within the stated errors and never NaN", "[extremes]") {
  constexpr std::size_t share = 3;  // a third of the catalogue; `extremes` compares all of it
  int finite = 0;
  for (std::size_t k = 0; k < catalogue().size(); k += share) {
    const ExtremeCase& example = catalogue()[k];
    INFO(described(example));
    const SafetyFactor found = oracle_of(example.sample).safety_factor(example.sample.com);
    const FactorComparison comparison = compared(example.sample, found, exact_safety_factor(example.sample));
    CHECK_FALSE(comparison.not_a_number);
    CHECK(comparison.value_error <= stated_factor_error);
    CHECK(comparison.gradient_error <= stated_gradient_error);
    finite += std::isfinite(found.value) && found.value > 0;
  }
  CHECK(finite > 400);
}

TEST_CASE("Factors and verdicts of the catalogue never contradict each other", "[extremes]") {
  for (const ExtremeCase& example : catalogue()) {
    INFO(described(example));
    const RobustOracle oracle = oracle_of(example.sample);
    const Eigen::Vector2d& com = example.sample.com;
    const SafetyFactor factor = oracle.safety_factor(com);
    const SafetyFactor balance = oracle.equilibrium_factor(com);
    CHECK((factor.value > 1 ? oracle.robust(com) : true));
    CHECK((oracle.robust(com) ? factor.value >= 1 : true));
    CHECK((balance.value > 1 ? oracle.equilibrium(com) : true));
    CHECK((oracle.equilibrium(com) ? balance.value >= 1 : true));
    CHECK_FALSE((factor.gradient.x() == 0 && std::signbit(factor.gradient.x())));
    CHECK_FALSE((factor.gradient.y() == 0 && std::signbit(factor.gradient.y())));
    if (factor.critical.kind == surefoot::stability::Critical::Kind::mode && factor.value < 1)
      CHECK(mode_names(oracle.feasible_modes(com)).size() > 0);
  }
}

TEST_CASE("Lengths times powers of two change neither verdict nor factor", "[extremes]") {
  for (std::size_t k = 0; k < catalogue().size(); k += 17) {
    const ExtremeCase& example = catalogue()[k];
    INFO(described(example));
    const RobustOracle oracle = oracle_of(example.sample);
    for (const double factor : {0x1p-30, 0x1p30}) {
      bool exact = true;  // nothing under- or overflows
      const auto scale = [&](double& value) {
        const double product = value * factor;
        exact = exact && std::isfinite(product) && product / factor == value;
        value = product;
      };
      SamplePosture scaled = example.sample;
      for (Contact& contact : scaled.contacts) scale(contact.position.x()), scale(contact.position.y());
      for (double* value : {&scaled.com.x(), &scaled.com.y(), &scaled.rho, &scaled.box.nu}) scale(*value);
      if (!exact) continue;
      const RobustOracle other = oracle_of(scaled);
      CHECK(other.robust(scaled.com) == oracle.robust(example.sample.com));
      CHECK(mode_names(other.feasible_modes(scaled.com)) == mode_names(oracle.feasible_modes(example.sample.com)));
      const double expected = oracle.safety_factor(example.sample.com).value,
                   found = other.safety_factor(scaled.com).value;
      CHECK((found == expected || std::abs(found - expected) <= 2 * stated_factor_error * expected));
    }
  }
}

TEST_CASE("No line of the catalogue has a factor above 1 that is not certified stable", "[extremes][line]") {
  int stable = 0, unstable = 0;
  for (std::size_t k = 0; k + 40 < catalogue().size(); k += 40) {
    const ExtremeCase& example = catalogue()[k];
    if (example.group == "denormals" || example.group == "near overflow") continue;
    INFO(described(example));
    const RobustOracle oracle = oracle_of(example.sample);
    const Eigen::Vector2d& from = example.sample.com;
    const Eigen::Vector2d to =
        0.75 * from + 0.25 * (example.sample.contacts[0].position + example.sample.contacts[1].position) / 2;
    const LineSafetyFactor least = oracle.line_safety_factor(from, to);
    const bool certified = oracle.line(from, to).stable();
    CHECK_FALSE(std::isnan(least.least.value));
    CHECK((least.least.value > 1 ? certified : true));
    CHECK((certified ? least.least.value >= 1 : true));
    (certified ? stable : unstable) += 1;
  }
  CHECK(stable > 10);
  CHECK(unstable > 10);
}
