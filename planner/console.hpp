// The three standard streams as every command uses them: results on stdout, everything else on stderr, errors on one
// line. Writing to stdout either succeeds completely or throws; nothing is buffered here.
#pragma once

#include <csignal>
#include <stdexcept>
#include <string>
#include <string_view>

namespace surefoot::planner {

/// Output that could not be written: one line, no prefix.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// stdout's reader has gone away (`surefoot ... | head`): no more output is wanted, and nobody need be told.
class ReaderGone : public OutputError {
 public:
  using OutputError::OutputError;
};

/// Makes sure that descriptors 0, 1 and 2 are open, so that no output file can take their place, and that writing to
/// a closed pipe, or beyond a limit of file size, is an error rather than a signal. A stream that was closed refuses to
/// be written to.
void guard_standard_streams();

/// While one exists, the first SIGINT asks for an early end instead of ending the program; the second one ends it.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  bool asked() const;

 private:
  struct sigaction before_;
};

/// Throws OutputError.
void write_stdout(std::string_view text);
/// "surefoot: text" on stderr; failure to write there is ignored.
void note(std::string_view text);
/// "surefoot: error: text" on stderr, made one line.
void report_error(std::string_view text);

/// A transient line on stderr where that is a terminal (not TERM=dumb), cut to its width, wiped by the next call or
/// note; "" only wipes.
void show_progress(std::string_view text);

bool stdout_takes_colour();  ///< a terminal, and neither NO_COLOR nor TERM=dumb
/// Line feeds and other control characters made visible.
std::string one_line(std::string_view text);

}  // namespace surefoot::planner
