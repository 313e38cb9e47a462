// Work-precision plots as SVG: error over time, both logarithmic, one panel per case, one curve per method, accuracy
// levels in the order of the rows. An error of zero has no place on a logarithmic axis: it lies on a marked line below
// it, no answer (an infinite error) on one above.
#pragma once

#include <string>

#include "bench/error_time/item.hpp"

namespace surefoot::bench {

std::string work_precision_plot(const Item& item, const Rows& rows);

}  // namespace surefoot::bench
