#include "tests/support/known_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"

namespace surefoot::testing {

using Eigen::Vector2d;
using gaits::Plan;
using gaits::Scene;

namespace {

double distance_to_line(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double squared = d.squaredNorm();
  const double part = squared > 0 ? std::clamp((point - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (point - a - part * d).norm();
}

/// The same stances in the opposite order.
Plan backwards(const Plan& plan) {
  Plan back = plan;
  std::reverse(back.stances.begin(), back.stances.end());
  for (std::size_t k = 0; k < plan.transfers.size(); ++k) {
    const std::size_t from = plan.transfers.size() - 1 - k;
    const gaits::Transfer& forth = plan.transfers[from];
    const gaits::Feet during = feet_during(plan.stances[from], forth);
    back.transfers[k].leg = forth.lift;
    back.transfers[k].foothold = *during[static_cast<std::size_t>(forth.lift)];
    back.transfers[k].lift = forth.leg;
  }
  return back;
}

void start_at(Scene& scene, const gaits::Stance& stance) {
  scene.start.feet = stance.feet;
  scene.start.com = stance.com;
  std::vector<int> legs;
  for (int leg = 0; leg < gaits::leg_count; ++leg)
    if (stance.feet[static_cast<std::size_t>(leg)]) legs.push_back(leg);
  scene.start.support = std::pair(legs.at(0), legs.at(1));
}

void end_at(Scene& scene, const Vector2d& com) {
  scene.goal.com_x = {com.x(), com.x()};
  scene.goal.com_y = {com.y(), com.y()};
}

void draw_reach_in(Scene& scene, const Plan& plan) {
  double greatest = 0, least = std::numeric_limits<double>::infinity();
  const auto include = [&](const gaits::Feet& feet, const Vector2d& a, const Vector2d& b) {
    for (const auto& foot : feet) {
      if (!foot) continue;
      greatest = std::max({greatest, (foot->position - a).norm(), (foot->position - b).norm()});
      least = std::min(least, distance_to_line(foot->position, a, b));
    }
  };
  for (const gaits::Stance& stance : plan.stances) include(stance.feet, stance.com, stance.com);
  for (std::size_t k = 0; k < plan.transfers.size(); ++k)
    include(feet_during(plan.stances[k], plan.transfers[k]), plan.stances[k].com, plan.stances[k + 1].com);
  scene.robot.reach_max = greatest;
  scene.robot.reach_min = least;
}

void raise_clearance(Scene& scene, const Plan& plan) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < plan.stances.size(); ++k)
    least = std::min(least, scene.terrain.distance(plan.stances[k].com,
                                                   plan.stances[std::min(k + 1, plan.stances.size() - 1)].com, 1e3));
  scene.robot.clearance = least;
}

void raise_disturbance(Scene& scene, Plan& plan) {
  rate(scene, plan);
  if (!std::isfinite(plan.safety_factor)) return;
  scene.disturbance.kappa *= plan.safety_factor * (1 - 1e-9);
  scene.disturbance.nu *= plan.safety_factor * (1 - 1e-9);
}

/// Cuts segments beside the footholds in use and bars the rest.
void bar_other_footholds(Scene& scene, Plan& plan, double around) {
  std::vector<std::set<double>> used(static_cast<std::size_t>(scene.terrain.chain_count()));
  const auto each = [&](auto&& change) {
    for (auto& foot : scene.start.feet)
      if (foot) change(*foot);
    for (gaits::Stance& stance : plan.stances)
      for (auto& foot : stance.feet)
        if (foot) change(*foot);
    for (gaits::Transfer& transfer : plan.transfers) change(transfer.foothold);
  };
  each([&](terrain::Foothold& foot) { used[static_cast<std::size_t>(foot.chain)].insert(foot.s); });
  std::vector<terrain::Chain> chains(used.size());
  for (const terrain::Segment& segment : scene.terrain.segments()) {
    terrain::Chain& chain = chains[static_cast<std::size_t>(segment.chain)];
    const auto& here = used[static_cast<std::size_t>(segment.chain)];
    const auto bars = [&](double s) {
      return std::none_of(here.begin(), here.end(), [&](double at) { return std::abs(at - s) < around; });
    };
    std::set<double> cuts{0};
    for (const double s : here)
      for (const double cut : {s - around - segment.s_begin, s + around - segment.s_begin})
        if (cut > around / 2 && cut < segment.length - around / 2) cuts.insert(cut);
    for (auto cut = cuts.begin(); cut != cuts.end(); ++cut) {
      const double end = std::next(cut) == cuts.end() ? segment.length : *std::next(cut);
      chain.vertices.push_back(segment.a + *cut * segment.tangent);
      terrain::Surface surface = segment.surface;
      const double middle = segment.s_begin + (*cut + end) / 2;
      surface.foothold = surface.foothold && !bars(middle);
      chain.surfaces.push_back(surface);
    }
    const bool last =
        segment.index + 1 ==
        static_cast<int>(std::count_if(scene.terrain.segments().begin(), scene.terrain.segments().end(),
                                       [&](const terrain::Segment& other) { return other.chain == segment.chain; }));
    if (last) chain.vertices.push_back(segment.b);
  }
  terrain::Terrain cut(std::move(chains));
  each([&](terrain::Foothold& foot) {
    if (const auto again = cut.foothold_at(foot.chain, foot.s)) foot = *again;
  });
  scene.terrain = std::move(cut);
}

}  // namespace

std::pair<double, double> crossing(const Scene& scene) {
  constexpr double aside = 1e-3;  // [m]
  if (!scene.goal.com_x) return {0, 0};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& foot : scene.start.feet) {
    if (!foot) continue;
    low = std::min(low, foot->position.x() - scene.robot.reach_max);
    high = std::max(high, foot->position.x() + scene.robot.reach_max);
  }
  if (scene.start.com) low = high = scene.start.com->x();
  if (high + aside < scene.goal.com_x->first) return {high + aside, scene.goal.com_x->first};
  if (low - aside > scene.goal.com_x->second) return {low - aside, scene.goal.com_x->second};
  return {0, 0};
}

std::vector<KnownPlan> hard_scenes(const std::string& text, const Plan& plan, double around) {
  std::vector<KnownPlan> found;
  const auto add = [&](const std::string& what, auto&&... changes) {
    KnownPlan known{what, gaits::parse_scene(text, what), plan};
    (changes(known.scene, known.plan), ...);
    rate(known.scene, known.plan);
    if (verify(known.scene, known.plan).holds()) found.push_back(std::move(known));
  };
  const auto back = [](Scene& scene, Plan& own) {
    own = backwards(own);
    start_at(scene, own.stances.front());
    const Vector2d com = own.stances.back().com;
    if (scene.goal.com_x) scene.goal.com_x = {com.x() - 0.05, com.x() + 0.05};
    if (scene.goal.com_y) scene.goal.com_y = {com.y() - 0.05, com.y() + 0.05};
  };
  const auto ends = [](Scene& scene, Plan& own) {
    start_at(scene, own.stances.front());
    end_at(scene, own.stances.back().com);
  };
  const auto reach = [](Scene& scene, Plan& own) { draw_reach_in(scene, own); };
  const auto clearance = [](Scene& scene, Plan& own) { raise_clearance(scene, own); };
  const auto disturbance = [](Scene& scene, Plan& own) { raise_disturbance(scene, own); };
  const auto footholds = [&](Scene& scene, Plan& own) { bar_other_footholds(scene, own, around); };
  add("as given");
  add("the way back", back);
  add("exact ends", ends);
  add("least reach", reach);
  add("greatest clearance", clearance);
  add("greatest disturbance", disturbance);
  add("no other footholds", footholds);
  add("all of these", footholds, ends, reach, clearance, disturbance);
  add("the way back, all of these", back, footholds, ends, reach, clearance, disturbance);
  return found;
}

}  // namespace surefoot::testing
