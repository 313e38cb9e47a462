// Straight lines of COMs: sampling against certificates, on lines whose violation is short.
#include <fmt/format.h>

#include <optional>

#include "bench/error_time/items.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/exact_cases.hpp"

namespace surefoot::bench {
namespace {

using Eigen::Vector2d;

struct Line {
  stability::RobustOracle oracle;
  Vector2d from, to;
  bool stable;  ///< decided in integers
};

/// A line that is not stable though its ends are robust, and one that shares `from` and is stable.
struct Pair {
  Vector2d from, unstable, stable;
};

bool robust(const testing::ExactPosture& exact, const Vector2d& com) {
  return exact.robust(exact.frame(testing::ExactCom(com)));
}
bool stable(const testing::ExactPosture& exact, const Vector2d& from, const Vector2d& to) {
  return testing::ExactLine(exact, from, to).stable();
}

/// Among robust COMs of one set of contacts.
std::optional<Pair> pair_among(const testing::ExactPosture& exact, const std::vector<Vector2d>& coms) {
  for (const Vector2d& from : coms) {
    std::optional<Vector2d> bad, good;
    for (const Vector2d& to : coms)
      if (to != from) (stable(exact, from, to) ? good : bad) = to;
    if (bad && good) return Pair{from, *bad, *good};
  }
  return std::nullopt;
}

/// The other ends drawn together until their distance is `gap` of what it was: the lines then differ by little, and the
/// violation is short. Nothing if the end of the unstable line is not robust, where any sample at the end sees it.
std::optional<Pair> drawn_together(const testing::ExactPosture& exact, Pair pair, double gap) {
  const double least = gap * (pair.unstable - pair.stable).norm();
  while ((pair.unstable - pair.stable).norm() > least) {
    const Vector2d middle = 0.5 * (pair.unstable + pair.stable);
    (stable(exact, pair.from, middle) ? pair.stable : pair.unstable) = middle;
  }
  if (!robust(exact, pair.unstable)) return std::nullopt;
  return pair;
}

struct Case {
  const char* name;
  double gap;  ///< 1: as found
  std::vector<Line> lines;
};

void fill(std::vector<Case>& cases, std::size_t pairs) {
  testing::Sampler sampler(73);
  for (int k = 0; cases.back().lines.size() < 2 * pairs; ++k) {
    const auto family =
        testing::line_family(k % 2 == 0 ? testing::LineKind::slender : testing::LineKind::stable_ends, sampler);
    std::vector<Vector2d> coms;
    for (const auto& line : family.lines) coms.insert(coms.end(), line.begin(), line.end());
    const testing::ExactPosture exact(family.sample);
    std::optional<Pair> pair = pair_among(exact, coms);
    for (Case& given : cases) {
      if (pair) pair = drawn_together(exact, *pair, given.gap);
      if (!pair) break;
      const auto oracle = testing::oracle_of(family.sample);
      given.lines.push_back({oracle, pair->from, pair->unstable, false});
      given.lines.push_back({oracle, pair->from, pair->stable, true});
    }
  }
}

template <class Accepts>
void add(Rows& rows, const Case& given, const char* method, const std::string& parameter, Accepts&& accepts) {
  std::size_t accepted = 0, refused = 0, unstable = 0;
  for (const Line& line : given.lines) {
    const bool yes = accepts(line);
    unstable += !line.stable;
    accepted += yes && !line.stable;
    refused += !yes && line.stable;
  }
  const Timing time = median_time([&] {
    for (const Line& line : given.lines) keep(accepts(line));
  });
  rows.add(given.name, method, parameter, static_cast<double>(accepted) / static_cast<double>(unstable),
           time.each(given.lines.size()),
           fmt::format("{} of {} unstable lines accepted, {} of {} stable ones refused", accepted, unstable, refused,
                       given.lines.size() - unstable));
}

void measure(Rows& rows, bool quick) {
  std::vector<Case> cases{{"violations as found", 1, {}},
                          {"ends within 1e-3 of touching", 1e-3, {}},
                          {"ends within 1e-6 of touching", 1e-6, {}}};
  fill(cases, quick ? 8 : 60);
  for (const Case& given : cases) {
    for (const int n : {2, 5, 17, 65, 257, 1025, 4097})
      add(rows, given, "sampling at n points", fmt::format("n = {}", n), [n](const Line& line) {
        for (int k = 0; k < n; ++k)
          if (!line.oracle.robust(line.from + (line.to - line.from) * (static_cast<double>(k) / (n - 1)))) return false;
        return true;
      });
    add(rows, given, "surefoot, certificates", "whole line",
        [](const Line& line) { return line.oracle.line(line.from, line.to).stable(); });
  }
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const Row& row : rows.all())
    if (row.method == "surefoot, certificates" || row.parameter == "n = 65" || row.parameter == "n = 4097")
      text += fmt::format("- {}, {} ({}): {}, {:.3g} µs.\n", row.scenario, row.method, row.parameter, row.note,
                          1e6 * row.time.seconds);
  return text;
}

}  // namespace

const Item line_item{
    "line",
    "Straight lines of COMs: false accepts against time",
    "integer arithmetic with polynomials in Bernstein form and isolated roots (tests/support/exact_line.hpp), which "
    "shares nothing "
    "with the certificates; it also makes the lines: each unstable one has robust ends and a stable neighbour",
    "share of unstable lines that are accepted",
    "time per line, contacts prepared",
    1e-6,
    measure,
    findings};

}  // namespace surefoot::bench
