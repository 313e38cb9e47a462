// Shared certificates: a few tests that exclude most non-static modes of a stable posture at once, at a point or along
// a straight line of COMs. What they leave undecided is decided mode by mode; they never exclude a mode that is
// feasible.
//
// 1. All modes in which contact i alone is loaded (roll, both slides) have N_i . xi = 0 and N_l . xi >= 0. One covector
//    Z = N_l + z N_i with Z . M^-1 v > 0 at the corners of W and Z . M^-1 s < 0 for both edges of cone i excludes them
//    together (dual_certificate.hpp). In words: whatever the force at i, the body presses l into the ground. A single
//    slide is also excluded by its own direction, Z = sigma T_i + z N_i, a roll by the sense of its rotation, and all
//    contacts breaking by Z = N_l.
// 2. Two slides at i and j move along the twist c only, xi = -(z . v / D) c: excluded where D is not zero and the
//    direction along c, or the force at i or at j, has the wrong sign on all of W.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "stability/box_test.hpp"
#include "stability/cover_conditions.hpp"
#include "stability/guard.hpp"
#include "stability/rows.hpp"

namespace surefoot::stability {

/// A covector of the contacts: a direction d at contact l with its moment r_l x d.
struct Reading {
  Vec2<double> d;
  double moment;
};

class Screen {
 public:
  /// `guard` belongs to the COM of the frame.
  Screen(const Frame<double>& frame, const DisturbanceBox& box, const Guard& guard)
      : frame_(frame), box_(box), guard_(guard) {}

  /// Whether the mode is shown to be infeasible for every wrench of W.
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
  enum class Known : std::int8_t { not_asked, no, yes };

  // ---- one loaded contact ----

  /// Everything that loads contact i alone.
  bool excludes_contact(int i) {
    if (known_[i] == Known::not_asked) known_[i] = presses_another(i) ? Known::yes : Known::no;
    return known_[i] == Known::yes;
  }
  bool presses_another(int i) const {
    for (int l = 0; l < frame_.contacts; ++l)
      if (l != i && proved(normal_reading(l), i, edge_u, edge_w)) return true;
    return false;
  }
  /// A slide by one of its own rows: its direction, or another contact's opening.
  bool excludes_slide(const ModeSpec& spec) const {
    const int edge = loaded_edge(spec.sigma_i);
    const ContactTerms<double>& t = frame_.at[spec.i];
    const double sigma = spec.sigma_i;
    const Vec2<double> direction{sigma * t.n.y, -sigma * t.n.x};
    if (proved({direction, cross(t.r, direction)}, spec.i, edge, edge)) return true;
    for (int l = 0; l < frame_.contacts; ++l)
      if (l != spec.i && proved(normal_reading(l), spec.i, edge, edge)) return true;
    return false;
  }

  Reading normal_reading(int l) const { return {frame_.at[l].n, frame_.at[l].nz}; }

  /// Z = A + z N_i presses under every force along the edges `first` to `last` of cone i. z is the greatest that does,
  /// slightly less: Z then reads W best where W presses i. Errors: Z has components of at most 1 + |z|, readings of the
  /// classes "row" and "denominator" of guard.hpp.
  bool proved(const Reading& reading, int i, int first, int last) const {
    const ContactTerms<double>& t = frame_.at[i];
    double z = HUGE_VAL, least = HUGE_VAL;
    for (int e = first; e <= last; ++e) {
      const double own = slide_denominator(frame_, t, e);
      if (!(own > guard_.denominator)) return false;
      z = std::min(z, -(frame_.rho2 * dot(reading.d, t.edge[e]) + reading.moment * t.sz[e]) / own);
      least = std::min(least, own);
    }
    if constexpr (guarded) z -= 8 * (1 + std::abs(z)) * guard_.area / least;
    const double slack = guarded ? (1 + std::abs(z)) * guard_.area : 0;
    const Row<double> covector{reading.d.x + z * t.n.x, reading.d.y + z * t.n.y, 0};
    const double moment = reading.moment + z * t.nz;
    if (!positive_on_corners_at<double>(covector, moment, frame_.rho2, box_, slack)) return false;
    for (int e = first; guarded && e <= last; ++e)
      if (!negative_on_edge_at<double>(covector, moment, t.edge[e], t.sz[e], frame_.rho2, slack)) return false;
    return true;
  }

  /// By its direction: alpha has the sign of -R . v whatever the force, which acts at x_i.
  bool excludes_roll(const ModeSpec& spec) const {
    return spec.sense != 0 && negative_on(box_, rotation_row(frame_.at[spec.i]), -spec.sense, guard_.length);
  }

  // ---- no loaded contact ----

  /// W presses some contact.
  bool excludes_break() const {
    for (int l = 0; l < frame_.contacts; ++l) {
      const ContactTerms<double>& t = frame_.at[l];
      const double force = frame_.rho2 * (t.n.y - box_.kappa * std::abs(t.n.x));
      if (force - box_.nu * std::abs(t.nz) > guard_.area) return true;
    }
    return false;
  }

  // ---- two loaded contacts ----

  /// One of the mode's rows (its direction along c, the force at i, the force at j) is negative on all of W.
  bool excludes_two_slides(const ModeSpec& spec) const {
    const int i = spec.i, j = spec.j, edge_i = loaded_edge(spec.sigma_i), edge_j = loaded_edge(spec.sigma_j);
    const Row<double> z = force_pair(frame_.at[i], edge_i, frame_.at[j], edge_j);
    const Row<double> mc = inertia_times_normal_cross(frame_, i, j);
    const double d = dot(z, mc), sign = d > 0 ? 1 : -1;
    if (!(std::abs(d) > guard_.denominator)) return false;
    if (spec.sense != 0 && negative_on(box_, z, -spec.sense * sign, guard_.length)) return true;
    return negative_on(box_, force_cross(frame_.at[j], edge_j, mc), sign, guard_.area) ||
           negative_on(box_, force_cross(frame_.at[i], edge_i, mc), -sign, guard_.area);  // s_j x M c, but M c x s_i
  }

  const Frame<double>& frame_;
  const DisturbanceBox& box_;
  const Guard& guard_;
  std::array<Known, 3> known_{};
};

}  // namespace surefoot::stability
