#include "stability/screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/cover_conditions.hpp"

namespace surefoot::stability {
namespace {

using Kind = ModeSpec::Kind;

/// The open interval of z on which all of  value_l + z value_i > 0  hold.
struct Interval {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  void need_positive(double value_l, double value_i) {
    if (value_i == 0) {
      if (!(value_l > 0)) high = low;
      return;
    }
    const double limit = -value_l / value_i;
    if (value_i > 0)
      low = std::max(low, limit);
    else
      high = std::min(high, limit);
  }
  double inside() const {
    if (std::isinf(low) && std::isinf(high)) return 0;
    if (std::isinf(high)) return low + 1 + std::abs(low);
    if (std::isinf(low)) return high - 1 - std::abs(high);
    return 0.5 * (low + high);
  }
};

/// A covector of the contacts: a direction d at contact l, (d, r_l x d).
struct Reading {
  int l;
  Vec2<double> d;
};

class ContactScreen {
 public:
  ContactScreen(const Posture& posture, const Frame<double>& a, const Frame<double>& b, double radius,
                const DisturbanceBox& box)
      : posture_(posture), a_(a), b_(b), radius_(radius), box_(box) {}

  /// Everything that loads contact i alone.
  bool excludes_contact(int i) const {
    constexpr int both = 2;
    for (int l = 0; l < a_.contacts; ++l)
      if (l != i && excludes({l, a_.at[l].n}, i, edge_u, both, false)) return true;
    return false;
  }
  /// A slide by one of its own rows: its direction, or another contact's opening.
  bool excludes_slide(const ModeSpec& spec) const {
    const int i = spec.i, edge = loaded_edge(spec.sigma_i);
    const Vec2<double>& n = a_.at[i].n;
    const double sigma = spec.sigma_i;
    if (excludes({i, {sigma * n.y, -sigma * n.x}}, i, edge, 1, false)) return true;
    for (int l = 0; l < a_.contacts; ++l)
      if (l != i && excludes({l, a_.at[l].n}, i, edge, 1, false)) return true;
    return false;
  }
  /// All contacts break: N_l + z N_i with z >= 0 reads no force at all.
  bool excludes_break() const {
    for (int i = 0; i < a_.contacts; ++i)
      for (int l = 0; l < i; ++l)
        if (excludes({l, a_.at[l].n}, i, 0, 0, true)) return true;
    return false;
  }

 private:
  /// Z = A + z N_i, z between its value at a and at b; `edges` edges of cone i from first_edge on are to be negative.
  bool excludes(const Reading& reading, int i, int first_edge, int edges, bool not_negative) const {
    const auto choose = [&](const Frame<double>& frame, double& z) {
      Interval interval;
      if (not_negative) interval.low = 0;
      restrict_corners(frame, reading, i, interval);
      for (int e = first_edge; e < first_edge + edges; ++e) restrict_edge(frame, reading, i, e, interval);
      z = interval.inside();
      return interval.low < interval.high;
    };
    double za = 0, zb = 0;
    if (!choose(a_, za)) return false;
    zb = za;
    if (&a_ != &b_ && !choose(b_, zb)) return false;
    return holds(reading, i, first_edge, edges, za, zb);
  }

  static double reading_moment(const Frame<double>& frame, const Reading& reading) {
    return cross(frame.at[reading.l].r, reading.d);
  }

  /// Times rho^2 throughout.
  void restrict_corners(const Frame<double>& frame, const Reading& reading, int i, Interval& interval) const {
    const ContactTerms<double>& ti = frame.at[i];
    const double rho2 = frame.rho2, k = rho2 * box_.kappa;
    const double pi = k * ti.n.x, pl = k * reading.d.x;
    const double qi = box_.nu * ti.nz, ql = box_.nu * reading_moment(frame, reading);
    const double oi = rho2 * ti.n.y, ol = rho2 * reading.d.y;
    interval.need_positive(ol - pl - ql, oi - pi - qi);
    interval.need_positive(ol + pl - ql, oi + pi - qi);
    interval.need_positive(ol + pl + ql, oi + pi + qi);
    interval.need_positive(ol - pl + ql, oi - pi + qi);
  }
  void restrict_edge(const Frame<double>& frame, const Reading& reading, int i, int e, Interval& interval) const {
    const ContactTerms<double>& ti = frame.at[i];
    interval.need_positive(-(frame.rho2 * dot(reading.d, ti.edge[e]) + reading_moment(frame, reading) * ti.sz[e]),
                           -(frame.rho2 * dot(ti.n, ti.edge[e]) + ti.nz * ti.sz[e]));
  }

  bool holds(const Reading& reading, int i, int first_edge, int edges, double z_a, double z_b) const {
    const ContactTerms<double>&ti = a_.at[i], &end = b_.at[i];
    const Vec2<double>& d = reading.d;
    const double moment_about_i = cross(posture_.offset<double>(i, reading.l), d);
    const auto covector = [&](double z) { return Row<double>{d.x + z * ti.n.x, d.y + z * ti.n.y, moment_about_i}; };
    const Row<double> za = covector(z_a), zb = covector(z_b);
    // Z is A + z N_i up to rounding, which the bounds below contain: |d|, |n| < 2 in the 1-norm.
    const double force = 2 * (1 + std::max(std::abs(z_a), std::abs(z_b)));
    const double moment_bound = (posture_.spread() + radius_) * force;
    const double factor = row_error_factor * posture_.edge_bound(), area = factor * a_.rho2 * force;
    const std::array<double, 3> moment{moment_about_com(za, ti.r),
                                       0.5 * (moment_about_com(za, end.r) + moment_about_com(zb, ti.r)),
                                       moment_about_com(zb, end.r)};
    if (!positive_on_corners<double>(za, zb, moment, a_.rho2, box_,
                                     area * (1 + box_.kappa) + factor * box_.nu * moment_bound + underflow_slack))
      return false;
    const double slack = area + factor * radius_ * moment_bound + underflow_slack;
    for (int e = first_edge; e < first_edge + edges; ++e)
      if (!negative_on_edge<double>(za, zb, moment, ti.edge[e], ti.sz[e], end.sz[e], a_.rho2, slack)) return false;
    return true;
  }

  const Posture& posture_;
  const Frame<double>&a_, &b_;
  double radius_;
  const DisturbanceBox& box_;
};

/// z = s_i x s_j.
Row<double> force_pair(const ContactTerms<double>& a, int edge_a, const ContactTerms<double>& b, int edge_b) {
  return cross(Row<double>{a.edge[edge_a].x, a.edge[edge_a].y, a.sz[edge_a]},
               Row<double>{b.edge[edge_b].x, b.edge[edge_b].y, b.sz[edge_b]});
}

Row<double> inertia_times_normal_cross(const Frame<double>& frame, int i, int j) {
  const Row<double> c = normal_cross(frame.at[i], frame.at[j]);
  return {c.p, c.one, frame.rho2 * c.q};
}

/// One of the mode's rows (its direction along c, the force at i, the force at j) negative on all of W along the line, by
/// Bernstein coefficients: z is linear in lambda, M c too, their products quadratic.
bool two_slides_excluded(const ModeSpec& spec, const Frame<double>& a, const Frame<double>& b, const DisturbanceBox& box,
                         const Guard& guard) {
  const int i = spec.i, j = spec.j, edge_i = loaded_edge(spec.sigma_i), edge_j = loaded_edge(spec.sigma_j);
  const Row<double> za = force_pair(a.at[i], edge_i, a.at[j], edge_j), ca = inertia_times_normal_cross(a, i, j);
  const double da = dot(za, ca), sign = da > 0 ? 1 : -1, least = guard.denominator;
  if (!(std::abs(da) > least)) return false;
  const auto negative = [&](const Row<double>& row, double error) {
    return sign * row.one + box.kappa * std::abs(row.p) + box.nu * std::abs(row.q) < -error;
  };
  const double sense = -spec.sense;
  const auto direction = [&](const Row<double>& z) { return Row<double>{sense * z.p, sense * z.one, sense * z.q}; };
  const bool by_direction = spec.sense != 0 && negative(direction(za), guard.length);
  if (&a == &b && by_direction) return true;
  const Row<double> zb = force_pair(b.at[i], edge_i, b.at[j], edge_j), cb = inertia_times_normal_cross(b, i, j);
  if (!(sign * dot(zb, cb) > least && sign * (dot(za, cb) + dot(zb, ca)) > 2 * least)) return false;
  if (by_direction && negative(direction(zb), guard.length)) return true;
  const auto by_force = [&](int k, int edge, double order) {  // order: s_j x M c, but M c x s_i
    const auto row = [&](const Frame<double>& frame, const Row<double>& c) {
      const Row<double> cross_product = force_cross(frame.at[k], edge, c);
      return Row<double>{order * cross_product.p, order * cross_product.one, order * cross_product.q};
    };
    if (!negative(row(a, ca), guard.area)) return false;
    if (&a == &b) return true;
    const Row<double> ab = row(a, cb), ba = row(b, ca);
    return negative({ab.p + ba.p, ab.one + ba.one, ab.q + ba.q}, 2 * guard.area) && negative(row(b, cb), guard.area);
  };
  return by_force(j, edge_j, 1) || by_force(i, edge_i, -1);
}

/// A roll by its direction: alpha has the sign of -R . v whatever the force, which acts at x_i; R is linear along the line.
bool roll_excluded(const ModeSpec& spec, const Frame<double>& a, const Frame<double>& b, const DisturbanceBox& box,
                   const Guard& guard) {
  const auto wrong_way = [&](const Frame<double>& frame) {
    const Vec2<double>& r = frame.at[spec.i].r;
    return -spec.sense * r.x - box.kappa * std::abs(r.y) - box.nu > guard.length;
  };
  return spec.sense != 0 && wrong_way(a) && (&a == &b || wrong_way(b));
}

}  // namespace

std::uint32_t screened_modes(const Posture& posture, const Frame<double>& a, const Frame<double>& b, double radius,
                             const DisturbanceBox& box, const Guard& guard, std::uint32_t wanted) {
  if (guard.nothing_certain()) return 0;
  const ContactScreen screen(posture, a, b, radius, box);
  std::array<signed char, 3> known{};  // 0: not asked yet
  const auto contact_excluded = [&](int i) {
    if (known[i] == 0) known[i] = screen.excludes_contact(i) ? 1 : -1;
    return known[i] > 0;
  };
  std::uint32_t mask = 0;
  std::uint32_t bit = 1;
  for (const ModeSpec& spec : posture.modes()) {
    const auto excluded = [&] {
      switch (spec.kind) {
        case Kind::all_break: return screen.excludes_break();
        case Kind::two_slides: return two_slides_excluded(spec, a, b, box, guard);
        case Kind::roll: return roll_excluded(spec, a, b, box, guard) || contact_excluded(spec.i);
        case Kind::slide: return contact_excluded(spec.i) || screen.excludes_slide(spec);
      }
      return false;
    };
    if ((wanted & bit) && excluded()) mask |= bit;
    bit <<= 1;
  }
  return mask;
}

}  // namespace surefoot::stability
