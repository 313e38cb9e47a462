// The faults that chains can have, found in the order of the file; crossings exactly and through the spatial index.
#pragma once

#include <vector>

#include "terrain/spatial_index.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::terrain {

/// Reports everything that can be told without looking at two segments at once; true if there is nothing.
bool check_chains(const std::vector<Chain>& chains, const TerrainFaultReport& report);

/// Reports, in order, every segment that meets an earlier one otherwise than in the vertex they share as neighbours; of
/// several earlier ones the first is named.
void check_crossings(const std::vector<Segment>& segments, const std::vector<Chain>& chains, const SpatialIndex& index,
                     const TerrainFaultReport& report);

}  // namespace surefoot::terrain
