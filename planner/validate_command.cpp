#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "gaits/plan_io.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"
#include "planner/infeasibility.hpp"
#include "planner/problem.hpp"
#include "planner/start_faults.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

namespace {

/// How much ground there is, and how slippery.
std::string ground_summary(const terrain::Terrain& ground) {
  double length = 0, least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const terrain::Segment& segment : ground.segments()) {
    length += segment.length;
    least = std::min(least, segment.surface.friction);
    greatest = std::max(greatest, segment.surface.friction);
  }
  const auto counted = [](std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{}, {}, {:.6g} m, friction {}{}",
                     counted(static_cast<std::size_t>(ground.chain_count()), "chain"),
                     counted(ground.segments().size(), "segment"), length, least,
                     least < greatest ? fmt::format(" to {}", greatest) : "");
}

/// What can be said of the start without a search; a fault that is proven is bad input, as it is for `plan`.
std::string start_summary(const gaits::Scene& scene, terrain::FaultList& faults) {
  StepProposals proposals(scene);
  const StartChoice choice = choose_start(proposals);
  if (!choice.nodes.empty()) return "start stands";
  if (choice.decided) {
    faults.add(start_error(scene, choice));
    return "";
  }
  const auto impossible = prove_infeasible(scene);
  if (impossible && impossible->obstacle == Obstacle::start)
    return "the start cannot stand: " + impossible->reason + hanging_feet(scene);
  return "no stable start was found: " + choice.fault;
}

/// The scene if it is in order.
std::optional<gaits::Scene> validate(const std::string& path, std::string& report) {
  terrain::FaultList faults;
  auto scene = open_scene(path, faults);
  const std::string start = scene ? start_summary(*scene, faults) : "";
  for (const terrain::InputError& fault : faults.kept()) report += one_line(fault.what()) + '\n';
  const std::string name = path == "-" ? "<stdin>" : one_line(path);
  if (const std::size_t kept = faults.kept().size(); kept < faults.count())
    fmt::format_to(std::back_inserter(report), "{}: and at least {} more\n", name, faults.count() - kept);
  const bool valid = faults.count() == 0;
  if (valid)
    fmt::format_to(std::back_inserter(report), "{}: valid: {}, {}, {}\n", name, one_line(scene->name),
                   ground_summary(scene->terrain), start);
  if (const std::string remark = scene ? scene_remark(*scene) : ""; !remark.empty())
    fmt::format_to(std::back_inserter(report), "{}: remark: {}\n", name, remark);
  return valid ? std::move(scene) : std::nullopt;
}

}  // namespace

int run_validate(const ValidateArguments& arguments) {
  const std::vector<std::string>& scenes = arguments.scenes;
  if (std::count(scenes.begin(), scenes.end(), "-") > 1)
    throw terrain::InputError("only one scene can be read from standard input");
  if (arguments.svg && scenes.size() > 1) throw terrain::InputError("--svg: only of one scene");
  std::optional<std::string> drawn;
  if (arguments.svg) drawn = scene_file(scenes.front());
  FigureOutputs picture({{"--svg", arguments.svg}}, drawn);
  bool all = true;
  for (const std::string& path : scenes) {
    std::string report;
    const auto scene = validate(path, report);
    all = scene && all;
    const bool draws = scene && picture.wants("--svg");
    if (draws) picture.put("--svg", gaits::to_svg(*scene));
    if (!draws || !picture.to_stdout()) write_stdout(report);
    if (draws) picture.commit();
  }
  return all ? exit_success : exit_bad_input;
}

}  // namespace surefoot::planner
