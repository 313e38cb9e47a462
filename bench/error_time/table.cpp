#include "bench/error_time/table.hpp"

#include <fmt/format.h>

#include "bench/error_time/machine.hpp"

namespace surefoot::bench {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

}  // namespace

std::string csv(const Item& item, const Rows& rows, bool quick) {
  std::string text = fmt::format("# {}: {}\n# error: {}\n# reference: {}\n# time: {} [s], medians of CPU time\n",
                                 item.name, item.what, item.error, item.reference, item.time);
  for (const std::string& line : machine_lines()) text += "# " + line + "\n";
  if (quick) text += "# quick: fewer cases and repetitions\n";
  text += "item,case,method,parameter,error,error_low,error_high,time_s,repetitions,note\n";
  for (const Row& row : rows.all())
    text += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{}\n", item.name, quoted(row.scenario),
                        quoted(row.method), quoted(row.parameter), row.error, row.low, row.high, row.time.seconds,
                        row.time.repetitions, quoted(row.note));
  return text;
}

}  // namespace surefoot::bench
