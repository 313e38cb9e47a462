// The verdicts of RobustOracle against exact decisions in integers: points (random, and on or within 4 units in the
// last place of a boundary) and straight lines. See README.md. Exit status 0: no difference, 1: some, 2: bad arguments.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

#include "tests/support/exact_comparison.hpp"

using namespace surefoot::testing;

namespace {

/// A run of cases of one kind with a seed of its own: answers do not depend on the number of threads.
struct Block {
  std::size_t row;
  std::uint64_t seed;
  long cases;
  std::function<ComparisonCounts(std::uint64_t, long, const Report&)> compare;
};

class Comparison {
 public:
  explicit Comparison(std::uint64_t seed) : seed_(seed) {}

  template <class Kind>
  void add(const char* group, Kind kind, long cases) {
    constexpr long block = 1000;
    names_.push_back(std::string(group) + ": " + name(kind));
    for (long done = 0; done < cases; done += block) {
      // Any mixing will do as long as seeds differ.
      const std::uint64_t seed = (seed_ * 1000003 + names_.size()) * 1000003 + blocks_.size();
      blocks_.push_back(
          {names_.size() - 1, seed, std::min(block, cases - done),
           [kind](std::uint64_t s, long n, const Report& report) { return compare_block(kind, s, n, report); }});
    }
  }

  ComparisonCounts run(int threads) {
    counts_.resize(names_.size());
    std::vector<std::thread> pool;
    for (int k = 1; k < threads; ++k) pool.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : pool) thread.join();
    ComparisonCounts all;
    for (const ComparisonCounts& counts : counts_) all += counts;
    return all;
  }

  void print() const {
    std::printf("%-28s %9s %8s %7s %12s %10s %18s %14s\n", "kind", "cases", "robust", "inside", "differences",
                "uncertain", "(exactly stable)", "exact us/case");
    for (std::size_t k = 0; k < names_.size(); ++k) {
      const ComparisonCounts& c = counts_[k];
      const double each = 1.0 / static_cast<double>(std::max(c.cases, 1L));
      std::printf("%-28s %9ld %7.1f%% %7ld %12ld %10ld %18ld %14.1f\n", names_[k].c_str(), c.cases,
                  100 * each * static_cast<double>(c.robust), c.inside, c.differences, c.uncertain, c.uncertain_stable,
                  1e6 * each * c.exact_seconds);
    }
  }

 private:
  void work() {
    constexpr long shown = 20;
    const Report report = [this](const std::string& difference) {
      const std::lock_guard lock(mutex_);
      if (shown_++ < shown) std::fprintf(stderr, "%s\n", difference.c_str());
    };
    for (std::size_t k = next_++; k < blocks_.size(); k = next_++) {
      const Block& block = blocks_[k];
      const ComparisonCounts counts = block.compare(block.seed, block.cases, report);
      const std::lock_guard lock(mutex_);
      counts_[block.row] += counts;
    }
  }

  std::uint64_t seed_;
  std::vector<std::string> names_;
  std::vector<Block> blocks_;
  std::vector<ComparisonCounts> counts_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  long shown_ = 0;
};

/// Shares of `cases` in the order of the kinds, in per cent; the first takes what is left over.
template <class Kind, std::size_t n>
void add_shares(Comparison& comparison, const char* group, const std::array<Kind, n>& kinds,
                const std::array<int, n>& per_cent, long cases) {
  long left = cases;
  for (std::size_t k = n; k-- > 0;) {
    const long share = k == 0 ? left : cases * per_cent[k] / 100;
    left -= share;
    if (share > 0) comparison.add(group, kinds[k], share);
  }
}

}  // namespace

int main(int argc, char** argv) {
  long random = 0, adversarial = 0, lines = 0;
  std::uint64_t seed = 1;
  int threads = 1;
  CLI::App app("Verdicts of the stability oracle against exact arithmetic");
  app.add_option("--random", random, "random postures")->check(CLI::NonNegativeNumber);
  app.add_option("--adversarial", adversarial, "COMs on or beside boundaries")->check(CLI::NonNegativeNumber);
  app.add_option("--lines", lines, "straight lines")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", seed, "another seed gives other cases");
  app.add_option("--threads", threads, "blocks of cases at a time")->check(CLI::Range(1, 256));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  Comparison comparison(seed);
  if (random > 0) comparison.add("points", PointKind::random, random);
  add_shares(comparison, "points", adversarial_kinds, std::array{20, 30, 10, 10, 5, 15, 10}, adversarial);
  add_shares(comparison, "lines", line_kinds, std::array{35, 20, 15, 10, 10, 5, 5}, lines);
  const ComparisonCounts all = comparison.run(threads);
  comparison.print();
  return all.differences == 0 ? 0 : 1;
}
