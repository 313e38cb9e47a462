// The numbers the project is held to, measured: each over its target.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/error_time/items.hpp"
#include "bench/glpk_verdict.hpp"
#include "bench/oracle_work.hpp"
#include "bench/plain_posture.hpp"
#include "bench/planner_runs.hpp"
#include "bench/region_stances.hpp"

namespace surefoot::bench {
namespace {

namespace fs = std::filesystem;
using stability::RobustOracle;

class Targets {
 public:
  Targets(Rows& rows, bool quick) : rows_(rows), quick_(quick) {}

  /// `target` and the measured value in the same unit; error: their ratio.
  void at_most(const std::string& what, const std::string& target, double limit, double value, Timing time,
               std::string note = {}) {
    rows_.add("targets", what, target, value / limit, time, std::move(note));
  }

  /// Time of one answer, answers of a whole batch taken in turns.
  template <class Answer>
  void answer(const std::string& what, double limit_us, std::size_t count, Answer&& ask) {
    const Timing time = each(count, ask);
    at_most(what, fmt::format("{:g} µs", limit_us), limit_us, 1e6 * time.seconds, time,
            fmt::format("{:.3g} µs", 1e6 * time.seconds));
  }
  template <class Answer>
  Timing each(std::size_t count, Answer&& ask) const {
    const Repetitions repetitions{quick_ ? 0.05 : 0.5, 5, 401};
    return median_time(
               [&] {
                 for (std::size_t k = 0; k < count; ++k) keep(ask(k));
               },
               repetitions)
        .each(count);
  }

  void oracle(int contacts) {
    const Work& given = work(contacts);
    const std::vector<RobustOracle> made = oracles(given);
    const auto fresh = [&](std::size_t k) {
      const auto& p = given.postures[k];
      return stability::robust(p.contacts, p.rho, p.box, p.com);
    };
    const std::string suffix = fmt::format(", {} contacts", contacts);
    answer("robust verdict, new contacts" + suffix, contacts == 2 ? 0.08 : 0.16, batch, fresh);
    GlpkVerdict solver;
    const Timing ours = each(batch, fresh), lp = each(batch / 4, [&](std::size_t k) {
                                              const auto& p = given.postures[k];
                                              return solver.robust(p.contacts, p.com, p.rho, p.box);
                                            });
    const double ratio = lp.seconds / ours.seconds, wanted = contacts == 2 ? 500 : 1000;
    at_most("GLPK over surefoot, same run" + suffix, fmt::format("at least {:g}", wanted), 1 / wanted, 1 / ratio, ours,
            fmt::format("{:.0f} ({:.3g} µs / {:.3g} µs)", ratio, 1e6 * lp.seconds, 1e6 * ours.seconds));
    answer("robust verdict, same contacts" + suffix, contacts == 2 ? 0.015 : 0.03, batch,
           [&](std::size_t k) { return made[k % 8].robust(given.to[k]); });  // eight take turns, as in a search
    answer("safety factor, critical constraint, gradient" + suffix, contacts == 2 ? 0.3 : 0.6, batch,
           [&](std::size_t k) { return made[k].safety_factor(given.postures[k].com); });
  }

  void lines() {
    const auto ask = [](const std::vector<Line>& given) {
      return [&given](std::size_t k) { return given[k].oracle.line(given[k].from, given[k].to); };
    };
    answer("straight line, transfers of the stored plans", 0.6, planned_transfers().size(), ask(planned_transfers()));
    const std::vector<Line> between = lines_between_robust(3);
    answer("straight line, random, robust ends", 0.6, between.size(), ask(between));
  }

  void guards() {
    for (const int contacts : {2, 3}) {
      const auto postures = random_plain_postures(contacts, 5000);
      std::vector<double> ratios;
      Timing time;
      for (int k = 0; k < (quick_ ? 5 : 31); ++k) {
        const Repetitions once{0, 1, 1};
        const Timing guarded = median_time([&] { keep(count_robust(postures.data(), postures.size())); }, once);
        const Timing plain = median_time([&] { keep(count_robust_unguarded(postures.data(), postures.size())); }, once);
        ratios.push_back(guarded.seconds / plain.seconds);
        time = guarded.each(postures.size());
      }
      time.repetitions = static_cast<int>(ratios.size());
      at_most(fmt::format("exact decisions over unguarded doubles, {} contacts", contacts), "1.3", 1.3, median(ratios),
              time, fmt::format("{:.2f}", median(ratios)));
    }
  }

  void regions() {
    std::vector<double> seconds;
    int proved = 0;
    for (const auto& groups : {drawn_postures(), canned_stances()})
      for (const StanceGroup& group : groups) {
        if (quick_ && group.stances.size() > 12) continue;
        for (const Stance& stance : group.stances) {
          const auto ask = [&stance] {
            return region_areas(stance.contacts, stance.rho, {{}, stance.box.kappa, stance.box.nu});
          };
          const auto areas = ask();
          proved += areas.error <= 1e-6 * areas.equilibrium;
          seconds.push_back(median_time(ask, {0, 3, 3}).seconds);
        }
      }
    const auto fast = std::count_if(seconds.begin(), seconds.end(), [](double s) { return s <= 1e-3; });
    const double middle = median(seconds), slowest = *std::max_element(seconds.begin(), seconds.end());
    at_most("area of R(W) to 1e-6, median of stances", "1 ms", 1e-3, middle, {middle, 3},
            fmt::format("{:.3g} ms; {} of {} within 1 ms, slowest {:.3g} ms; {} proved to 1e-6", 1e3 * middle, fast,
                        seconds.size(), 1e3 * slowest, proved));
  }

  void first_plans() {
    double worst = 0;
    std::string name, long_one;
    const int seeds = quick_ ? 3 : 20;
    for (const auto& entry : fs::directory_iterator(SUREFOOT_PLANS)) {
      const std::string stem = entry.path().stem().string();
      const auto [seconds, solved] = median_first_plan(std::string(SUREFOOT_MAPS) + "/" + stem + ".yaml", seeds);
      const std::string text = fmt::format("{} {:.3g} ms ({} of {} seeds)", stem, 1e3 * seconds, solved, seeds);
      if (stem == "long_rubble") long_one = text;
      if (seconds > worst) worst = seconds, name = text;
    }
    at_most("first verified plan, slowest canned scene, median over seeds", "20 ms", 0.02, worst, {worst, seeds}, name);
  }

  void terrain_length() {
    const std::vector<double> lengths =
        quick_ ? std::vector<double>{125, 250} : std::vector<double>{250, 500, 1000, 2000};
    std::vector<double> seconds;
    for (const double length : lengths) {
      const std::string file = rubble(length);
      const auto [time, solved] = median_first_plan(file, quick_ ? 1 : 3);
      fs::remove(file);
      if (solved == 0) return;  // no Python, or no plan: no row
      seconds.push_back(time);
      if (length == 1000)
        at_most("1 km of rubble, first verified plan", "1 s", 1, time, {time, 3}, fmt::format("{:.3g} s", time));
    }
    const double exponent = std::log(seconds.back() / seconds.front()) / std::log(lengths.back() / lengths.front());
    at_most(fmt::format("cost over length, exponent from {:g} to {:g} m", lengths.front(), lengths.back()), "1.1", 1.1,
            exponent, {seconds.back(), 3}, fmt::format("{:.2f}", exponent));
  }

 private:
  /// Infinite time where no seed has a plan.
  static std::pair<double, int> median_first_plan(const std::string& file, int seeds) {
    std::vector<double> times;
    if (!fs::exists(file)) return {INFINITY, 0};
    for (int seed = 1; seed <= seeds; ++seed)
      if (const auto found = first_plan(file, static_cast<std::uint32_t>(seed))) times.push_back(found->whole());
    return {times.empty() ? INFINITY : median(times), static_cast<int>(times.size())};
  }

  static std::string rubble(double length) {
    const std::string file =
        (fs::temp_directory_path() / fmt::format("surefoot_rubble_{}_{:g}.yaml", getpid(), length)).string();
    const std::string command = fmt::format("python3 '{}/make_rubble.py' rubble {:g} 2 60 --gentle > '{}' 2>/dev/null",
                                            SUREFOOT_MAPS, length, file);
    if (std::system(command.c_str()) != 0) fs::remove(file);
    return file;
  }

  Rows& rows_;
  bool quick_;
};

void measure(Rows& rows, bool quick) {
  Targets targets(rows, quick);
  for (const int contacts : {2, 3}) targets.oracle(contacts);
  targets.lines();
  targets.guards();
  targets.regions();
  targets.first_plans();
  targets.terrain_length();
}

/// Why a target is missed where it is, by the beginning of the row's name. Shares of instructions: callgrind.
constexpr std::pair<const char*, const char*> reasons[]{
    {"robust verdict, new contacts",
     "a quarter of the instructions finds the facets of the cone, a quarter decides modes at the COM, a fifth (three "
     "contacts) lists the "
     "modes that the contacts allow, all with bounds of their rounding errors; nothing of this can be kept for another "
     "COM"},
    {"GLPK over surefoot",
     "as the rows of surefoot's own times; where those were measured, GLPK was about as fast as where the target was "
     "set"},
    {"robust verdict, same contacts",
     "the target is what the best test of equilibrium alone takes; more than half of the instructions go to the modes "
     "beyond it"},
    {"safety factor", "some postures in a hundred are left to fractions, at 20 to 400 µs each"},
    {"straight line, transfers", "certificates and their error bounds for some twenty modes on one line"},
    {"straight line, random",
     "a case made harder than any plan: rho down to 0.01 m on lines of 1 to 2 m, which are halved until certificates "
     "hold; transfers of plans "
     "are in the row above"},
    {"area of R(W)", "braced stances, whose region is clipped, and some on three contacts need more rectangles"},
    {"first verified plan",
     "long_rubble alone: 100 m and more than 200 steps, whose search takes three quarters of the time; on all other "
     "canned scenes a few ms"},
    {"cost over length", "measured on short lengths, where set-up counts"}};

std::string findings(const Rows& rows) {
  std::string text = "| work | target | measured | over target | |\n|---|---|---|---|---|\n", why;
  for (const Row& row : rows.all())
    text += fmt::format("| {} | {} | {} | {:.2f} | {} |\n", row.method, row.parameter, row.note, row.error,
                        row.error <= 1 ? "met" : "missed");
  for (const auto& [begin, reason] : reasons)
    if (std::any_of(rows.all().begin(), rows.all().end(),
                    [begin = begin](const Row& row) { return row.method.starts_with(begin) && row.error > 1; }))
      why += fmt::format("- {}: {}.\n", begin, reason);
  if (!why.empty()) text += "\nWhat is missed, and why:\n\n" + why;
  return text +
         "\nSteps against the exhaustive optimum: the plot of planners above (effort 1 has as many as the grid's "
         "optimum or fewer on every scene "
         "shown, in the times given there). Extreme inputs: the third plot of verdicts, and "
         "[extremes.md](extremes.md).\n";
}

}  // namespace

const Item targets_item{"targets",
                        "The numbers the project is held to",
                        "none: times alone",
                        "measured over target (at most 1: met)",
                        "time",
                        1e-3,
                        measure,
                        findings,
                        false};

}  // namespace surefoot::bench
