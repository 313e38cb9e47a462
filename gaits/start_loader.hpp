// The `start` block of a scene, and the bound of every length in a scene.
#pragma once

#include <string_view>

#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// The bound that terrain sets for coordinates holds for every length, so that no square overflows.
double bounded(const terrain::Node& node, std::string_view what, double value);

inline const terrain::Keys start_keys{"feet", "support", "com"};

/// Terrain and robot are missing where their faults have been told. Throws as terrain::Node does.
Start read_start(const terrain::Node& node, const terrain::Terrain* ground, const Robot* robot);

}  // namespace surefoot::gaits
