// A frictional point contact, the box of disturbances, and the contact modes of [OR-P, Table I].
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace surefoot::stability {

/// Point contact with Coulomb friction. The normal points from the ground into free space; it need not
/// have unit length, any direction is allowed.
struct Contact {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();   ///< not zero
  double friction = 0;                                 ///< Coulomb coefficient, >= 0
};

/// W = {|p| <= kappa, |q| <= nu} with p = f_x / f_y and q = torque / f_y [OR-P, section V].
struct DisturbanceBox {
  double kappa = 0;  ///< >= 0
  double nu = 0;     ///< [m], >= 0
};

/// A wrench in the homogeneous coordinates of [OR-P, section V]; gravity is p = q = 0.
struct Wrench {
  double p = 0;
  double q = 0;  ///< [m]
};

/// What one contact does at the instant considered [OR-P, Table I].
enum class ContactState : char {
  breaks = 'F',          ///< breaks away
  rolls = 'R',           ///< fixed or rolling
  slides_along = 'U',    ///< slides along +t, t = (n_y, -n_x)
  slides_against = 'W',  ///< slides along -t
};

/// One state per contact, in the order of the contacts: "UF", "FWR", ...
struct ContactMode {
  std::array<ContactState, 3> at{ContactState::breaks, ContactState::breaks, ContactState::breaks};
  int contacts = 0;
  std::string name() const {
    std::string text;
    for (int i = 0; i < contacts; ++i) text += static_cast<char>(at[i]);
    return text;
  }
  friend bool operator==(const ContactMode&, const ContactMode&) = default;
};

}  // namespace surefoot::stability
