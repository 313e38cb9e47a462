// docs/error_vs_time.md, made from what was measured.
#pragma once

#include <string>
#include <vector>

#include "bench/error_time/item.hpp"

namespace surefoot::bench {

struct Measured {
  const Item* item;
  Rows rows;
  double seconds;  ///< CPU time that the item took
};

std::string page(const std::vector<Measured>& all, bool quick);

}  // namespace surefoot::bench
