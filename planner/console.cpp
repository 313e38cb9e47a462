#include "planner/console.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "planner/signals.hpp"

namespace surefoot::planner {

namespace {

/// 0, or errno of the write that failed.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN) {  // a pipe that its owner made non-blocking is full
      pollfd place{descriptor, POLLOUT, 0};
      ::poll(&place, 1, -1);
      continue;
    }
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void guard_standard_streams() {
  // The opposite access mode: the stream exists, but using it stays the error that it was.
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF)
      if (::open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY) != descriptor) std::_Exit(2);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // beyond the greatest size of files writing is an error as well
}

namespace {

/// When [ns] the interruption was asked for, 0: not yet. One variable, as two signals may be handled by two threads at
/// the same time.
std::atomic<std::int64_t> interruption_asked = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);  // so that a signal handler may write it

/// Notes the first of two signals; true for the second one, unless they come together: a terminal's or a supervisor's
/// one request may arrive twice.
bool asked_again() {
  constexpr std::int64_t together = 200'000'000;  // [ns]
  timespec clock{};
  ::clock_gettime(CLOCK_MONOTONIC, &clock);
  const std::int64_t now = clock.tv_sec * std::int64_t{1'000'000'000} + clock.tv_nsec;
  std::int64_t first = 0;
  return !interruption_asked.compare_exchange_strong(first, now) && now - first >= together;
}

extern "C" void ask_interruption(int signal) {
  const int interrupted_errno = errno;
  if (asked_again()) end_by_signal(signal);  // returns: the signal comes once this handler is left
  errno = interrupted_errno;
}

}  // namespace

// Where SIGINT is ignored (a job in the background of a script), it stays ignored.
Interruption::Interruption() {
  interruption_asked = 0;
  ::sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler != SIG_IGN) std::signal(SIGINT, ask_interruption);
}

Interruption::~Interruption() { ::sigaction(SIGINT, &before_, nullptr); }

bool Interruption::asked() const { return interruption_asked != 0; }

void write_stdout(std::string_view text) {
  const int fault = write_all(STDOUT_FILENO, text);
  if (fault == EPIPE) throw ReaderGone("standard output was closed by its reader");
  if (fault != 0) throw OutputError(fmt::format("cannot write to standard output: {}", std::strerror(fault)));
}

void note(std::string_view text) {
  show_progress("");
  write_all(STDERR_FILENO, fmt::format("surefoot: {}\n", one_line(text)));
}

void report_error(std::string_view text) { note(fmt::format("error: {}", text)); }

namespace {

/// A terminal that knows escape sequences.
bool is_able_terminal(int descriptor) {
  const char* terminal = std::getenv("TERM");
  return ::isatty(descriptor) && (terminal == nullptr || std::strcmp(terminal, "dumb") != 0);
}

/// Columns that a line may take without being wrapped, which could not be wiped again.
std::size_t columns(int descriptor) {
  constexpr std::size_t usual = 80;
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : usual - 1;
}

}  // namespace

void show_progress(std::string_view text) {
  static bool shown = false;
  if ((text.empty() && !shown) || !is_able_terminal(STDERR_FILENO)) return;
  write_all(STDERR_FILENO, fmt::format("\r\x1b[K{}", one_line(text).substr(0, columns(STDERR_FILENO))));
  shown = !text.empty();
}

bool stdout_takes_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  if (no_colour != nullptr && *no_colour != '\0') return false;
  return is_able_terminal(STDOUT_FILENO);
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') line += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else line += c;
  }
  return line;
}

}  // namespace surefoot::planner
