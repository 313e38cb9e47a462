#include "planner/infeasibility.hpp"

#include <algorithm>
#include <cmath>

#include "planner/infeasibility_graph.hpp"
#include "planner/infeasibility_reason.hpp"

namespace surefoot::planner {

using proof::Bounds;
using proof::Graph;
using proof::Pieces;

namespace {

/// Pieces at first: short enough that plain walking is told from what cannot be, long enough to be few.
constexpr double coarsest = 0.25;  // relative to reach_max

}  // namespace

std::optional<Impossibility> prove_infeasible(const gaits::Scene& scene, const ProofLimits& limits) {
  std::uint64_t work = 0;
  const Bounds bounds(scene, {});
  if (!(bounds.slack() < limits.finest * bounds.reach())) return std::nullopt;  // coordinates too far out to tell
  Pieces pieces(scene, coarsest * bounds.reach(), bounds.reach() + bounds.slack());
  Graph graph(bounds, pieces, true, limits, work);
  while (!graph.exhausted()) {
    const std::optional<int> least = graph.search();
    if (graph.exhausted()) break;
    if (!least) return proof::explain(scene, pieces, limits, work);
    if (*least == 0 || !graph.refine(*least)) break;
  }
  return std::nullopt;
}

}  // namespace surefoot::planner
