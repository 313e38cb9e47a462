#include "stability/point_test.hpp"

#include <cmath>

#include "stability/screen.hpp"

namespace surefoot::stability {
namespace {

double greatest_offset(const Frame<double>& frame) {
  double radius = 0;
  for (int i = 0; i < frame.contacts; ++i)
    radius = std::max(radius, std::abs(frame.at[i].r.x) + std::abs(frame.at[i].r.y));
  return radius;
}

bool meets_with_sign(const RowList<Rational>& rows, bool negative, const DisturbanceBox& box) {
  RowList<Rational> signed_rows = rows;
  if (negative)
    for (int k = 0; k < rows.count; ++k) signed_rows.row[k] = -rows.row[k];
  const auto point = middle(signed_rows, Rational(box.kappa), Rational(box.nu));
  if (!point) return false;
  for (int k = 0; k < rows.count; ++k) {
    const Row<Rational>& row = signed_rows.row[k];
    if (row.p.is_zero() && row.one.is_zero() && row.q.is_zero()) continue;  // theory section 4: drop it
    if (value_at(row, point->x, point->y) <= 0) return false;
  }
  return true;
}

}  // namespace

bool meets_box_exactly(const RowSink<Rational>& sink, const DisturbanceBox& box) {
  const int sign = sink.d ? sink.d->sign() : 1;
  return (sign >= 0 && meets_with_sign(sink.rows, false, box)) || (sign <= 0 && meets_with_sign(sink.rows, true, box));
}

PointQuery::PointQuery(const Posture& posture, const Eigen::Vector2d& com, const DisturbanceBox& box)
    : posture_(posture), com_(com), box_(box), frame_(posture.frame(com)), radius_(greatest_offset(frame_)),
      guard_(posture.edge_bound(), posture.rho2(), radius_, box) {}

std::uint32_t PointQuery::screened() const {
  return screened_modes(posture_, frame_, frame_, radius_, box_, guard_);
}

const Frame<Rational>& PointQuery::exact_frame() {
  if (!exact_) exact_ = posture_.exact_frame(com_);
  return *exact_;
}

bool PointQuery::equilibrium() {
  if (posture_.flat_cone()) return false;
  // g = (p, 1, X_x - p X_y + q) with X = com - x_1 = -r_1: a facet's least value over W is at a corner.
  const double x = -frame_.at[0].r.x, y = -frame_.at[0].r.y;
  // z has errors below facet_error (times lengths), the sum at most 8 u of the magnitudes, which facet_error bounds too.
  const double lengths = posture_.spread() + std::abs(x) + std::abs(y);
  const double error = guard_.nothing_certain()
                           ? guard_.area
                           : 4 * posture_.facet_error() * (lengths * (1 + box_.kappa) + box_.nu) + underflow_slack;
  for (const Facet& facet : posture_.facets()) {
    const Row<double>& z = facet.z;
    const double least = z.one + z.q * x - box_.kappa * std::abs(z.p - z.q * y) - box_.nu * std::abs(z.q);
    if (least > error) continue;
    if (least < -error || !inside_exactly(facet)) return false;
  }
  return true;
}

bool PointQuery::inside_exactly(const Facet& facet) const {
  const Row<Rational> z = posture_.exact_facet(facet);
  const Eigen::Vector2d& origin = posture_.position(0);
  const Rational x = Rational(com_.x()) - Rational(origin.x()), y = Rational(com_.y()) - Rational(origin.y());
  const Rational slope = z.p - z.q * y;
  const Rational least = z.one + z.q * x - Rational(box_.kappa) * abs(slope) - Rational(box_.nu) * abs(z.q);
  return least > 0;
}

bool PointQuery::feasible(const ModeSpec& spec) {
  PointSink sink(guard_, box_);
  emit_rows(frame_, spec, sink);
  if (sink.excluded()) return false;
  if (sink.sign_certain()) {
    if (find_witness(sink.rows, box_)) return true;
    if (any_certificate(sink.rows, box_, [](const Certificate&) { return true; })) return false;
  }
  return feasible_exactly(spec);
}

bool PointQuery::feasible_exactly(const ModeSpec& spec) {
  RowSink<Rational> sink;
  emit_rows(exact_frame(), spec, sink);
  return meets_box_exactly(sink, box_);
}

}  // namespace surefoot::stability
