// How precisely must the COM be placed? The largest disc around a COM that lies in R(W).
#pragma once

#include <Eigen/Core>
#include <span>

#include "stability/contact.hpp"

namespace surefoot::stability {

/// Radius [m] of a disc about `com` in all of which R_SS(W) holds and no non-static mode is feasible; 0 where com is
/// not in R(W) itself. Safe: never larger than the largest such disc, since all that is nearer is excluded by dual
/// certificates (region_rows.hpp). Sharp to `disc_precision` but where a mode comes arbitrarily close to feasible
/// without being so: along D = 0 the rows of a slide are multiples of one form, and the disc may end there. Discs
/// larger than `greatest_disc` times the extent of contacts and COM are not looked for. Contacts as for RobustOracle.
double com_tolerance(std::span<const Contact> contacts, double radius_of_gyration, const DisturbanceBox& box,
                     const Eigen::Vector2d& com);

constexpr double disc_precision = 1e-4;  ///< relative
constexpr double greatest_disc = 100;

}  // namespace surefoot::stability
