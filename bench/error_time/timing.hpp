// CPU time of this thread, which other programs on the machine disturb least, as medians over repetitions.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace surefoot::bench {

struct Timing {
  double seconds = 0;
  int repetitions = 0;
  Timing each(std::size_t count) const { return {seconds / static_cast<double>(count), repetitions}; }
};

inline double cpu_time(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The middle value; of an even number the upper of the two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Repetitions {
  double budget = 0.1;  ///< [s] after which there are no more, but at least `least`
  int least = 3, most = 101;
};

/// Median time of one call of `work`, after one call that warms up. A call should take some ten microseconds at least.
template <class Work>
Timing median_time(Work&& work, const Repetitions& repetitions = {}) {
  std::vector<double> times;
  const double begin = cpu_time();
  work();
  const bool slow = cpu_time() - begin > repetitions.budget;  // warm enough
  while (static_cast<int>(times.size()) < (slow ? 1 : repetitions.least) ||
         (cpu_time() - begin < repetitions.budget && static_cast<int>(times.size()) < repetitions.most)) {
    const double start = cpu_time();
    work();
    times.push_back(cpu_time() - start);
  }
  return {median(times), static_cast<int>(times.size())};
}

/// Keeps a result from being optimised away.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace surefoot::bench
