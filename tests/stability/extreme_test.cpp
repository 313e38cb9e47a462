// Where neighbours fail: extreme scales and shifts, tiny friction, contacts that nearly or exactly coincide, COMs at a
// hair's breadth from a boundary. Expected verdicts come from exact rational arithmetic on the very doubles the oracle
// gets.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/agreement.hpp"
#include "tests/support/direct_reference.hpp"

using namespace surefoot::testing;
using surefoot::stability::RobustOracle;

namespace {

void compare_verdicts(const SamplePosture& sample) {
  INFO(name(sample.kind) << "\n" << sample.json());
  const RobustOracle oracle = oracle_of(sample);
  const DirectReference<Rational> exact(sample);
  CHECK(mode_names(oracle.feasible_modes(sample.com)) == sorted(exact.feasible_modes(sample.com)));
  CHECK(oracle.equilibrium(sample.com) == exact.equilibrium(sample.com));
  CHECK(oracle.robust(sample.com) == exact.robust(sample.com));
}

void scale(SamplePosture& sample, double factor) {
  for (Contact& contact : sample.contacts) contact.position *= factor;
  sample.com *= factor;
  sample.rho *= factor;
  sample.box.nu *= factor;
}

void shift(SamplePosture& sample, const Eigen::Vector2d& by) {
  for (Contact& contact : sample.contacts) contact.position += by;
  sample.com += by;
}

void bring_together(SamplePosture& sample, double distance) {
  for (std::size_t i = 1; i < sample.contacts.size(); ++i) {
    sample.contacts[i].position.x() = sample.contacts[0].position.x() + distance * static_cast<double>(i);
    sample.contacts[i].position.y() = sample.contacts[0].position.y();
  }
}

void for_all_kinds(std::uint64_t seed, int rounds, const std::function<void(SamplePosture&, Sampler&)>& change) {
  Sampler sampler(seed);
  INFO("seed " << seed);
  for (int round = 0; round < rounds; ++round) {
    for (const Kind kind : all_kinds) {
      SamplePosture sample = sampler.posture(kind, sampler.integer(2, 3));
      change(sample, sampler);
      compare_verdicts(sample);
    }
  }
}

}  // namespace

TEST_CASE("Verdicts are exact for lengths a million times larger and smaller", "[extreme]") {
  for_all_kinds(1, 6, [](SamplePosture& sample, Sampler&) { scale(sample, 1e6); });
  for_all_kinds(2, 6, [](SamplePosture& sample, Sampler&) { scale(sample, 1e-6); });
}

TEST_CASE("Verdicts are exact when everything is shifted by a million metres", "[extreme]") {
  for_all_kinds(3, 6, [](SamplePosture& sample, Sampler&) { shift(sample, {1e6, -1e6}); });
  for_all_kinds(4, 6, [](SamplePosture& sample, Sampler&) { shift(sample, {-1e6, 1e6 + 0.1}); });
}

TEST_CASE("Verdicts are exact for friction of one millionth and of one million", "[extreme]") {
  for_all_kinds(5, 6, [](SamplePosture& sample, Sampler&) {
    for (Contact& contact : sample.contacts) contact.friction = 1e-6;
  });
  for_all_kinds(6, 3, [](SamplePosture& sample, Sampler&) {
    for (Contact& contact : sample.contacts) contact.friction = 1e6;
  });
}

TEST_CASE("Verdicts are exact for contacts a nanometre apart", "[extreme]") {
  for_all_kinds(7, 6, [](SamplePosture& sample, Sampler& sampler) {
    bring_together(sample, 1e-9);
    sample.com.x() = sample.contacts[0].position.x() + sampler.uniform(-1e-9, 3e-9);
    if (sampler.chance(0.5)) sample.box.nu = 1e-10;
  });
}

TEST_CASE("Verdicts are exact for identical contacts", "[extreme]") {
  for_all_kinds(8, 6, [](SamplePosture& sample, Sampler& sampler) {
    sample.contacts[1] = sample.contacts[0];
    if (sampler.chance(0.5)) sample.contacts.back() = sample.contacts[0];
  });
}

TEST_CASE("Verdicts are exact for nearly collinear contacts on a slope that doubles cannot hold", "[extreme]") {
  for_all_kinds(9, 6, [](SamplePosture& sample, Sampler& sampler) {
    const double slope = sampler.uniform(-0.5, 0.5);
    for (Contact& contact : sample.contacts) {
      contact.position.y() = slope * contact.position.x();
      contact.normal = Eigen::Vector2d(-slope, 1).normalized();
    }
  });
}

TEST_CASE("Verdicts are exact for tiny and for vanishing disturbances", "[extreme]") {
  for_all_kinds(10, 4, [](SamplePosture& sample, Sampler&) { sample.box = {0, 0}; });
  for_all_kinds(11, 4, [](SamplePosture& sample, Sampler&) { sample.box = {1e-12, 1e-14}; });
  for_all_kinds(12, 4, [](SamplePosture& sample, Sampler&) { sample.box = {1e8, 1e8}; });
}

TEST_CASE("Verdicts are exact for COMs within rounding of the boundary of the robust region", "[extreme]") {
  const std::uint64_t seed = 13;
  Sampler sampler(seed);
  INFO("seed " << seed);
  int found = 0;
  for (int round = 0; round < 4000 && found < 60; ++round) {
    SamplePosture sample = sampler.posture(all_kinds[round % all_kinds.size()], sampler.integer(2, 3));
    const DirectReference<double> reference(sample);
    Eigen::Vector2d in = sample.com, out = sampler.com_near(sample.contacts);
    if (!reference.robust(in) || reference.robust(out)) continue;
    ++found;
    for (int step = 0; step < 60; ++step) {
      const Eigen::Vector2d middle = 0.5 * (in + out);
      (reference.robust(middle) ? in : out) = middle;
    }
    for (const double offset : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-9, -1e-9}) {
      sample.com = in + Eigen::Vector2d(offset, 0);
      compare_verdicts(sample);
    }
  }
  CHECK(found == 60);
}

TEST_CASE("COMs exactly on a boundary are outside: level ground with dyadic numbers", "[extreme]") {
  // Tipping at x - p h + q = 0: x = kappa h + nu exactly.
  SamplePosture sample;
  sample.contacts = {{{0, 0}, {0, 1}, 1}, {{1, 0}, {0, 1}, 1}};
  sample.rho = 0.5;
  sample.box = {0.25, 0.125};
  sample.com = {0.25 * 0.5 + 0.125, 0.5};
  CHECK_FALSE(oracle_of(sample).equilibrium(sample.com));
  CHECK_FALSE(oracle_of(sample).robust(sample.com));
  CHECK(oracle_of(sample).safety_factor(sample.com).value == Approx(1).epsilon(1e-12));
  compare_verdicts(sample);
  sample.com.x() = std::nextafter(sample.com.x(), 1);
  CHECK(oracle_of(sample).equilibrium(sample.com));
  compare_verdicts(sample);
  // Sliding at |p| = mu: friction 0.25 against kappa 0.25.
  for (Contact& contact : sample.contacts) contact.friction = 0.25;
  sample.com = {0.5, 0.25};
  CHECK_FALSE(oracle_of(sample).equilibrium(sample.com));
  compare_verdicts(sample);
  for (Contact& contact : sample.contacts) contact.friction = std::nextafter(0.25, 1);
  CHECK(oracle_of(sample).equilibrium(sample.com));
  compare_verdicts(sample);
}

TEST_CASE("A cone without interior supports nothing, a whole-space cone everything", "[degenerate]") {
  SamplePosture sample;
  sample.rho = 0.3;
  sample.com = {0.5, 0.4};
  // All rays on one line: identical frictionless contacts straight below the COM.
  sample.contacts = {{{0.5, 0}, {0, 1}, 0}, {{0.5, 0}, {0, 2}, 0}};
  CHECK_FALSE(oracle_of(sample).equilibrium(sample.com));
  CHECK(oracle_of(sample).equilibrium_factor(sample.com).value == 0);
  // All rays in one plane: frictionless level ground.
  sample.contacts = {{{0, 0}, {0, 1}, 0}, {{1, 0}, {0, 1}, 0}, {{0.2, 0}, {0, 1}, 0}};
  CHECK_FALSE(oracle_of(sample).equilibrium(sample.com));
  CHECK_FALSE(oracle_of(sample).robust(sample.com));
  // Floor and ceiling: whole space. A huge box, a COM far off.
  sample.contacts = {{{0, 0}, {0, 1}, 0.5}, {{0, 1}, {0, -1}, 0.5}};
  sample.com = {30, -20};
  sample.box = {100, 1000};
  CHECK(oracle_of(sample).equilibrium(sample.com));
  CHECK(std::isinf(oracle_of(sample).equilibrium_factor(sample.com).value));
  CHECK(oracle_of(sample).equilibrium_half_planes().empty());
  CHECK(oracle_of(sample).line_equilibrium(sample.com, {-30, 50}));
}

TEST_CASE("Two slides loaded along one line through the COM's percussion axis are not taken for possible",
          "[degenerate]") {
  // The loaded edges (2, 1) at the first foot and (1, 1/2) at the second lie on one line, so D = 0 wherever the COM is,
  // and at this COM M c is parallel to that line too: the slide needs a wrench along it, p = 2, which W does not hold.
  const std::vector<surefoot::stability::Contact> contacts{{{0.25, 0.6875}, {0, 1}, 2}, {{-0.875, 0.125}, {1, 0}, 0.5}};
  const Eigen::Vector2d com(0.125, 0.375), from_com(contacts[0].position - com);
  const double rho = 0.25;
  // c = N_1 x N_2 with N = (n, r x n), in units where the first contact's normal is (0, 1) and the second's (1, 0).
  const double n1z = from_com.x(), n2z = -(contacts[1].position - com).y();
  const Eigen::Vector3d c = Eigen::Vector3d(0, 1, n1z).cross(Eigen::Vector3d(1, 0, n2z));
  const Eigen::Vector3d mc(c.x(), c.y(), rho * rho * c.z());
  const Eigen::Vector3d force(2, 1, from_com.x() * 1 - from_com.y() * 2);
  REQUIRE(mc.cross(force).isZero(0));
  const RobustOracle oracle(contacts, rho, {0.0625, 0.125});
  CHECK(mode_names(oracle.feasible_modes(com)) == std::vector<std::string>{"RF"});
}
