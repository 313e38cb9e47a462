#include "stability/line_test.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stability/point_test.hpp"

namespace surefoot::stability {
namespace {

/// Proofs on [a, b] fail on intervals shorter than this only where the mode is feasible or tangential nearby.
constexpr double least_interval = 0x1p-40;
/// More intervals than this are not tried: a line of ordinary length needs one or two, lines of 1000 rho some tens.
constexpr int max_intervals = 4096;

/// Proves intervals from `lambda` on, each twice as long as the last where that works, half as long where not.
/// make_frame(lambda) gives the frame in doubles, proves(a, b, ...) the decision. Returns the lambda reached.
template <class MakeFrame, class Proves>
double proved_up_to(const DualCertificate& certificate, double lambda, MakeFrame&& make_frame, Proves&& proves) {
  Covector here = certificate.propose(make_frame(lambda));
  double length = 1 - lambda;
  for (int k = 0; k < max_intervals && here.found && lambda < 1 && length >= least_interval; ++k) {
    const double end = length < 1 - lambda ? lambda + length : 1;
    const Covector there = certificate.propose(make_frame(end));
    if (there.found && proves(here, lambda, there, end)) {
      lambda = end;
      here = there;
      length *= 2;
    } else {
      length = 0.5 * (end - lambda);
    }
  }
  return lambda;
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

double LineQuery::excluded_up_to(const ModeSpec& spec, double s, double lambda) const {
  const DualCertificate certificate(posture_, spec, {s * box_.kappa, s * box_.nu});
  const auto frame = [&](double at) { return posture_.frame(from_, to_, at); };
  return proved_up_to(certificate, lambda, frame, [&](const Covector& a, double la, const Covector& b, double lb) {
    return certificate.proves(a, frame(la), b, frame(lb), radius_);
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
  const Guard guard(posture_.edge_bound(), posture_.rho2(), radius_, box_);
  PointSink sink(guard, box_);
  emit_rows(posture_.frame(from_, to_, lambda), spec, sink);
  return !sink.excluded() && sink.sign_certain() && find_witness(sink.rows, box_);
}

bool LineQuery::has_witness_exactly(const ModeSpec& spec, double lambda) const {
  RowSink<Rational> sink;
  emit_rows(posture_.exact_frame(from_, to_, lambda), spec, sink);
  return meets_box_exactly(sink, box_);
}

LineMode LineQuery::feasible_exactly(const ModeSpec& spec) const {
  const auto feasible_here = [&](double at) { return has_witness_exactly(spec, at); };
  for (const double end : {0.0, 1.0})
    if (feasible_here(end)) return {LineOutcome::feasible, end};
  const DualCertificate certificate(posture_, spec, box_);
  const auto frame = [&](double at) { return posture_.frame(from_, to_, at); };
  const auto exact_frame = [&](double at) { return posture_.exact_frame(from_, to_, at); };
  const double reached =
      proved_up_to(certificate, 0, frame, [&](const Covector& a, double la, const Covector& b, double lb) {
        return certificate.proves(a, exact_frame(la), b, exact_frame(lb));
      });
  if (reached >= 1) return {LineOutcome::excluded, 0};
  if (const auto found = probe_beyond(reached, feasible_here)) return {LineOutcome::feasible, *found};
  return {LineOutcome::uncertain, reached};
}

}  // namespace surefoot::stability
