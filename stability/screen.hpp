// Shared certificates: a few tests that exclude most non-static modes of a stable posture at once, at a point or along
// a straight line of COMs. What they leave undecided is decided mode by mode; they never exclude a mode that is
// feasible.
//
// 1. All modes in which contact i alone is loaded (roll, both slides) have N_i . xi = 0 and N_l . xi >= 0. One covector
//    Z = N_l + z N_i with Z . M^-1 v > 0 at the corners of W and Z . M^-1 s < 0 for both edges of cone i excludes them
//    together (dual_certificate.hpp). In words: whatever the force at i, the body presses l into the ground. A single
//    slide is also excluded by its own direction, Z = sigma T_i + z N_i, a roll by the sense of its rotation, and all
//    contacts breaking by Z = N_l.
// 2. Two slides at i and j move along the twist c only, xi = -(z . v / D) c: excluded where D keeps its sign and the
//    direction along c, or the force at i or at j, has the wrong sign on all of W.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "stability/cover_conditions.hpp"
#include "stability/guard.hpp"
#include "stability/rows.hpp"

namespace surefoot::stability {

/// A covector of the contacts at the two ends: a direction d at contact l with its moment r_l x d.
struct Reading {
  Vec2<double> d;
  double moment_a, moment_b;
};

/// Tests on the straight line between the COMs of two frames; at_point: these are one COM.
template <bool at_point>
class Screen {
 public:
  /// `guard` belongs to the COMs between those of frames a and b.
  Screen(const Frame<double>& a, const Frame<double>& b, const DisturbanceBox& box, const Guard& guard)
      : a_(a), b_(b), box_(box), guard_(guard) {}

  /// Whether the mode is shown to be infeasible for every wrench of W at every COM between those of the frames.
  bool excludes(const ModeSpec& spec) {
    if (guard_.nothing_certain()) return false;
    switch (spec.kind) {
      case ModeSpec::Kind::all_break: return excludes_break();
      case ModeSpec::Kind::roll: return excludes_contact(spec.i) || excludes_roll(spec);
      case ModeSpec::Kind::slide: return excludes_contact(spec.i) || excludes_slide(spec);
      case ModeSpec::Kind::two_slides: return excludes_two_slides(spec);
    }
    return false;
  }

 private:
  enum class Known : signed char { not_asked, no, yes };

  // ---- one loaded contact ----

  /// Everything that loads contact i alone.
  bool excludes_contact(int i) {
    if (known_[i] == Known::not_asked) known_[i] = presses_another(i) ? Known::yes : Known::no;
    return known_[i] == Known::yes;
  }
  bool presses_another(int i) const {
    for (int l = 0; l < a_.contacts; ++l)
      if (l != i && proved(normal_reading(l), i, edge_u, edge_w)) return true;
    return false;
  }
  /// A slide by one of its own rows: its direction, or another contact's opening.
  bool excludes_slide(const ModeSpec& spec) const {
    const int edge = loaded_edge(spec.sigma_i);
    const ContactTerms<double>& t = a_.at[spec.i];
    const double sigma = spec.sigma_i;
    const Vec2<double> direction{sigma * t.n.y, -sigma * t.n.x};
    if (proved({direction, cross(t.r, direction), cross(b_.at[spec.i].r, direction)}, spec.i, edge, edge)) return true;
    for (int l = 0; l < a_.contacts; ++l)
      if (l != spec.i && proved(normal_reading(l), spec.i, edge, edge)) return true;
    return false;
  }

  Reading normal_reading(int l) const { return {a_.at[l].n, a_.at[l].nz, b_.at[l].nz}; }

  /// Z = A + z N_i presses under every force along the edges `first` to `last` of cone i: z at each end is the greatest
  /// that does, slightly less; it then reads W best where W presses i.
  bool proved(const Reading& reading, int i, int first, int last) const {
    double za, zb;
    if (!greatest_multiple(a_, reading.d, reading.moment_a, i, first, last, za)) return false;
    zb = za;
    if (!at_point && !greatest_multiple(b_, reading.d, reading.moment_b, i, first, last, zb)) return false;
    return holds(reading, i, first, last, za, zb);
  }

  bool greatest_multiple(const Frame<double>& frame, const Vec2<double>& d, double moment, int i, int first, int last,
                         double& z) const {
    const ContactTerms<double>& t = frame.at[i];
    z = HUGE_VAL;
    double least = HUGE_VAL;
    for (int e = first; e <= last; ++e) {
      const double own = slide_denominator(frame, t, e);
      if (!(own > guard_.denominator)) return false;
      z = std::min(z, -(frame.rho2 * dot(d, t.edge[e]) + moment * t.sz[e]) / own);
      least = std::min(least, own);
    }
    z -= 8 * (1 + std::abs(z)) * guard_.area / least;
    return true;
  }

  /// The two conditions on Z of cover_conditions.hpp. Errors: Z has components of at most 1 + |z|, readings of the
  /// classes "row" and "denominator" of guard.hpp.
  bool holds(const Reading& reading, int i, int first, int last, double za, double zb) const {
    const ContactTerms<double>&ta = a_.at[i], &tb = b_.at[i];
    const Vec2<double>& d = reading.d;
    const auto covector = [&](double z) { return Row<double>{d.x + z * ta.n.x, d.y + z * ta.n.y, 0}; };
    const double slack = (1 + std::max(std::abs(za), std::abs(zb))) * guard_.area;
    const Row<double> ra = covector(za);
    const double ma = reading.moment_a + za * ta.nz;
    if constexpr (at_point) {
      if (!positive_on_corners_at<double>(ra, ma, a_.rho2, box_, slack)) return false;
      for (int e = first; e <= last; ++e)
        if (!negative_on_edge_at<double>(ra, ma, ta.edge[e], ta.sz[e], a_.rho2, slack)) return false;
      return true;
    }
    const Row<double> rb = covector(zb);
    const double mb = reading.moment_b + zb * tb.nz;
    const double between = 0.5 * ((reading.moment_b + za * tb.nz) + (reading.moment_a + zb * ta.nz));
    const std::array<double, 3> moment{ma, between, mb};
    if (!positive_on_corners<double>(ra, rb, moment, a_.rho2, box_, slack)) return false;
    for (int e = first; e <= last; ++e)
      if (!negative_on_edge<double>(ra, rb, moment, ta.edge[e], ta.sz[e], tb.sz[e], a_.rho2, slack)) return false;
    return true;
  }

  /// By its direction: alpha has the sign of -R . v whatever the force, which acts at x_i; R is linear along the line.
  bool excludes_roll(const ModeSpec& spec) const {
    const auto wrong_way = [&](const Frame<double>& frame) {
      const Vec2<double>& r = frame.at[spec.i].r;
      return -spec.sense * r.x - box_.kappa * std::abs(r.y) - box_.nu > guard_.length;
    };
    return spec.sense != 0 && wrong_way(a_) && (at_point || wrong_way(b_));
  }

  // ---- no loaded contact ----

  /// W presses some contact, at both ends: N . M^-1 v is linear along the line.
  bool excludes_break() const {
    const auto pressed = [&](const Frame<double>& frame, int l) {
      const ContactTerms<double>& t = frame.at[l];
      return frame.rho2 * (t.n.y - box_.kappa * std::abs(t.n.x)) - box_.nu * std::abs(t.nz) > guard_.area;
    };
    for (int l = 0; l < a_.contacts; ++l)
      if (pressed(a_, l) && (at_point || pressed(b_, l))) return true;
    return false;
  }

  // ---- two loaded contacts ----

  bool negative(const Row<double>& row, double sign, double error) const {
    return sign * row.one + box_.kappa * std::abs(row.p) + box_.nu * std::abs(row.q) < -error;
  }

  /// One of the mode's rows (its direction along c, the force at i, the force at j) negative on all of W along the
  /// line, by Bernstein coefficients: z is linear in lambda, M c too, their products quadratic.
  bool excludes_two_slides(const ModeSpec& spec) const {
    const int i = spec.i, j = spec.j, edge_i = loaded_edge(spec.sigma_i), edge_j = loaded_edge(spec.sigma_j);
    const Row<double> za = force_pair(a_.at[i], edge_i, a_.at[j], edge_j), ca = inertia_times_normal_cross(a_, i, j);
    const double da = dot(za, ca), sign = da > 0 ? 1 : -1, least = guard_.denominator;
    if (!(std::abs(da) > least)) return false;
    const double sense = -spec.sense * sign;
    const bool by_direction = spec.sense != 0 && negative(za, sense, guard_.length);
    if constexpr (at_point) {
      return by_direction || negative(force_cross(a_.at[j], edge_j, ca), sign, guard_.area) ||
             negative(force_cross(a_.at[i], edge_i, ca), -sign, guard_.area);
    }
    const Row<double> zb = force_pair(b_.at[i], edge_i, b_.at[j], edge_j), cb = inertia_times_normal_cross(b_, i, j);
    if (!(sign * dot(zb, cb) > least && sign * (dot(za, cb) + dot(zb, ca)) > 2 * least)) return false;
    if (by_direction && negative(zb, sense, guard_.length)) return true;
    const auto by_force = [&](int k, int edge, double signs) {
      if (!negative(force_cross(a_.at[k], edge, ca), signs, guard_.area)) return false;
      if (!negative(force_cross(b_.at[k], edge, cb), signs, guard_.area)) return false;
      const Row<double> ab = force_cross(a_.at[k], edge, cb), ba = force_cross(b_.at[k], edge, ca);
      return negative({ab.p + ba.p, ab.one + ba.one, ab.q + ba.q}, signs, 2 * guard_.area);
    };
    return by_force(j, edge_j, sign) || by_force(i, edge_i, -sign);  // s_j x M c, but M c x s_i
  }

  const Frame<double>&a_, &b_;
  const DisturbanceBox& box_;
  const Guard& guard_;
  std::array<Known, 3> known_{};
};

}  // namespace surefoot::stability
