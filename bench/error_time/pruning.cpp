// What is left out: each rule by itself, time with it over time without it, per canned scene, and whether the answers
// are the same.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "bench/error_time/items.hpp"
#include "bench/planner_runs.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"
#include "gaits/verifier_geometry.hpp"
#include "planner/infeasibility.hpp"
#include "planner/refine.hpp"
#include "stability/line_test.hpp"
#include "stability/point_test.hpp"

namespace surefoot::bench {
namespace {

using Eigen::Vector2d;
using stability::RobustOracle;

struct Given {
  gaits::Scene scene;
  gaits::Plan plan;  ///< the stored one
};

constexpr const char *canned_scenes = "canned scenes, a point each", *all_same = "the same: all ";

/// Answers as numbers, so that they can be compared.
using Answers = std::vector<double>;

struct Rule {
  const char* name;
  /// Answers to the rule's questions on a scene, with and without the rule.
  std::function<Answers(const Given&, bool with)> ask;
};

// ---- stability ----

/// The stances' contacts, and COMs on a grid about each stance's COM.
template <class Ask>
Answers over_coms(const Given& given, Ask&& ask) {
  Answers answers;
  const double far = 0.4 * given.scene.robot.reach_max;
  constexpr int n = 5;  // on either side
  for (const gaits::Stance& stance : given.plan.stances) {
    std::vector<stability::Contact> contacts;
    for (const auto& foot : stance.feet)
      if (foot) contacts.push_back(gaits::contact_at(*foot));
    for (int i = -n; i <= n; ++i)
      for (int k = -n; k <= n; ++k) answers.push_back(ask(contacts, Vector2d(stance.com + far / n * Vector2d(i, k))));
  }
  return answers;
}

Answers modes_after_equilibrium(const Given& given, bool with) {
  const double rho = given.scene.robot.radius_of_gyration;
  const auto& box = given.scene.disturbance;
  return over_coms(given, [&](const std::vector<stability::Contact>& contacts, const Vector2d& com) -> double {
    if (with) return stability::robust(contacts, rho, box, com);
    const RobustOracle oracle(contacts, rho, box);
    const bool no_mode = oracle.feasible_modes(com).empty();
    return oracle.equilibrium(com) && no_mode;
  });
}

Answers shared_point_certificates(const Given& given, bool with) {
  return over_coms(given, [&](const std::vector<stability::Contact>& contacts, const Vector2d& com) -> double {
    const stability::Posture posture(contacts, given.scene.robot.radius_of_gyration);
    stability::PointQuery query(posture, com, given.scene.disturbance);
    if (!query.equilibrium()) return 0;
    if (with) return query.any_feasible() == nullptr;
    return std::none_of(posture.modes().begin(), posture.modes().end(),
                        [&query](const auto& spec) { return query.feasible(spec); });
  });
}

Answers shared_line_certificates(const Given& given, bool with) {
  Answers answers;
  for (std::size_t k = 0; k < given.plan.transfers.size(); ++k) {
    const RobustOracle oracle =
        gaits::oracle_of(given.scene, gaits::feet_during(given.plan.stances[k], given.plan.transfers[k]));
    const Vector2d &from = given.plan.stances[k].com, &to = given.plan.stances[k + 1].com;
    if (with) {
      answers.push_back(oracle.line(from, to).stable());
      continue;
    }
    const stability::LineQuery query(oracle.posture(), from, to, oracle.box());
    const auto modes = oracle.posture().modes();
    answers.push_back(oracle.line_equilibrium(from, to) &&
                      std::all_of(modes.begin(), modes.end(), [&query](const auto& spec) {
                        return query.feasible(spec).outcome == stability::LineOutcome::excluded;
                      }));
  }
  return answers;
}

// ---- terrain ----

/// From every stance of the plan, swings of the free leg to places within reach.
Answers swings_where_nothing_is_near(const Given& given, bool with) {
  Answers answers;
  const gaits::Scene& scene = given.scene;
  const double radius = scene.robot.reach_min;
  for (std::size_t k = 0; k < given.plan.transfers.size(); ++k) {
    const Vector2d com = given.plan.stances[k].com, to = given.plan.transfers[k].foothold.position - com;
    const bool any_way = with && gaits::swings_any_way(scene, com);  // asked once for all landings
    for (const auto& stretch : scene.terrain.stretches_within(com, radius, scene.robot.reach_max)) {
      const auto landing = scene.terrain.foothold_at(stretch.segment->chain, 0.5 * (stretch.s_begin + stretch.s_end));
      if (!landing) continue;
      const Vector2d from = landing->position - com;
      answers.push_back(any_way || scene.terrain.sector_is_free(com, radius, from, to) ||
                        scene.terrain.sector_is_free(com, radius, to, from));
    }
  }
  return answers;
}

Answers terrain_out_of_reach(const Given& given, bool with) {
  Answers answers;
  const gaits::Scene& scene = given.scene;
  const double greatest = scene.robot.reach_max;
  for (std::size_t k = 0; k + 1 < given.plan.stances.size(); ++k) {
    const Vector2d from = given.plan.stances[k].com, to = given.plan.stances[k + 1].com;
    double least = greatest;
    if (with) least = std::min(least, scene.terrain.distance(from, to, greatest));
    else
      for (const terrain::Segment& s : scene.terrain.segments())
        least = std::min(least, gaits::bare::distance(from, to, s.a, s.b));
    answers.push_back(std::round(1e12 * least / greatest));  // two formulas: equal to rounding
  }
  return answers;
}

// ---- search ----

Answers numbers_of(const gaits::Plan& plan) {
  Answers answers{static_cast<double>(plan.steps()), plan.safety_factor};
  for (const gaits::Stance& stance : plan.stances) answers.insert(answers.end(), {stance.com.x(), stance.com.y()});
  return answers;
}

Answers proof_after_stalling(const Given& given, bool with) {
  const gaits::Plan plan = planned(given.scene, "Layers", 1, 0, "steps");
  if (!with && planner::prove_infeasible(given.scene)) return {};
  return numbers_of(plan);
}

Answers refinement_of_what_can_gain(const Given& given, bool with) {
  planner::RefineOptions options;
  options.leave_out = with;
  return numbers_of(planner::refine_unverified(given.scene, given.plan, options));
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{{"modes asked only in equilibrium", modes_after_equilibrium},
                                     {"shared certificates at a COM", shared_point_certificates},
                                     {"shared certificates on a line", shared_line_certificates},
                                     {"swing test only where terrain is near", swings_where_nothing_is_near},
                                     {"terrain out of reach", terrain_out_of_reach},
                                     {"proof only once the search stalls", proof_after_stalling},
                                     {"refinement only of what can gain", refinement_of_what_can_gain}};
  return all;
}

std::vector<Given> canned(bool quick) {
  std::vector<Given> scenes;
  std::vector<std::filesystem::path> plans;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_PLANS)) plans.push_back(entry.path());
  std::sort(plans.begin(), plans.end());
  for (const auto& path : plans) {
    if (quick && path.stem() != "flat" && path.stem() != "chimney" && path.stem() != "rubble") continue;
    scenes.push_back({gaits::load_scene(std::filesystem::path(SUREFOOT_MAPS) / path.stem().concat(".yaml")),
                      gaits::read_plan(path)});
  }
  return scenes;
}

Row row_of(const Rule& rule, const Given& given, bool quick) {
  const Answers with = rule.ask(given, true), without = rule.ask(given, false);
  std::size_t same = 0;
  for (std::size_t k = 0; k < std::min(with.size(), without.size()); ++k) same += with[k] == without[k];
  const std::size_t all = std::max(with.size(), without.size());
  const Repetitions repetitions{quick ? 0.01 : 0.1, 3, 51};
  const Timing on = median_time([&] { keep(rule.ask(given, true)); }, repetitions);
  const Timing off = median_time([&] { keep(rule.ask(given, false)); }, repetitions);
  const double ratio = on.seconds / off.seconds;
  return {canned_scenes,
          rule.name,
          given.scene.name,
          ratio,
          ratio,
          ratio,
          on,
          fmt::format("without the rule {:.3g} s; {}{} of {} answers", off.seconds,
                      same == all ? all_same : "the same are ", same, all)};
}

void measure(Rows& rows, bool quick) {
  const auto scenes = canned(quick);
  for (const Rule& rule : rules()) {
    std::vector<Row> of_rule;
    for (const Given& given : scenes) of_rule.push_back(row_of(rule, given, quick));
    std::sort(of_rule.begin(), of_rule.end(),
              [](const Row& one, const Row& two) { return one.time.seconds < two.time.seconds; });
    for (Row& row : of_rule) rows.add(std::move(row));
  }
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const Rule& rule : rules()) {
    std::vector<double> ratios;
    bool same = true;
    for (const Row& row : rows.all())
      if (row.method == rule.name) {
        ratios.push_back(row.error);
        same &= row.note.find(all_same) != std::string::npos;
      }
    const auto [least, greatest] = std::minmax_element(ratios.begin(), ratios.end());
    text += fmt::format("- {}: {:.2g} in the median of the scenes ({:.2g} to {:.2g}); answers {}.\n", rule.name,
                        median(ratios), *least, *greatest, same ? "the same throughout" : "NOT all the same");
  }
  return text +
         "- Without a switch, and so without a row: contact modes that the geometry excludes for every COM (they are "
         "never listed: their rows "
         "would be linearly dependent); exact arithmetic where doubles decide (the guard's cost is in the plot of "
         "verdicts); frictional stability "
         "where no restitution is given (there is nothing to ask); the bound on steps still needed, lazy checks of "
         "steps and the widths of Layers "
         "(they steer what a search of limited work finds, so the answer is not the same); the 120 weakest windows of "
         "long plans (likewise).\n";
}

}  // namespace

const Item pruning_item{"pruning",
                        "What is left out: time with each rule over time without it",
                        "the same questions asked with the rule switched off; column note counts equal answers",
                        "time with over without the rule (below 1: it saves)",
                        "time with the rule, per scene",
                        1e-3,
                        measure,
                        findings};

}  // namespace surefoot::bench
