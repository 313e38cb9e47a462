// Proofs that a non-static mode is infeasible for every wrench of W, at a point or along a straight line of COMs.
//
// A mode asks for forces phi_m >= 0 along some cone edges and a twist xi = M^-1 (w + sum phi_m s_m) in a kinematic cone
// K: contacts that stay do not move along their normals, slides have their direction, rolls do not slide, the others
// open. K does not depend on the COM. If a covector Z is not negative on K and, with v = (p, 1, q) = -w,
//     Z . M^-1 v > 0 at the corners of W      and      Z . M^-1 s_m < 0 for every such edge,
//     (*)
// then Z . xi = -Z . M^-1 v + sum phi_m Z . M^-1 s_m < 0, against Z . xi >= 0: infeasible. Conversely (Farkas) such a Z
// exists wherever the mode is infeasible with any margin, also where the denominator D of the mode's rows vanishes.
//
// Along a line of COMs, Z is interpolated between the covectors found at two points of it. It stays in its cone, which
// is convex; Z's moment about the COM is then quadratic and (*) cubic at most, and all Bernstein coefficients on the
// interval having the right sign proves (*) on all of it. Halving the interval makes the proof sharper by its square.
#pragma once

#include <array>
#include <cstdint>

#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

/// A proof at one COM. For all_break: multipliers of N_1, N_2, N_3. Otherwise Z about the position of contact spec.i,
/// so that Z . (velocity of that point, alpha) = p v_x + one v_y + q alpha.
struct Covector {
  Row<double> z;
  bool found;
};

/// Extreme twists of K about contact spec.i, as (velocity of that point, alpha).
template <class K>
struct TwistCone {
  std::array<Row<K>, 2> extreme;
  int count = 0;
  bool free_rotation = false;  // K contains both rotations about x_i: Z must have no moment about it
  void add(const Row<K>& twist) { extreme[count++] = twist; }
};

/// The cone edges along which a mode has forces.
struct LoadedEdges {
  struct At {
    std::int8_t contact, edge;
  };
  std::array<At, 2> at;
  int count = 0;
  explicit LoadedEdges(const ModeSpec& spec);
};

/// What all COMs of a line have in common.
struct LineFrame {
  const Posture& posture;
  DisturbanceBox box;
  double radius;  // bounds |r_x| + |r_y| on the line, and the terms it is computed from
  Guard guard;    // of that radius
  LineFrame(const Posture& p, const DisturbanceBox& b, double r)
      : posture(p), box(b), radius(r), guard(GuardScale(p.edge_bound(), p.rho2(), b).at(r)) {}
};

/// Certificates for one mode on one line.
class DualCertificate {
 public:
  DualCertificate(const LineFrame& line, const ModeSpec& spec);

  /// A covector well inside the cone of those that satisfy all conditions at the COM of `frame`. That it is not
  /// negative on K is certain; (*) is only proposed.
  Covector propose(const Frame<double>& frame) const;
  /// Whether `a` at the COM of frame_a and `b` at that of frame_b, proposed there, prove the mode infeasible on the
  /// straight line between these COMs: in doubles with error bounds, or exactly.
  bool proves(const Covector& a, const Frame<double>& frame_a, const Covector& b, const Frame<double>& frame_b) const;
  bool proves(const Covector& a, const Frame<Dyadic>& frame_a, const Covector& b, const Frame<Dyadic>& frame_b) const;
  /// Whether (±1, kappa, 0) or (0, nu, ±rho^2) about all COMs, which read 0 on a side of W and nothing negative on it,
  /// prove the mode infeasible between the COMs of the frames. Where Z is positive on K, the inequalities (*) need not
  /// be strict: so are proved modes that W only touches, where kappa is a friction coefficient or W has no extent along
  /// an axis. Exact, and dear; `may_prove_on_border` tells in doubles where asking is in vain.
  bool proves_on_border(const Frame<Dyadic>& frame_a, const Frame<Dyadic>& frame_b) const;
  bool may_prove_on_border(const Frame<double>& frame_a, const Frame<double>& frame_b) const;
  const TwistCone<double>& cone() const { return cone_; }

 private:
  Covector propose_widened(const Frame<double>& frame, double widening) const;
  Covector propose_force(const Frame<double>& frame) const;
  Covector propose_breaks(const Frame<double>& frame) const;
  bool surely_in_cone(const Row<double>& z) const;

  const LineFrame& line_;
  ModeSpec spec_;
  LoadedEdges edges_;
  TwistCone<double> cone_;
};

}  // namespace surefoot::stability
