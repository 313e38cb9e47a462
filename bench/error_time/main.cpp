// surefoot bench: error against run time for every computation that has an error. See bench/README.md.
// Exit status: 0 done, 2 bad input or usage.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bench/error_time/item.hpp"
#include "bench/error_time/page.hpp"
#include "bench/error_time/plot.hpp"
#include "bench/error_time/table.hpp"
#include "planner/bench_options.hpp"
#include "terrain/document.hpp"

using namespace surefoot::bench;
namespace fs = std::filesystem;

namespace {

int fault(const std::string& text) {
  std::cerr << "surefoot: error: " << text << '\n';
  return 2;
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write {}", path.string()));
}

/// Those named, in the order of the registry; all if none is.
std::vector<const Item*> chosen(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const Item* item : items()) known.push_back(item->name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string meant = surefoot::terrain::near_miss(name, known);
    throw std::invalid_argument(fmt::format("unknown item '{}'{}; there are {}", name,
                                            meant.empty() ? "" : fmt::format(", did you mean {}?", meant),
                                            fmt::join(known, ", ")));
  }
  std::vector<const Item*> found;
  for (const Item* item : items())
    if (names.empty() || std::find(names.begin(), names.end(), item->name) != names.end()) found.push_back(item);
  return found;
}

/// Measures an item and writes its table and plot.
Measured measured(const Item& item, const fs::path& directory, bool quick) {
  std::cerr << fmt::format("{}: {} ... ", item.name, item.what) << std::flush;
  Measured result{&item, {}, 0};
  const double begin = cpu_time(CLOCK_PROCESS_CPUTIME_ID);
  item.measure(result.rows, quick);
  result.seconds = cpu_time(CLOCK_PROCESS_CPUTIME_ID) - begin;
  write(directory / fmt::format("{}.csv", item.name), csv(item, result.rows, quick));
  if (item.plotted) write(directory / fmt::format("{}.svg", item.name), work_precision_plot(item, result.rows));
  std::cerr << fmt::format("{:.1f} s\n", result.seconds);
  return result;
}

int run(int count, char** words) {
  CLI::App app(surefoot::planner::bench_description, "surefoot bench");
  surefoot::planner::BenchArguments arguments;
  add_bench_options(app, arguments);
  try {
    app.parse(count, words);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return 0;
  } catch (const CLI::ParseError& error) {
    return fault(error.what());
  }
  if (arguments.list) {
    for (const Item* item : items()) std::cout << fmt::format("{:<12} {}\n", item->name, item->what);
    return 0;
  }
  if (!arguments.docs.empty() && !arguments.names.empty())
    return fault("--docs writes the page of all items: name none");
  const auto which = chosen(arguments.names);
  const fs::path directory =
      arguments.docs.empty() ? fs::path(arguments.out) : fs::path(arguments.docs) / "figures" / "error_time";
  fs::create_directories(directory);
  std::vector<Measured> all;
  for (const Item* item : which) {
    all.push_back(measured(*item, directory, arguments.quick));
    std::cout << fmt::format("{}\n  reference: {}\n", item->what, item->reference) << item->findings(all.back().rows)
              << std::flush;
  }
  if (!arguments.docs.empty()) write(fs::path(arguments.docs) / "error_vs_time.md", page(all, arguments.quick));
  return 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    return run(count, words);
  } catch (const std::exception& error) {
    return fault(error.what());
  }
}
