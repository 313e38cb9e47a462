// Preloaded into the program by signal_test.cpp: raises a signal before or after the n-th call of a function of the
// library, as SUREFOOT_SIGNAL="number:function:n:before|after" says.
#include <dlfcn.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

void meet(const char* function, const char* when) {
  static int calls_before = 0, calls_after = 0;
  const char* order = std::getenv("SUREFOOT_SIGNAL");
  char wanted[32] = "", moment[32] = "";
  int number = 0, nth = 0;
  if (!order || std::sscanf(order, "%d:%31[^:]:%d:%31s", &number, wanted, &nth, moment) != 4) return;
  if (std::strcmp(wanted, function) != 0 || std::strcmp(moment, when) != 0) return;
  int& calls = std::strcmp(when, "before") == 0 ? calls_before : calls_after;
  if (++calls == nth) ::kill(::getpid(), number);
}

template <class Function, class... Arguments>
int passed_on(const char* name, Arguments... arguments) {
  meet(name, "before");
  const int result = reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name))(arguments...);
  meet(name, "after");
  return result;
}

}  // namespace

extern "C" {
int mkstemp(char* pattern) { return passed_on<int(char*)>("mkstemp", pattern); }
int fchmod(int descriptor, mode_t mode) noexcept { return passed_on<int(int, mode_t)>("fchmod", descriptor, mode); }
int fsync(int descriptor) { return passed_on<int(int)>("fsync", descriptor); }
int unlink(const char* path) noexcept { return passed_on<int(const char*)>("unlink", path); }
int rename(const char* from, const char* to) noexcept {
  return passed_on<int(const char*, const char*)>("rename", from, to);
}
}
