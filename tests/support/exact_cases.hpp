// Inputs for the exact comparison: random postures, COMs on and within 4 units in the last place of boundaries, lines
// that touch. Boundaries are found by bisection with exact decisions, down to neighbouring doubles.
#pragma once

#include <functional>
#include <optional>

#include "tests/support/exact_line.hpp"

namespace surefoot::testing {

/// One set of contacts and the COMs to ask about.
struct PointFamily {
  SamplePosture sample;
  std::vector<Eigen::Vector2d> coms;
};
struct LineFamily {
  SamplePosture sample;
  std::vector<std::array<Eigen::Vector2d, 2>> lines;
};

enum class PointKind {
  random,       ///< postures of every kind of sample_posture.hpp in turn
  facet,        ///< COM at a facet for one corner of W
  mode,         ///< COM where a mode begins to be feasible
  denominator,  ///< COM at a change of sign of some D
  painleve,     ///< D = 0 exactly, by construction, and beside it
  both_zero,    ///< D = 0 and, at the same COM, the rate at which another contact opens
  grid,         ///< small dyadic numbers throughout: boundaries are hit exactly
  nearly,       ///< coincidences missed by one unit in the last place: normals, positions, friction
};
inline constexpr std::array adversarial_kinds{PointKind::facet,    PointKind::mode,      PointKind::denominator,
                                              PointKind::painleve, PointKind::both_zero, PointKind::grid,
                                              PointKind::nearly};

enum class LineKind {
  random,       ///< random ends
  stable_ends,  ///< both ends robust
  slender,      ///< both ends robust, small rho, large nu, long lines
  tangential,   ///< an end moved by bisection to where the verdict changes, and its neighbours
  grid,         ///< small dyadic numbers: touching exactly, running along boundaries
  painleve,     ///< D changes its sign on the line, or only touches zero
  tied,         ///< friction kappa, or W without extent along an axis: modes that W touches all along
};
inline constexpr std::array line_kinds{LineKind::random, LineKind::stable_ends, LineKind::slender, LineKind::tangential,
                                       LineKind::grid,   LineKind::painleve,    LineKind::tied};

const char* name(PointKind kind);
const char* name(LineKind kind);

/// May be without COMs or lines where no boundary was found.
PointFamily point_family(PointKind kind, Sampler& sampler);
LineFamily line_family(LineKind kind, Sampler& sampler);

}  // namespace surefoot::testing
