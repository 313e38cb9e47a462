// Claims of [OR-P] and their errata, as far as they can be checked: shares of theory section 9, printed lemmas where
// they hold, and counter-examples where they do not.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/agreement.hpp"
#include "tests/support/direct_reference.hpp"

using namespace surefoot::testing;
using surefoot::stability::RobustOracle;

namespace {

constexpr double boundary = 1e-9;  // of the safety factor: rounding of a factor that is 1 on paper
constexpr double degree = 3.14159265358979323846 / 180;

// Ground that rises by `slope` to the right: the normal is the vertical turned by it.
Eigen::Vector2d normal_of(double slope) { return {-std::sin(slope), std::cos(slope)}; }

struct Share {
  double robust = 0;
  std::set<std::string> modes;  // that occur within R_SS(W)
};

Share share_of_robust(const std::vector<Contact>& contacts, double rho) {
  const RobustOracle oracle(contacts, rho, {std::tan(10 * degree), 0.1});
  int equilibria = 0, robust = 0;
  Share share;
  for (int i = 0; i < 57; ++i) {
    for (int k = 0; k < 141; ++k) {
      const Eigen::Vector2d com(-0.2 + 1.4 * i / 56, -2 + 7.0 * k / 140);
      if (!oracle.equilibrium(com)) continue;
      ++equilibria;
      // Two COMs of the grid lie on the boundary of R(W) of the symmetric vee; the published shares count the closed
      // region.
      const double sigma = oracle.safety_factor(com).value;
      if (std::abs(sigma - 1) > boundary) CHECK(oracle.robust(com) == (sigma > 1));
      robust += sigma > 1 - boundary;
      for (const std::string& mode : mode_names(oracle.feasible_modes(com))) share.modes.insert(mode);
    }
  }
  share.robust = static_cast<double>(robust) / equilibria;
  return share;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Edges {
  Eigen::Vector2d u, w;
  explicit Edges(const Contact& contact) {
    const Eigen::Vector2d n = contact.normal.normalized(), t(n.y(), -n.x());
    u = n + contact.friction * t;
    w = n - contact.friction * t;
  }
};

// Where the rays from a along d and from b along e meet, if both look towards the meeting point.
std::optional<Eigen::Vector2d> meeting(const Eigen::Vector2d& a, const Eigen::Vector2d& d, const Eigen::Vector2d& b,
                                       const Eigen::Vector2d& e) {
  const double determinant = cross(d, e);
  if (std::abs(determinant) < 1e-6) return std::nullopt;
  const double along_d = cross(b - a, e) / determinant, along_e = cross(b - a, d) / determinant;
  if (along_d < 1e-6 || along_e < 1e-6) return std::nullopt;
  return a + along_d * d;
}

bool contains(const std::vector<std::string>& names, const std::string& wanted) {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

}  // namespace

TEST_CASE("Small inertia costs robustness: shares of R(W) in R_SS(W) on two postures [OR-P, Fig. 5]", "[paper]") {
  const std::vector<Contact> uneven{{{0, 0}, normal_of(-35 * degree), 0.5}, {{1, 0.1}, normal_of(10 * degree), 0.5}};
  const std::vector<Contact> vee{{{0, 0}, normal_of(-30 * degree), 0.5}, {{1, 0}, normal_of(30 * degree), 0.5}};
  const auto rounded = [](double share) { return std::round(1000 * share) / 1000; };
  CHECK(rounded(share_of_robust(uneven, 0.25).robust) == Approx(1.000));
  CHECK(rounded(share_of_robust(uneven, 0.1).robust) == Approx(0.634));
  CHECK(rounded(share_of_robust(uneven, 0.05).robust) == Approx(0.602));
  CHECK(rounded(share_of_robust(vee, 0.25).robust) == Approx(1.000));
  CHECK(rounded(share_of_robust(vee, 0.1).robust) == Approx(0.921));
  CHECK(rounded(share_of_robust(vee, 0.05).robust) == Approx(0.842));
  const std::set<std::string> responsible{"FF", "FU", "UF", "UU"};
  for (const double rho : {0.1, 0.05}) CHECK(share_of_robust(uneven, rho).modes == responsible);
}

TEST_CASE("[OR-P, Lemma II.1, V.1] hold where the cones meet above the contacts, with p_ww the left point", "[paper]") {
  const std::uint64_t seed = 21;
  Sampler sampler(seed);
  int inside = 0, outside = 0;
  for (int round = 0; round < 3000; ++round) {
    SamplePosture sample = sampler.posture(Kind::vee, 2);
    if (sample.contacts[1].position.x() - sample.contacts[0].position.x() < 0.05) continue;
    const Contact &one = sample.contacts[0], &two = sample.contacts[1];
    const Edges first(one), second(two);
    const auto uu = meeting(one.position, first.u, two.position, second.u);
    const auto ww = meeting(one.position, first.w, two.position, second.w);
    const bool bounded = meeting(one.position, first.u, two.position, second.w) &&
                         meeting(one.position, first.w, two.position, second.u);
    if (!uu || !ww || !bounded) continue;
    INFO("seed " << seed << "\n" << sample.json());
    double depth = std::numeric_limits<double>::infinity();
    for (const double p : {-sample.box.kappa, sample.box.kappa}) {
      for (const double q : {-sample.box.nu, sample.box.nu}) {
        const auto across = [&](const Eigen::Vector2d& point) {
          return (sample.com.x() - point.x()) - p * (sample.com.y() - point.y()) + q;
        };
        depth = std::min({depth, across(*ww), -across(*uu), across(one.position), -across(two.position)});
      }
    }
    if (std::abs(depth) < 1e-9) continue;
    CHECK(oracle_of(sample).equilibrium(sample.com) == (depth > 0));
    depth > 0 ? ++inside : ++outside;
  }
  CHECK(inside > 100);
  CHECK(outside > 100);
}

TEST_CASE("[OR-P, Lemma II.1] has the wrong sense on ridges: an erratum", "[paper]") {
  // Lambda: both normals lean outwards by 10 degrees, mu = 0.5; the edges p_uu, p_ww meet below the ground.
  const std::vector<Contact> ridge{{{-0.5, 0}, normal_of(10 * degree), 0.5}, {{0.5, 0}, normal_of(-10 * degree), 0.5}};
  const Edges first(ridge[0]), second(ridge[1]);
  CHECK_FALSE(meeting({-0.5, 0}, first.u, {0.5, 0}, second.u));
  // Vertical forces at both feet lie inside the cones (tan 10 degrees < 0.5) and carry any COM between the feet.
  for (const double x : {-0.49, -0.2, 0.0, 0.3, 0.49}) CHECK(RobustOracle(ridge, 0.5, {0, 0}).equilibrium({x, 1}));
}

TEST_CASE("[OR-P, Lemma VI.1] is exact for kappa = 0 and upward normals", "[paper]") {
  const std::uint64_t seed = 22;
  Sampler sampler(seed);
  int feasible = 0;
  for (int round = 0; round < 2000; ++round) {
    SamplePosture sample = sampler.posture(round % 2 ? Kind::vee : Kind::ridge, 2);
    sample.box.kappa = 0;
    sample.rho = sampler.uniform(0.01, 0.2);
    INFO("seed " << seed << "\n" << sample.json());
    double first = std::numeric_limits<double>::infinity(), second = first;
    for (const Contact& contact : sample.contacts) {
      const Eigen::Vector2d n = contact.normal.normalized(), t(n.y(), -n.x());
      const double inertia = sample.rho * sample.rho * n.y(),
                   turn = sample.box.nu * (sample.com - contact.position).dot(t);
      first = std::min(first, turn - inertia);
      second = std::min(second, -turn - inertia);
    }
    const double depth = std::max(first, second);
    if (std::abs(depth) < 1e-12) continue;
    CHECK(contains(mode_names(oracle_of(sample).feasible_modes(sample.com)), "FF") == (depth > 0));
    feasible += depth > 0;
  }
  CHECK(feasible > 100);
}

TEST_CASE("[OR-P, Lemma IV.3] holds under gravity once two signs are mended", "[paper]") {
  // With h_2 mended (an effective mass), phi = h_1 / h_2 and tau h_2 + h_1 (r_1 x C) = I_c h_0, where r_1 = -x. Then
  // h_2 n_2 . a_2 = (r_2 x n_2) h_0 + (n_2 . C) h_1 + (n_2 . f) h_2 with r_2 x n_2 = t_2 . (x_2 - x): printed with x -
  // x_2.
  const std::uint64_t seed = 23;
  Sampler sampler(seed);
  int feasible = 0;
  for (int round = 0; round < 3000; ++round) {
    SamplePosture sample = sampler.posture(generic_kinds[round % generic_kinds.size()], 2);
    sample.box = {0, 0};
    INFO("seed " << seed << "\n" << sample.json());
    const Contact &one = sample.contacts[0], &two = sample.contacts[1];
    const Eigen::Vector2d n1 = one.normal.normalized(), t1(n1.y(), -n1.x()), n2 = two.normal.normalized(),
                          t2(n2.y(), -n2.x()), x = sample.com - one.position, x2 = two.position - one.position,
                          force(0, -1), cw = Edges(one).w;
    const double inertia = sample.rho * sample.rho, turn = cross(x, cw);
    const double h0 = n1.dot(force) * turn;
    const double h1 = -inertia * force.dot(n1);
    const double h2 = inertia * n1.dot(cw) + t1.dot(x) * turn;
    const double h3 = n1.dot(x) * h0 + t1.dot(cw) * h1 + t1.dot(force) * h2;
    const double h4 = t2.dot(x2 - x) * h0 + n2.dot(cw) * h1 + n2.dot(force) * h2;
    const double least = std::min({h1, h2, h3, h4}), greatest = std::max({h1, h2, h3, h4});
    if (std::abs(least) < 1e-12 || std::abs(greatest) < 1e-12) continue;
    CHECK(contains(mode_names(oracle_of(sample).feasible_modes(sample.com)), "UF") == (least > 0 || greatest < 0));
    feasible += least > 0 || greatest < 0;
  }
  CHECK(feasible > 50);
}

TEST_CASE("[OR-P, Lemma IV.2] fails: RF and equilibrium coexist for close feet one above the other", "[paper]") {
  const std::uint64_t seed = 24;
  Sampler sampler(seed);
  int coexisting = 0;
  for (int round = 0; round < 20000 && coexisting < 5; ++round) {
    SamplePosture sample = sampler.posture(Kind::gentle, 2);
    sample.contacts[1].position = sample.contacts[0].position + Eigen::Vector2d(sampler.uniform(-0.1, 0.1), 0.3);
    sample.com = sample.contacts[0].position + Eigen::Vector2d(sampler.uniform(-0.2, 0.2), sampler.uniform(0, 1));
    sample.box = {0, 0};
    const DirectReference<Rational> exact(sample);
    if (!exact.equilibrium(sample.com) || !contains(exact.feasible_modes(sample.com), "RF")) continue;
    INFO("seed " << seed << "\n" << sample.json());
    CHECK(oracle_of(sample).equilibrium(sample.com));
    CHECK(contains(mode_names(oracle_of(sample).feasible_modes(sample.com)), "RF"));
    CHECK_FALSE(oracle_of(sample).robust(sample.com));
    ++coexisting;
  }
  CHECK(coexisting == 5);
}

TEST_CASE("[OR-P, section III] calls UW kinematically infeasible, on steep ground it occurs", "[paper]") {
  const std::uint64_t seed = 25;
  Sampler sampler(seed);
  int sliding_apart = 0;
  for (int round = 0; round < 20000 && sliding_apart < 5; ++round) {
    const SamplePosture sample = sampler.posture(round % 2 ? Kind::walls : Kind::any, 2);
    const DirectReference<Rational> exact(sample);
    if (!contains(exact.feasible_modes(sample.com), "UW")) continue;
    INFO("seed " << seed << "\n" << sample.json());
    CHECK(contains(mode_names(oracle_of(sample).feasible_modes(sample.com)), "UW"));
    ++sliding_apart;
  }
  CHECK(sliding_apart == 5);
}
