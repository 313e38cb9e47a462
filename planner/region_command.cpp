#include "planner/region_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"
#include "planner/posture_input.hpp"
#include "planner/stance_input.hpp"

namespace surefoot::planner {
namespace {

using terrain::Document;
using terrain::InputError;

/// What the figure is about, with all that it refers to.
struct Subject {
  std::optional<gaits::Scene> scene;
  gaits::RegionFigure figure;
  std::optional<double> restitution;  ///< given: frictional stability is wanted too
};

void read_scene(const RegionArguments& arguments, Subject& subject) {
  subject.scene = open_scene(*arguments.scene);
  const gaits::Scene& scene = *subject.scene;
  const StanceInput stance = read_stance(scene, arguments.stance);
  subject.figure.contacts = stance.contacts;
  subject.figure.contact_names = stance.names;
  subject.figure.title = stance.title;
  subject.figure.terrain = &scene.terrain;
  subject.figure.radius_of_gyration = scene.robot.radius_of_gyration;
  subject.figure.box = {{}, scene.disturbance.kappa, scene.disturbance.nu};
  if (stance.contacts.size() == 2) subject.restitution = scene.restitution;
  else if (scene.restitution) note("frictional stability is about two contacts: --stance LEG,LEG shows where it holds");
}

/// A query line (formats.md) whose `com`, if it is there, is only marked.
void read_posture(const RegionArguments& arguments, Subject& subject) {
  const std::string& path = *arguments.posture;
  const Document document = read_posture_document(path, "surefoot region takes a scene without --posture");
  DisturbedPosture posture = read_disturbed_posture(document.root());
  subject.figure.contacts = std::move(posture.contacts);
  for (std::size_t i = 1; i <= subject.figure.contacts.size(); ++i)
    subject.figure.contact_names.push_back(std::to_string(i));
  subject.figure.radius_of_gyration = posture.rho;
  subject.figure.box = {{}, posture.box.kappa, posture.box.nu};
  subject.figure.com = posture.com;
  subject.restitution = posture.restitution;
  subject.figure.title = path == "-" ? "posture" : std::filesystem::path(path).stem().string();
}

Subject read_subject(const RegionArguments& arguments) {
  if (arguments.scene.has_value() == arguments.posture.has_value())
    throw InputError(arguments.scene ? fmt::format("a scene, {}, and --posture are given; expected one of them",
                                                   one_line(*arguments.scene))
                                     : "nothing to draw: expected a scene file or --posture FILE");
  if (arguments.posture && arguments.stance) throw InputError("--stance: only for a scene; a posture is one stance");
  Subject subject;
  if (arguments.scene) read_scene(arguments, subject);
  else read_posture(arguments, subject);
  if (arguments.wrench) {
    const std::vector<double> wrench = read_numbers("--wrench", *arguments.wrench, 2, "p,q");
    subject.figure.box = {{wrench[0], wrench[1]}, 0, 0};
  }
  if (arguments.restitution) subject.restitution = checked_restitution(*arguments.restitution, "--restitution");
  if (subject.restitution && subject.figure.contacts.size() != 2)
    throw InputError(fmt::format("restitution: frictional stability is about two contacts, there are {}{}",
                                 subject.figure.contacts.size(),
                                 arguments.scene ? "; expected two legs, for example --stance 1,2" : ""));
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
                        arguments.scene ? scene_file(*arguments.scene) : arguments.posture);
  const gaits::RegionFigure& figure = subject.figure;
  const stability::Region region = stability::region(figure.contacts, figure.radius_of_gyration, figure.box, options);
  std::optional<stability::FrictionalRegion> frictional;
  if (subject.restitution) {
    stability::FrictionalRegionOptions same;
    same.window = options.window;
    same.polygons = outputs.wants("--svg") || outputs.wants("--json");
    frictional = stability::frictional_region(figure.contacts, figure.radius_of_gyration, *subject.restitution, same);
  }
  if (outputs.wants("--svg")) outputs.put("--svg", gaits::to_svg(figure, region, frictional));
  if (outputs.wants("--json")) outputs.put("--json", region_to_json(figure, region, frictional));
  if (!outputs.to_stdout()) write_stdout(region_to_text(figure, region, frictional));
  outputs.commit();
  return exit_success;
}

}  // namespace surefoot::planner
