// What callers of the library must give: where it is missing, std::invalid_argument says what and where. (The numbers
// of a scene or a query are judged before, where they are read.) Where a check would cost what the answer does it is
// asserted only: by Posture and robust(), and of COMs.
#pragma once

#include <limits>
#include <span>

#include "stability/contact.hpp"

namespace surefoot::stability {

[[noreturn]] void refuse(const char* what);

inline void require(bool given, const char* what) {
  if (!given) [[unlikely]]
    refuse(what);
}
// Finite, too: no comparison holds for a number that is none.
inline bool positive(double value) { return value > 0 && value <= std::numeric_limits<double>::max(); }
inline void require_restitution(double restitution) {
  require(restitution > 0 && restitution < 1, "restitution: expected a number between 0 and 1, ends excluded");
}
inline bool not_negative(double value) { return value >= 0 && value <= std::numeric_limits<double>::max(); }

/// The first of the contacts that is none: numbers that are not finite, a normal of zero, negative friction.
void require_contacts(std::span<const Contact> contacts);
void require_radius_of_gyration(double rho);
void require_box(const DisturbanceBox& box);

}  // namespace surefoot::stability
