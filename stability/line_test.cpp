#include "stability/line_test.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "stability/decisions.hpp"
#include "stability/line_screen.hpp"
#include "stability/point_test.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

/// Proofs on [a, b] fail on intervals shorter than this only where the mode is feasible or tangential nearby.
constexpr double least_interval = 0x1p-40;
/// More intervals than these are not tried: a line of ordinary length needs one or two, lines of 1000 rho some tens.
constexpr int max_intervals = 4096, max_exact_intervals = 200;

/// A point of the line with the covector proposed there.
struct Proposal {
  double lambda;
  Frame<double> frame;
  Covector covector;
};

/// Proves intervals from `lambda` on, each twice as long as the last where that works, half as long where not;
/// proves(a, b) decides between two proposals. Returns the lambda reached.
template <class Propose, class Proves>
double proved_up_to(double lambda, int intervals, Propose&& propose_at, Proves&& proves) {
  Proposal here = propose_at(lambda);
  double length = 1 - lambda;
  for (int k = 0; k < intervals && here.covector.found && here.lambda < 1 && length >= least_interval; ++k) {
    const double end = length < 1 - here.lambda ? here.lambda + length : 1;
    Proposal there = propose_at(end);
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
  assert(from.allFinite() && to.allFinite());
  for (int i = 0; i < posture.contacts(); ++i) radius_ = std::max(radius_, (posture.position(i) - from).lpNorm<1>());
  radius_ += (to - from).lpNorm<1>();
}

namespace {

/// Proves an interval as a whole, then its halves for the modes that are left.
class Scanner {
 public:
  Scanner(const LineFrame& line, const Vector2d& from, const Vector2d& to, bool seeks_feasible)
      : line_(line), certificates_(line), from_(from), to_(to), seeks_feasible_(seeks_feasible) {}

  LineScan scan() {
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << line_.posture.modes().size()) - 1);
    Station start = station(0), end = station(1);
    result_.excluded = excluded_between(start, end, all, 0);
    if (result_.feasible_mode < 0) exclude_on_border(start, end, all & ~result_.excluded);
    return result_;
  }

 private:
  static constexpr int most_halvings = 7;

  Station station(double lambda) const { return {lambda, line_.posture.frame(from_, to_, lambda)}; }

  /// The modes among those wanted that are proved on the whole interval.
  std::uint32_t excluded_between(Station& a, Station& b, std::uint32_t wanted, int halvings) {
    Station middle = station(0.5 * (a.lambda() + b.lambda()));
    LineInterval interval(certificates_, a, middle, b);
    std::uint32_t left = remaining(wanted, [&](int k) { return interval.excludes_by_rows(k); });
    const bool ends = halvings == 0;
    if (seeks_feasible_ && ends && (meets_witness(a, left) || meets_witness(b, left))) return wanted & ~left;
    left = remaining(left, [&](int k) { return interval.excludes_by_covectors(k); });
    const std::uint32_t whole = wanted & ~left;
    if (left == 0) return whole;
    if (halvings == most_halvings) {
      for (std::uint32_t rest = left; rest != 0; rest &= rest - 1) result_.reached[std::countr_zero(rest)] = a.lambda();
      return whole;
    }
    if (seeks_feasible_ && meets_witness(middle, left)) return whole;
    const std::uint32_t first = excluded_between(a, middle, left, halvings + 1);
    if (first == 0 || result_.feasible_mode >= 0) return whole;
    return whole | excluded_between(middle, b, first, halvings + 1);
  }

  template <class Excludes>
  static std::uint32_t remaining(std::uint32_t modes, Excludes&& excludes) {
    std::uint32_t left = modes;
    for (std::uint32_t rest = modes; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      if (excludes(k)) left &= ~(1u << k);
    }
    return left;
  }

  void exclude_on_border(const Station& start, const Station& end, std::uint32_t modes) {
    const std::uint32_t left = remaining(modes, [&](int k) {
      return !certificates_.of_mode(k).may_prove_on_border(start.frame(), end.frame());
    });
    if (left == 0) return;
    const Frame<Dyadic> a = line_.posture.exact_frame(from_), b = line_.posture.exact_frame(to_);
    const auto proves = [&](int k) { return certificates_.of_mode(k).proves_on_border(a, b); };
    result_.excluded |= left & ~remaining(left, proves);
  }

  bool meets_witness(Station& at, std::uint32_t modes) {
    for (std::uint32_t rest = modes; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      if (!at.has_witness(line_, k)) continue;
      ++decisions.witnesses;
      result_.feasible_mode = k;
      result_.feasible_at = at.lambda();
      return true;
    }
    return false;
  }

  const LineFrame& line_;
  LineCertificates certificates_;
  const Vector2d &from_, &to_;
  bool seeks_feasible_;
  LineScan result_;
};

}  // namespace

LineScan LineQuery::scan(double s, bool seeks_feasible) const {
  const DisturbanceBox box{s * box_.kappa, s * box_.nu};
  const LineFrame line(posture_, box, radius_);
  if (line.guard.nothing_certain()) return {};
  return Scanner(line, from_, to_, seeks_feasible).scan();
}

double LineQuery::excluded_up_to(const ModeSpec& spec, double s, double lambda) const {
  const LineFrame line(posture_, {s * box_.kappa, s * box_.nu}, radius_);
  if (line.guard.nothing_certain()) return lambda;
  const DualCertificate certificate(line, spec);
  const auto propose = [&](double at) {
    const Frame<double> frame = posture_.frame(from_, to_, at);
    return Proposal{at, frame, certificate.propose(frame)};
  };
  return proved_up_to(lambda, max_intervals, propose, [&](const Proposal& a, const Proposal& b) {
    return certificate.proves(a.covector, a.frame, b.covector, b.frame);
  });
}

LineMode LineQuery::feasible(const ModeSpec& spec, double from) const {
  ++decisions.modes_marched;
  const double lambda = excluded_up_to(spec, 1, from);
  if (lambda >= 1) return {LineOutcome::excluded, 0};
  if (const auto found = probe_beyond(lambda, [&](double at) { return has_witness(spec, at); }))
    return {LineOutcome::feasible, *found};
  return feasible_exactly(spec);
}

/// A wrench for which the mode is feasible at lambda, beyond the error bounds.
bool LineQuery::has_witness(const ModeSpec& spec, double lambda) const {
  PointSink sink(GuardScale(posture_.edge_bound(), posture_.rho2(), box_).at(radius_), box_);
  emit_rows(posture_.frame(from_, to_, lambda), spec, sink);
  return !sink.excluded() && sink.sign_certain() && meets_box(sink.rows, box_) == Meeting::yes;
}

bool LineQuery::has_witness_exactly(const ModeSpec& spec, double lambda) const {
  RowSink<Dyadic> sink;
  emit_rows(posture_.exact_frame(from_, to_, lambda), spec, sink);
  return meets_box_exactly(sink, box_);
}

LineMode LineQuery::feasible_exactly(const ModeSpec& spec) const {
  --decisions.modes_marched;
  ++decisions.lines_exactly;
  const auto feasible_here = [&](double at) { return has_witness_exactly(spec, at); };
  for (const double end : {0.0, 1.0})
    if (feasible_here(end)) return {LineOutcome::feasible, end};
  const LineFrame line(posture_, box_, radius_);
  const DualCertificate certificate(line, spec);
  const auto propose = [&](double at) {
    const Frame<double> frame = posture_.frame(from_, to_, at);
    return Proposal{at, frame, certificate.propose(frame)};
  };
  const double reached = proved_up_to(0, max_exact_intervals, propose, [&](const Proposal& a, const Proposal& b) {
    return certificate.proves(a.covector, posture_.exact_frame(from_, to_, a.lambda), b.covector,
                              posture_.exact_frame(from_, to_, b.lambda));
  });
  if (reached >= 1) return {LineOutcome::excluded, 0};
  if (const auto found = probe_beyond(reached, feasible_here)) return {LineOutcome::feasible, *found};
  return {LineOutcome::uncertain, reached};
}

}  // namespace surefoot::stability
