#include "planner/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "gaits/verifier.hpp"

namespace surefoot::planner {
namespace {

using Clock = std::chrono::steady_clock;

/// How far a number is changed at most: beyond it is another robot, or another ground.
double greatest_change(Remedy remedy) { return remedy == Remedy::friction ? 8 : remedy == Remedy::reach ? 4 : 16; }
bool grows(Remedy remedy) { return remedy == Remedy::friction || remedy == Remedy::reach; }

/// Two decimals: what is tried is what is told.
double factor_of(Remedy remedy, double change) { return std::round(100 * (grows(remedy) ? change : 1 / change)) / 100; }

terrain::Terrain with_friction(const terrain::Terrain& ground, double factor) {
  std::vector<terrain::Chain> chains(static_cast<std::size_t>(ground.chain_count()));
  for (const terrain::Segment& segment : ground.segments()) {
    terrain::Chain& chain = chains[static_cast<std::size_t>(segment.chain)];
    if (chain.vertices.empty()) chain.vertices.push_back(segment.a);
    chain.vertices.push_back(segment.b);
    chain.surfaces.push_back({factor * segment.surface.friction, segment.surface.foothold});
  }
  return terrain::Terrain(std::move(chains));
}

std::string words(const gaits::Scene& scene, Remedy remedy, double factor) {
  const auto instead = [factor](const char* what, double value) {
    return fmt::format("{} {:.6g} instead of {:.6g}", what, factor * value, value);
  };
  switch (remedy) {
    case Remedy::friction: {
      const auto& segments = scene.terrain.segments();
      const double first = segments.front().surface.friction;
      const bool one = std::all_of(segments.begin(), segments.end(),
                                   [first](const auto& segment) { return segment.surface.friction == first; });
      return one ? instead("friction", first) : fmt::format("all friction times {:.6g}", factor);
    }
    case Remedy::reach: return instead("reach", scene.robot.reach_max);
    case Remedy::disturbances:
      return fmt::format("disturbances times {:.6g} (kappa {:.6g}, nu {:.6g})", factor,
                         factor * scene.disturbance.kappa, factor * scene.disturbance.nu);
    case Remedy::clearance: return instead("clearance", scene.robot.clearance);
    case Remedy::equilibrium:
      return "stability: {criterion: equilibrium}, for a robot that braces actively: balance alone is asked for";
  }
  return {};
}

class Trials {
 public:
  Trials(const gaits::Scene& scene, const SearchOptions& options)
      : scene_(scene), options_(options), deadline_(deadline_after(Clock::now(), options.time_limit)) {}

  /// The least change that does, to remedy_step; nothing where none does.
  std::optional<RemedyFound> find(Remedy remedy) const {
    if (remedy == Remedy::clearance && scene_.robot.clearance == 0) return std::nullopt;
    if (remedy == Remedy::disturbances && scene_.disturbance.kappa == 0 && scene_.disturbance.nu == 0)
      return std::nullopt;
    if (remedy == Remedy::equilibrium) {
      if (scene_.criterion != gaits::Criterion::robust || !does(remedy, 1)) return std::nullopt;
      return RemedyFound{remedy, 1, words(scene_, remedy, 1)};
    }
    double too_little = 1, enough = greatest_change(remedy);
    if (!does(remedy, factor_of(remedy, enough))) return std::nullopt;
    while (enough > remedy_step * too_little && !stopped()) {
      const double change = std::sqrt(too_little * enough);
      (does(remedy, factor_of(remedy, change)) ? enough : too_little) = change;
    }
    const double factor = factor_of(remedy, enough);
    return RemedyFound{remedy, factor, words(scene_, remedy, factor)};
  }

  bool stopped() const { return Clock::now() >= deadline_ || options_.interrupted(); }

 private:
  bool does(Remedy remedy, double factor) const {
    if (stopped()) return false;
    const std::chrono::duration<double> left = deadline_ - Clock::now();
    SearchOptions options{.seed = options_.seed, .time_limit = left.count(), .planner = options_.planner};
    options.effort = 0;
    options.interrupted = options_.interrupted;
    try {
      const gaits::Scene scene = changed(scene_, remedy, factor);
      const gaits::Plan plan = search(scene, options);
      return plan.status == gaits::Status::solved && gaits::verify(scene, plan).holds();
    } catch (const terrain::InputError&) {  // the start is none for that robot
      return false;
    }
  }

  const gaits::Scene& scene_;
  const SearchOptions& options_;
  Clock::time_point deadline_;
};

}  // namespace

gaits::Scene changed(const gaits::Scene& scene, Remedy remedy, double factor) {
  gaits::Scene result{.file = scene.file,
                      .name = scene.name,
                      .terrain = with_friction(scene.terrain, remedy == Remedy::friction ? factor : 1),
                      .robot = scene.robot,
                      .disturbance = scene.disturbance,
                      .criterion = scene.criterion,
                      .restitution = scene.restitution,
                      .start = scene.start,
                      .goal = scene.goal,
                      .search = scene.search};
  for (auto& foot : result.start.feet)
    if (foot) foot->friction = result.terrain.segment(foot->chain, foot->segment).surface.friction;
  if (remedy == Remedy::equilibrium) result.criterion = gaits::Criterion::equilibrium;
  if (remedy == Remedy::reach) result.robot.reach_max *= factor;
  if (remedy == Remedy::clearance) result.robot.clearance *= factor;
  if (remedy == Remedy::disturbances) {
    result.disturbance.kappa *= factor;
    result.disturbance.nu *= factor;
  }
  return result;
}

Remedies remedies(const gaits::Scene& scene, const SearchOptions& options) {
  const Trials trials(scene, options);
  Remedies result;
  const auto balance = trials.find(Remedy::equilibrium);  // one search, while there is time for it; told last
  for (const Remedy remedy : {Remedy::friction, Remedy::reach, Remedy::disturbances, Remedy::clearance})
    if (const auto one = trials.find(remedy)) result.found.push_back(*one);
  if (balance) result.found.push_back(*balance);
  result.cut_off = trials.stopped();
  return result;
}

}  // namespace surefoot::planner
