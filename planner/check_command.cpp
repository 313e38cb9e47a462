#include <fmt/format.h>

#include <iterator>

#include "gaits/plan_io.hpp"
#include "gaits/verifier.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"

namespace surefoot::planner {

int run_check(const std::string& scene_path, const std::string& plan_path) {
  if (scene_path == "-" && plan_path == "-")
    throw terrain::InputError("scene and plan cannot both be read from standard input");
  const gaits::Scene scene = open_scene(scene_path);
  const gaits::Plan plan = plan_path == "-" ? gaits::parse_plan(read_stdin(), "<stdin>") : gaits::read_plan(plan_path);
  if (plan.status != gaits::Status::solved) {
    write_stdout(fmt::format("no plan to check: status {}{}{}\n", gaits::to_string(plan.status),
                             plan.reason.empty() ? "" : ": ", one_line(plan.reason)));
    return exit_failure;
  }
  const gaits::Verification verification = gaits::verify(scene, plan);
  std::string text;
  for (const gaits::Fault& fault : verification.faults)
    fmt::format_to(std::back_inserter(text), "{}: {}: {}\n", fault.place, gaits::to_string(fault.rule),
                   one_line(fault.message));
  if (verification.holds())
    fmt::format_to(std::back_inserter(text), "holds: {} stances, {} transfers, least safety factor {:.6g}\n",
                   verification.stances, verification.transfers, plan.safety_factor);
  write_stdout(text);
  return verification.holds() ? exit_success : exit_failure;
}

}  // namespace surefoot::planner
