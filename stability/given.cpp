#include "stability/given.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace surefoot::stability {

void refuse(const char* what) { throw std::invalid_argument(what); }

void require_contacts(std::span<const Contact> contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const char* fault = nullptr;
    if (!contact.position.allFinite() || !contact.normal.allFinite() || !std::isfinite(contact.friction))
      fault = "a number is not finite";
    else if (contact.friction < 0) fault = "friction is negative";
    else if (contact.normal.isZero(0)) fault = "the normal is zero";
    if (fault != nullptr) refuse(("contact " + std::to_string(i + 1) + ": " + fault).c_str());
  }
}

void require_radius_of_gyration(double rho) { require(positive(rho), "radius of gyration: expected a number > 0 [m]"); }

void require_box(const DisturbanceBox& box) {
  require(not_negative(box.kappa) && not_negative(box.nu), "disturbance: expected kappa and nu to be numbers >= 0");
}

}  // namespace surefoot::stability
