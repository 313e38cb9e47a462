// The completed hybrid system of [OR-H, section V]: after a push, flight and collisions, accumulations of infinitely
// many collisions completed at their limit, then motion with closed contacts under Coulomb friction, until rest or
// until the body leaves the neighbourhood of its nominal posture.
//
// Accumulations (Zeno points).
//   bouncing    one contact, the other away: completed when over all that is left of it the contact's acceleration is
//               constant to rounding and the other contact is not reached whatever the impulses; a ball's at once
//   clattering  both contacts: completed when the speeds that gravity can still make of heights and rates are below
//               rounding of the speeds of this run, for all the collisions that the restitution leaves
//   chattering  a closed contact is hit by the other's collision, in zero time: completed as soon as it is decided that
//               the two will collide by turns for ever (`chatters`)
//   dying out   collisions and slides with friction by turns: ended when 1e-12 of the run's speeds are left
// None of them by a count: a run with too many collisions ends `undecided`.
//
// Accuracy. Flights are exact to rounding; times of collisions too. Heights and rates keep their own relative accuracy,
// however small. Motion with closed contacts: local error 1e-13. Energy never grows but by rounding.
// Limits: restitution so near 1 that 1 / (1 - e) collisions per decade of speed exceed `most_collisions`; where several
// modes are consistent the one that keeps most contacts is taken and counted; where none is, the run ends (an impact
// without collision, which [OR-H] leaves out).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "stability/hybrid_modes.hpp"

namespace surefoot::stability {

struct HybridOptions {
  double restitution = 0.5;                    ///< 0 < e < 1
  double neighbourhood = 0.1;                  ///< [m] of HybridBody::excursion: the run ends beyond
  double time_limit = 100;                     ///< [s]
  std::uint64_t most_collisions = 10'000'000;  ///< a change of mode counts as 1000 of them
};

struct HybridEvent {
  enum class Kind {
    collision,   ///< at `contact`, approached with `speed`
    bouncing,    ///< an accumulation at `contact`, of `duration`, is completed
    clattering,  ///< an accumulation at all contacts is completed
    chattering,  ///< the same in zero time
    dies_out,    ///< collisions and slides by turns: 1e-12 of the speeds of this run are left
    mode,        ///< motion in `mode` begins
    sample,      ///< a moment of it
    stops,       ///< sliding at `contact` ends
    lifts,       ///< `contact` loses its force
    slips,       ///< a rolling `contact` begins to slide
    reaches      ///< `contact` comes down while the other is closed
  } kind = Kind::sample;
  double time = 0;  ///< [s]
  int contact = 0;
  double speed = 0, duration = 0;
  ContactMode mode;
  bool ambiguous = false;  ///< more than one mode was consistent
  BodyState state;         ///< after the event
};

struct HybridRun {
  enum class Outcome {
    rest,          ///< the body stands still, balanced [theory section 3]
    left,          ///< it left the neighbourhood
    inconsistent,  ///< no contact mode is consistent
    undecided      ///< the time limit, most_collisions, or most_steps of a motion (hybrid_motion.hpp) was reached
  } outcome = Outcome::undecided;
  double time = 0;  ///< [s] at the end
  BodyState state;  ///< at the end
  std::uint64_t collisions = 0, modes = 0;
  int accumulations = 0, ambiguous = 0;
  double greatest_excursion = 0;  ///< [m] on the way; in flight at moments_of_flight (hybrid_flight.hpp)
  double energy_growth = 0;       ///< [m^2/s^2] greatest growth between two events: rounding
};

const char* name(HybridRun::Outcome outcome);

/// From a state with all heights >= 0. `watch` is told of every event. Throws std::invalid_argument for a start that is
/// not finite or below the ground, a restitution that is not between 0 and 1, limits that are not positive.
HybridRun simulate(const HybridBody& body, const BodyState& start, const HybridOptions& options,
                   const std::function<void(const HybridEvent&)>& watch = {});

}  // namespace surefoot::stability
