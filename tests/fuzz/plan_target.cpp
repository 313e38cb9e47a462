#include <string>
#include <vector>

#include "gaits/plan_io.hpp"
#include "gaits/verifier.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

namespace {

/// The ground that the plans of the corpus are made for.
const gaits::Scene& ground() {
  static const gaits::Scene scene = gaits::parse_scene(R"(surefoot: 1
terrain: {friction: 0.5, chains: [{vertices: [[-1, 0], [7, 0], [7, 1]]}]}
robot: {radius_of_gyration: 0.15, reach: [0.25, 0.9], clearance: 0.2}
disturbance: {kappa: 0.1, nu: 0.04}
start: {feet: [{x: -0.3}, {x: 0.25}, {x: 0}], support: [1, 2]}
goal: {com_x: [0.4, 6]}
)",
                                                       "ground");
  return scene;
}

/// `surefoot check` draws plans that do not hold, too.
void draw(const gaits::Plan& plan, const gaits::Verification& verification) {
  std::vector<std::string> faults;
  for (const gaits::Fault& fault : verification.faults) faults.push_back(gaits::to_string(fault));
  const std::string svg = gaits::to_svg(ground(), plan, faults), html = gaits::to_html(ground(), plan, faults);
  for (const std::string& picture : {svg, html}) expect(!picture.empty(), "a plan has a picture");
}

}  // namespace

void plan(std::string_view bytes) {
  try {
    const gaits::Plan read = gaits::parse_plan(bytes, "input");
    const std::string json = gaits::to_json(read), yaml = gaits::to_yaml(read);
    expect(gaits::to_json(gaits::parse_plan(json, "input")) == json, "a plan survives JSON");
    expect(gaits::to_yaml(gaits::parse_plan(yaml, "input")) == yaml, "a plan survives YAML");
    expect(gaits::to_json(gaits::parse_plan(yaml, "input")) == json, "JSON and YAML hold the same plan");
    const gaits::Verification verification = gaits::verify(ground(), read);
    constexpr std::size_t few = 4;  // a page takes some milliseconds a stance
    if (read.status == gaits::Status::solved && read.stances.size() <= few) draw(read, verification);
  } catch (const terrain::InputError& fault) {
    expect_located(fault.what());
  }
}

}  // namespace surefoot::fuzz
