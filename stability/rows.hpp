// The one formulation of the non-static contact modes (theory section 4): for each mode, rows G such that
//   mode feasible at (p, q)  <=>  G . (p, 1, q) > 0 for every row.
// Templated on the number type of the COM (numbers.hpp); normals need not have unit length (t = (n_y, -n_x)).
//
// Notation. r = x_i - x; N = (n, r x n); T = (t, r x t); C = n - sigma mu t the loaded cone edge of a slide
// in direction sigma t (sigma = +1: mode U, sigma = -1: mode W); s = (C, r x C); R = (r_y, -r_x, 1), the twist of a
// unit rotation about the contact; v = (p, 1, q) = -w; M = diag(1, 1, rho^2). Rows are scaled by positive factors
// (rho^2, |n|^2, rho^2 + |r|^2) and by the denominator D, whose sign the caller applies.
//
// Derivations.
//   F...F   xi = M^-1 w, row N . xi; times rho^2:  -(rho^2 n, r x n).
//   R at i  about the contact: alpha (rho^2 + |r|^2) = -R . v, a = alpha (r_y, -r_x), force f_i = a + (p, 1).
//           (rho^2 + |r|^2) d . f_i = (rho^2 d + r (d . r), r x d) . v  for any direction d; d = mu n -+ t.
//           N_l . xi = alpha N_l . R and N_l . R = (x_l - x_i) x n_l does not depend on x: only its sign matters.
//   slide   D = N . M^-1 s, phi = N . M^-1 v / D, D (A . xi) = -M^-1 v . ((M^-1 s) x (A x N)) for any covector A
//           (u x (A x B) = A (u . B) - B (u . A)); A = sigma T gives A x N = sigma |n|^2 R.
//   two slides  c = N_i x N_j, z = s_i x s_j, D = z . M c, xi = -(z . v / D) c, phi_i = v . (s_j x M c) / D,
//           phi_j = v . (M c x s_i) / D. The signs of T_i . c, T_j . c, N_l . c do not depend on x: `sense`.
#pragma once

#include <array>
#include <cstdint>

#include "stability/contact.hpp"
#include "stability/numbers.hpp"
#include "stability/planar.hpp"

namespace surefoot::stability {

/// Which edge of the friction cone: C^u = n + mu t, C^w = n - mu t.
enum Edge { edge_u = 0, edge_w = 1 };

/// One contact seen from the COM.
template <class V>
struct ContactTerms {
  using K = Constant<V>;
  Vec2<K> n;
  std::array<Vec2<K>, 2> edge;  // C^u, C^w
  K mu;
  Vec2<V> r;
  V nz;                 // r x n
  std::array<V, 2> sz;  // r x C^u, r x C^w
};

template <class V>
struct Frame {
  Constant<V> rho2;
  int contacts;
  std::array<ContactTerms<V>, 3> at;
};

/// A non-static mode of a given contact set, with what the geometry of the contacts says about it for every COM.
struct ModeSpec {
  enum class Kind : unsigned char { all_break, roll, slide, two_slides } kind;
  std::int8_t i, j;                  // the contacts that stay
  std::int8_t sigma_i, sigma_j;      // +1: U, -1: W
  std::int8_t sense;                 // roll, two_slides: required sign of alpha or of xi along c; 0: free
  std::array<bool, 3> row_vanishes;  // slide: N_l is a multiple of N_i, its breaking row is identically zero
};

inline ContactMode contact_mode(const ModeSpec& spec, int contacts) {
  const auto slide = [](int sigma) { return sigma > 0 ? ContactState::slides_along : ContactState::slides_against; };
  ContactMode mode;
  mode.contacts = contacts;
  if (spec.kind == ModeSpec::Kind::roll) mode.at[spec.i] = ContactState::rolls;
  if (spec.kind == ModeSpec::Kind::slide || spec.kind == ModeSpec::Kind::two_slides)
    mode.at[spec.i] = slide(spec.sigma_i);
  if (spec.kind == ModeSpec::Kind::two_slides) mode.at[spec.j] = slide(spec.sigma_j);
  return mode;
}

inline int loaded_edge(int sigma) { return sigma > 0 ? edge_w : edge_u; }

template <class V>
Row<V> rotation_row(const ContactTerms<V>& a) {
  return {a.r.y, -a.r.x, V(Constant<V>(1))};
}

/// (rho^2 n, r x n): N . M^-1 v, times rho^2.
template <class V>
Row<V> normal_row(const Frame<V>& frame, const ContactTerms<V>& a) {
  return {V(frame.rho2 * a.n.x), V(frame.rho2 * a.n.y), a.nz};
}

/// N_i . M^-1 N_j, times rho^2.
template <class V>
V normal_product(const Frame<V>& frame, int i, int j) {
  const ContactTerms<V>&a = frame.at[i], &b = frame.at[j];
  return V(frame.rho2 * dot(a.n, b.n)) + a.nz * b.nz;
}

template <class V>
Row<V> roll_force_row(const Frame<V>& frame, const ContactTerms<V>& a, const Vec2<Constant<V>>& d) {
  const V along = a.r.x * d.x + a.r.y * d.y;
  return {V(frame.rho2 * d.x) + a.r.x * along, V(frame.rho2 * d.y) + a.r.y * along, a.r.x * d.y - a.r.y * d.x};
}

template <class V>
V slide_denominator(const Frame<V>& frame, const ContactTerms<V>& a, int edge) {
  return V(frame.rho2 * dot(a.n, a.n)) + a.nz * a.sz[edge];
}

/// -(M^-1)((M^-1 s) x E), times rho^2, for a triple E = A x N.
template <class V>
Row<V> slide_row(const Frame<V>& frame, const ContactTerms<V>& a, int edge, const Row<V>& e) {
  const Vec2<Constant<V>>& c = a.edge[edge];
  const V& sz = a.sz[edge];
  return {sz * e.one - e.q * (frame.rho2 * c.y), e.q * (frame.rho2 * c.x) - sz * e.p, e.p * c.y - e.one * c.x};
}

/// N_a x N_b; the last component does not depend on x.
template <class V>
Row<V> normal_cross(const ContactTerms<V>& a, const ContactTerms<V>& b) {
  return {b.nz * a.n.y - a.nz * b.n.y, a.nz * b.n.x - b.nz * a.n.x, V(cross(a.n, b.n))};
}

/// s x M c for the force s = (C, r x C) along an edge.
template <class V>
Row<V> force_cross(const ContactTerms<V>& a, int edge, const Row<V>& mc) {
  const Vec2<Constant<V>>& c = a.edge[edge];
  return {mc.q * c.y - a.sz[edge] * mc.one, a.sz[edge] * mc.p - mc.q * c.x, mc.one * c.x - mc.p * c.y};
}

/// M c for the twist c = N_a x N_b along which both contacts slide.
template <class V>
Row<V> inertia_times_normal_cross(const Frame<V>& frame, int i, int j) {
  const Row<V> c = normal_cross(frame.at[i], frame.at[j]);
  return {c.p, c.one, c.q * frame.rho2};
}

/// z = s_a x s_b for the forces along one edge of each.
template <class V>
Row<V> force_pair(const ContactTerms<V>& a, int edge_a, const ContactTerms<V>& b, int edge_b) {
  const Vec2<Constant<V>>&ca = a.edge[edge_a], &cb = b.edge[edge_b];
  return {b.sz[edge_b] * ca.y - a.sz[edge_a] * cb.y, a.sz[edge_a] * cb.x - b.sz[edge_b] * ca.x, V(cross(ca, cb))};
}

/// How many of a mode's rows are force constraints: emit_rows hands them over last, after the kinematic ones.
inline int force_rows(const ModeSpec& spec) {
  switch (spec.kind) {
    case ModeSpec::Kind::all_break: return 0;
    case ModeSpec::Kind::slide: return 1;
    default: return 2;
  }
}

/// Hands the rows of a mode to `sink`: first sink.denominator(D) where there is one, then sink.add(row), which returns
/// true to stop early. sink.add_length(row) takes rows whose p and 1 slots are lengths (rounding-error class of
/// guard.hpp).
template <class V, class Sink>
void emit_rows(const Frame<V>& frame, const ModeSpec& spec, Sink& sink) {
  using K = Constant<V>;
  const ContactTerms<V>& a = frame.at[spec.i];
  switch (spec.kind) {
    case ModeSpec::Kind::all_break:
      for (int l = 0; l < frame.contacts; ++l)
        if (sink.add(-normal_row(frame, frame.at[l]))) return;
      return;
    case ModeSpec::Kind::roll: {
      if (spec.sense != 0) {
        const Row<V> rotation = rotation_row(a);
        if (sink.add_length(spec.sense > 0 ? -rotation : rotation)) return;
      }
      const Vec2<K> plus{a.mu * a.n.x + a.n.y, a.mu * a.n.y - a.n.x};
      const Vec2<K> minus{a.mu * a.n.x - a.n.y, a.mu * a.n.y + a.n.x};
      if (sink.add(roll_force_row(frame, a, plus))) return;
      sink.add(roll_force_row(frame, a, minus));
      return;
    }
    case ModeSpec::Kind::slide: {
      const int edge = loaded_edge(spec.sigma_i);
      sink.denominator(slide_denominator(frame, a, edge));
      const Row<V> rotation = rotation_row(a);
      if (sink.add(slide_row(frame, a, edge, spec.sigma_i > 0 ? rotation : -rotation))) return;
      for (int l = 0; l < frame.contacts; ++l) {
        if (l == spec.i || spec.row_vanishes[l]) continue;
        if (sink.add(slide_row(frame, a, edge, normal_cross(frame.at[l], a)))) return;
      }
      sink.add(normal_row(frame, a));
      return;
    }
    case ModeSpec::Kind::two_slides: {
      const ContactTerms<V>& b = frame.at[spec.j];
      const int edge_a = loaded_edge(spec.sigma_i), edge_b = loaded_edge(spec.sigma_j);
      const Row<V> mc = inertia_times_normal_cross(frame, spec.i, spec.j);
      const Row<V> z = force_pair(a, edge_a, b, edge_b);
      sink.denominator(dot(z, mc));
      if (spec.sense != 0 && sink.add_length(spec.sense > 0 ? -z : z)) return;
      if (sink.add(force_cross(b, edge_b, mc))) return;
      sink.add(-force_cross(a, edge_a, mc));
      return;
    }
  }
}

}  // namespace surefoot::stability
