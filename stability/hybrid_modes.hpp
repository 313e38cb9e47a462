// What closed contacts do under Coulomb friction [OR-H, Table I]: accelerations and forces of a contact mode, and which
// mode is consistent with the state. Speeds and centripetal terms count, so this is more than the modes at rest of
// rows.hpp, and shares nothing with it.
#pragma once

#include <optional>

#include "stability/hybrid_body.hpp"

namespace surefoot::stability {

/// Accelerations and contact forces per mass in one mode. An open contact has state `breaks`.
struct ModeMotion {
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();  ///< of the COM [m/s^2]
  double alpha = 0;                                        ///< [rad/s^2]
  std::array<double, 2> lift{}, slip{};                    ///< accelerations of the contacts along n and t
  std::array<double, 2> normal_force{}, tangent_force{};   ///< [m/s^2]
};

/// nullopt where the equations of the mode have no single solution.
std::optional<ModeMotion> motion_in(const HybridBody& body, const BodyState& state, const ContactMode& mode);

struct ModeChoice {
  std::optional<ContactMode> mode;  ///< none: no mode is consistent, only an impact could resolve it [OR-H, section II]
  ModeMotion motion;
  int consistent = 0;  ///< how many are; of several the one that keeps most contacts, rolling before sliding
};
/// A contact that has just come to the edge of what it did: of its friction cone where it rolled, of all force where it
/// lifts. Rounding would let it go on, and end that at once, for ever.
struct Leaving {
  int contact = -1;
  bool lifts = false;
};
/// Among the modes other than rest of all contacts. A contact that is leaving does what it did only if nothing else is
/// consistent.
ModeChoice choose_mode(const HybridBody& body, const BodyState& state, const Leaving& leaving = {});

}  // namespace surefoot::stability
