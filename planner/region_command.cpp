#include "planner/region_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"
#include "planner/posture_input.hpp"

namespace surefoot::planner {
namespace {

using terrain::Document;
using terrain::InputError;
using terrain::Node;

/// What the figure is about, with all that it refers to.
struct Subject {
  std::optional<gaits::Scene> scene;
  gaits::RegionFigure figure;
};

std::vector<int> legs_of(const std::string& text) {
  const char* form = "two or three legs as 1,2 or 1,2,3";
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (commas != 1 && commas != 2) throw InputError(fmt::format("--stance: found {}, expected {}", one_line(text), form));
  std::vector<int> legs;
  for (const double value : read_numbers("--stance", text, commas + 1, form)) {
    const int leg = value == 1 ? 0 : value == 2 ? 1 : value == 3 ? 2 : -1;
    if (leg < 0 || std::find(legs.begin(), legs.end(), leg) != legs.end())
      throw InputError(fmt::format("--stance: found {}, expected {}", one_line(text), form));
    legs.push_back(leg);
  }
  std::sort(legs.begin(), legs.end());
  return legs;
}

/// The legs that carry the first stance, as far as the scene says.
std::vector<int> first_legs(const gaits::Scene& scene) {
  if (scene.start.support) return {scene.start.support->first, scene.start.support->second};
  std::vector<int> planted;
  for (int leg = 0; leg < gaits::leg_count; ++leg)
    if (scene.start.feet[leg]) planted.push_back(leg);
  return planted;
}

void read_scene(const RegionArguments& arguments, Subject& subject) {
  subject.scene = open_scene(*arguments.scene);
  const gaits::Scene& scene = *subject.scene;
  const std::vector<int> legs = arguments.stance ? legs_of(*arguments.stance) : first_legs(scene);
  std::string names;
  for (const int leg : legs) {
    const auto& foot = scene.start.feet[leg];
    if (!foot) throw InputError(fmt::format("--stance: leg {} starts in the air ({})", leg + 1, scene.start.place));
    subject.figure.contacts.push_back(gaits::contact_at(*foot));
    subject.figure.contact_names.push_back(std::to_string(leg + 1));
    names += (names.empty() ? "" : ", ") + std::to_string(leg + 1);
  }
  subject.figure.title = fmt::format("{}: start feet of legs {}", scene.name, names);
  subject.figure.terrain = &scene.terrain;
  subject.figure.radius_of_gyration = scene.robot.radius_of_gyration;
  subject.figure.box = {{}, scene.disturbance.kappa, scene.disturbance.nu};
}

/// A query line (formats.md) whose `com`, if it is there, is only marked.
void read_posture(const RegionArguments& arguments, Subject& subject) {
  const std::string& path = *arguments.posture;
  const Document document = read_document(path);
  const Node& root = document.root();
  root.allow_only({"contacts", "com", "rho", "kappa", "nu"}, "posture");
  subject.figure.contacts = read_contacts(root, 1, 3);
  for (std::size_t i = 1; i <= subject.figure.contacts.size(); ++i) subject.figure.contact_names.push_back(std::to_string(i));
  subject.figure.radius_of_gyration = root.require("rho", "posture").positive("rho");
  subject.figure.box.kappa = root.require("kappa", "posture").not_negative("kappa");
  subject.figure.box.nu = root.require("nu", "posture").not_negative("nu");
  if (const Node* com = root.find("com")) subject.figure.com = read_point(*com, "com");
  subject.figure.title = path == "-" ? "posture" : std::filesystem::path(path).stem().string();
}

Subject read_subject(const RegionArguments& arguments) {
  if (arguments.scene.has_value() == arguments.posture.has_value())
    throw InputError(arguments.scene ? "a scene and --posture are given; expected one of them"
                                     : "nothing to draw: expected a scene file or --posture FILE");
  if (arguments.posture && arguments.stance) throw InputError("--stance: only for a scene; a posture is one stance");
  Subject subject;
  if (arguments.scene)
    read_scene(arguments, subject);
  else
    read_posture(arguments, subject);
  if (arguments.wrench) {
    const std::vector<double> wrench = read_numbers("--wrench", *arguments.wrench, 2, "p,q");
    subject.figure.box = {{wrench[0], wrench[1]}, 0, 0};
  }
  return subject;
}

stability::RegionOptions options_of(const RegionArguments& arguments) {
  stability::RegionOptions options;
  if (!arguments.window) return options;
  const char* form = "xmin,ymin,xmax,ymax with xmin < xmax and ymin < ymax";
  const std::vector<double> w = read_numbers("--window", *arguments.window, 4, form);
  if (!(w[0] < w[2] && w[1] < w[3]))
    throw InputError(fmt::format("--window: found {}, expected {}", one_line(*arguments.window), form));
  options.window = Eigen::AlignedBox2d(Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3]));
  return options;
}

}  // namespace

int run_region(const RegionArguments& arguments) {
  const stability::RegionOptions options = options_of(arguments);
  const Subject subject = read_subject(arguments);
  FigureOutputs outputs({{"--svg", arguments.svg}, {"--json", arguments.json}},
                        arguments.scene ? arguments.scene : arguments.posture);
  const gaits::RegionFigure& figure = subject.figure;
  const stability::Region region =
      stability::region(figure.contacts, figure.radius_of_gyration, figure.box, options);
  if (outputs.wants("--svg")) outputs.put("--svg", gaits::to_svg(figure, region));
  if (outputs.wants("--json")) outputs.put("--json", region_to_json(figure, region));
  if (!outputs.to_stdout()) write_stdout(region_to_text(figure, region));
  outputs.commit();
  return exit_success;
}

}  // namespace surefoot::planner
