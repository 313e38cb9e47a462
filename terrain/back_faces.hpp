// Where ground looks at the back of other ground: legal (a thin shelf over a path), but most often a ceiling whose
// vertices run the wrong way, so that its solid fills the space below. And chains that are ground or obstacles the
// wrong way round, and what lies in solid ground.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "terrain/terrain.hpp"

namespace surefoot::terrain {

struct BackFace {
  int chain;  ///< the one that turns its back
  Point at;   ///< where [m]
  int index;  ///< of what looks at it: a chain, a point
};

/// The first met by rays of length `within` [m] from the middles of segments on which a foot may stand, along their
/// normals, or ground or ceiling whose own middle is seen so, against its normal. Every segment is asked where there
/// are few, an even choice of them where there are many. Obstacles that are open below, their ends at most `room` [m]
/// above other ground, may show their inside, if none of the `feet` is there (those that stand on them are not).
std::optional<BackFace> back_face_seen(const Terrain& terrain, double within, std::span<const Foothold> feet,
                                       double room);

/// The first met by rays of that length straight up and down from the points; of many points an even choice is asked.
std::optional<BackFace> back_face_over(const Terrain& terrain, std::span<const Point> points, double within);

/// The chains whose free side is their inside, though neither the boxes of the start nor, where it is open, that of
/// the goal meets the extent (or lies below it, where it is open): most likely obstacles given the wrong way round. One
/// is closed (nobody comes in who has not begun there), or runs from right to left and both its ends are at most `room`
/// [m] above other ground. Open ones only as far as there are few enough to ask.
std::vector<int> obstacles_inside_out(const Terrain& terrain, std::span<const Eigen::AlignedBox2d> start,
                                      const Eigen::AlignedBox2d& goal, double room);

/// Whether a rectangle of finite extent lies in solid ground: no segment meets it, and straight up, down, left and
/// right of it nothing but backs is seen, one above or below at least. The chain of that one.
std::optional<int> solid_around(const Terrain& terrain, const Eigen::AlignedBox2d& area);

/// The first chain that is most likely ground given the wrong way round: it faces down somewhere (leaning walls aside)
/// and up nowhere, no ground lies below it, and ground within `near` [m] beside it is at most `room` [m] lower, so that
/// it is no ceiling of anything. Nothing where there are too many chains to ask.
std::optional<int> ground_upside_down(const Terrain& terrain, double near, double room);

}  // namespace surefoot::terrain
