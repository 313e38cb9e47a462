// Random small pushes, and whether the body comes to rest near where it stood.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "gaits/text_table.hpp"
#include "planner/simulate_command.hpp"
#include "stability/frictional.hpp"

namespace surefoot::planner {
namespace {

using stability::Contact;
using stability::HybridBody;
using stability::HybridRun;

/// The same numbers on every machine: the standard leaves its distributions open.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_;
};

/// Rows of the report, by what holds of the posture.
constexpr int classes = 5;
constexpr std::array<const char*, classes> class_names{"guaranteed", "kinematic-strong only", "clattering only",
                                                       "neither", "no equilibrium"};
constexpr std::array<const char*, classes> class_keys{"guaranteed", "kinematic_strong", "clattering", "neither",
                                                      "no_equilibrium"};

int class_of(const stability::FrictionalVerdict& verdict) {
  if (!verdict.equilibrium) return 4;
  if (verdict.stable()) return 0;
  return verdict.kinematic_strong ? 1 : verdict.clattering ? 2 : 3;
}

struct Counts {
  std::uint64_t runs = 0;
  std::array<std::uint64_t, 4> outcome{};
  double farthest = 0;  ///< displacement at rest, relative to the extent
};

std::vector<Contact> random_feet(Random& random) {
  std::vector<Contact> feet;
  constexpr double steepest = 0.9;  // [rad]
  for (const int side : {-1, 1}) {
    const double lean = random.uniform(-steepest, steepest);
    feet.push_back({{side * random.uniform(0.3, 1), random.uniform(-0.2, 0.2)},
                    {std::sin(lean), std::cos(lean)},
                    random.uniform(0.2, 1.5)});
  }
  return feet;
}

/// Over the feet, from a quarter of their distance below to one above.
Eigen::Vector2d random_com(Random& random, const std::vector<Contact>& feet) {
  const Eigen::Vector2d &a = feet[0].position, &b = feet[1].position, middle = 0.5 * (a + b);
  const double width = std::max(std::abs(b.x() - a.x()), 1e-3 * (b - a).norm());
  return {middle.x() + width * random.uniform(-0.6, 0.6), middle.y() + width * random.uniform(-0.25, 1)};
}

/// A push of a size: heights in [0, size], angle, rates as a fall over size would give.
stability::BodyState push(const HybridBody& body, double size, Random& random) {
  const double d = size * body.extent(), u = std::sqrt(2 * body.gravity() * d);
  const double h1 = random.uniform(0, d), h2 = random.uniform(0, d), angle = random.uniform(-size, size);
  const double u1 = random.uniform(-u, u), u2 = random.uniform(-u, u), spin = random.uniform(-u, u) / body.extent();
  if (!body.parallel_normals()) return body.state_at_heights({h1, h2, angle}, {u1, u2, spin});
  // Level ground: up by what lifts both feet, then turned.
  const double lift = h1 + std::abs(angle) * (body.extent() + (body.ground(0) - body.com()).norm());
  return body.state_at({random.uniform(-d, d), lift, angle}, {u1, u2, spin});
}

}  // namespace

SampleReport sample_pushes(const SampleRequest& request) {
  Random random(request.seed);
  std::array<Counts, classes> counts;
  for (std::uint64_t k = 0; k < request.runs; ++k) {
    const auto contacts = request.contacts.empty() ? random_feet(random) : request.contacts;
    const Eigen::Vector2d com = request.com ? *request.com : random_com(random, contacts);
    const double rho = request.rho > 0 ? request.rho : random.uniform(0.02, 0.4);
    const stability::Posture posture(contacts, rho);
    Counts& count =
        counts[static_cast<std::size_t>(class_of(frictional_verdict(posture, com, request.options.restitution)))];
    const HybridBody body(contacts, com, rho, request.gravity);
    const HybridRun run = stability::simulate(body, push(body, request.size, random), request.options_for(body));
    ++count.runs;
    ++count.outcome[static_cast<std::size_t>(run.outcome)];
    if (run.outcome == HybridRun::Outcome::rest)
      count.farthest = std::max(count.farthest, body.excursion(run.state) / body.extent());
    request.progress(k + 1);
  }
  using gaits::TextTable;
  SampleReport report;
  report.text =
      fmt::format("{} pushes of size {:.3g} (relative to the distance of the feet), restitution {:.6g}, seed {}\n",
                  request.runs, request.size, request.options.restitution, request.seed);
  constexpr auto right = TextTable::Align::right;
  TextTable table({{"", "posture [OR-H, Theorem 3]", TextTable::Align::left},
                   {"", "runs", right},
                   {"", "rest", right},
                   {"", "left", right},
                   {"", "inconsistent", right},
                   {"", "undecided", right},
                   {"", "share at rest", right},
                   {"", "farthest rest [distance of the feet]", right}});
  nlohmann::ordered_json tree;
  tree["surefoot"] = 1;
  tree["runs"] = request.runs, tree["size"] = request.size, tree["restitution"] = request.options.restitution;
  tree["seed"] = request.seed;
  for (std::size_t c = 0; c < classes; ++c) {
    const Counts& count = counts[c];
    std::vector<TextTable::Cell> cells{{class_names[c]}, {std::to_string(count.runs)}};
    for (const auto n : count.outcome) cells.push_back({std::to_string(n)});
    cells.push_back({count.runs > 0 ? fmt::format("{:.2f} %", 100.0 * static_cast<double>(count.outcome[0]) /
                                                                  static_cast<double>(count.runs))
                                    : "-"});
    cells.push_back({count.outcome[0] > 0 ? fmt::format("{:.2g}", count.farthest) : "-"});
    table.add(cells);
    tree["classes"][class_keys[c]] = {{"runs", count.runs},
                                      {"rest", count.outcome[0]},
                                      {"left", count.outcome[1]},
                                      {"inconsistent", count.outcome[2]},
                                      {"undecided", count.outcome[3]},
                                      {"farthest_rest", count.farthest}};
  }
  report.text += '\n' + table.print(false);
  report.json = tree.dump(1) + "\n";
  return report;
}

}  // namespace surefoot::planner
