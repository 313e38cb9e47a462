// A 2-3-2 gait [OR-P, section VII]: two-contact stances joined by straight three-contact transfers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gaits/robot.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

using Feet = std::array<std::optional<terrain::Foothold>, leg_count>;  ///< planted feet by leg

/// Two planted feet, COM at rest.
struct Stance {
  Feet feet;                                      ///< exactly two are planted
  Eigen::Vector2d com = Eigen::Vector2d::Zero();  ///< [m]
  double safety_factor = 0;                       ///< of the stance, in [0, inf]
  std::string limit;                              ///< what limits it ("equilibrium", "UF", "none")
};

/// From one stance to the next: `leg` is placed on `foothold`, the COM moves straight to the next
/// stance's COM on three contacts, then `lift` is lifted.
struct Transfer {
  int leg = 0;  ///< 0..2
  terrain::Foothold foothold;
  int lift = 0;              ///< 0..2
  double safety_factor = 0;  ///< least on the line
  std::string limit;
};

struct LeftOut {
  std::string what, why;
};

enum class Status { solved, no_plan_found, infeasible };
const char* to_string(Status status);

/// How far a search went that knows.
struct Resolution {
  double foothold_spacing = 0;     ///< of the finest lattice exhausted or, where none was, begun [m]
  int com_columns = 0;             ///< of COMs across each pair of footholds there
  bool fewest_on_lattice = false;  ///< that lattice has no plan of fewer steps
  int least_steps = 0;             ///< no plan whatever has fewer
};

struct Plan {
  std::string scene;
  Status status = Status::no_plan_found;
  std::string reason;  ///< why there is no plan; empty if solved
  std::string planner;
  std::uint32_t seed = 1;
  std::vector<Stance> stances;  ///< one more than transfers when solved
  std::vector<Transfer> transfers;
  double safety_factor = 0;  ///< least of all
  std::optional<double> safety_factor_before_refinement;
  double time_s = 0;
  std::optional<Resolution> resolution;
  std::vector<LeftOut> left_out;
  int steps() const { return static_cast<int>(transfers.size()); }
};

/// The three planted feet during a transfer.
Feet feet_during(const Stance& from, const Transfer& transfer);

}  // namespace surefoot::gaits
