#include <fmt/format.h>

#include <string>
#include <vector>

#include "gaits/plan_io.hpp"
#include "gaits/verifier.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"

namespace surefoot::planner {

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
    return exit_failure;
  }
  const gaits::Verification verification = gaits::verify(scene, plan);
  std::vector<std::string> faults;
  for (const gaits::Fault& fault : verification.faults)
    faults.push_back(fmt::format("{}: {}: {}", fault.place, gaits::to_string(fault.rule), one_line(fault.message)));
  if (outputs.wants("--svg")) outputs.put("--svg", gaits::to_svg(scene, plan));
  if (outputs.wants("--html")) outputs.put("--html", gaits::to_html(scene, plan, faults));
  if (!outputs.to_stdout())
    write_stdout(verification.holds() ? fmt::format("holds: {} stances, {} transfers, least safety factor {:.6g}\n",
                                                    verification.stances, verification.transfers, plan.safety_factor)
                                      : fmt::format("{}\n", fmt::join(faults, "\n")));
  outputs.commit();
  return verification.holds() ? exit_success : exit_failure;
}

}  // namespace surefoot::planner
