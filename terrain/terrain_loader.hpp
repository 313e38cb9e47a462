// Reads the `terrain` block of a scene: chains, friction, per-segment overrides. Every fault is reported
// with file, line and column of the value that is wrong, including geometric ones (zero length, crossing).
#pragma once

#include "terrain/document.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::terrain {

inline const Keys terrain_keys{"friction", "chains"}, chain_keys{"vertices", "segments"},
    segment_keys{"friction", "foothold"};

/// Throws InputError. Where the document keeps its faults: the terrain as far as it can be read, or AlreadyTold.
Terrain load_terrain(const Node& node);

}  // namespace surefoot::terrain
