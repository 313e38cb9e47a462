#include "tests/support/extreme_exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace surefoot::testing {
namespace {

using Scale = std::optional<Quotient>;  // nothing: infinite

/// (P, Q) in units of the box, and its weight: a . (P, Q) + b.
struct Scaled {
  Quotient x, y, b;
};

Quotient absolute(const Quotient& value) { return value < 0 ? Quotient(-value) : value; }

/// Least |.|_inf of {rows >= 0}: at the origin, where a row meets a diagonal, or where two rows meet.
Scale closed_scale(const std::vector<Scaled>& rows) {
  Scale best;
  const auto offer = [&](const Quotient& x, const Quotient& y) {
    const Quotient reach = std::max(absolute(x), absolute(y));
    if (best && reach >= *best) return;
    for (const Scaled& row : rows)
      if (row.x * x + row.y * y + row.b < 0) return;
    best = reach;
  };
  offer(0, 0);
  for (std::size_t i = 0; i < rows.size() && !(best && *best == 0); ++i) {
    const Scaled& a = rows[i];
    for (const int side : {1, -1}) {
      const Quotient slope = a.x + side * a.y;
      if (slope == 0) continue;
      const Quotient at = -a.b / slope;
      offer(at, side * at);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Scaled& c = rows[j];
      const Quotient det = a.x * c.y - a.y * c.x;
      if (det != 0) offer((a.y * c.b - a.b * c.y) / det, (a.b * c.x - a.x * c.b) / det);
    }
  }
  return best;
}

/// One sign of D. A row alone keeps the mode beyond |b| / |a|_1: most modes end here, given a bound.
Scale signed_scale(const ModeForms& forms, int sign, const ExactFrame& frame, const Scale& bound) {
  const Form& corner = frame.corners[2];
  std::vector<Scaled> rows;
  for (const Form& form : forms.rows) {
    Scaled row{Quotient(form.p * corner.p), Quotient(form.q * corner.q), Quotient(form.one * corner.one)};
    if (sign < 0) row = {-row.x, -row.y, -row.b};
    const Quotient size = absolute(row.x) + absolute(row.y);
    if (row.b <= 0 && (size == 0 || (bound && -row.b > *bound * size))) return std::nullopt;
    rows.push_back(row);
  }
  const Scale closed = closed_scale(rows);
  if (!closed) return std::nullopt;
  // The open polygon is not empty iff it meets every larger box.
  const Quotient beyond = 2 * *closed + 1;
  const Integer n(numerator(beyond)), d(denominator(beyond));
  std::array<Form, 4> corners = frame.corners;
  for (Form& c : corners) c = {c.p * n, c.one * d, c.q * n};
  return meets_box(forms.rows, sign, corners) ? closed : std::nullopt;
}

Scale lesser(const Scale& a, const Scale& b) { return !a ? b : !b ? a : std::min(*a, *b); }

Scale mode_scale(const ExactFrame& frame, const ExactMode& mode, const Scale& bound) {
  const ModeForms forms = ExactPosture::mode_forms(frame, mode);
  Scale best;
  if (forms.d.sign() >= 0) best = signed_scale(forms, 1, frame, bound);
  if (forms.d.sign() <= 0) best = lesser(best, signed_scale(forms, -1, frame, bound));
  return best;
}

Form ray(const ExactFrame& frame, int k) {
  const ExactFrame::At& at = frame.at[k / 2];
  const Integer mu = k % 2 == 0 ? Integer(-at.mu) : at.mu;
  return {at.one * at.n.p + mu * at.t.p, at.one * at.n.one + mu * at.t.one, at.one * at.n.q + mu * at.t.q};
}

struct Pair {
  int a, b, sign;
};

/// Pairs of rays that have all others on one side; which do, does not depend on the COM.
std::vector<Pair> supporting_pairs(const ExactFrame& frame) {
  std::vector<Pair> pairs;
  for (int b = 1; b < 2 * frame.count; ++b) {
    for (int a = 0; a < b; ++a) {
      const Form z = cross(ray(frame, a), ray(frame, b));
      if (z.p.is_zero() && z.one.is_zero() && z.q.is_zero()) continue;
      bool above = false, below = false;
      for (int k = 0; k < 2 * frame.count; ++k) {
        const int side = dot(z, ray(frame, k)).sign();
        above |= side > 0, below |= side < 0;
      }
      if (!below) pairs.push_back({a, b, 1});
      if (!above) pairs.push_back({a, b, -1});
    }
  }
  return pairs;
}

Scale facet_scale(const ExactFrame& frame, const Pair& pair) {
  const Form z = cross(ray(frame, pair.a), ray(frame, pair.b)), &corner = frame.corners[2];
  const Quotient here(pair.sign * z.one * corner.one);
  if (here <= 0) return Quotient(0);
  const Quotient fall(abs(z.p) * corner.p + abs(z.q) * corner.q);
  return fall == 0 ? Scale() : Scale(here / fall);
}

/// A facet or a mode.
using Constraint = std::function<Scale(const ExactFrame&)>;

}  // namespace

ExactVerdict exact_verdict(const SamplePosture& sample) {
  const ExactPosture posture(sample);
  const ExactFrame frame = posture.frame(ExactCom(sample.com));
  ExactVerdict verdict;
  verdict.equilibrium = posture.equilibrium(frame);
  verdict.modes = posture.feasible_modes(frame);
  verdict.robust = verdict.equilibrium && verdict.modes.empty();
  return verdict;
}

ExactFactor exact_safety_factor(const SamplePosture& sample) {
  const ExactPosture posture(sample);
  const ExactCom com(sample.com);
  const ExactFrame frame = posture.frame(com);
  const std::vector<Pair> pairs = supporting_pairs(frame);
  ExactFactor factor;
  SamplePosture at_rest = sample;
  at_rest.box = {0, 0};
  const ExactPosture resting(at_rest);
  if (!resting.equilibrium(resting.frame(com))) {  // also where the cone has no interior
    factor.value = Quotient(0);
    return factor;
  }
  std::vector<std::pair<Scale, Constraint>> found;
  Scale least;
  const auto consider = [&](const Scale& scale, Constraint constraint) {
    if (!scale) return;
    found.emplace_back(scale, std::move(constraint));
    least = lesser(least, scale);
  };
  for (const Pair& pair : pairs)
    consider(facet_scale(frame, pair), [pair](const ExactFrame& at) { return facet_scale(at, pair); });
  for (const ExactMode& mode : posture.modes())
    consider(mode_scale(frame, mode, least),
             [&mode](const ExactFrame& at) { return mode_scale(at, mode, std::nullopt); });
  factor.value = least;
  if (!least || *least == 0) return factor;
  int unit = -200;
  for (const Contact& contact : sample.contacts) {
    const double distance = (contact.position - sample.com).lpNorm<1>();
    if (distance > 0) unit = std::min(unit, std::ilogb(distance) - 200);
  }
  unit = std::min(unit, com.exponent);
  const ExactCom here = com.in_unit(unit);
  const Quotient step = unit < 0 ? Quotient(1, Integer(Integer(1) << -unit)) : Quotient(Integer(Integer(1) << unit));
  const Quotient near = *least * (1 + Quotient(1, Integer(Integer(1) << 60)));
  for (int axis = 0; axis < 2; ++axis) {
    Scale at[2];
    for (const int side : {0, 1}) {
      ExactCom moved = here;
      (axis == 0 ? moved.x : moved.y) += side == 0 ? -1 : 1;
      const ExactFrame there = posture.frame(moved);
      for (const auto& [scale, constraint] : found)
        if (*scale <= near) at[side] = lesser(at[side], constraint(there));
    }
    if (!at[0] || !at[1]) {
      factor.kink = true;
      continue;
    }
    const Quotient forward = (*at[1] - *least) / step, backward = (*least - *at[0]) / step;
    factor.gradient[axis] = (forward + backward) / 2;
    if (absolute(forward - backward) > (absolute(forward) + absolute(backward)) / (Integer(1) << 40))
      factor.kink = true;
  }
  return factor;
}

}  // namespace surefoot::testing
