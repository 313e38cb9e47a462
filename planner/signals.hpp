// Ending by a signal without leaving anything behind: temporary files are removed, one line is said, and the program
// ends by that signal, so that whoever started it sees why.
#pragma once

#include <csignal>
#include <string>

namespace surefoot::planner {

/// From now on for SIGINT, SIGTERM and SIGHUP, where these are not ignored.
void end_cleanly_on_signals();
/// What they do; may be called by a handler.
extern "C" void end_by_signal(int signal);

/// While it lives these signals wait (in this thread: meant for moments when there is no other).
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

/// A file that a signal removes. To be called while signals are held, together with what makes or unmakes the file.
void remove_on_signal(const std::string& path);
void keep_on_signal(const std::string& path);

}  // namespace surefoot::planner
