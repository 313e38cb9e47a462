// The commands of `surefoot`, without the parsing of their arguments. Each returns its exit status; bad input is
// thrown as terrain::InputError, output that cannot be written as OutputError (both end in exit_bad_input).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"

namespace surefoot::planner {

enum ExitStatus : int {
  exit_success = 0,     ///< solved; the plan holds; all lines were read
  exit_failure = 1,     ///< no plan within the limit; the plan does not hold
  exit_bad_input = 2,   ///< bad input or usage, or output that cannot be written
  exit_infeasible = 3,  ///< proven that there is no plan
};

struct PlanArguments {
  std::string scene;
  std::optional<std::string> output, svg, html;  ///< files; "-" is stdout
  std::optional<std::string> format;             ///< text, json, yaml; otherwise by the name of the output
  std::optional<std::int64_t> seed;              ///< the rest override the scene's `search`
  std::optional<double> time_limit;              ///< [s]
  std::optional<std::string> planner, objective;
  double effort = 1;  ///< work spent on a better plan, relative to the usual
  bool no_refine = false, explain = false, quiet = false, verbose = false;
};

struct CheckArguments {
  std::string scene, plan;
  std::optional<std::string> svg, html;  ///< pictures of the plan, whether it holds or not
};

int run_plan(const PlanArguments& arguments);
int run_check(const CheckArguments& arguments);
/// Lines of `file`, "-" for stdin. With `stats`, stderr tells how the answers were decided.
int run_query(const std::string& file, bool stats);
/// Lists the canned scenes (canned_scenes.hpp).
int run_maps();

/// One line for each scene that is in order, one line for each fault of the others (FaultList::most_kept at most).
struct ValidateArguments {
  std::vector<std::string> scenes;
  std::optional<std::string> svg;  ///< of one scene; "-" is stdout, which then holds nothing else
};
int run_validate(const ValidateArguments& arguments);

/// Loads a scene: a file, the name of a canned one (canned_scenes.hpp), "-" for stdin. Unless `quiet`, a large one is
/// named while it is read.
gaits::Scene open_scene(const std::string& path, bool quiet = false);
/// The same with all faults in the list: nothing if there is any.
std::optional<gaits::Scene> open_scene(const std::string& path, terrain::FaultList& faults, bool quiet = false);
/// What is legal but most likely a mistake: chains that seem to be given the wrong way round, a goal in solid
/// ground, lengths that look like millimetres, friction that looks like an angle; "" if there is nothing.
std::string scene_remark(const gaits::Scene& scene);
/// A remark on COMs of a plan that lie behind a chain, in what pictures show as solid; "" if there are none.
std::string behind_chain_remark(const gaits::Scene& scene, const gaits::Plan& plan);
/// All of stdin.
std::string read_stdin();

}  // namespace surefoot::planner
