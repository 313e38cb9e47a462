// What `surefoot bench` and the program behind it, surefoot-bench, both read.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace surefoot::planner {

struct BenchArguments {
  std::vector<std::string> names;
  std::string out = "bench_results", docs;
  bool quick = false, list = false;
};

constexpr const char* bench_description =
    "Error against run time of every computation that has an error: tables (CSV) and plots (SVG)";

inline void add_bench_options(CLI::App& app, BenchArguments& a) {
  app.add_option("ITEM", a.names, "what to measure (default: everything)");
  app.add_option("--out", a.out, "directory for tables and plots (default: bench_results)")->type_name("DIR");
  app.add_flag("--quick", a.quick, "fewer cases and repetitions: half a minute for everything");
  app.add_flag("--list", a.list, "tell the items, and nothing else");
  app.add_option("--docs", a.docs, "write error_vs_time.md there, with tables and plots in figures/error_time below it")
      ->type_name("DIR");
  app.footer(
      "Exit status: 0 done, 2 bad input or usage.\n"
      "Example: surefoot bench verdict hybrid --quick --out results");
}

}  // namespace surefoot::planner
