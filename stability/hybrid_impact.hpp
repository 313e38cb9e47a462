// Flight and collisions: when a contact is reached, the frictionless restitution law [OR-H, (4)], and the limits of
// infinitely many collisions.
#pragma once

#include "stability/hybrid_body.hpp"

namespace surefoot::stability {

/// Time [s] after which contact i touches the ground in free flight, infinity if not within `horizon`. From h >= 0; a
/// closed contact that is let go of, or one that has just bounced, is not at once reached again.
/// Guarantee: the first such time, to a few units in the last place of it: steps are taken by lower bounds of h from
/// Taylor's theorem with |h'''| <= |omega|^3 |arm|, so none passes over a root.
double time_to_contact(const HybridBody& body, const BodyState& state, int i, double horizon);

/// A collision at contact i with rate_i < 0 [OR-H, (4)].
void collide(const HybridBody& body, BodyState& state, int i, double restitution);

/// Impulses along the normals that bring the rates of all contacts to 0: the limit of a clattering or chattering
/// sequence, whose sum of impulses is determined by its end. Heights become 0.
void settle(const HybridBody& body, BodyState& state);

/// Both contacts touch and `a` has just collided: will a and b collide by turns for ever, in zero time?
/// Without heights the map (9) is linear; x = u_a / |u_b| goes to e / ((1 + e) psi_b - x), and a and b change names. It
/// stays positive for ever iff x is at most the greater, repelling fixed point of two such steps, which is real above
/// the dashed curve of [OR-H, Fig. 2]: psi_1 psi_2 (1 + e)^2 >= 4 e.
bool chatters(const HybridBody& body, const BodyState& state, int a, double restitution);

/// A bounce that has begun: contact i is touching with rate > 0. The whole rest of the bouncing at i, were it alone and
/// the acceleration constant [OR-H, section III].
struct Bouncing {
  double time = 0;     ///< [s] until its limit; infinity where the contact does not come back
  double error = 0;    ///< relative: how much the acceleration of the contact changes meanwhile
  bool alone = false;  ///< the other contact is not reached meanwhile, whatever the order of impulses
};
Bouncing bouncing(const HybridBody& body, const BodyState& state, int i, double restitution);
/// The state at the limit: contact i closed.
void finish_bouncing(const HybridBody& body, BodyState& state, int i, double restitution, double time);

/// The Poincare map of clattering, linearised, for any g_a and g_b [OR-H, (7); theory section 7]. Contact a has just
/// collided, b comes down.
struct Clattering {
  double u_a = 0, u_b = 0;  ///< rates after the collision at a [m/s]
  double h_b = 0;           ///< [m]
  double time = 0;          ///< [s] until b collides, after a step
  bool persists = true;     ///< (8): b was reached before a fell back
};
/// One collision further; in the result the names of a and b are exchanged.
Clattering clatter(const Clattering& from, double restitution, double psi_b, double g_a, double g_b);

}  // namespace surefoot::stability
