// The oracle as a service (`surefoot query`): one JSON object per line in, one JSON object per line out, in order. A
// line that is no proper question (an empty one too) is answered by {"error": ..., "line": n}; it stops nothing.
// Nothing is guessed: contacts, com, rho, kappa, nu and each contact's p, n, mu must be given; unknown and
// duplicate keys and non-finite numbers are refused.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace surefoot::planner {

/// Longest line that is read [bytes]; three contacts take about 500.
constexpr std::size_t longest_query_line = 1u << 20;

/// Appends the answer to one line, without a line feed. `number` counts from 1. Never throws on bad input.
void answer_query(std::string& out, std::string_view line, std::size_t number);
/// The answer to a line of more than longest_query_line bytes.
void answer_too_long(std::string& out, std::size_t number);

}  // namespace surefoot::planner
