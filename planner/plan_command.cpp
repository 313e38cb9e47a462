#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gaits/plan_io.hpp"
#include "gaits/verifier.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"
#include "planner/refine.hpp"
#include "planner/remedies.hpp"
#include "planner/search.hpp"

namespace surefoot::planner {

namespace {

using Clock = std::chrono::steady_clock;

/// `word` among `words`. Throws, with the near miss, if it is none of them.
std::string one_of(const std::string& what, const std::string& word, const std::vector<std::string>& words) {
  if (const std::string* known = gaits::known_word(word, words)) return *known;
  throw terrain::InputError(gaits::not_known(what, word, words));
}

/// The scene's defaults, which were checked when it was read, overridden by the command line.
SearchOptions search_options(const PlanArguments& arguments, const gaits::Scene& scene) {
  SearchOptions options{.seed = scene.search.seed,
                        .time_limit = arguments.time_limit.value_or(scene.search.time_limit),
                        .planner = scene.search.planner,
                        .objective = scene.search.objective};
  if (arguments.seed) {
    if (*arguments.seed < 1 || *arguments.seed > gaits::greatest_seed)
      throw terrain::InputError(
          fmt::format("--seed: found {}, expected 1 to {}", *arguments.seed, gaits::greatest_seed));
    options.seed = static_cast<std::uint32_t>(*arguments.seed);
  }
  if (!std::isfinite(options.time_limit) || options.time_limit <= 0)
    throw terrain::InputError(fmt::format("--time-limit: found {}, expected seconds > 0", options.time_limit));
  if (!std::isfinite(arguments.effort) || arguments.effort < 0)
    throw terrain::InputError(fmt::format("--effort: found {}, expected a number >= 0", arguments.effort));
  options.effort = arguments.effort;
  if (arguments.planner) options.planner = one_of("--planner", *arguments.planner, planner_names());
  if (arguments.objective) options.objective = one_of("--objective", *arguments.objective, gaits::objective_names());
  return options;
}

/// As asked for, otherwise by the name of the output, otherwise text.
std::string output_format(const PlanArguments& arguments) {
  if (arguments.format) return one_of("--format", *arguments.format, {"text", "json", "yaml"});
  const std::string name = arguments.output.value_or(""), lower = terrain::lower_case(name);
  for (const char* picture : {".png", ".pdf", ".jpg", ".jpeg"})
    if (lower.ends_with(picture))
      throw terrain::InputError(fmt::format("-o {}: the plan itself goes there; pictures are --svg and --html", name));
  for (const char* picture : {".svg", ".html"})
    if (lower.ends_with(picture))
      throw terrain::InputError(fmt::format(
          "-o {}: the plan itself goes there; did you mean --{} {}? (--format text writes it there all the same)", name,
          picture + 1, name));
  if (lower.ends_with(".json")) return "json";
  if (lower.ends_with(".yaml") || lower.ends_with(".yml")) return "yaml";
  return "text";
}

std::string written(const gaits::Scene& scene, const gaits::Plan& plan, const std::string& format, bool explain,
                    bool colour) {
  std::string text = format == "json"   ? gaits::to_json(plan)
                     : format == "yaml" ? gaits::to_yaml(plan)
                                        : gaits::to_text(scene, plan, {.colour = colour, .explain = explain});
  if (text.empty() || text.back() != '\n') text += '\n';
  return text;
}

/// Where the plan goes, checked before the search, filled only when there is a plan.
FigureOutputs open_outputs(const PlanArguments& arguments) {
  const bool plan_to_stdout = arguments.output.value_or("-") == "-";
  for (const auto& [option, path] : {std::pair("--svg", arguments.svg), std::pair("--html", arguments.html)})
    if (plan_to_stdout && path == "-")
      throw terrain::InputError(
          fmt::format("{} -: standard output is taken by the plan; give -o a file name too", option));
  return FigureOutputs({{"-o", arguments.output.value_or("-")}, {"--svg", arguments.svg}, {"--html", arguments.html}},
                       scene_file(arguments.scene));
}

/// The refined plan where it holds, the plan as found where only that holds; `fault` where neither does.
gaits::Plan refine_and_verify(const gaits::Scene& scene, const gaits::Plan& found, const PlanArguments& arguments,
                              bool refine, Clock::time_point deadline, std::string& fault) {
  const auto refusal = [&scene](const gaits::Plan& plan) -> std::string {
    const gaits::Verification verification = gaits::verify(scene, plan);
    if (verification.holds()) return {};
    const gaits::Fault& first = verification.faults.front();
    return fmt::format("{}: {}: {}", first.place, gaits::to_string(first.rule), first.message);
  };
  if (refine) {
    RefineOptions options;
    options.deadline = deadline;
    gaits::Plan refined = refine_unverified(scene, found, options);
    const std::string refused = refusal(refined);
    if (refused.empty()) return refined;
    if (arguments.verbose) note("the refined plan does not hold and is dropped: " + refused);
  }
  fault = refusal(found);
  return found;
}

void tell(const gaits::Plan& plan) {
  if (plan.safety_factor_before_refinement)
    note(fmt::format("refined: least safety factor {:.6g} -> {:.6g}", *plan.safety_factor_before_refinement,
                     plan.safety_factor));
  note(fmt::format("verified: {} stances, {} transfers", plan.stances.size(), plan.transfers.size()));
}

/// Lines on standard error, where standard output or a file has something else.
void note_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) note(line);
}

void deliver(const PlanArguments& arguments, const gaits::Scene& scene, const gaits::Plan& plan,
             FigureOutputs& outputs) {
  const bool colour = !outputs.file("-o") && stdout_takes_colour();
  const std::string format = output_format(arguments);
  outputs.put("-o", written(scene, plan, format, arguments.explain, colour));
  if (outputs.wants("--svg")) outputs.put("--svg", gaits::to_svg(scene, plan));
  if (outputs.wants("--html")) outputs.put("--html", gaits::to_html(scene, plan));
  outputs.commit(arguments.quiet);
  if (arguments.explain && format != "text") note_lines(gaits::explanation(scene, plan));
}

/// For --explain where there is no plan; a paragraph of its own.
std::string what_would_help(const gaits::Scene& scene, SearchOptions options, bool quiet) {
  if (!quiet) show_progress("looking for what would help ...");
  options.progress = [](const std::string&) {};
  const Remedies tried = remedies(scene, options);
  show_progress("");
  std::string text =
      fmt::format("\nNo single change of friction, reach, disturbances{} was found to help.\n",
                  scene.criterion == gaits::Criterion::robust ? ", clearance or criterion" : " or clearance");
  if (!tried.found.empty())
    text =
        "\nEach of these alone would do (with it a plan was found and verified; with less of a number a short "
        "search found none):\n";
  for (const RemedyFound& remedy : tried.found) text += fmt::format("  {}\n", remedy.words);
  if (tried.cut_off)
    text += fmt::format("This was cut off by {}: others, or less, might do.\n",
                        options.interrupted() ? "Ctrl-C" : "the time limit");
  return text;
}

/// No plan: said where the plan would have gone, but no file is touched.
int report_no_plan(const PlanArguments& arguments, const gaits::Scene& scene, const gaits::Plan& plan,
                   const FigureOutputs& outputs, const SearchOptions& options) {
  const OutputFile* file = outputs.file("-o");
  const std::string format = output_format(arguments);
  std::vector<std::string> untouched;
  for (const char* option : {"-o", "--svg", "--html"})
    if (const OutputFile* wanted = outputs.file(option)) untouched.push_back(wanted->path());
  if (!file) write_stdout(written(scene, plan, format, arguments.explain, stdout_takes_colour()));
  else note(fmt::format("{}{}{}", gaits::to_string(plan.status), plan.reason.empty() ? "" : ": ", plan.reason));
  if (!untouched.empty() && !(arguments.quiet && !file))
    note(fmt::format("{} {} not written{}", fmt::join(untouched, ", "), untouched.size() == 1 ? "is" : "are",
                     outputs.wants("--svg") ? " (surefoot validate --svg draws the scene)" : ""));
  if (arguments.explain && !options.interrupted()) {
    const std::string help = what_would_help(scene, options, arguments.quiet);
    if (!file && format == "text") write_stdout(help);
    else note_lines(help);
  } else if (arguments.explain) {
    note("what would help is not looked for: cut off by Ctrl-C");
  }
  if (!arguments.explain && !arguments.quiet) note("plan --explain looks for what would help");
  return plan.status == gaits::Status::infeasible ? exit_infeasible : exit_failure;
}

}  // namespace

int run_plan(const PlanArguments& arguments) {
  output_format(arguments);  // says what is wrong with it before anything else is done
  const gaits::Scene scene = open_scene(arguments.scene, arguments.quiet);
  SearchOptions options = search_options(arguments, scene);
  if (const std::string remark = arguments.quiet ? "" : scene_remark(scene); !remark.empty()) note("remark: " + remark);
  FigureOutputs outputs = open_outputs(arguments);
  if (arguments.verbose)
    note(fmt::format("{}: {} segment{}, planner {}, seed {}, time limit {} s", scene.name,
                     scene.terrain.segments().size(), scene.terrain.segments().size() == 1 ? "" : "s", options.planner,
                     options.seed, options.time_limit));
  if (!arguments.quiet) options.progress = [](const std::string& text) { show_progress(text); };
  const Interruption interruption;
  options.interrupted = [&interruption] { return interruption.asked(); };
  const auto begin = Clock::now();
  const auto elapsed = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  gaits::Plan plan = search(scene, options);
  show_progress("");
  if (interruption.asked() && plan.status == gaits::Status::solved && !arguments.quiet)
    note("interrupted: this is the best plan so far, not refined");
  if (arguments.verbose)
    note(fmt::format("search: {}, {} steps, {:.3f} s", gaits::to_string(plan.status), plan.steps(), elapsed()));
  if (plan.status == gaits::Status::solved) {
    std::string fault;
    // Refinement trades the COM's way for safety.
    const bool refine = !arguments.no_refine && !interruption.asked() && options.objective != "distance";
    if (!arguments.no_refine && options.objective == "distance")
      plan.left_out.push_back({"refinement", "it would make the COM's way longer; the objective is distance"});
    plan = refine_and_verify(scene, plan, arguments, refine, deadline_after(begin, options.time_limit), fault);
    if (!fault.empty()) {
      report_error("internal: the verifier refuses the plan that was found, nothing is printed: " + fault);
      return exit_failure;
    }
    if (arguments.verbose) tell(plan);
  }
  plan.time_s = elapsed();
  if (const std::string remark = arguments.quiet ? "" : behind_chain_remark(scene, plan); !remark.empty())
    note("remark: " + remark);
  if (plan.status != gaits::Status::solved) return report_no_plan(arguments, scene, plan, outputs, options);
  deliver(arguments, scene, plan, outputs);
  return exit_success;
}

}  // namespace surefoot::planner
