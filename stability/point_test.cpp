#include "stability/point_test.hpp"

#include <cmath>

#include "stability/decisions.hpp"
#include "stability/screen.hpp"

namespace surefoot::stability {
namespace {

double greatest_offset(const Frame<double>& frame) {
  double radius = 0;
  for (int i = 0; i < frame.contacts; ++i)
    radius = std::max(radius, std::abs(frame.at[i].r.x) + std::abs(frame.at[i].r.y));
  return radius;
}

/// The polygon of {rows >= 0} in the box has a point where every row is positive iff each row is positive at one of its
/// vertices.
bool meets_with_sign(const RowSink<Dyadic>& sink, bool negative, const DisturbanceBox& box) {
  const RowList<Dyadic>& rows = sink.rows;
  RowList<Dyadic> signed_rows = rows;
  if (negative)
    for (int k = 0; k < rows.count; ++k) signed_rows.row[k] = -rows.row[k];
  const Polygon<Dyadic> polygon = feasible_polygon(signed_rows, Dyadic(box.kappa), Dyadic(box.nu));
  if (polygon.count == 0) return false;
  for (int k = 0; k < rows.count; ++k) {
    const Row<Dyadic>& row = signed_rows.row[k];
    // Theory section 4 drops rows that vanish for every COM: the direction of two slides does, where z = s_i x s_j = 0.
    // The other rows that do are not emitted (ModeSpec::row_vanishes); one that vanishes at this COM only is not
    // positive.
    if (k == sink.direction && row.p.is_zero() && row.one.is_zero() && row.q.is_zero()) continue;
    bool positive = false;
    for (int v = 0; v < polygon.count && !positive; ++v) positive = weighted_value(row, polygon.at[v]) > 0;
    if (!positive) return false;
  }
  return true;
}

}  // namespace

bool meets_box_exactly(const RowSink<Dyadic>& sink, const DisturbanceBox& box) {
  const int sign = sink.d ? sink.d->sign() : 1;
  return (sign >= 0 && meets_with_sign(sink, false, box)) || (sign <= 0 && meets_with_sign(sink, true, box));
}

void PointQuery::make_frame() {
  if (framed_) return;
  framed_ = true;
  frame_ = posture_.frame(com_);
  if constexpr (guarded) guard_ = GuardScale(posture_.edge_bound(), posture_.rho2(), box_).at(greatest_offset(frame_));
}

const ModeSpec* PointQuery::any_feasible() {
  make_frame();
  Screen screen(frame_, box_, guard_);
  for (const ModeSpec& spec : posture_.modes())
    if (screen.excludes(spec)) ++decisions.modes_by_screen;
    else if (feasible(spec)) return &spec;
  return nullptr;
}

const Frame<Dyadic>& PointQuery::exact_frame() {
  if (!exact_) exact_ = posture_.exact_frame(com_);
  return *exact_;
}

bool PointQuery::equilibrium() const {
  if (posture_.flat_cone()) return false;
  // g = (p, 1, X_x - p X_y + q) with X = com - x_1: a facet's least value over W is at a corner.
  const double x = com_.x() - posture_.position(0).x(), y = com_.y() - posture_.position(0).y();
  // z has errors below facet_error (times lengths), the sum at most 8 u of the magnitudes, which facet_error bounds
  // too.
  const double lengths = posture_.spread() + std::abs(x) + std::abs(y);
  const double error =
      guarded ? 4 * posture_.facet_error() * (lengths * (1 + box_.kappa) + box_.nu) + underflow_slack : 0;
  for (const Facet& facet : posture_.facets()) {
    const Row<double>& z = facet.z;
    const double least = z.one + z.q * x - box_.kappa * std::abs(z.p - z.q * y) - box_.nu * std::abs(z.q);
    ++decisions.facets;
    if (least > error) continue;
    if (!guarded || least < -error || !inside_exactly(facet)) return false;
  }
  return true;
}

bool PointQuery::inside_exactly(const Facet& facet) const {
  ++decisions.facets_exactly;
  const Row<Dyadic> z = posture_.exact_facet(facet);
  const Eigen::Vector2d& origin = posture_.position(0);
  const Dyadic x = Dyadic(com_.x()) - Dyadic(origin.x()), y = Dyadic(com_.y()) - Dyadic(origin.y());
  const Dyadic slope = z.p - z.q * y;
  const Dyadic least = z.one + z.q * x - Dyadic(box_.kappa) * abs(slope) - Dyadic(box_.nu) * abs(z.q);
  return least > 0;
}

bool PointQuery::feasible(const ModeSpec& spec) {
  make_frame();
  PointSink sink(guard_, box_);
  emit_rows(frame_, spec, sink);
  ++decisions.modes_by_rows;
  if (sink.excluded()) return false;
  const Meeting meeting = sink.sign_certain() ? meets_box(sink.rows, box_) : Meeting::uncertain;
  return guarded && meeting == Meeting::uncertain ? feasible_exactly(spec) : meeting == Meeting::yes;
}

bool PointQuery::feasible_exactly(const ModeSpec& spec) {
  --decisions.modes_by_rows;
  ++decisions.modes_exactly;
  RowSink<Dyadic> sink;
  emit_rows(exact_frame(), spec, sink);
  return meets_box_exactly(sink, box_);
}

}  // namespace surefoot::stability
