// Place and reason of an impossibility that is proven already: where the feet that the start and those that the goal can
// reach end, and which rules alone suffice to keep them apart (the proof is repeated with fewer rules on the same
// pieces, fewest first; what is named is therefore proven too).
#pragma once

#include <cstdint>

#include "planner/infeasibility.hpp"
#include "planner/infeasibility_graph.hpp"

namespace surefoot::planner::proof {

/// For pieces on which the goal cannot be reached. Spends at most as much work again as the limit; where that is not
/// enough, the reason is less precise.
Impossibility explain(const gaits::Scene& scene, Pieces& pieces, const ProofLimits& limits, std::uint64_t work);

}  // namespace surefoot::planner::proof
