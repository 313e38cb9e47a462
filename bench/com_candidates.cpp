// What it costs the planner to try COMs and be refused, against the region they might be drawn from. For every canned
// scene with a stored plan: the footholds that a lattice offers about the plan's COMs, all pairs of them; the COMs that
// ComCandidates offers on each pair, how many of them hold, and its time beside that of region_areas to 1e-3 (an
// upper bound of what drawing can save: all refusals). CSV on stdout.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <vector>

#include "gaits/plan_io.hpp"
#include "planner/com_candidates.hpp"
#include "stability/region.hpp"

namespace fs = std::filesystem;
using namespace surefoot;
using Clock = std::chrono::steady_clock;

namespace {

double microseconds_since(Clock::time_point begin) {
  return 1e6 * std::chrono::duration<double>(Clock::now() - begin).count();
}

void row(const gaits::Scene& scene, const gaits::Plan& plan) {
  constexpr double spacing = 0.15, inset = 0.02;  // of the reach: those of planner/anytime_search.cpp
  constexpr int columns = 5, every = 20;          // regions are timed of every 20th pair
  planner::FootholdLattice lattice(scene.terrain, spacing * scene.robot.reach_max, inset * scene.robot.reach_max);
  planner::ComCandidates coms(scene, lattice, columns, scene.disturbance);
  std::set<std::pair<int, int>> pairs;
  std::vector<int> near;
  for (const gaits::Stance& stance : plan.stances) {
    near.clear();
    lattice.look_from(stance.com, scene.robot.reach_min, scene.robot.reach_max);
    lattice.list(0, near);
    for (const int a : near)
      for (const int b : near)
        if (a < b) pairs.insert({a, b});
  }
  const auto begin = Clock::now();
  std::size_t with_coms = 0, kept = 0;
  std::set<std::pair<int, int>> standable;
  for (const auto& [a, b] : pairs) {
    const int pair = coms.pair(a, b, 0);
    const std::size_t before = kept;
    for (std::int32_t com = coms.next(pair, -1); com >= 0; com = coms.next(pair, com)) kept += coms.holds(pair, com);
    with_coms += kept > before;
    if (kept > before) standable.insert({a, b});
  }
  const double candidates_us = microseconds_since(begin);
  double region_us = 0;
  std::size_t regions = 0, k = 0;
  for (const auto& [a, b] : standable) {
    if (k++ % every != 0) continue;
    const stability::Contact contacts[] = {gaits::contact_at(lattice[a]), gaits::contact_at(lattice[b])};
    stability::RegionOptions options;
    options.area_tolerance = 1e-3;
    const auto start = Clock::now();
    stability::region_areas(contacts, scene.robot.radius_of_gyration,
                            {{}, scene.disturbance.kappa, scene.disturbance.nu}, options);
    region_us += microseconds_since(start);
    ++regions;
  }
  const auto asked = static_cast<double>(coms.asked());
  std::printf("%s,%zu,%zu,%.0f,%.1f,%.2f,%.3f,%.0f\n", scene.name.c_str(), pairs.size(), with_coms, asked,
              100 * (1 - static_cast<double>(kept) / asked), candidates_us / static_cast<double>(pairs.size()),
              candidates_us / asked, regions > 0 ? region_us / static_cast<double>(regions) : 0);
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::printf("scene,pairs,with COMs,COMs asked,refused %%,us per pair,us per COM asked,us per region\n");
  std::vector<fs::path> plans;
  for (const auto& entry : fs::directory_iterator(SUREFOOT_PLANS)) plans.push_back(entry.path());
  std::sort(plans.begin(), plans.end());
  for (const fs::path& path : plans)
    row(gaits::load_scene(fs::path(SUREFOOT_MAPS) / path.stem().concat(".yaml")), gaits::read_plan(path));
}
