#include "stability/line_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stability/point_test.hpp"
#include "stability/screen.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

/// Proofs on [a, b] fail on intervals shorter than this only where the mode is feasible or tangential nearby.
constexpr double least_interval = 0x1p-40;
/// More intervals than these are not tried: a line of ordinary length needs one or two, lines of 1000 rho some tens.
constexpr int max_intervals = 4096, max_exact_intervals = 200;

/// A point of the line with the covector proposed there.
struct Station {
  double lambda;
  Frame<double> frame;
  Covector covector;
};

/// Proves intervals from `lambda` on, each twice as long as the last where that works, half as long where not; proves(a, b)
/// decides between two stations. Returns the lambda reached.
template <class MakeStation, class Proves>
double proved_up_to(double lambda, int intervals, MakeStation&& make_station, Proves&& proves) {
  Station here = make_station(lambda);
  double length = 1 - lambda;
  for (int k = 0; k < intervals && here.covector.found && here.lambda < 1 && length >= least_interval; ++k) {
    const double end = length < 1 - here.lambda ? here.lambda + length : 1;
    Station there = make_station(end);
    if (there.covector.found && proves(here, there)) {
      here = there;
      length *= 2;
    } else {
      length = 0.5 * (end - here.lambda);
    }
  }
  return here.lambda;
}

/// Proofs stop just before a violation: the first of some points beyond `lambda`, ever farther, for which `test` holds.
template <class Test>
std::optional<double> probe_beyond(double lambda, Test&& test) {
  if (test(lambda)) return lambda;
  for (const int exponent : {-46, -40, -34, -28, -22, -16, -12, -9, -6, -4, -3, -2, -1, 0}) {
    const double probe = std::min(1.0, lambda + std::ldexp(1 - lambda, exponent));
    if (test(probe)) return probe;
  }
  return std::nullopt;
}

}  // namespace

LineQuery::LineQuery(const Posture& posture, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                     const DisturbanceBox& box)
    : posture_(posture), from_(from), to_(to), box_(box) {
  for (int i = 0; i < posture.contacts(); ++i)
    radius_ = std::max(radius_, (posture.position(i) - from).lpNorm<1>());
  radius_ += (to - from).lpNorm<1>();
}

namespace {

/// Screens an interval as a whole, then its halves for the modes that are left.
class RecursiveScreen {
 public:
  RecursiveScreen(const Posture& posture, const Vector2d& from, const Vector2d& to, double radius,
                  const DisturbanceBox& box)
      : posture_(posture), from_(from), to_(to), box_(box),
        guard_(GuardScale(posture.edge_bound(), posture.rho2(), box).at(radius)) {}

  std::uint32_t excluded(double a, const Frame<double>& at_a, double b, const Frame<double>& at_b, std::uint32_t wanted,
                         int halvings) const {
    Screen<false> screen(at_a, at_b, box_, guard_);
    std::uint32_t whole = 0, bit = 1;
    for (const ModeSpec& spec : posture_.modes()) {
      if ((wanted & bit) && screen.excludes(spec)) whole |= bit;
      bit <<= 1;
    }
    const std::uint32_t left = wanted & ~whole;
    if (left == 0 || halvings == 0) return whole;
    const double middle = 0.5 * (a + b);
    const Frame<double> at_middle = frame(middle);
    const std::uint32_t first = excluded(a, at_a, middle, at_middle, left, halvings - 1);
    if (first == 0) return whole;
    return whole | excluded(middle, at_middle, b, at_b, first, halvings - 1);
  }
  Frame<double> frame(double lambda) const { return posture_.frame(from_, to_, lambda); }

 private:
  const Posture& posture_;
  const Vector2d &from_, &to_;
  const DisturbanceBox& box_;
  Guard guard_;
};

}  // namespace

std::uint32_t LineQuery::screened(double s) const {
  constexpr int halvings = 6;
  const DisturbanceBox box{s * box_.kappa, s * box_.nu};
  const RecursiveScreen screen(posture_, from_, to_, radius_, box);
  const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << posture_.modes().size()) - 1);
  return screen.excluded(0, screen.frame(0), 1, screen.frame(1), all, halvings);
}

double LineQuery::excluded_up_to(const ModeSpec& spec, double s, double lambda) const {
  const DualCertificate certificate(posture_, spec, {s * box_.kappa, s * box_.nu});
  const auto station = [&](double at) {
    const Frame<double> frame = posture_.frame(from_, to_, at);
    return Station{at, frame, certificate.propose(frame)};
  };
  return proved_up_to(lambda, max_intervals, station, [&](const Station& a, const Station& b) {
    return certificate.proves(a.covector, a.frame, b.covector, b.frame, radius_);
  });
}

LineMode LineQuery::feasible(const ModeSpec& spec) const {
  const double lambda = excluded_up_to(spec, 1, 0);
  if (lambda >= 1) return {LineOutcome::excluded, 0};
  if (const auto found = probe_beyond(lambda, [&](double at) { return has_witness(spec, at); }))
    return {LineOutcome::feasible, *found};
  return feasible_exactly(spec);
}

/// A wrench for which the mode is feasible at lambda, beyond the error bounds.
bool LineQuery::has_witness(const ModeSpec& spec, double lambda) const {
  const Guard guard = GuardScale(posture_.edge_bound(), posture_.rho2(), box_).at(radius_);
  PointSink sink(guard, box_);
  emit_rows(posture_.frame(from_, to_, lambda), spec, sink);
  return !sink.excluded() && sink.sign_certain() && meets_box(sink.rows, box_) == Meeting::yes;
}

bool LineQuery::has_witness_exactly(const ModeSpec& spec, double lambda) const {
  RowSink<Dyadic> sink;
  emit_rows(posture_.exact_frame(from_, to_, lambda), spec, sink);
  return meets_box_exactly(sink, box_);
}

LineMode LineQuery::feasible_exactly(const ModeSpec& spec) const {
  const auto feasible_here = [&](double at) { return has_witness_exactly(spec, at); };
  for (const double end : {0.0, 1.0})
    if (feasible_here(end)) return {LineOutcome::feasible, end};
  const DualCertificate certificate(posture_, spec, box_);
  const auto station = [&](double at) {
    const Frame<double> frame = posture_.frame(from_, to_, at);
    return Station{at, frame, certificate.propose(frame)};
  };
  const double reached = proved_up_to(0, max_exact_intervals, station, [&](const Station& a, const Station& b) {
    return certificate.proves(a.covector, posture_.exact_frame(from_, to_, a.lambda), b.covector,
                              posture_.exact_frame(from_, to_, b.lambda));
  });
  if (reached >= 1) return {LineOutcome::excluded, 0};
  if (const auto found = probe_beyond(reached, feasible_here)) return {LineOutcome::feasible, *found};
  return {LineOutcome::uncertain, reached};
}

}  // namespace surefoot::stability
