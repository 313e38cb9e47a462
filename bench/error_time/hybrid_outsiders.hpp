// What the hybrid dynamics of stability/ are held against: the same body in 200 digits, plain event-driven simulation,
// and a plain time-stepping scheme. All are written from [OR-H, (1)-(4)] and share only the numbers of the body with
// stability/hybrid_*.
#pragma once

#include <Eigen/Core>

#include "stability/hybrid_body.hpp"

namespace surefoot::bench {

/// The limit of infinitely many collisions.
struct ZenoPoint {
  double time = 0;                                     ///< [s]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< (v_x, v_y, omega) there
  int collisions = 0;
};

/// Flights and collisions in 200 digits until 1e-22 of the speed of the first collision is left: what then remains of
/// time is less than that of the whole. For starts from which all contacts collide for ever.
ZenoPoint zeno_in_many_digits(const stability::HybridBody& body, const stability::BodyState& start, double restitution);

/// The usual event-driven simulation in doubles: the first `most` collisions one by one, the last of them taken for the
/// limit.
ZenoPoint zeno_by_plain_events(const stability::HybridBody& body, const stability::BodyState& start, double restitution,
                               int most);

/// Moreau's time stepping with steps of a fixed size h [J. J. Moreau 1988; V. Acary and B. Brogliato, Numerical Methods
/// for Nonsmooth Dynamical Systems, section 10.1]: half a step of free motion, Newton's law of impact with the contacts
/// that have been passed there (a linear complementarity problem of at most two unknowns), half a step with the new
/// velocity. Until `horizon`; the limit is taken to be the end of the last step after which some contact moves faster
/// than gravity makes it in twenty steps.
ZenoPoint zeno_by_time_stepping(const stability::HybridBody& body, const stability::BodyState& start,
                                double restitution, double step, double horizon);

}  // namespace surefoot::bench
