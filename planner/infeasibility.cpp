#include "planner/infeasibility.hpp"

#include <algorithm>
#include <limits>

#include "planner/infeasibility_graph.hpp"
#include "planner/infeasibility_reason.hpp"

namespace surefoot::planner {

using proof::Bounds;
using proof::Graph;
using proof::Pieces;

namespace {

/// Pieces at first: short enough that plain walking is told from what cannot be, long enough to be few.
constexpr double coarsest = 0.25;  // relative to reach_max

/// The verifier lets a start foot be a slack away: beside a vertex it may stand on the next segment.
bool starts_at_vertex(const gaits::Scene& scene, double slack) {
  return std::any_of(scene.start.feet.begin(), scene.start.feet.end(), [&](const auto& foot) {
    if (!foot) return false;
    const terrain::Segment& segment = scene.terrain.segment(foot->chain, foot->segment);
    const double at = foot->s - segment.s_begin;
    return at <= 2 * slack || at >= segment.length - 2 * slack;
  });
}

/// The window lies between all first COMs and the goal.
bool parts_start_from_goal(const gaits::Scene& scene, const ProofWindow& window, double slack) {
  const auto& goal = scene.goal.com_x;
  if (!goal || !(window.from != window.to)) return false;
  const double way = window.from < window.to ? 1 : -1;
  const double goal_begins = way > 0 ? goal->first : -goal->second;
  double start_ends = -std::numeric_limits<double>::infinity();
  for (const auto& foot : scene.start.feet)
    if (foot) start_ends = std::max(start_ends, way * foot->position.x() + scene.robot.reach_max + slack);
  if (scene.start.com) start_ends = way * scene.start.com->x() + slack;
  return start_ends <= way * window.from && way * window.to <= goal_begins;
}

}  // namespace

std::optional<Impossibility> prove_infeasible(const gaits::Scene& scene, const ProofLimits& limits) {
  std::uint64_t work = 0;
  const Bounds bounds(scene, {}, limits.window);
  if (limits.window && !parts_start_from_goal(scene, *limits.window, bounds.slack())) return std::nullopt;
  // Coordinates too far out to tell, or a start that is not quite known.
  if (!(bounds.slack() < limits.finest * bounds.reach())) return std::nullopt;
  if (starts_at_vertex(scene, bounds.slack())) return std::nullopt;
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
