#include "bench/error_time/page.hpp"

#include <fmt/format.h>

#include "bench/error_time/machine.hpp"

namespace surefoot::bench {

std::string page(const std::vector<Measured>& all, bool quick) {
  std::string text =
      "# Error against run time\n\n"
      "Made by `./surefoot bench --docs docs` (bench/README.md); do not edit. Up is the error, right the time, both "
      "logarithmic: the lower\n"
      "left is better. `none`: no error was found; `failed`: no answer. Times are medians of CPU time; ratios within a "
      "plot mean more\n"
      "than times. Every point stands with its numbers in the table beside the plot.\n\n";
  for (const std::string& line : machine_lines()) text += "- " + line + "\n";
  if (quick) text += "\nA quick run: fewer cases and repetitions.\n";
  double seconds = 0;
  for (const Measured& one : all) {
    const Item& item = *one.item;
    const std::string table = fmt::format("[Table](figures/error_time/{}.csv)", item.name);
    text += fmt::format("\n## {}\n\n", item.what);
    if (item.plotted)
      text += fmt::format("Reference: {}. {}.\n\n![{}](figures/error_time/{}.svg)\n\n", item.reference, table,
                          item.what, item.name);
    else text += table + ".\n\n";
    text += item.findings(one.rows);
    seconds += one.seconds;
  }
  return text + fmt::format("\nAll of it took {:.0f} s of CPU time.\n", seconds);
}

}  // namespace surefoot::bench
