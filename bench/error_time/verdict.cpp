// Robust verdicts: share of wrong ones over the time of one.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>

#include "bench/error_time/items.hpp"
#include "bench/glpk_verdict.hpp"
#include "bench/plain_posture.hpp"
#include "tests/support/direct_reference.hpp"
#include "tests/support/exact_cases.hpp"
#include "tests/support/extreme_cases.hpp"
#include "tests/support/extreme_lp.hpp"
#include "tests/support/extreme_plain.hpp"

namespace surefoot::bench {
namespace {

using testing::SamplePosture;

struct Case {
  const char* name;
  std::vector<SamplePosture> postures;
  bool solver_may_abort = false;  ///< GLPK ends the program on some of these unless it is caught
};

/// Nothing coincides but by accident.
Case random_case(bool quick) {
  Case made{"random postures", {}};
  testing::Sampler sampler(71);
  const std::size_t count = quick ? 300 : 2000;
  while (made.postures.size() < count)
    made.postures.push_back(
        sampler.posture(testing::generic_kinds[made.postures.size() % testing::generic_kinds.size()],
                        sampler.integer(2, 3)));
  return made;
}

/// COMs at a facet of R_SS(W) or where a mode begins: neighbouring doubles on both sides, and up to 4 units beside.
Case near_case(bool quick) {
  Case made{"COM within 4 ulp of a boundary", {}};
  testing::Sampler sampler(72);
  const std::size_t count = quick ? 200 : 1500;
  for (int k = 0; made.postures.size() < count; ++k) {
    const auto family =
        testing::point_family(k % 3 == 0 ? testing::PointKind::facet : testing::PointKind::mode, sampler);
    for (const Eigen::Vector2d& com : family.coms) {
      made.postures.push_back(family.sample);
      made.postures.back().com = com;
    }
  }
  return made;
}

Case extreme_case(bool quick) {
  Case made{"catalogue of extreme postures", {}, true};
  const auto catalogue = testing::extreme_catalogue();
  for (std::size_t k = 0; k < catalogue.size(); k += quick ? 20 : 2) made.postures.push_back(catalogue[k].sample);
  return made;
}

bool by_integers(const SamplePosture& s) {
  const testing::ExactPosture exact(s);
  return exact.robust(exact.frame(testing::ExactCom(s.com)));
}
bool by_rationals(const SamplePosture& s) { return testing::DirectReference<testing::Rational>(s).robust(s.com); }

/// A verdict, or nothing where a solver gave up.
using Verdict = std::function<std::optional<bool>(std::size_t)>;

class Measurement {
 public:
  Measurement(Rows& rows, const Case& given) : rows_(rows), case_(given) {
    for (const SamplePosture& s : given.postures) truth_.push_back(by_integers(s));
  }

  /// `count`: of the postures, for methods that are slow; 0: all.
  void add(const char* method, const char* parameter, const Verdict& verdict, std::size_t count = 0,
           const char* note = "") {
    const std::size_t n = count == 0 ? truth_.size() : std::min(count, truth_.size());
    std::size_t wrong = 0, unsafe = 0, none = 0;
    const auto at = [&](std::size_t k) { return k * truth_.size() / n; };  // spread over all
    for (std::size_t k = 0; k < n; ++k) {
      const auto found = verdict(at(k));
      wrong += found != truth_[at(k)];
      unsafe += found.value_or(false) && !truth_[at(k)];
      none += !found;
    }
    Repetitions repetitions;
    repetitions.most = 21;
    const Timing time = median_time(
        [&] {
          for (std::size_t k = 0; k < n; ++k) keep(verdict(at(k)));
        },
        repetitions);
    std::string text = fmt::format("{} of {} wrong ({} unsafe)", wrong, n, unsafe);
    if (none > 0) text += fmt::format(", {} of these without answer", none);
    if (*note != '\0') text += std::string("; ") + note;
    rows_.add(case_.name, method, parameter, static_cast<double>(wrong) / static_cast<double>(n), time.each(n), text);
  }

 private:
  Rows& rows_;
  const Case& case_;
  std::vector<bool> truth_;
};

void measure_case(Rows& rows, const Case& given, bool quick) {
  Measurement measurement(rows, given);
  const auto& postures = given.postures;
  const char* plain = "formulas, plain floating point";
  measurement.add(plain, "float", [&](std::size_t k) { return testing::plain_verdict_in<float>(postures[k]).robust; });
  measurement.add(plain, "double",
                  [&](std::size_t k) { return testing::plain_verdict_in<double>(postures[k]).robust; });
  measurement.add(plain, "80 bit",
                  [&](std::size_t k) { return testing::plain_verdict_in<long double>(postures[k]).robust; });
  std::vector<PlainPosture> bare;
  for (const SamplePosture& s : postures) bare.push_back(plain_posture(s));
  measurement.add("surefoot, guards taken out", "double",
                  [&](std::size_t k) { return count_robust_unguarded(&bare[k], 1) == 1; });
  measurement.add("surefoot, guarded doubles", "double", [&](std::size_t k) { return count_robust(&bare[k], 1) == 1; });
  const std::size_t few = quick ? 40 : 300;
  for (const auto& [label, above, tolerance] :
       {std::tuple{"1e-3", 1e-3, 1e-4}, {"1e-5", 1e-5, 1e-6}, {"1e-8", 1e-8, 1e-9}}) {
    // Caught failures free all of GLPK's memory: no problem of another solver may be alive there.
    std::optional<GlpkVerdict> solver;
    if (!given.solver_may_abort) solver.emplace(above, tolerance);
    if (given.solver_may_abort)
      measurement.add(
          "GLPK, feasible above", label,
          [&, a = above, t = tolerance](std::size_t k) -> std::optional<bool> {
            const auto verdict = testing::lp_verdict(postures[k], a, t);
            return verdict.unanswered ? std::nullopt : std::optional(verdict.robust);
          },
          few, "every mode asked, automatic scaling");
    else
      measurement.add(
          "GLPK, feasible above", label,
          [&](std::size_t k) -> std::optional<bool> {
            const SamplePosture& s = postures[k];
            return solver->robust(s.contacts, s.com, s.rho, s.box);
          },
          few);
  }
  measurement.add(
      "exact rationals (linear system)", "exact", [&](std::size_t k) { return by_rationals(postures[k]); },
      quick ? 10 : 60);
  measurement.add(
      "exact integers (the reference)", "exact", [&](std::size_t k) { return by_integers(postures[k]); }, few);
}

void measure(Rows& rows, bool quick) {
  for (const Case& given : {random_case(quick), near_case(quick), extreme_case(quick)})
    measure_case(rows, given, quick);
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const char* scenario : {"random postures", "COM within 4 ulp of a boundary", "catalogue of extreme postures"}) {
    const Row* ours = rows.find(scenario, "surefoot, guarded doubles");
    const Row* bare = rows.find(scenario, "surefoot, guards taken out");
    const Row* plain = rows.find(scenario, "formulas, plain floating point", "double");
    const Row* solver = rows.find(scenario, "GLPK, feasible above", "1e-8");
    text += fmt::format(
        "- {}: surefoot {:.3g} µs, {}; without its guards {:.3g} µs, {}; plain doubles {:.3g} µs, {}; GLPK {:.3g} µs, "
        "{}.\n",
        scenario, 1e6 * ours->time.seconds, ours->note, 1e6 * bare->time.seconds, bare->note, 1e6 * plain->time.seconds,
        plain->note, 1e6 * solver->time.seconds, solver->note);
  }
  return text;
}

}  // namespace

const Item verdict_item{"verdict",
                        "Robust verdict: share of wrong answers against time",
                        "integer arithmetic with a derivation of its own (tests/support/exact_posture.hpp); the "
                        "integers and the exact rational "
                        "linear systems (direct_reference.hpp), which share nothing, are held against each other",
                        "share of wrong verdicts",
                        "time per posture, contacts new",
                        1e-6,
                        measure,
                        findings};

}  // namespace surefoot::bench
