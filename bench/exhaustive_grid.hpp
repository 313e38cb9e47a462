// Exhaustive search on a grid: every foothold of a spacing, every COM of a square lattice, every step that breaks no
// rule of gaits/rules.hpp, in the order of the cost. It knows nothing of planner/: what it finds is the optimum of its
// grid, for comparison.
#pragma once

#include <cstdint>
#include <string>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::bench {

struct Grid {
  double spacing = 0.1;  ///< of footholds along a segment [m]
  double com = 0.1;      ///< side of the lattice of COMs [m]
};

struct GridOptimum {
  bool found = false;
  gaits::Plan plan;               ///< rated, if found
  std::uint64_t states = 0;       ///< expanded
  std::uint64_t steps_asked = 0;  ///< rules asked of
};

/// objective: steps, distance or safety (greatest least factor, then fewest steps). Ends without result beyond
/// `most_states`.
GridOptimum exhaustive_optimum(const gaits::Scene& scene, const Grid& grid, const std::string& objective,
                               std::uint64_t most_states);

}  // namespace surefoot::bench
