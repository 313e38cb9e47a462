#include "planner/bench_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "planner/commands.hpp"
#include "planner/console.hpp"

namespace surefoot::planner {

int run_bench(char** words) {
  std::error_code fault;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", fault).parent_path() / "surefoot-bench";
  execv(program.c_str(), words);
  report_error(errno == ENOENT
                   ? fmt::format("bench: {} is not there; ./surefoot bench builds it (or CMake's preset bench)",
                                 program.string())
                   : fmt::format("bench: cannot start {}: {}", program.string(), std::strerror(errno)));
  return exit_bad_input;
}

}  // namespace surefoot::planner
