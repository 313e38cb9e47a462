#include "bench/error_time/machine.hpp"

#include <fmt/format.h>
#include <glpk.h>
#include <gmp.h>
#include <nlopt.h>
#include <ompl/config.h>
#include <sys/utsname.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <fstream>
#include <thread>

namespace surefoot::bench {
namespace {

/// A value of /proc/cpuinfo or /proc/meminfo, "" if there is none.
std::string proc_value(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key))
      if (const auto at = line.find_first_not_of(" \t", line.find(':') + 1); at != std::string::npos)
        return line.substr(at);
  return "unknown";
}

}  // namespace

std::vector<std::string> machine_lines() {
  utsname system{};
  uname(&system);
  int major = 0, minor = 0, bugfix = 0;
  nlopt_version(&major, &minor, &bugfix);
  return {fmt::format("machine: {} ({}), {} processors, {} {}", proc_value("/proc/cpuinfo", "model name"),
                      system.machine, std::thread::hardware_concurrency(), system.sysname, system.release),
          fmt::format("compiler: {} {}, {}", SUREFOOT_COMPILER, __VERSION__, SUREFOOT_BUILD),
          fmt::format(
              "libraries: surefoot {}, GLPK {}, NLopt {}.{}.{}, OMPL {}.{}.{}, Eigen {}.{}.{}, Boost {}.{}.{}, GMP {}",
              SUREFOOT_VERSION, glp_version(), major, minor, bugfix, OMPL_MAJOR_VERSION, OMPL_MINOR_VERSION,
              OMPL_PATCH_VERSION, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, BOOST_VERSION / 100000,
              BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, gmp_version)};
}

}  // namespace surefoot::bench
