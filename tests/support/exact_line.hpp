// Straight lines of COMs decided in integers, for tests and the exact comparison only: is a mode feasible for some
// lambda in [0, 1]?
//
// On the line every row and D are quadratic in lambda. Whether rows meet the box depends on the signs of polynomials:
// rows at the corners of the box (degree 2), pairs of rows on its sides (4), gradients of pairs (4) and determinants of
// triples (6) (exact_posture.hpp: Helly). For each sign of D the feasible set is open in [0, 1]; so one point between
// any two neighbouring roots decides, with both ends, and a double root of D where both signs are tested.
//   1. points: ends and the middle of every interval looked at;
//   2. proof: on an interval no wrench is left, by coefficients of the polynomials in Bernstein form, else it is
//   halved;
//   3. what is not settled after `halvings`: all roots isolated to 2^-root_bits of that interval, points on both sides
//   of each.
//      Distinct roots of different polynomials closer than this would count as one; nothing else is approximate.
#pragma once

#include <optional>

#include "tests/support/exact_line_proof.hpp"

namespace surefoot::testing {

/// numerator / denominator
struct Fraction {
  Integer numerator, denominator;
  double approximate() const;
  bool equals(double value) const;
};

/// How lines were decided.
struct LineWork {
  long points = 0, intervals = 0, by_roots = 0;
};

/// Is there a t in [0, 1] at which all rows, with the sign of d (both where d = 0), meet the box with these corners?
class PieceDecision {
 public:
  static constexpr int halvings = 20;
  static constexpr int root_bits = 200;

  explicit PieceDecision(const std::array<Form, 4>& corners) : corners_(corners) {}
  std::optional<Fraction> feasible(const ModePiece& whole);
  bool feasible_at(const ModePiece& piece, const Fraction& at) const;
  const LineWork& work() const { return work_; }

 private:
  std::optional<Fraction> between_roots(const ModePiece& piece);
  std::vector<Bernstein> undecided(const ModePiece& piece) const;

  std::array<Form, 4> corners_;
  LineWork work_;
};

class ExactLine {
 public:
  ExactLine(const ExactPosture& posture, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

  /// At every point: R_SS(W) is convex.
  bool equilibrium() const;
  /// Where the mode is feasible, if anywhere.
  std::optional<Fraction> feasible(const ExactMode& mode);
  /// First the points 0, 1/2, 1 for all modes, then every mode by `feasible`.
  bool stable();
  const LineWork& work() const { return decision_.work(); }

 private:
  const ExactPosture& posture_;
  std::array<ExactFrame, 3> frames_;  // at 0, 1/2, 1 in one unit of length
  PieceDecision decision_;
};

}  // namespace surefoot::testing
