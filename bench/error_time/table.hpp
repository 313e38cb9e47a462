// Rows as CSV, with what they were measured on in comment lines above.
#pragma once

#include <string>

#include "bench/error_time/item.hpp"

namespace surefoot::bench {

/// item, case, method, parameter, error, error_low, error_high, time_s, repetitions, note
std::string csv(const Item& item, const Rows& rows, bool quick);

}  // namespace surefoot::bench
