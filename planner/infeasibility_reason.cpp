#include "planner/infeasibility_reason.hpp"

namespace surefoot::planner::proof {

Impossibility explain(const gaits::Scene&, Graph& graph, const ProofLimits&, std::uint64_t& work) {
  Impossibility result;
  result.work = work;
  result.reason = "reached " + std::to_string(graph.reached().size());
  return result;
}

}  // namespace surefoot::planner::proof
