// Place and reason of an impossibility that is proven already: where the feet that the start and those that the goal
// can reach end, and which rules suffice to keep them apart: one rule after the other is dropped where the proof holds
// without it on the same pieces. What is named in the end is therefore proven too.
#pragma once

#include <cstdint>

#include "planner/infeasibility.hpp"
#include "planner/infeasibility_graph.hpp"

namespace surefoot::planner::proof {

/// For pieces on which the goal cannot be reached. Spends up to twice the work of the limits on it; where that is not
/// enough, more rules are named than needed.
Impossibility explain(const gaits::Scene& scene, Pieces& pieces, const ProofLimits& limits, std::uint64_t work);

}  // namespace surefoot::planner::proof
