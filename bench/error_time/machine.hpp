// What a measurement was made on and with.
#pragma once

#include <string>
#include <vector>

namespace surefoot::bench {

/// "machine: ...", "compiler: ...", "libraries: ...", one line each.
std::vector<std::string> machine_lines();

}  // namespace surefoot::bench
