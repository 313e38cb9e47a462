// Where ground looks at the back of other ground: legal (a thin shelf over a path), but most often a ceiling whose
// vertices run the wrong way, so that its solid fills the space below.
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

/// The first chain that faces down somewhere (leaning walls aside) and up nowhere, and has no other chain that faces up
/// below the middle of any such segment: what cannot be a ceiling of anything. Of very large terrains not all chains
/// are asked.
std::optional<int> ceiling_over_nothing(const Terrain& terrain);

}  // namespace surefoot::terrain
