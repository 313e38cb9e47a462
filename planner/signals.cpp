#include "planner/signals.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string_view>

namespace surefoot::planner {

namespace {

constexpr std::array ending{SIGINT, SIGTERM, SIGHUP};

sigset_t ending_set() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : ending) sigaddset(&set, signal);
  return set;
}

/// Storage that never goes away, so that a handler may read it at any time. A plan has three outputs at most.
struct Slot {
  std::atomic<bool> used = false;
  char path[PATH_MAX] = {};
};
std::array<Slot, 8> slots;
static_assert(std::atomic<bool>::is_always_lock_free);

std::string_view last_line(int signal) {
  switch (signal) {
    case SIGINT: return "surefoot: error: ended by SIGINT\n";
    case SIGTERM: return "surefoot: error: ended by SIGTERM\n";
    case SIGHUP: return "surefoot: error: ended by SIGHUP\n";
    default: return "surefoot: error: ended by a signal\n";
  }
}

void say(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody to tell
}

}  // namespace

// Async-signal-safe functions only.
extern "C" void end_by_signal(int signal) {
  static std::atomic<bool> begun = false;
  if (begun.exchange(true)) return;
  for (const Slot& slot : slots)
    if (slot.used) ::unlink(slot.path);
  if (::isatty(STDERR_FILENO)) say("\r\x1b[K");  // wipes a line of progress
  say(last_line(signal));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void end_cleanly_on_signals() {
  for (const int signal : ending) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action.sa_handler = end_by_signal;
    action.sa_mask = ending_set();
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

SignalsHeld::SignalsHeld() {
  const sigset_t set = ending_set();
  pthread_sigmask(SIG_BLOCK, &set, &before_);
}

SignalsHeld::~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

void remove_on_signal(const std::string& path) {
  for (Slot& slot : slots) {
    if (slot.used || path.size() >= sizeof slot.path) continue;
    std::memcpy(slot.path, path.c_str(), path.size() + 1);
    slot.used = true;
    return;
  }
}

void keep_on_signal(const std::string& path) {
  for (Slot& slot : slots)
    if (slot.used && path == slot.path) slot.used = false;
}

}  // namespace surefoot::planner
