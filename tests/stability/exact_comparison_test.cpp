// A share of the exact comparison (bench/README.md) with fixed seeds, and the exact decisions themselves against the
// brute force of direct_reference.hpp and cases computed by hand.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/agreement.hpp"
#include "tests/support/direct_reference.hpp"
#include "tests/support/exact_comparison.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::testing;

namespace {

constexpr std::uint64_t seed = 20;

template <class Kind>
ComparisonCounts compared(Kind kind, long cases) {
  std::string differences;
  const ComparisonCounts counts =
      compare_block(kind, seed, cases, [&](const std::string& text) { differences.append(text).append("\n"); });
  INFO(differences);
  CHECK(counts.differences == 0);
  CHECK(counts.cases == cases);
  return counts;
}

}  // namespace

TEST_CASE("Verdicts agree with exact arithmetic on random postures", "[exact]") {
  const ComparisonCounts counts = compared(PointKind::random, 6000);
  CHECK(counts.robust > surefoot::test::enough(600));
}

TEST_CASE("Verdicts agree with exact arithmetic on and beside every kind of boundary", "[exact]") {
  for (const PointKind kind : adversarial_kinds) {
    const ComparisonCounts counts = compared(kind, 700);
    INFO(name(kind));
    CHECK(counts.robust > 0);
    CHECK(counts.robust < counts.cases);
  }
}

TEST_CASE("Answers for lines agree with an exact decision at every point of them", "[exact][line]") {
  for (const LineKind kind : line_kinds) {
    const ComparisonCounts counts = compared(kind, 150);
    INFO(name(kind));
    CHECK(counts.robust > 0);
    CHECK(counts.robust < counts.cases);
    if (kind == LineKind::slender) CHECK(counts.inside > 0);
    if (kind == LineKind::stable_ends || kind == LineKind::slender || kind == LineKind::random ||
        kind == LineKind::tied)
      CHECK(counts.uncertain == 0);
  }
}

TEST_CASE("Exact decisions in integers and the brute force in rationals are the same", "[exact][reference]") {
  Sampler sampler(seed);
  for (int round = 0; round < 8; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      INFO(sample.json());
      const ExactPosture exact(sample);
      const DirectReference<Rational> direct(sample);
      const ExactFrame frame = exact.frame(ExactCom(sample.com));
      CHECK(exact.feasible_modes(frame) == sorted(direct.feasible_modes(sample.com)));
      CHECK(exact.equilibrium(frame) == direct.equilibrium(sample.com));
      CHECK(exact.robust(frame) == direct.robust(sample.com));
    }
  }
}

TEST_CASE("Where a point of a line allows a mode, so does the exact decision on the line", "[exact][reference]") {
  Sampler sampler(seed);
  int feasible = 0, infeasible = 0, confirmed = 0;
  for (int round = 0; round < 4; ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      const Eigen::Vector2d to = sampler.com_near(sample.contacts);
      INFO(sample.json() << " to " << to.transpose());
      const ExactPosture exact(sample);
      ExactLine line(exact, sample.com, to);
      for (const ExactMode& mode : exact.modes()) {
        INFO(mode.mode.name());
        const auto found = line.feasible(mode);
        bool sampled = false;
        for (int k = 0; k <= 16 && !sampled; ++k)
          sampled = exact.feasible(exact.frame(ExactCom(sample.com, to, k / 16.0)), mode);
        if (sampled) CHECK(found);
        const double lambda = found ? found->approximate() : -1;
        if (found && found->equals(lambda)) CHECK(exact.feasible(exact.frame(ExactCom(sample.com, to, lambda)), mode));
        confirmed += found && found->equals(lambda);
        feasible += found.has_value();
        infeasible += !found;
      }
    }
  }
  CHECK(feasible > surefoot::test::enough(100));
  CHECK(infeasible > surefoot::test::enough(100));
  CHECK(confirmed > surefoot::test::enough(100));
}

namespace {

/// Random rows on an interval; some touch each other, or zero, at points that no halving meets.
class PieceSampler {
 public:
  Bernstein quadratic(int greatest) { return {number(greatest), number(greatest), number(greatest)}; }
  QuadraticForm row(int greatest) {
    QuadraticForm result;
    for (Form& form : result) form = {number(greatest), number(greatest) - greatest / 3, number(greatest)};
    return result;
  }
  static QuadraticForm constant(const Bernstein& f) { return {Form{0, f[0], 0}, Form{0, f[1], 0}, Form{0, f[2], 0}}; }
  /// -(m t - k)^2 2^50 + 1 or 0: positive at most on an interval of about 2^-24 around k / m.
  QuadraticForm hair() {
    const int m = sampler_.integer(2, 9), k = sampler_.integer(1, m - 1), above = sampler_.integer(0, 1);
    const Integer steep = Integer(1) << 50;
    return constant({above - steep * k * k, 2 * above + 2 * steep * k * (m - k), above - steep * (m - k) * (m - k)});
  }
  ModePiece piece(int shape) {
    const int greatest = shape % 2 == 0 ? 3 : 30;  // small numbers touch exactly
    ModePiece piece;
    piece.d = sampler_.chance(0.5) ? quadratic(greatest) : Bernstein{1, 2, 1};
    for (int rows = sampler_.integer(1, 4); rows > 0; --rows) piece.rows.push_back(row(greatest));
    if (shape % 10 == 0) {  // f > 0 and -f > 0
      const Bernstein f = quadratic(9);
      piece.rows = {constant(f), constant({-f[0], -f[1], -f[2]})};
    } else if (shape % 10 == 1) {
      piece.rows.resize(1);
      piece.rows.push_back(hair());
    } else if (shape % 10 < 5) {  // y > 0 and d w - y > 0: parallel where d = 0
      piece.d = quadratic(9);
      const Form y{number(3), number(3), number(3)};
      const Integer w = sampler_.chance(0.5) ? 1 : -1;
      piece.rows.resize(1);
      piece.rows.push_back({y, Form{2 * y.p, 2 * y.one, 2 * y.q}, y});
      const QuadraticForm& a = piece.rows.back();
      QuadraticForm b;
      for (int k = 0; k < 3; ++k) b[k] = {-a[k].p, w * piece.d[k] - a[k].one, -a[k].q};
      piece.rows.push_back(b);
    }
    return piece;
  }

 private:
  Integer number(int greatest) { return sampler_.integer(-greatest, greatest); }
  Sampler sampler_{seed};
};

}  // namespace

TEST_CASE("Random quadratic rows: what dense sampling allows, the decision on an interval finds",
          "[exact][reference]") {
  const std::array<Form, 4> corners{Form{-1, 1, -1}, Form{1, 1, -1}, Form{1, 1, 1}, Form{-1, 1, 1}};
  PieceSampler sampler;
  int inside = 0, hairs = 0, none = 0, by_roots = 0;
  for (int round = 0; round < surefoot::test::rounds(6000); ++round) {
    const ModePiece piece = sampler.piece(round);
    PieceDecision decision(corners);
    const auto found = decision.feasible(piece);
    bool sampled = false;
    for (int k = 0; k <= 64 && !sampled; ++k) sampled = decision.feasible_at(piece, {k, 64});
    if (sampled && !found) FAIL_CHECK("round " << round);
    if (found) CHECK(decision.feasible_at(piece, *found));
    inside += found && !decision.feasible_at(piece, {0, 1}) && !decision.feasible_at(piece, {1, 1});
    hairs += found && !sampled && round % 10 == 1;
    none += !found;
    by_roots += decision.work().by_roots > 0;
  }
  CHECK(inside > surefoot::test::enough(200));
  CHECK(hairs > surefoot::test::enough(20));
  CHECK(none > surefoot::test::enough(1000));
  CHECK(by_roots > surefoot::test::enough(100));
}

TEST_CASE("A line that passes the point of a wedge of unstable COMs, computed by hand", "[exact][reference]") {
  // Feet at (-+1/2, 0), normals leaning 45 degrees inwards, COM (X, Y), kappa = 0: N_1 = (1, 1, Y - X - 1/2),
  // N_2 = (-1, 1, 1/2 - X - Y). FF at q = -nu with rho^2 / nu = 1/2 iff Y - X > 1 and -X - Y > 0: a wedge with its
  // point at
  // (-1/2, 1/2). At q = +nu the wedge is its mirror image, X > 1/2.
  SamplePosture sample;
  sample.contacts = {{{-0.5, 0}, {1, 1}, 0.5}, {{0.5, 0}, {-1, 1}, 0.5}};
  sample.rho = 0.25;
  sample.box = {0, 0.125};
  const ExactPosture exact(sample);
  const ExactMode& all_break = exact.modes().front();
  REQUIRE(all_break.mode.name() == "FF");
  const double beside = std::nextafter(-0.5, -1);
  CHECK_FALSE(ExactLine(exact, {-0.5, 0}, {-0.5, 1.25}).feasible(all_break));
  CHECK_FALSE(exact.feasible(exact.frame(ExactCom(Eigen::Vector2d(beside, 0))), all_break));
  const auto found = ExactLine(exact, {beside, 0}, {beside, 1.25}).feasible(all_break);
  REQUIRE(found);
  CHECK(found->approximate() == Approx(0.4).epsilon(1e-12));  // an interval of lambda of 2^-53 / 1.25
  // Along its sides: Y = 1 + X touches nowhere, and half a unit beside it does.
  CHECK_FALSE(ExactLine(exact, {-0.5, 0.5}, {-1.5, -0.5}).feasible(all_break));
  CHECK(ExactLine(exact, {-0.5, 0.5}, {-1.5, std::nextafter(-0.5, 0)}).feasible(all_break));
}

TEST_CASE("Roots are separated where they are, multiple ones once", "[exact][reference]") {
  // (2t - 1)^2 (4t - 1)(3t - 2)(t - 1): 1/4, 1/2, 2/3, 1 in (0, 1]; each factor a t + b as b (1 - t) + (a + b) t.
  const auto factor = [](int a, int b) { return Bernstein{Integer(b), Integer(a + b)}; };
  Bernstein polynomial{Integer(1)};
  for (const Bernstein& f : {factor(2, -1), factor(2, -1), factor(4, -1), factor(3, -2), factor(1, -1)})
    polynomial = product(polynomial, f);
  const auto roots = isolated_roots(polynomial, 100);
  REQUIRE(roots.size() == 4);
  const std::array<double, 4> expected{0.25, 0.5, 2.0 / 3, 1};
  for (int k = 0; k < 4; ++k) {
    const auto& [low, high] = roots[k];
    CHECK(high.numerator - low.numerator == 1);
    const Fraction upper{high.numerator, Integer(1) << high.exponent};
    CHECK(upper.approximate() == Approx(expected[k]).epsilon(1e-15));
  }
  CHECK(isolated_roots(product(factor(0, 1), factor(1, 1)), 20).empty());
  const auto half = isolated_roots(factor(2, -1), 1);
  REQUIRE(half.size() == 1);
  CHECK(half[0][1].numerator == 1);
}
