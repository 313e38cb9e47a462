// Motion with closed contacts in one contact mode, until something ends it.
#pragma once

#include <functional>

#include "stability/hybrid_modes.hpp"

namespace surefoot::stability {

struct MotionEnd {
  enum class Cause {
    stops,    ///< the sliding of `contact` comes to rest
    lifts,    ///< the normal force of `contact` vanishes
    slips,    ///< a rolling contact's force reaches the edge of the friction cone
    reaches,  ///< the open `contact` reaches the ground
    leaves,   ///< the neighbourhood is left
    work,     ///< `most_steps` were tried: some component is too small for its error to be kept
    time      ///< the time limit
  } cause = Cause::time;
  int contact = 0;
  double time = 0;  ///< [s] since the begin
};

/// Steps tried in one mode: usual motions take tens to hundreds. Feet at one point, of which one slides, have no height
/// to keep, and steps would shrink for ever.
constexpr int most_steps = 4'000;
constexpr int refused_step = 10;  ///< counts as so many: in usual motions they are rare

struct MotionLimits {
  double excursion = 0;  ///< [m], see HybridBody::excursion
  double time = 0;       ///< [s]
};

/// Integrates by Runge-Kutta-Fehlberg 7(8), local error 1e-13 of each component, and places the end to a few units in
/// the last place of its time within a step. `sample` is called with the time and state after each step.
MotionEnd move_in_mode(const HybridBody& body, BodyState& state, const ContactMode& mode, const MotionLimits& limits,
                       const std::function<void(double, const BodyState&)>& sample);

}  // namespace surefoot::stability
