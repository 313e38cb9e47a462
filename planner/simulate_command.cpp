#include "planner/simulate_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "gaits/motion_svg.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "planner/figure_outputs.hpp"
#include "planner/posture_input.hpp"
#include "planner/pushed_posture.hpp"
#include "planner/stance_input.hpp"

namespace surefoot::planner {
namespace {

using stability::HybridBody;
using terrain::InputError;

using Clock = std::chrono::steady_clock;

constexpr double earth_gravity = 9.81;    // [m/s^2]
constexpr double usual_time_limit = 100;  // [s]
constexpr double usual_size = 1e-6;       // of the extent

struct Subject {
  std::string title = "random postures";
  SampleRequest request;
  Push push;
};

std::optional<Eigen::Vector3d> triple(const std::optional<std::string>& text, const char* option, const char* form) {
  if (!text) return std::nullopt;
  const auto values = read_numbers(option, *text, 3, form);
  return Eigen::Vector3d(values[0], values[1], values[2]);
}

double positive(double value, const char* option) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("{}: found {}, expected a number > 0", option, value));
  return value;
}

void read_file(const std::string& path, Subject& subject) {
  const terrain::Document document = read_posture_document(path, "surefoot simulate takes a scene with --scene");
  PushedPosture posture = read_pushed_posture(document.root());
  subject.request.contacts = std::move(posture.contacts);
  subject.request.rho = posture.rho;
  subject.request.com = posture.com;
  if (posture.restitution) subject.request.options.restitution = *posture.restitution;
  if (posture.gravity) subject.request.gravity = *posture.gravity;
  subject.push = posture.push;
  subject.title = path == "-" ? "posture" : std::filesystem::path(path).stem().string();
}

void read_scene(const SimulateArguments& a, Subject& subject) {
  const gaits::Scene scene = open_scene(*a.scene);
  const StanceInput stance = read_stance(scene, a.stance);
  if (stance.legs.size() != 2)
    throw InputError(
        fmt::format("--stance: {} legs stand, expected two, for example --stance 1,2", stance.legs.size()));
  subject.title = stance.title;
  if (stance.legs != std::vector<int>{0, 1}) subject.title += ", here contacts 1 and 2";
  subject.request.contacts = stance.contacts;
  subject.request.rho = scene.robot.radius_of_gyration;
  if (scene.start.com) subject.request.com = *scene.start.com;
  if (scene.restitution) subject.request.options.restitution = *scene.restitution;
}

Subject read_subject(const SimulateArguments& a) {
  Subject subject;
  SampleRequest& request = subject.request;
  request.options.restitution = 0;
  request.gravity = earth_gravity;
  if (!a.posture && !a.scene && !a.sample)
    throw InputError("nothing to simulate: expected a posture file, --scene SCENE, or --sample N for random postures");
  if (a.posture && a.scene) throw InputError("a posture and --scene are given; expected one of them");
  if (a.stance && !a.scene) throw InputError("--stance: only with --scene; a posture is one stance");
  if (a.posture) read_file(*a.posture, subject);
  if (a.scene) read_scene(a, subject);
  if (a.com) {
    const auto com = read_numbers("--com", *a.com, 2, "x,y");
    request.com = Eigen::Vector2d(com[0], com[1]);
  }
  if (a.restitution) request.options.restitution = checked_restitution(*a.restitution, "--restitution");
  if (a.gravity) request.gravity = positive(*a.gravity, "--gravity");
  if (const auto given = triple(a.q, "--q", "rx,ry,theta")) subject.push.q = given;
  if (const auto given = triple(a.q_rate, "--q-rate", "vx,vy,omega")) subject.push.q_rate = given;
  if (const auto given = triple(a.heights, "--heights", "h1,h2,theta")) subject.push.heights = given;
  if (const auto given = triple(a.heights_rate, "--heights-rate", "u1,u2,omega")) subject.push.heights_rate = given;
  const bool lacks_com = !request.com && !a.sample;
  if (request.options.restitution == 0)
    throw InputError(fmt::format("restitution is missing: expected in the posture or scene, or as --restitution{}",
                                 lacks_com ? "; so is com, --com x,y" : ""));
  if (lacks_com) throw InputError("com is missing: expected in the posture, as the scene's start.com, or as --com x,y");
  request.options.time_limit = a.time_limit ? positive(*a.time_limit, "--time-limit") : usual_time_limit;
  if (a.neighbourhood) request.neighbourhood = positive(*a.neighbourhood, "--neighbourhood");
  request.size = a.size ? positive(*a.size, "--size") : usual_size;
  if (a.sample && *a.sample < 1) throw InputError(fmt::format("--sample: found {}, expected a count >= 1", *a.sample));
  if (a.seed && *a.seed < 0) throw InputError(fmt::format("--seed: found {}, expected a number >= 0", *a.seed));
  request.runs = static_cast<std::uint64_t>(a.sample.value_or(0));
  request.seed = static_cast<std::uint64_t>(a.seed.value_or(1));
  return subject;
}

SimulateRecord record_run(const HybridBody& body, const Subject& subject) {
  SimulateRecord record;
  record.title = subject.title;
  record.restitution = subject.request.options.restitution;
  record.start = start_of(body, subject.push);
  const stability::HybridOptions options = subject.request.options_for(body);
  record.neighbourhood = options.neighbourhood;
  record.run = stability::simulate(body, record.start, options, [&record](const stability::HybridEvent& event) {
    if (record.events.size() < most_events) record.events.push_back(event);
    else ++record.omitted;
  });
  return record;
}

}  // namespace

int run_simulate(const SimulateArguments& arguments) {
  Subject subject = read_subject(arguments);
  SampleRequest& request = subject.request;
  FigureOutputs outputs({{"--svg", arguments.svg}, {"--json", arguments.json}},
                        arguments.scene ? arguments.scene : arguments.posture);
  if (arguments.sample) {
    if (arguments.svg) throw InputError("--svg: a sample of many runs has no picture");
    if (const Push& push = subject.push; push.q || push.q_rate || push.heights || push.heights_rate)
      throw InputError("--sample draws the pushes: leave out q, q_rate, heights and heights_rate");
    if (!request.contacts.empty() && request.contacts.size() != 2)
      throw InputError("--sample: expected a posture of two contacts");
    request.progress = [&request, next = Clock::now()](std::uint64_t done) mutable {
      const auto now = Clock::now();
      if (now < next) return;
      next = now + std::chrono::milliseconds(100);
      show_progress(fmt::format("{} of {} pushes", done, request.runs));
    };
    const SampleReport report = sample_pushes(request);
    show_progress("");
    if (outputs.wants("--json")) outputs.put("--json", report.json);
    if (!outputs.to_stdout()) write_stdout(report.text);
    outputs.commit();
    return exit_success;
  }
  const HybridBody body(request.contacts, *request.com, request.rho, request.gravity, arguments.linearised);
  const SimulateRecord record = record_run(body, subject);
  if (outputs.wants("--svg")) {
    gaits::MotionFigure figure{record.title, {}, body.contacts(), record.start, record.events};
    figure.result = fmt::format("{} after {:.6g} s, {} collision{}", name(record.run.outcome), record.run.time,
                                record.run.collisions, record.run.collisions == 1 ? "" : "s");
    outputs.put("--svg", gaits::to_svg(figure));
  }
  if (outputs.wants("--json")) outputs.put("--json", simulation_to_json(body, record));
  if (!outputs.to_stdout()) write_stdout(simulation_to_text(body, record));
  outputs.commit();
  return exit_success;
}

}  // namespace surefoot::planner
