// Why there is no foothold where a scene puts a foot, in words.
#pragma once

#include <optional>
#include <string>

#include "gaits/scene.hpp"

namespace surefoot::gaits {

/// For an x [m] at which Terrain::footholds_at_x finds nothing.
std::string no_foothold_at_x(const terrain::Terrain& ground, double x);

/// Whether the first stance may stand on that leg.
bool may_carry(const Start& start, int leg);

/// Every force within its friction cone points down, beyond the rounding of a unit normal.
bool cannot_push_up(const terrain::Foothold& foot);

/// The chain of the first start foot, if none of the feet that may carry the first stance can push up (every force
/// within their friction cones points down): no stance on them balances, under any criterion. Most likely the chain was
/// given the wrong way round.
std::optional<int> chain_above_start(const Start& start);

}  // namespace surefoot::gaits
