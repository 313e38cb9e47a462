#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>

#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/query.hpp"
#include "stability/decisions.hpp"

namespace surefoot::planner {

namespace {

/// Answers the lines of one file. What has been answered is written before waiting for more input, so that a
/// partner at the other end of a pipe gets each answer before it has to ask again.
class QuerySession {
 public:
  QuerySession(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

  void run() {
    while (read_more()) answer_complete_lines();
    if (!pending_.empty() || skipping_) answer(pending_);
    flush();
    if (number_ > 1 && questions_ == 0)
      note(fmt::format(
          "{}: none of the {} lines is a question; one is a JSON object on one line with contacts, com, rho, "
          "kappa and nu",
          name_, number_));
  }

 private:
  bool read_more() {
    flush();
    char chunk[1 << 16];
    ssize_t count = 0;
    do count = ::read(descriptor_, chunk, sizeof chunk);
    while (count < 0 && errno == EINTR);
    if (count < 0) throw terrain::InputError(fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
    pending_.append(chunk, static_cast<std::size_t>(count));
    return count > 0;
  }

  void answer_complete_lines() {
    std::size_t begin = 0;
    for (std::size_t end; (end = pending_.find('\n', std::max(begin, searched_))) != std::string::npos; begin = end + 1)
      answer(std::string_view(pending_).substr(begin, end - begin));
    pending_.erase(0, begin);
    if (pending_.size() > longest_query_line) {
      skipping_ = true;
      pending_.clear();
    }
    searched_ = pending_.size();
  }

  void answer(std::string_view line) {
    ++number_;
    searched_ = 0;
    if (skipping_ || line.size() > longest_query_line) answer_too_long(out_, number_);
    else answer_query(out_, line, number_);
    questions_ += line.find("\"contacts\"") != std::string_view::npos;
    skipping_ = false;
    out_ += '\n';
  }

  void flush() {
    write_stdout(out_);
    out_.clear();
  }

  int descriptor_;
  std::string name_;
  std::string pending_;                     // read, not yet answered
  std::size_t searched_ = 0;                // of pending_, known to hold no line feed
  bool skipping_ = false;                   // inside a line that is too long
  std::size_t number_ = 0, questions_ = 0;  // lines read, and those of them that look like questions
  std::string out_;
};

}  // namespace

namespace {

void print_stats() {
  const stability::Decisions& d = stability::decisions;
  std::string text;
  const auto row = [&](std::string_view what, std::uint64_t count, std::uint64_t exactly) {
    const double share = count == 0 ? 0 : static_cast<double>(exactly) / static_cast<double>(count);
    fmt::format_to(std::back_inserter(text), "{:<44} {:>14} {:>12} {:>10.2e}\n", what, count, exactly, share);
  };
  const auto stage = [&](std::string_view what, std::uint64_t count) {
    fmt::format_to(std::back_inserter(text), "  {:<42} {:>14}\n", what, count);
  };
  fmt::format_to(std::back_inserter(text), "{:<44} {:>14} {:>12} {:>10}\n", "decisions", "all", "exactly", "share");
  row("signs of a set of contacts", d.signs, d.signs_exactly);
  row("facets of the equilibrium cone", d.facets, d.facets_exactly);
  row("modes at a COM", d.modes_by_screen + d.modes_by_rows + d.modes_exactly, d.modes_exactly);
  stage("by a certificate shared by several modes", d.modes_by_screen);
  stage("by their rows in doubles", d.modes_by_rows);
  const std::uint64_t intervals = d.intervals_by_rows + d.intervals_by_covectors + d.witnesses + d.modes_marched;
  row("modes on an interval of a line", intervals + d.lines_exactly, d.lines_exactly);
  stage("by their rows", d.intervals_by_rows);
  stage("by covectors", d.intervals_by_covectors);
  stage("feasible at a point met on the way", d.witnesses);
  stage("left to marching", d.modes_marched);
  std::fputs(text.c_str(), stderr);
}

}  // namespace

int run_query(const std::string& file, bool stats) {
  if (file == "-") {
    if (::isatty(STDIN_FILENO)) note("reading query lines from the terminal; end with Ctrl-D");
    QuerySession(STDIN_FILENO, "standard input").run();
  } else {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw terrain::InputError(fmt::format("{}: cannot read: {}", file, std::strerror(errno)));
    QuerySession(descriptor, file).run();
    ::close(descriptor);
  }
  if (stats) print_stats();
  return exit_success;
}

}  // namespace surefoot::planner
