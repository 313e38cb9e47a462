// Every item of `surefoot bench`, one per file of this folder.
#pragma once

#include "bench/error_time/item.hpp"

namespace surefoot::bench {

extern const Item targets_item;
extern const Item verdict_item;
extern const Item factor_item;
extern const Item line_item;
extern const Item planners_item;
extern const Item pruning_item;
extern const Item refinement_item;
extern const Item region_item;
extern const Item hybrid_item;

}  // namespace surefoot::bench
