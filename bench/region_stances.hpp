// Stances for bench_region --stances: those of docs/regions.md and of the canned scenes.
#pragma once

#include <string>
#include <vector>

#include "bench/region_methods.hpp"

namespace surefoot::bench {

/// Stances under one name; `name` of each is empty but for single ones.
struct StanceGroup {
  std::string name;
  std::vector<Stance> stances;
};

/// Each posture of docs/figures/postures by itself.
std::vector<StanceGroup> drawn_postures();
/// Of each scene in maps/: the stances of its stored plan, on two contacts and (a group of its own) those on three
/// between them; of a scene without a stored plan the start feet.
std::vector<StanceGroup> canned_stances();

}  // namespace surefoot::bench
