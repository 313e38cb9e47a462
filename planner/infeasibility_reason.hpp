// Place and reason of an impossibility that is proven already: where the reach of start and goal end, and which rules
// alone suffice to keep them apart (the proof is repeated with fewer rules on the same pieces, fewest first).
#pragma once

#include <cstdint>

#include "planner/infeasibility.hpp"
#include "planner/infeasibility_graph.hpp"

namespace surefoot::planner::proof {

/// `graph` has been searched in vain. What it costs is added to `work`, at most as much again as the limit.
Impossibility explain(const gaits::Scene& scene, Graph& graph, const ProofLimits& limits, std::uint64_t& work);

}  // namespace surefoot::planner::proof
