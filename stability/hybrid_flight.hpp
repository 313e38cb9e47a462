// How far a body is displaced in free flight, before it meets the ground again.
#pragma once

#include <optional>
#include <vector>

#include "stability/hybrid_body.hpp"

namespace surefoot::stability {

/// The state after a time s >= 0 of flight.
BodyState flown(const HybridBody& body, const BodyState& state, double s);

/// Not less than any displacement (HybridBody::excursion) in a flight of that duration [m].
double farthest_in_flight(const HybridBody& body, const BodyState& state, double duration);

/// Moments of a flight [s] in order, the apex and the end among them: in between the body turns by a quarter of a
/// radian at most, unless it spins more than 1000 rad. A contact of a spinning body may be farther away in between by
/// the little that it turns on.
std::vector<double> moments_of_flight(const HybridBody& body, const BodyState& state, double duration);

/// When the body leaves the neighbourhood [m] in a flight of that duration, if it does at one of these moments: it may
/// come back before the end.
std::optional<double> time_to_leave(const HybridBody& body, const BodyState& state, double duration,
                                    double neighbourhood);

}  // namespace surefoot::stability
