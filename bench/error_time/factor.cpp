// Safety factors: relative error over time.
#include <fmt/format.h>

#include <cmath>

#include "bench/error_time/items.hpp"
#include "bench/glpk_verdict.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/extreme_cases.hpp"
#include "tests/support/extreme_factor.hpp"
#include "tests/support/lp_reference.hpp"

namespace surefoot::bench {
namespace {

using stability::DisturbanceBox;
using testing::SamplePosture;

struct Posture {
  SamplePosture sample;
  testing::ExactFactor exact;  ///< finite, above 0
  stability::RobustOracle oracle;
};

struct Case {
  const char* name;
  std::vector<Posture> postures;
  bool solver_may_abort = false;

  void take(const SamplePosture& sample) {
    auto exact = testing::exact_safety_factor(sample);
    if (exact.value && *exact.value > 0) postures.push_back({sample, std::move(exact), testing::oracle_of(sample)});
  }
};

std::vector<Case> cases(bool quick) {
  std::vector<Case> made;
  for (const int contacts : {2, 3}) {
    made.push_back({contacts == 2 ? "random, 2 contacts" : "random, 3 contacts", {}});
    testing::Sampler sampler(74 + static_cast<std::uint64_t>(contacts));
    const std::size_t count = quick ? 30 : 200;
    for (std::size_t k = 0; made.back().postures.size() < count; ++k)
      made.back().take(sampler.posture(testing::generic_kinds[k % testing::generic_kinds.size()], contacts));
  }
  made.push_back({"catalogue of extreme postures", {}, true});
  const auto catalogue = testing::extreme_catalogue();
  for (std::size_t k = 0; k < catalogue.size(); k += quick ? 60 : 9) made.back().take(catalogue[k].sample);
  return made;
}

/// sup {s : holds(s W)} by ever longer strides and halving of the logarithm, to a relative tolerance.
template <class Holds>
double bisected(const SamplePosture& sample, double tolerance, Holds&& holds) {
  const auto at = [&](double s) { return holds(DisturbanceBox{s * sample.box.kappa, s * sample.box.nu}); };
  constexpr double greatest = 1e120;  // beyond, kappa and nu may leave the range of doubles
  double low = 1, high = 1;
  if (at(1)) {
    for (double stride = 2; at(high = low * stride); stride *= stride)
      if ((low = high) > greatest) return INFINITY;
  } else {
    for (double stride = 2; !at(low = high / stride); stride *= stride)
      if ((high = low) < 1 / greatest) return 0;
  }
  while (high > low * (1 + tolerance)) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (at(middle) ? low : high) = middle;
  }
  return std::sqrt(low) * std::sqrt(high);
}

/// Nineteen of twenty errors are at most as great; failures count as infinite.
double percentile_95(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  return errors[(errors.size() * 95 + 99) / 100 - 1];
}

template <class Find>
void add(Rows& rows, const Case& given, const char* method, const std::string& parameter, Find&& find,
         std::size_t count = 0) {
  const std::size_t n = count == 0 ? given.postures.size() : std::min(count, given.postures.size());
  std::vector<double> errors;
  double greatest = 0;
  std::size_t failures = 0;
  for (std::size_t k = 0; k < n; ++k) {
    stability::SafetyFactor found;
    found.value = find(given.postures[k]);
    double error = std::isnan(found.value)
                       ? INFINITY
                       : testing::compared(given.postures[k].sample, found, given.postures[k].exact).value_error;
    if (!(error < 1)) error = INFINITY, ++failures;
    if (std::isfinite(error)) greatest = std::max(greatest, error);
    errors.push_back(error);
  }
  const Timing time = median_time(
      [&] {
        for (std::size_t k = 0; k < n; ++k) keep(find(given.postures[k]));
      },
      {0.1, 3, 31});
  rows.add(
      given.name, method, parameter, percentile_95(errors), time.each(n),
      fmt::format("of {}: {} failed (NaN, or off by more than the factor itself), the others off by {:.1e} at most", n,
                  failures, greatest));
}

void measure_case(Rows& rows, const Case& given, bool quick) {
  add(rows, given, "surefoot", "1e-9 guaranteed",
      [](const Posture& p) { return p.oracle.safety_factor(p.sample.com).value; });
  std::vector<testing::DirectReference<double>> direct;
  for (const Posture& p : given.postures) direct.emplace_back(p.sample);
  add(rows, given, "linear system in plain doubles", "double", [&](const Posture& p) {
    return direct[static_cast<std::size_t>(&p - given.postures.data())].safety_factor(p.sample.com).value;
  });
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9})
    add(rows, given, "bisection on surefoot's verdict", "to " + power_of_ten(tolerance), [tolerance](const Posture& p) {
      return bisected(p.sample, tolerance, [&p](const DisturbanceBox& box) {
        return stability::robust(p.sample.contacts, p.sample.rho, box, p.sample.com);
      });
    });
  if (given.solver_may_abort) return;  // GLPK ends the program on some of these
  const std::size_t few = quick ? 10 : 60;
  GlpkVerdict solver;
  for (const double tolerance : {1e-1, 1e-3, 1e-6})
    add(
        rows, given, "bisection on GLPK's verdict", "to " + power_of_ten(tolerance),
        [&, tolerance](const Posture& p) {
          return bisected(p.sample, tolerance, [&](const DisturbanceBox& box) {
            return solver.robust(p.sample.contacts, p.sample.com, p.sample.rho, box);
          });
        },
        few);
  std::vector<testing::LpReference> programs;
  for (const Posture& p : given.postures) programs.emplace_back(p.sample);
  add(
      rows, given, "GLPK, least scale of each mode", "LP",
      [&](const Posture& p) {
        return programs[static_cast<std::size_t>(&p - given.postures.data())].safety_factor(p.sample.com).value;
      },
      few);
}

void measure(Rows& rows, bool quick) {
  for (const Case& given : cases(quick)) measure_case(rows, given, quick);
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const Row& row : rows.all())
    if (row.method == "surefoot" || row.method.starts_with("linear") || row.method.starts_with("GLPK"))
      text += fmt::format("- {}, {}: {:.3g} µs; {}.\n", row.scenario, row.method, 1e6 * row.time.seconds, row.note);
  return text;
}

}  // namespace

const Item factor_item{"factor",
                       "Safety factor: relative error against time",
                       "exact rational linear programs on rows in integers, every candidate tried "
                       "(tests/support/extreme_exact.hpp); postures whose factor "
                       "is finite and above 0",
                       "relative error, 95th percentile",
                       "time per posture, contacts prepared",
                       1e-6,
                       measure,
                       findings};

}  // namespace surefoot::bench
