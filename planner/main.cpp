// The command line of surefoot: parses arguments, maps everything that goes wrong to one line on stderr and an exit
// status (commands.hpp).
#include <fmt/format.h>
#include <gmp.h>
#include <nlopt.h>
#include <ompl/config.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <boost/version.hpp>
#include <cstdlib>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/bench_command.hpp"
#include "planner/bench_options.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/region_command.hpp"
#include "planner/search.hpp"
#include "planner/signals.hpp"
#include "planner/simulate_command.hpp"
#include "planner/usage_faults.hpp"
#include "terrain/document.hpp"

namespace {

using namespace surefoot::planner;
using surefoot::gaits::objective_names;
using surefoot::terrain::InputError;

std::string version() {
  int major = 0, minor = 0, bugfix = 0;
  nlopt_version(&major, &minor, &bugfix);
  return fmt::format(
      "surefoot {}\nOMPL {}.{}.{}, NLopt {}.{}.{}, Eigen {}.{}.{}, Boost {}.{}.{}, GMP {}, yaml-cpp {}, "
      "nlohmann-json {}.{}.{}, CLI11 {}, fmt {}.{}.{}",
      SUREFOOT_VERSION, OMPL_MAJOR_VERSION, OMPL_MINOR_VERSION, OMPL_PATCH_VERSION, major, minor, bugfix,
      EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
      BOOST_VERSION % 100, gmp_version, SUREFOOT_YAML_CPP_VERSION, NLOHMANN_JSON_VERSION_MAJOR,
      NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, CLI11_VERSION, FMT_VERSION / 10000,
      FMT_VERSION / 100 % 100, FMT_VERSION % 100);
}

struct Arguments {
  PlanArguments plan;
  RegionArguments region;
  SimulateArguments simulate;
  CheckArguments check;
  ValidateArguments validate;
  BenchArguments bench;
  std::string query_file = "-";
  bool query_stats = false;
};

constexpr const char* scene_words = "scene file (YAML) or canned scene, - for standard input";

CLI::App* add_plan(CLI::App& app, PlanArguments& a) {
  CLI::App* plan = app.add_subcommand("plan", "Plan a gait for a scene, verify it and print it");
  plan->add_option("SCENE", a.scene, scene_words)->required();
  plan->add_option(
          "-o,--output", a.output,
          "write the plan to FILE (replaced as a whole; untouched where no plan is found),\n- for standard output")
      ->type_name("FILE");
  plan->add_option("--format", a.format, "text, json or yaml (default: by the name of FILE, else text)")
      ->type_name("NAME");
  plan->add_option("--svg", a.svg, "also draw the plan")->type_name("FILE");
  plan->add_option("--html", a.html, "also make a page that plays the gait in a browser")->type_name("FILE");
  plan->add_option("--seed", a.seed, "seed of the search (default: the scene's, else 1)")->type_name(whole_number);
  plan->add_option("--time-limit", a.time_limit, "seconds until the search gives up (default: the scene's, else 10)")
      ->type_name("S");
  plan->add_option("--planner", a.planner, fmt::format("{}", fmt::join(planner_names(), ", ")))->type_name("NAME");
  plan->add_option("--objective", a.objective, fmt::format("{}", fmt::join(objective_names(), ", ")))
      ->type_name("NAME");
  plan->add_option("--effort", a.effort, "work spent on a better plan, relative to the usual; 0: take the first")
      ->type_name("X");
  plan->add_flag("--no-refine", a.no_refine, "leave the plan as the search found it");
  plan->add_flag(
      "--explain", a.explain,
      "say what limits each step and what was left out; where there is no plan, what would help (takes longer);\n"
      "on standard error where standard output or a file takes the plan in another form");
  auto* quiet = plan->add_flag("-q,--quiet", a.quiet, "nothing but the result: no progress, no notes");
  plan->add_flag("-v,--verbose", a.verbose, "counts and times of each stage on standard error")->excludes(quiet);
  plan->footer(
      "Exit status: 0 solved, 1 no plan found within the limit, 2 bad input or usage, 3 proven infeasible.\n"
      "Ctrl-C ends the search with the best plan so far; a second one ends the program.\n"
      "Example: surefoot plan stairs_up -o plan.json --svg plan.svg --html plan.html");
  return plan;
}

CLI::App* add_check(CLI::App& app, CheckArguments& a) {
  CLI::App* check = app.add_subcommand("check", "Verify a plan file against a scene, independently of the planner");
  check->add_option("SCENE", a.scene, scene_words)->required();
  check->add_option("PLAN", a.plan, "plan file (JSON or YAML), - for standard input")->required();
  check->add_option("--svg", a.svg, "draw the plan, whether it holds or not")->type_name("FILE");
  check->add_option("--html", a.html, "make a page that plays it in a browser and lists its faults")->type_name("FILE");
  check->footer(
      "Exit status: 0 the plan holds, 1 it does not (one line per fault), 2 bad input or usage.\n"
      "Example: surefoot check stairs_up plan.json --html plan.html");
  return check;
}

CLI::App* add_validate(CLI::App& app, Arguments& a) {
  CLI::App* validate = app.add_subcommand("validate", "Say everything that is wrong with scenes, without planning");
  validate->add_option("SCENE", a.validate.scenes, "scene files (YAML) or canned scenes, - for standard input")
      ->required();
  validate->add_option("--svg", a.validate.svg, "draw the scene, start feet and goal: SVG file, - for standard output")
      ->type_name("FILE");
  validate->footer(
      "One line per fault (file:line:column: what), or one line that says what the scene holds.\n"
      "Exit status: 0 all scenes are in order, 2 one is not, or bad usage.\n"
      "Example: surefoot validate scene.yaml other.yaml");
  return validate;
}

CLI::App* add_query(CLI::App& app, Arguments& a) {
  CLI::App* query = app.add_subcommand("query", "Answer questions about postures: JSON lines in, JSON lines out");
  query->add_option("FILE", a.query_file, "file of queries, - or nothing for standard input")->type_name("FILE");
  query->add_flag("--stats", a.query_stats, "afterwards, on standard error: how many decisions each stage made");
  query->footer(
      "One answer per line, in order; a bad line (an empty one too) answers {\"error\": ..., \"line\": N}.\n"
      "Exit status: 0 all lines were read, 2 bad input or usage.\n"
      "Example: echo '{\"contacts\": [{\"p\": [0,0], \"n\": [0,1], \"mu\": 0.5}, "
      "{\"p\": [1,0], \"n\": [0,1], \"mu\": 0.5}],\n"
      "          \"com\": [0.5,0.4], \"rho\": 0.2, \"kappa\": 0.17, \"nu\": 0.1}' | tr -d '\\n' | surefoot query");
  return query;
}

CLI::App* add_region(CLI::App& app, RegionArguments& a) {
  CLI::App* region =
      app.add_subcommand("region", "Stability regions of a stance: where the COM may be, and what forbids the rest");
  region->add_option("SCENE", a.scene, scene_words);
  region
      ->add_option("--posture", a.posture, "instead of a scene: a query line (JSON); its com, if it has one, is marked")
      ->type_name("FILE");
  region->add_option("--stance", a.stance, "two or three legs that stand (default: start.support, or all start feet)")
      ->type_name("LEG,LEG");
  region->add_option("--wrench", a.wrench, "one wrench p,q [1, m] instead of the box W")->type_name("P,Q");
  region
      ->add_option("--restitution", a.restitution,
                   "two contacts: where they are frictionally stable, for this coefficient\n"
                   "between 0 and 1 (default: that of the scene or posture)")
      ->type_name("E");
  region->add_option("--window", a.window, "clip to this rectangle [m]")->type_name("XMIN,YMIN,XMAX,YMAX");
  region->add_option("--svg", a.svg, "draw it; - for standard output")->type_name("FILE");
  region->add_option("--json", a.json, "cells, areas and boundaries; - for standard output")->type_name("FILE");
  region->footer(
      "Exit status: 0 done, 2 bad input or usage.\n"
      "Example: surefoot region vee --svg region.svg");
  return region;
}

CLI::App* add_simulate(CLI::App& app, SimulateArguments& a) {
  CLI::App* simulate =
      app.add_subcommand("simulate", "Hybrid dynamics of a posture after a push: collisions, slides, rest or not");
  simulate->add_option("POSTURE", a.posture,
                       "a query line of one or two contacts (JSON), - for standard input; may have\n"
                       "restitution, gravity, q, q_rate, heights, heights_rate");
  simulate->add_option("--scene", a.scene, "instead of a posture: two start feet of a scene file or canned scene")
      ->type_name("SCENE");
  simulate->add_option("--stance", a.stance, "which two (default: start.support)")->type_name("LEG,LEG");
  simulate->add_option("--restitution", a.restitution, "coefficient of restitution, between 0 and 1")->type_name("E");
  simulate->add_option("--com", a.com, "COM [m]")->type_name("X,Y");
  simulate->add_option("--q", a.q, "start: displacement and turn [m, m, rad]")->type_name("RX,RY,THETA");
  simulate->add_option("--q-rate", a.q_rate, "start: velocity [m/s, m/s, rad/s]")->type_name("VX,VY,OMEGA");
  simulate->add_option("--heights", a.heights, "start, instead of --q: heights of the contacts and turn")
      ->type_name("H1,H2,THETA");
  simulate->add_option("--heights-rate", a.heights_rate, "start, instead of --q-rate: their rates")
      ->type_name("U1,U2,OMEGA");
  simulate->add_option("--gravity", a.gravity, "[m/s^2] (default 9.81)")->type_name("G");
  simulate
      ->add_option("--neighbourhood", a.neighbourhood,
                   "displacement at which the body has left [m] (default: a tenth of\n"
                   "the distance of the contacts or, where that is more, of rho)")
      ->type_name("D");
  simulate->add_option("--time-limit", a.time_limit, "simulated seconds (default 100)")->type_name("S");
  simulate->add_flag("--linearised", a.linearised, "the linearised dynamics about the posture");
  simulate->add_option("--sample", a.sample, "random pushes; without com random COMs, without POSTURE random postures")
      ->type_name(whole_number);
  simulate->add_option("--size", a.size, "of random pushes, relative to the distance of the contacts (default 1e-6)")
      ->type_name("X");
  simulate->add_option("--seed", a.seed, "of random pushes (default 1)")->type_name(whole_number);
  simulate->add_option("--svg", a.svg, "draw heights and angle over time; - for standard output")->type_name("FILE");
  simulate->add_option("--json", a.json, "outcome and events; - for standard output")->type_name("FILE");
  simulate->footer(
      "Exit status: 0 done, whatever the outcome, 2 bad input or usage.\n"
      "Example: surefoot simulate --scene vee --com=-0.2,0.2 --q-rate 0,0.05,0.1 --restitution 0.3 --svg motion.svg");
  return simulate;
}

int run(int count, char** words) {
  CLI::App app("Quasistatic 2-3-2 gait planner for a planar three-legged robot.", "surefoot");
  Arguments arguments;
  app.set_help_flag("-h,--help", "Print this and exit");
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  app.footer("surefoot COMMAND --help tells more.");
  const CLI::App* plan = add_plan(app, arguments.plan);
  const CLI::App* check = add_check(app, arguments.check);
  const CLI::App* validate = add_validate(app, arguments);
  add_query(app, arguments);
  const CLI::App* region = add_region(app, arguments.region);
  const CLI::App* simulate = add_simulate(app, arguments.simulate);
  const CLI::App* bench = app.add_subcommand("bench", bench_description);
  add_bench_options(*app.get_subcommand("bench"), arguments.bench);
  const CLI::App* maps = app.add_subcommand("maps", "List the canned scenes: what each exercises");
  if (count <= 1) {
    report_error(command_missing(app));
    return exit_bad_input;
  }
  try {
    if (const std::string fault = equals_sign(app, count, words); !fault.empty()) throw InputError(fault);
    app.parse(count, words);
    if (const std::string fault = empty_argument(app); !fault.empty()) throw InputError(fault);
    if (const std::string fault = overflowing_argument(app); !fault.empty()) throw InputError(fault);
  } catch (const CLI::CallForHelp&) {
    write_stdout(app.help());
    return exit_success;
  } catch (const CLI::CallForVersion&) {
    write_stdout(version() + "\n");
    return exit_success;
  } catch (const CLI::ParseError& fault) {
    report_error(usage_fault(app, fault, count, words));
    return exit_bad_input;
  }
  if (bench->parsed()) return run_bench(words + 1);
  if (plan->parsed()) return run_plan(arguments.plan);
  if (check->parsed()) return run_check(arguments.check);
  if (validate->parsed()) return run_validate(arguments.validate);
  if (region->parsed()) return run_region(arguments.region);
  if (simulate->parsed()) return run_simulate(arguments.simulate);
  if (maps->parsed()) return run_maps();
  return run_query(arguments.query_file, arguments.query_stats);
}

}  // namespace

int main(int count, char** words) {
  guard_standard_streams();
  end_cleanly_on_signals();
  try {
    return run(count, words);
  } catch (const ReaderGone&) {
  } catch (const InputError& fault) {
    report_error(fault.what());
  } catch (const OutputError& fault) {
    report_error(fault.what());
  } catch (const std::bad_alloc&) {
    report_error("out of memory");
  } catch (const std::exception& fault) {
    report_error(fmt::format("internal: {}", fault.what()));
  }
  return exit_bad_input;
}
