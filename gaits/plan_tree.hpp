// Plans as trees of JSON, for the writers of gaits/ alone: the library for JSON does not show in the headers that
// others include.
#pragma once

#include <nlohmann/json.hpp>

#include "gaits/plan.hpp"

namespace surefoot::gaits {

/// Keys as in formats.md, in the order in which they are written. Throws std::invalid_argument if a number is not
/// finite (safety factors may be: "inf").
nlohmann::ordered_json tree_of(const Plan& plan);
nlohmann::ordered_json tree_of(const terrain::Foothold& foot);

}  // namespace surefoot::gaits
