// Shared certificates: a few tests that exclude most non-static modes of a stable posture at once, at a point or along a
// straight line of COMs. What they leave undecided is decided mode by mode; they never exclude a mode that is feasible.
//
// 1. All modes in which contact i alone is loaded (roll, both slides) have N_i . xi = 0 and N_l . xi >= 0. One covector
//    Z = N_l + z N_i with Z . M^-1 v > 0 at the corners of W and Z . M^-1 s < 0 for both edges of cone i excludes them together
//    (dual_certificate.hpp). In words: whatever the force at i, the body presses l into the ground. A single slide is also
//    excluded by its own direction, Z = sigma T_i + z N_i, a roll by the sense of its rotation, and all contacts breaking by Z = N_l + z N_i with z >= 0.
// 2. Two slides at i and j move along the twist c only, xi = -(z . v / D) c: excluded where D keeps its sign and the direction along
//    c, or the force at i or at j, has the wrong sign on all of W.
#pragma once

#include <cstdint>

#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

/// Bit k is set if modes()[k], one of those wanted, is shown to be infeasible for every wrench of W at every COM between those of frames a and b. `radius` bounds
/// |r_x| + |r_y| between them; `guard` belongs to that radius.
std::uint32_t screened_modes(const Posture& posture, const Frame<double>& a, const Frame<double>& b, double radius,
                             const DisturbanceBox& box, const Guard& guard, std::uint32_t wanted = ~0u);

}  // namespace surefoot::stability
