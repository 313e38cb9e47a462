// Outer bounds for the proof of impossibility: what feet anywhere on pieces of terrain allow the COM to be.
// Every set returned contains the set that the rules (and the verifier with its slack) allow; polygons are drawn out by
// `slack`, so rounding cannot lose a COM.
//
// Balance of two pieces. The wrench that feet on pieces A and B must supply for f = (p, 1), q about the origin is (f,
// c_x - p c_y + q) (theory section 3). For a fixed p the moments that the two cones can supply with force f form an
// interval; over all positions on the pieces it lies between the extremes of a linear program in the four cone edges
// whose moments are intervals: an end is attained on a pair of edges, or is infinite where the feet can squeeze the
// body between them. So R_SS(W) lies in the strips lo(p) + nu <= c_x - p c_y <= hi(p) - nu, p = -kappa, kappa.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/infeasibility.hpp"
#include "planner/infeasibility_convex.hpp"
#include "planner/infeasibility_region.hpp"

namespace surefoot::planner::proof {

/// Rules that count. Those left out are as if they held: how the reason of an impossibility is found.
struct Rules {
  bool balance = true;      ///< two feet balance the weight ...
  bool disturbance = true;  ///< ... and every wrench of W
  bool modes = true;        ///< no contact mode but rest
  bool sight = true;        ///< a leg that moves is visible from the COM
  bool clearance = true;
  bool least_reach = true;
};

/// Footholds of one segment between two arc lengths from its beginning [m], ends included.
struct Piece {
  const terrain::Segment* segment = nullptr;
  double begin = 0, end = 0;  ///< [m]
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
  double length() const { return end - begin; }
};
Piece piece_of(const terrain::Segment& segment, double begin, double end);
Piece middle_of(const Piece& piece);

/// Moments [m] about a point that feet on two pieces can supply with a given force.
struct Moments {
  bool possible = false;  ///< the force itself can be supplied
  double lo = 0, hi = 0;  ///< may be infinite
};
/// `rounding` [m]: how far a foot may stand from where its arc length says.
Moments moments_of(const Piece& first, const Piece& second, const Eigen::Vector2d& force, const Eigen::Vector2d& about,
                   double rounding);

/// A piece with the terrain that may come between it and a COM within reach.
struct Foot {
  Piece piece;
  std::span<const terrain::Segment* const> around;
};

/// What is asked of a COM: within reach of all feet, seeing those in `seen`.
struct Demand {
  std::span<const Foot* const> feet;
  std::span<const Foot* const> seen;
};

class Bounds {
 public:
  /// With a window: the goal is to get beyond it, by way of COMs within it.
  Bounds(const gaits::Scene& scene, const Rules& rules, const std::optional<ProofWindow>& window = {});

  double slack() const { return slack_; }  ///< [m]
  double reach() const { return scene_.robot.reach_max; }
  const gaits::Scene& scene() const { return scene_; }
  const gaits::Goal& goal() const { return goal_; }
  /// Where the last COM before the window lies (no two COMs of one step are further apart than two reaches).
  std::optional<std::pair<double, double>> entry() const { return entry_; }
  /// A stance with such COMs has no part in crossing the window.
  bool outside(const Convex& coms) const;

  /// COMs within reach of both pieces. Empty: none.
  Convex reachable(const Piece& first, const Piece& second) const;
  /// Keeps what feet on the pieces may balance W at.
  void clip_to_balance(Convex& coms, const Piece& first, const Piece& second) const;
  void clip_to_point(Convex& coms, const Eigen::Vector2d& point) const;
  void clip_to_reach(Convex& coms, const Piece& piece) const;
  void clip_to_sight(Convex& coms, const Piece& piece) const;
  void clip_to_goal(Convex& coms) const;
  void clip_to_entry(Convex& coms) const;

  /// The parts of the region in which some COM of the polygon may meet the demand with the first two feet as stance
  /// (bits); for a part that is not named there is none, whatever footholds on the pieces are taken. Decides by halving
  /// the polygon down to `finest` [m]; adds the number of polygons to `work`.
  unsigned may_hold(const Convex& coms, const Demand& demand, const Region& region, double finest,
                    std::uint64_t& work) const;
  /// Those of the parts in which a COM was found that meets the demand (feet are points) and is stable.
  unsigned does_hold(const Convex& coms, const Demand& demand, const Region& region, unsigned parts,
                     std::uint64_t& work) const;
  Field field() const { return {scene_, rules_.clearance, slack_}; }

 private:
  bool excluded(const Convex& coms, const Eigen::Vector2d& centre, double radius, const Demand& demand) const;
  bool met_at(const Eigen::Vector2d& com, const Demand& demand) const;
  bool stable_at(const Eigen::Vector2d& com, const Demand& demand) const;
  bool hidden(std::span<const Eigen::Vector2d> coms, const Foot& foot) const;

  const gaits::Scene& scene_;
  Rules rules_;
  stability::DisturbanceBox box_;
  double slack_;
  gaits::Goal goal_;
  std::optional<ProofWindow> window_;
  std::optional<std::pair<double, double>> entry_;
};

}  // namespace surefoot::planner::proof
