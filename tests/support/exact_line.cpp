#include "tests/support/exact_line.hpp"

#include <algorithm>

namespace surefoot::testing {
namespace {

Form combined(const std::array<Form, 3>& f, const std::array<int, 3>& k) {
  return {k[0] * f[0].p + k[1] * f[1].p + k[2] * f[2].p, k[0] * f[0].one + k[1] * f[1].one + k[2] * f[2].one,
          k[0] * f[0].q + k[1] * f[1].q + k[2] * f[2].q};
}
Integer combined(const Bernstein& f, const std::array<int, 3>& k) { return k[0] * f[0] + k[1] * f[1] + k[2] * f[2]; }

// c_0 (1 - t)^2 + c_1 t (1 - t) + c_2 t^2 from the values at 0, 1/2, 1; and of its halves, four times as large.
constexpr std::array<std::array<int, 3>, 3> from_values{{{1, 0, 0}, {-1, 4, -1}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 3> first_half{{{4, 0, 0}, {4, 2, 0}, {1, 1, 1}}};
constexpr std::array<std::array<int, 3>, 3> second_half{{{1, 1, 1}, {0, 2, 4}, {0, 0, 4}}};

template <class T>
T transformed(const T& f, const std::array<std::array<int, 3>, 3>& by) {
  return {combined(f, by[0]), combined(f, by[1]), combined(f, by[2])};
}

ModePiece half(const ModePiece& piece, bool second) {
  ModePiece result;
  const auto& by = second ? second_half : first_half;
  result.d = transformed(piece.d, by);
  for (const QuadraticForm& row : piece.rows) result.rows.push_back(transformed(row, by));
  result.first = 2 * piece.first + (second ? 1 : 0);
  result.depth = piece.depth + 1;
  return result;
}

Fraction on_line(const ModePiece& piece, const DyadicPoint& t) {
  return {(piece.first << t.exponent) + t.numerator, Integer(1) << (piece.depth + t.exponent)};
}

/// Where a quadratic that is not identically zero has a double root in [0, 1].
std::optional<Fraction> double_root(const Bernstein& d) {
  if (sign_on_interval(d) == Sign::zero || d[1] * d[1] != 4 * d[0] * d[2]) return std::nullopt;
  // d_0 (1 - t)^2 + d_1 t (1 - t) + d_2 t^2: t = (2 d_0 - d_1) / (2 (d_0 - d_1 + d_2))
  Integer numerator = 2 * d[0] - d[1], denominator = 2 * (d[0] - d[1] + d[2]);
  if (denominator.sign() < 0) numerator = -numerator, denominator = -denominator;
  if (denominator.is_zero() || numerator.sign() < 0 || numerator > denominator) return std::nullopt;
  return Fraction{numerator, denominator};
}

using Quotient = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

}  // namespace

double Fraction::approximate() const { return Quotient(numerator, denominator).convert_to<double>(); }
bool Fraction::equals(double value) const { return Quotient(numerator, denominator) == Quotient(value); }

bool PieceDecision::feasible_at(const ModePiece& piece, const Fraction& at) const {
  const Integer rest = at.denominator - at.numerator;
  const std::array<Integer, 3> weight{rest * rest, rest * at.numerator, at.numerator * at.numerator};
  std::vector<Form> rows;
  for (const QuadraticForm& row : piece.rows) {
    Form sum{0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      sum = {sum.p + weight[k] * row[k].p, sum.one + weight[k] * row[k].one, sum.q + weight[k] * row[k].q};
    }
    rows.push_back(sum);
  }
  const int d = Integer(weight[0] * piece.d[0] + weight[1] * piece.d[1] + weight[2] * piece.d[2]).sign();
  return (d >= 0 && meets_box(rows, 1, corners_)) || (d <= 0 && meets_box(rows, -1, corners_));
}

std::vector<Bernstein> PieceDecision::undecided(const ModePiece& piece) const {
  std::vector<Bernstein> open;
  const auto add = [&](const Bernstein& polynomial) {
    if (sign_on_interval(polynomial) == Sign::open) open.push_back(polynomial);
  };
  add(piece.d);
  const std::vector<CornerValues> at = corner_values(piece.rows, 1, corners_);
  const std::size_t count = at.size();
  for (std::size_t a = 0; a < count; ++a) {
    for (const Bernstein& values : at[a]) add(values);
    for (std::size_t b = a + 1; b < count; ++b) {
      for (int i = 0; i < 4; ++i) add(side_cross(at[a], at[b], i, (i + 1) % 4));
      add(minor(piece.rows[a], piece.rows[b]));
      for (std::size_t c = b + 1; c < count; ++c) add(determinant(piece.rows[a], piece.rows[b], piece.rows[c]));
    }
  }
  return open;
}

/// Points on both sides of every root and between all of them.
std::optional<Fraction> PieceDecision::between_roots(const ModePiece& piece) {
  ++work_.by_roots;
  std::vector<Integer> points{0, Integer(1) << root_bits};
  for (const Bernstein& polynomial : undecided(piece)) {
    for (const auto& [low, high] : isolated_roots(polynomial, root_bits)) {
      points.push_back(low.numerator >> (low.exponent - root_bits));
      points.push_back(high.numerator >> (high.exponent - root_bits));
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto feasible_there = [&](const Integer& numerator, int exponent) {
    ++work_.points;
    return feasible_at(piece, {numerator, Integer(1) << exponent});
  };
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Integer between = points[k] + points[k + 1];
    if (feasible_there(between, root_bits + 1)) return on_line(piece, {between, root_bits + 1});
  }
  for (const Integer& point : points)
    if (feasible_there(point, root_bits)) return on_line(piece, {point, root_bits});
  return std::nullopt;
}

std::optional<Fraction> PieceDecision::feasible(const ModePiece& whole) {
  constexpr long many_intervals = 300;  // beyond, roots of the whole line are cheaper; the answer is the same
  const Fraction from{0, 1}, to{1, 1};
  for (const Fraction& end : {from, to})
    if (feasible_at(whole, end)) return end;
  if (const auto root = double_root(whole.d); root && feasible_at(whole, *root)) return root;
  std::vector<ModePiece> pending{whole};
  for (long seen = 0; !pending.empty(); ++seen) {
    const ModePiece piece = std::move(pending.back());
    pending.pop_back();
    ++work_.intervals;
    if (proved_empty(piece, corners_)) continue;
    if (feasible_at(piece, {1, 2})) return on_line(piece, {1, 1});
    if (seen > many_intervals) return between_roots(whole);
    if (piece.depth == halvings) {
      if (const auto found = between_roots(piece)) return found;
      continue;
    }
    pending.push_back(half(piece, true));
    pending.push_back(half(piece, false));
  }
  return std::nullopt;
}

namespace {
std::array<ExactFrame, 3> frames_on(const ExactPosture& posture, const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& to) {
  const ExactCom middle(from, to, 0.5);
  const auto at = [&](double lambda) { return posture.frame(ExactCom(from, to, lambda).in_unit(middle.exponent)); };
  return {at(0), posture.frame(middle), at(1)};
}
}  // namespace

ExactLine::ExactLine(const ExactPosture& posture, const Eigen::Vector2d& from, const Eigen::Vector2d& to)
    : posture_(posture), frames_(frames_on(posture, from, to)), decision_(frames_[0].corners) {}

bool ExactLine::equilibrium() const { return posture_.equilibrium(frames_[0]) && posture_.equilibrium(frames_[2]); }

std::optional<Fraction> ExactLine::feasible(const ExactMode& mode) {
  std::array<ModeForms, 3> forms;
  for (int k = 0; k < 3; ++k) forms[k] = ExactPosture::mode_forms(frames_[k], mode);
  ModePiece whole;
  whole.d = transformed(Bernstein{forms[0].d, forms[1].d, forms[2].d}, from_values);
  for (std::size_t k = 0; k < forms[0].rows.size(); ++k)
    whole.rows.push_back(transformed(QuadraticForm{forms[0].rows[k], forms[1].rows[k], forms[2].rows[k]}, from_values));
  return decision_.feasible(whole);
}

bool ExactLine::stable() {
  if (!equilibrium()) return false;
  for (const ExactFrame& frame : frames_)
    for (const ExactMode& mode : posture_.modes())
      if (posture_.feasible(frame, mode)) return false;
  return std::none_of(posture_.modes().begin(), posture_.modes().end(),
                      [&](const ExactMode& mode) { return feasible(mode).has_value(); });
}

}  // namespace surefoot::testing
