#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gaits/plan_io.hpp"
#include "gaits/verifier.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"

namespace surefoot::planner {

namespace {

std::string counted(int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

/// "; for feet that were not found stability is not judged in 3 of 5 stances and 2 of 4 transfers", or nothing.
std::string not_judged(const gaits::Verification& verification) {
  const int stances = verification.stances_with_lost_feet, transfers = verification.transfers_with_lost_feet;
  if (stances == 0 && transfers == 0) return "";
  return fmt::format("; for feet that were not found stability is not judged in {} of {} and {} of {}", stances,
                     counted(verification.stances, "stance"), transfers, counted(verification.transfers, "transfer"));
}

/// "does not hold: 35 faults in 3 of 5 stances and 3 of 4 transfers".
std::string verdict(const gaits::Verification& verification, const gaits::Plan& plan) {
  if (verification.holds())
    return fmt::format("holds: {}, {}, least safety factor {:.6g}", counted(verification.stances, "stance"),
                       counted(verification.transfers, "transfer"), plan.safety_factor);
  const std::size_t count = verification.faults.size();
  if (std::all_of(verification.faults.begin(), verification.faults.end(), [](const auto& f) { return f.stated; }))
    return fmt::format(
        "does not hold: {} stated safety factor{} not that of this scene, but every stance and transfer is stable and "
        "legal (least safety factor {:.6g})",
        count, count == 1 ? " is" : "s are", verification.least_factor);
  std::set<std::string> stances, transfers;
  for (const gaits::Fault& fault : verification.faults)
    if (fault.place.starts_with("stance")) stances.insert(fault.place);
    else if (fault.place.starts_with("transfer")) transfers.insert(fault.place);
  if (stances.empty() && transfers.empty())
    return fmt::format("does not hold: {} fault{}{}", count, count == 1 ? "" : "s", not_judged(verification));
  return fmt::format("does not hold: {} fault{} in {} of {} stances and {} of {} transfers{}", count,
                     count == 1 ? "" : "s", stances.size(), plan.stances.size(), transfers.size(),
                     plan.transfers.size(), not_judged(verification));
}

/// One line per fault; what is said again of later places is told at the first, with their number.
std::string fault_lines(const gaits::Verification& verification) {
  std::map<std::pair<gaits::Rule, std::string>, int> places;
  for (const gaits::Fault& fault : verification.faults) ++places[{fault.rule, fault.message}];
  std::string text;
  for (const gaits::Fault& fault : verification.faults) {
    int& count = places[{fault.rule, fault.message}];
    if (count == 0) continue;
    text += one_line(gaits::to_string(fault));
    text += count == 1 ? "\n" : fmt::format(" (and so at {} more place{})\n", count - 1, count == 2 ? "" : "s");
    count = 0;
  }
  return text;
}

constexpr double same_place = 1e-6;  ///< of the greatest reach

/// Where a plan was made with another friction than the scene has; "" if nowhere (a plan need not state any).
std::string other_friction(const gaits::Scene& scene, const gaits::Plan& plan) {
  const auto differs = [&](const terrain::Foothold& foot) {
    const auto here = scene.terrain.foothold_at(foot.chain, foot.s);
    // A foot that is not where the plan says is lost, which is told.
    const double near = same_place * scene.robot.reach_max;
    const bool found = here && (here->position - foot.position).norm() <= near;
    return foot.friction > 0 && found && here->friction != foot.friction;
  };
  for (std::size_t k = 0; k < plan.stances.size(); ++k)
    for (std::size_t leg = 0; leg < gaits::leg_count; ++leg)
      if (const auto& foot = plan.stances[k].feet[leg]; foot && differs(*foot))
        return fmt::format("the plan was made with friction {} under foot {} of stance {}, where this scene has {}",
                           foot->friction, leg + 1, k + 1, scene.terrain.foothold_at(foot->chain, foot->s)->friction);
  return "";
}

}  // namespace

int run_check(const CheckArguments& arguments) {
  if (arguments.scene == "-" && arguments.plan == "-")
    throw terrain::InputError("scene and plan cannot both be read from standard input");
  const gaits::Scene scene = open_scene(arguments.scene);
  const gaits::Plan plan =
      arguments.plan == "-" ? gaits::parse_plan(read_stdin(), "<stdin>") : gaits::read_plan(arguments.plan);
  FigureOutputs outputs({{"--svg", arguments.svg}, {"--html", arguments.html}}, arguments.plan);
  for (const char* option : {"--svg", "--html"})
    if (const OutputFile* file = outputs.file(option); file && file->same_as(scene_file(arguments.scene)))
      throw terrain::InputError(fmt::format("{}: is the scene itself and would be overwritten", file->path()));
  if (plan.status != gaits::Status::solved) {
    write_stdout(fmt::format("no plan to check: status {}{}{}\n", gaits::to_string(plan.status),
                             plan.reason.empty() ? "" : ": ", one_line(plan.reason)));
    if (outputs.wants("--svg") || outputs.wants("--html")) note("no picture is written: there is nothing to draw");
    return exit_failure;
  }
  const gaits::Verification verification = gaits::verify(scene, plan);
  std::vector<std::string> faults;
  for (const gaits::Fault& fault : verification.faults) faults.push_back(one_line(gaits::to_string(fault)));
  if (outputs.wants("--svg")) outputs.put("--svg", gaits::to_svg(scene, plan, faults));
  if (outputs.wants("--html")) outputs.put("--html", gaits::to_html(scene, plan, faults));
  if (!verification.holds() && plan.scene != scene.name)
    note(fmt::format("the plan is for a scene named {}, this one is {}", plan.scene, scene.name));
  if (!outputs.to_stdout()) write_stdout(fault_lines(verification) + verdict(verification, plan) + "\n");
  if (const std::string other = verification.holds() ? "" : other_friction(scene, plan); !other.empty()) note(other);
  const bool meant = verification.holds() || plan.scene == scene.name;
  if (const std::string remark = meant ? behind_chain_remark(scene, plan) : ""; !remark.empty())
    note("remark: " + remark);
  outputs.commit();
  return verification.holds() ? exit_success : exit_failure;
}

}  // namespace surefoot::planner
