// Random postures of every kind the terrain can offer, from fixed seeds, and their text as a query line.
// Kinds that rely on an exact coincidence (level treads, collinear inclines, a foot above a foot) are drawn on a
// dyadic grid, so that the coincidence holds for the doubles and not only for the intention.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "stability/contact.hpp"

namespace surefoot::testing {

using stability::Contact;
using stability::ContactMode;
using stability::ContactState;
using stability::DisturbanceBox;
using stability::Wrench;

enum class Kind {
  gentle,        ///< normals within 30 degrees of up
  any,           ///< normals of any direction
  flat,          ///< level ground: all normals on parallel lines, all contacts on one line
  vee,           ///< normals lean towards each other
  stairs,        ///< level treads at different heights, some contacts on risers
  ridge,         ///< normals lean away from each other
  walls,         ///< nearly vertical ground, overhanging at times
  stacked,       ///< a foot straight above another: some n_j passes through x_i
  incline,       ///< collinear contacts on a slope
  treads,        ///< parallel normals, contacts not on one line
  coincident,    ///< two or three contacts at one point
  opposed,       ///< two normals on one line, same or opposite sense
  frictionless,  ///< any of the above with all mu = 0
};
inline constexpr std::array<Kind, 13> all_kinds{Kind::gentle,      Kind::any,    Kind::flat,       Kind::vee,
                                                Kind::stairs,      Kind::ridge,  Kind::walls,      Kind::stacked,
                                                Kind::incline,     Kind::treads, Kind::coincident, Kind::opposed,
                                                Kind::frictionless};
/// No row of theory section 4 vanishes there except by accident.
inline constexpr std::array<Kind, 5> generic_kinds{Kind::gentle, Kind::any, Kind::vee, Kind::ridge, Kind::walls};

const char* name(Kind kind);

struct SamplePosture {
  Kind kind = Kind::any;
  std::vector<Contact> contacts;
  Eigen::Vector2d com = Eigen::Vector2d::Zero();
  double rho = 1;
  DisturbanceBox box;

  /// The posture as a query line (formats.md): paste it into `surefoot query`.
  std::string json() const;
};

class Sampler {
 public:
  explicit Sampler(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high);
  int integer(int low, int high);  ///< both ends included
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// count 0 draws 1, 2 or 3 contacts (one in ten, four in ten, five in ten).
  SamplePosture posture(Kind kind, int count = 0);
  /// A COM near the contacts, likely enough to be balanced.
  Eigen::Vector2d com_near(const std::vector<Contact>& contacts);

 private:
  std::vector<Contact> place(Kind kind, int count);
  std::mt19937_64 random_;
};

/// All non-static modes of theory section 4 for `count` contacts: every contact breaks; one rolls or slides and the
/// others break; two slide and the rest break. 4, 11 and 22 modes.
std::vector<ContactMode> non_static_modes(int count);

}  // namespace surefoot::testing
