// Areas of R(W) on many stances. (Error against time, method by method: surefoot-bench region.)
//   bench_region --stances [NAME] region_areas to 1e-6 on every stance of docs/regions.md and of the stored plans of
//                                 the canned scenes: times, proved error, rectangles
//   bench_region --random N       areas of N random postures against grids of oracle calls, within the grids'
//                                 error and the stated one; times
//   bench_region --extremes [N]   the catalogue of extreme postures, every Nth: time and stated error by group
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "bench/region_methods.hpp"
#include "bench/region_stances.hpp"
#include "stability/region.hpp"
#include "tests/support/extreme_cases.hpp"
#include "tests/support/sample_posture.hpp"

namespace {

using namespace surefoot::bench;
using namespace surefoot::stability;
using Eigen::Vector2d;

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Least time of a few runs [ms].
template <class Work>
double least_time(Work&& work) {
  double least = HUGE_VAL, spent = 0;
  for (int run = 0; run < 20 && spent < 200; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double ms = milliseconds_since(begin);
    least = std::min(least, ms);
    spent += ms;
  }
  return least;
}

WrenchBox wrenches(const DisturbanceBox& box) { return {{}, box.kappa, box.nu}; }

RegionOptions without_curves(double tolerance) {
  RegionOptions options;
  options.curves = false;
  options.area_tolerance = tolerance;
  return options;
}

/// One row for a group of stances; the time of a stance is the least of some runs.
void stance_row(const StanceGroup& group) {
  std::vector<double> ms;
  double error = 0;
  int rectangles = 0, proved = 0;
  for (const Stance& stance : group.stances) {
    RegionAreas areas;
    ms.push_back(least_time([&] { areas = region_areas(stance.contacts, stance.rho, wrenches(stance.box)); }));
    const double relative = areas.equilibrium > 0 ? areas.error / areas.equilibrium : 0;
    error = std::max(error, relative);
    rectangles = std::max(rectangles, areas.rectangles);
    proved += relative <= 1e-6;
  }
  std::sort(ms.begin(), ms.end());
  const auto fast = std::upper_bound(ms.begin(), ms.end(), 1.0) - ms.begin();
  std::printf("%s,%zu,%.3f,%.3f,%td,%d,%.1e,%d\n", group.name.c_str(), ms.size(), ms[ms.size() / 2], ms.back(), fast,
              proved, error, rectangles);
}

void stances(const char* name) {
  std::printf(
      "posture or scene,stances,median ms,slowest ms,within 1 ms,proved to 1e-6,greatest error,most rectangles\n");
  for (const auto& groups : {drawn_postures(), canned_stances()})
    for (const StanceGroup& group : groups)
      if (name == nullptr || group.name == name) stance_row(group);
}

int random_postures(int count) {
  using namespace surefoot::testing;
  Sampler sampler(2025);
  int outside = 0, nonempty = 0, noted = 0, proved = 0, cells_proved = 0;
  std::vector<double> areas_ms, region_ms;
  for (int k = 0; k < count; ++k) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(k) % all_kinds.size()]);
    const auto begin = std::chrono::steady_clock::now();
    const RegionAreas areas = region_areas(s.contacts, s.rho, wrenches(s.box), without_curves(1e-6));
    areas_ms.push_back(milliseconds_since(begin));
    const auto middle = std::chrono::steady_clock::now();
    const Region r = region(s.contacts, s.rho, wrenches(s.box));
    region_ms.push_back(milliseconds_since(middle));
    if (r.empty()) continue;
    ++nonempty;
    noted += !r.note.empty();
    proved += areas.error <= 1.01e-6 * areas.equilibrium;
    cells_proved += r.cells_error <= 1e-5 * r.equilibrium_area;
    const Area grid = by_grid(RobustOracle(s.contacts, s.rho, s.box), bounds_of(r.equilibrium), 150);
    const double off = std::abs(grid.value - r.robust_area), apart = std::abs(areas.robust - r.robust_area);
    if (off <= grid.error + r.area_error && apart <= areas.error + r.area_error) continue;
    ++outside;
    std::printf("outside: %.6g, grid %.6g +- %.2g, subdivision %.6g +- %.2g: %s\n", r.robust_area, grid.value,
                grid.error, areas.robust, areas.error, s.json().c_str());
  }
  const auto times = [](const char* what, std::vector<double>& ms) {
    std::sort(ms.begin(), ms.end());
    double sum = 0;
    for (const double t : ms) sum += t;
    std::printf("%s [ms]: median %.3f, mean %.3f, 95 %% %.2f, slowest %.1f\n", what, ms[ms.size() / 2],
                sum / static_cast<double>(ms.size()), ms[ms.size() * 95 / 100], ms.back());
  };
  std::printf(
      "%d postures, %d with a region, %d outside of an error, %d with a note; %d of R(W) proved to 1e-6, all cells of "
      "%d to 1e-5\n",
      count, nonempty, outside, noted, proved, cells_proved);
  times("areas", areas_ms);
  times("region", region_ms);
  return outside == 0 ? 0 : 1;
}

void extremes(std::size_t step) {
  struct Group {
    int cases = 0, regions = 0, statements = 0, noted = 0;
    double areas_ms = 0, region_ms = 0, error = 0, cells_error = 0;
  };
  std::map<std::string, Group> groups;
  const auto catalogue = surefoot::testing::extreme_catalogue();
  for (std::size_t k = 0; k < catalogue.size(); k += step) {
    const auto& extreme = catalogue[k];
    const auto& s = extreme.sample;
    Group& group = groups[extreme.group];
    ++group.cases;
    const auto begin = std::chrono::steady_clock::now();
    const RegionAreas areas = region_areas(s.contacts, s.rho, wrenches(s.box));
    group.areas_ms = std::max(group.areas_ms, milliseconds_since(begin));
    const auto middle = std::chrono::steady_clock::now();
    const Region r = region(s.contacts, s.rho, wrenches(s.box));
    group.region_ms = std::max(group.region_ms, milliseconds_since(middle));
    group.regions += !r.empty();
    group.statements += r.empty() && !r.note.empty();
    group.noted += !r.empty() && !r.note.empty();
    if (r.empty()) continue;
    group.error = std::max(group.error, areas.error / areas.equilibrium);
    group.cells_error = std::max(group.cells_error, r.cells_error / r.equilibrium_area);
  }
  std::printf(
      "group,cases,regions,statements,notes,slowest_areas_ms,slowest_region_ms,greatest_error,greatest_cells_error\n");
  for (const auto& [name, group] : groups)
    std::printf("%s,%d,%d,%d,%d,%.2f,%.2f,%.1e,%.1e\n", name.c_str(), group.cases, group.regions, group.statements,
                group.noted, group.areas_ms, group.region_ms, group.error, group.cells_error);
}

}  // namespace

int main(int count, char** words) {
  if (count == 3 && std::strcmp(words[1], "--random") == 0) return random_postures(std::atoi(words[2]));
  if (count >= 2 && std::strcmp(words[1], "--extremes") == 0) {
    extremes(count == 3 ? std::max<std::size_t>(1, std::strtoul(words[2], nullptr, 10)) : 1);
    return 0;
  }
  if (count >= 2 && std::strcmp(words[1], "--stances") == 0) {
    stances(count == 3 ? words[2] : nullptr);
    return 0;
  }
  std::fprintf(stderr, "usage: bench_region --stances [NAME] | --random N | --extremes [N]\n");
  return 2;
}
