// Where ground looks at the back of other ground: legal (a thin shelf over a path), but most often a ceiling whose
// vertices run the wrong way, so that its solid fills the space below. And chains that are ground the wrong way round.
#pragma once

#include <optional>
#include <span>

#include "terrain/terrain.hpp"

namespace surefoot::terrain {

struct BackFace {
  int chain;  ///< the one that turns its back
  Point at;   ///< where [m]
  int index;  ///< of what looks at it: a chain, a point
};

/// The first met by rays of length `within` [m] from the middles of segments on which a foot may stand, along their
/// normals. Every such segment is asked where there are few, an even choice of them where there are many.
std::optional<BackFace> back_face_seen(const Terrain& terrain, double within);

/// The first met by rays of that length straight up and down from the points; of many points an even choice is asked.
std::optional<BackFace> back_face_over(const Terrain& terrain, std::span<const Point> points, double within);

/// The first wall of a chain that faces down somewhere and up nowhere behind which, within so far below, lies other
/// ground: an obstacle on that ground whose vertices run the wrong way.
std::optional<BackFace> wall_back_seen(const Terrain& terrain, double within);

/// Whether all the points (an even choice of many) lie in solid ground: straight up and down from them nothing but
/// backs is seen, and one at least. One of these, `index` 0; nothing if they do not, or there are no points.
std::optional<BackFace> solid_around(const Terrain& terrain, std::span<const Point> points);

/// The first chain that is most likely ground given the wrong way round: it faces down somewhere (leaning walls aside)
/// and up nowhere, no ground lies below it, and ground within `near` [m] beside it is at most `room` [m] lower, so that
/// it is no ceiling of anything. Nothing where there are too many chains to ask.
std::optional<int> ground_upside_down(const Terrain& terrain, double near, double room);

}  // namespace surefoot::terrain
