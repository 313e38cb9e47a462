#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/query.hpp"

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
    if (skipping_ || line.size() > longest_query_line)
      answer_too_long(out_, number_);
    else
      answer_query(out_, line, number_);
    skipping_ = false;
    out_ += '\n';
  }

  void flush() {
    write_stdout(out_);
    out_.clear();
  }

  int descriptor_;
  std::string name_;
  std::string pending_;       // read, not yet answered
  std::size_t searched_ = 0;  // of pending_, known to hold no line feed
  bool skipping_ = false;     // inside a line that is too long
  std::size_t number_ = 0;
  std::string out_;
};

}  // namespace

int run_query(const std::string& file) {
  if (file == "-") {
    if (::isatty(STDIN_FILENO)) note("reading query lines from the terminal; end with Ctrl-D");
    QuerySession(STDIN_FILENO, "standard input").run();
    return exit_success;
  }
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw terrain::InputError(fmt::format("{}: cannot read: {}", file, std::strerror(errno)));
  QuerySession(descriptor, file).run();
  ::close(descriptor);
  return exit_success;
}

}  // namespace surefoot::planner
