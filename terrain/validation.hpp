// The faults that chains can have, found in the order of the file; crossings exactly and through the spatial index.
#pragma once

#include <vector>

#include "terrain/spatial_index.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::terrain {

/// Throws TerrainFault for everything that can be told without looking at two segments at once.
void check_chains(const std::vector<Chain>& chains);

/// Throws TerrainFault naming the first segment, in order, that meets an earlier one otherwise than in the vertex
/// they share as neighbours; of several earlier ones the first.
void check_crossings(const std::vector<Segment>& segments, const std::vector<Chain>& chains,
                     const SpatialIndex& index);

}  // namespace surefoot::terrain
