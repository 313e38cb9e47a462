// Proof that no 2-3-2 plan exists: necessary conditions of the rules (gaits/rules.hpp), decided on outer bounds.
//
// Method. The terrain is cut into pieces; a node is a pair of pieces that two feet may stand on at once, with an outer
// polygon of the COMs that such a stance allows: reach of both, and R_SS(W) of every wrench cone that feet anywhere on
// the pieces can have (infeasibility_bounds.hpp). A transfer places a foot on a third piece from a COM of one pair and
// lifts one at a COM of the next; each of the two COMs must be within reach of all three pieces, keep the clearance and
// see the foot that moves. Joining pairs wherever both COMs may exist gives a graph that contains every plan: if the
// goal is not reached in it, there is no plan. Where it is reached, the pieces on the doubtful transfers of the
// shortest ways (those that their middles do not confirm) are halved, until the goal is cut off, or a way remains that
// the middles confirm all along, or the limits are reached (counterexample-guided refinement). Intervals of footholds
// and polygons of COMs were chosen over boxes in all coordinates because every bound used is then exact but for the
// width of the pieces.
//
// Guarantee: what is returned is proven, for every plan that gaits::verify would accept: all bounds are drawn out by
// `slack` (verifier slack and rounding together). Nothing returned means nothing: the relaxation forgets which leg is
// which, swings, the COM's way between the transfers of one pair, and straight lines (only their ends count).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "gaits/scene.hpp"

namespace surefoot::planner {

/// Where to look for a barrier: a COM that gets from one side to the other passes all that lies between.
struct ProofWindow {
  double from = 0, to = 0;  ///< x [m]; every first COM lies before `from`, the goal after `to` (to < from: leftwards)
};

struct ProofLimits {
  /// Bounds evaluated, 0.5 to 1 us each; up to twice as many again for the reason of what is proven.
  std::uint64_t work = 600000;
  double finest = 1.0 / 512;  ///< least length of a piece, relative to reach_max
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  std::function<bool()> stop = [] { return false; };  ///< asked now and then; true gives up
  /// Long terrain: look no further than this. What is proven is that the window cannot be crossed; its work does not
  /// depend on what lies outside. Nothing is proven where start or goal do not lie on either side of it.
  std::optional<ProofWindow> window;
};

/// What the plan fails at.
enum class Obstacle {
  start,    ///< no stance on the start feet is possible
  goal,     ///< no stance with the COM in the goal is possible
  barrier,  ///< stances are possible at both, but no chain of transfers joins them
};

struct Impossibility {
  Obstacle obstacle = Obstacle::barrier;
  /// Where [m]: between the feet that the start and those that the goal can reach; the goal's own, where the start can
  /// reach all of these.
  std::optional<std::pair<double, double>> x, y;
  std::string reason;      ///< a sentence: place, then the rules that suffice to forbid it, with their numbers
  std::uint64_t work = 0;  ///< bounds evaluated
};

/// Why no plan exists, if that can be proven within the limits; nothing otherwise. Const and re-entrant.
/// Without deadline and stop the answer depends on the scene and the limits alone.
std::optional<Impossibility> prove_infeasible(const gaits::Scene& scene, const ProofLimits& limits = {});

}  // namespace surefoot::planner
