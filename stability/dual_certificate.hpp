// Proofs that a non-static mode is infeasible for every wrench of W, at a point or along a straight line of COMs.
//
// A mode asks for forces phi_m >= 0 along some cone edges and a twist xi = M^-1 (w + sum phi_m s_m) in a kinematic cone K:
// contacts that stay do not move along their normals, slides have their direction, rolls do not slide, the others open. K does
// not depend on the COM. If a covector Z is not negative on K and, with v = (p, 1, q) = -w,
//     Z . M^-1 v > 0 at the corners of W      and      Z . M^-1 s_m < 0 for every such edge,                          (*)
// then Z . xi = -Z . M^-1 v + sum phi_m Z . M^-1 s_m < 0, against Z . xi >= 0: infeasible. Conversely (Farkas) such a Z
// exists wherever the mode is infeasible with any margin, also where the denominator D of the mode's rows vanishes.
//
// Along a line of COMs, Z is interpolated between the covectors found at two points of it. It stays in its cone, which is
// convex; Z's moment about the COM is then quadratic and (*) cubic at most, and all Bernstein coefficients on the
// interval having the right sign proves (*) on all of it. Halving the interval makes the proof sharper by its square.
#pragma once

#include <array>

#include "stability/posture.hpp"

namespace surefoot::stability {

/// A proof at one COM. For all_break: multipliers of N_1, N_2, N_3. Otherwise Z about the position of contact spec.i, so that
/// Z . (velocity of that point, alpha) = p v_x + one v_y + q alpha.
struct Covector {
  Row<double> z{0, 0, 0};
  bool found = false;
};

/// Extreme twists of K about contact spec.i, as (velocity of that point, alpha).
template <class K>
struct TwistCone {
  std::array<Row<K>, 3> extreme;
  int count = 0;
  bool free_rotation = false;  // K contains both rotations about x_i: Z must have no moment about it
  void add(const Row<K>& twist) { extreme[count++] = twist; }
};

/// Certificates for one mode of one posture and one box.
class DualCertificate {
 public:
  DualCertificate(const Posture& posture, const ModeSpec& spec, const DisturbanceBox& box);

  /// A covector well inside the cone of those that satisfy all conditions at the COM of `frame`: only a proposal.
  Covector propose(const Frame<double>& frame) const;
  /// Whether `a` at the COM of frame_a and `b` at that of frame_b prove the mode infeasible on the straight line between these
  /// COMs. In doubles with error bounds for |r_x| + |r_y| <= radius, in rationals exactly.
  bool proves(const Covector& a, const Frame<double>& frame_a, const Covector& b, const Frame<double>& frame_b,
              double radius) const;
  bool proves(const Covector& a, const Frame<Dyadic>& frame_a, const Covector& b,
              const Frame<Dyadic>& frame_b) const;

 private:
  Covector propose_widened(const Frame<double>& frame, double widening) const;
  template <class K>
  bool in_cone(const Covector& covector, const TwistCone<K>& cone, double error) const;

  const Posture& posture_;
  const ModeSpec& spec_;
  DisturbanceBox box_;
  TwistCone<double> cone_;
};

}  // namespace surefoot::stability
