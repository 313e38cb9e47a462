// What the certainty of verdicts costs: random postures by surefoot and by the same code that takes doubles at their
// word, in turns; least times. Then the share of decisions that needed exact arithmetic. See bench/README.md.
#include "bench/plain_posture.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "stability/decisions.hpp"

namespace {

using surefoot::bench::PlainPosture, surefoot::bench::random_plain_postures;

template <class Count>
double nanoseconds_each(const std::vector<PlainPosture>& postures, Count&& count, std::size_t& robust) {
  const auto start = std::chrono::steady_clock::now();
  robust = count(postures.data(), postures.size());
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  return time.count() / static_cast<double>(postures.size());
}

void compare(int contacts) {
  constexpr std::size_t count = 20000;
  constexpr int rounds = 40;
  const std::vector<PlainPosture> postures = random_plain_postures(contacts, count);
  double guarded = HUGE_VAL, plain = HUGE_VAL;
  std::size_t robust = 0, robust_plain = 0;
  for (int k = 0; k < rounds; ++k) {
    guarded = std::min(guarded, nanoseconds_each(postures, surefoot::bench::count_robust, robust));
    plain = std::min(plain, nanoseconds_each(postures, surefoot::bench::count_robust_unguarded, robust_plain));
  }
  std::printf(
      "%d contacts, %zu random postures (%zu robust, %zu by plain doubles): %.1f ns, plain %.1f ns, ratio %.3f\n",
      contacts, count, robust, robust_plain, guarded, plain, guarded / plain);
}

}  // namespace

int main() {
  for (const int contacts : {2, 3}) compare(contacts);
  const surefoot::stability::Decisions& d = surefoot::stability::decisions;
  const std::uint64_t exactly = d.signs_exactly + d.facets_exactly + d.modes_exactly;
  const std::uint64_t all = d.signs + d.facets + d.modes_by_screen + d.modes_by_rows + d.modes_exactly;
  std::printf("decisions that needed exact arithmetic: %llu of %llu, share %.2e\n",
              static_cast<unsigned long long>(exactly), static_cast<unsigned long long>(all),
              static_cast<double>(exactly) / static_cast<double>(all));
}
