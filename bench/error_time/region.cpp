// Area of R(W): relative error over time, by grids, quadtrees and the methods of stability/region.hpp.
#include "stability/region.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/error_time/items.hpp"
#include "bench/region_methods.hpp"
#include "bench/region_stances.hpp"
#include "tests/support/region_reference.hpp"

namespace surefoot::bench {
namespace {

stability::WrenchBox wrenches(const stability::DisturbanceBox& box) { return {{}, box.kappa, box.nu}; }

stability::RegionOptions areas_to(double tolerance) {
  stability::RegionOptions options;
  options.curves = false;
  options.area_tolerance = tolerance;
  return options;
}

void measure_stance(Rows& rows, const Stance& stance, bool quick) {
  const auto whole = region(stance.contacts, stance.rho, wrenches(stance.box), areas_to(1e-6));
  const stability::RobustOracle oracle(stance.contacts, stance.rho, stance.box);
  const double unit = whole.equilibrium_area;
  const auto truth = testing::reference_area(oracle, whole.equilibrium, (quick ? 1e-7 : 1e-9) * unit);
  const auto add = [&](const char* method, const std::string& parameter, auto&& find) {
    const Area found = find();
    const Timing time = median_time([&] { keep(find()); }, {quick ? 0.03 : 0.2, 3, 51});
    rows.add(
        stance.name, method, parameter, std::abs(found.value - truth.area) / unit, time,
        fmt::format("area {:.10g} m^2, its own error {:.1e}; reference {:.10g}, its error {:.1e} (errors over R_SS(W))",
                    found.value, found.error / unit, truth.area, truth.error / unit));
  };
  const auto box = bounds_of(whole.equilibrium);
  for (const int n : {10, 30, 100, 300, 1000})
    if (!quick || n <= 300)
      add("grid of n x n oracle calls", fmt::format("n = {}", n), [&, n] { return by_grid(oracle, box, n); });
  for (const int depth : {4, 6, 8, 10, 12})
    if (!quick || depth <= 8)
      add("quadtree of certificates", fmt::format("depth {}", depth),
          [&, depth] { return by_quadtree(stance, box, depth); });
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8})
    add("surefoot, subdivision (areas, proved)", "to " + power_of_ten(tolerance), [&, tolerance] {
      const auto areas = region_areas(stance.contacts, stance.rho, wrenches(stance.box), areas_to(tolerance));
      return Area{areas.robust, areas.error};
    });
  for (const double tolerance : {1e-3, 1e-6, 1e-9})
    add("surefoot, sweep alone", "to " + power_of_ten(tolerance),
        [&, tolerance] { return by_sweep(stance, tolerance); });
  add("surefoot, region with cells and curves", "to 1e-6", [&] {
    const auto found = region(stance.contacts, stance.rho, wrenches(stance.box));
    return Area{found.robust_area, found.area_error};
  });
}

constexpr std::array shown{"uneven_rho_0.1", "vee_rho_0.1", "three_contacts"};  // of docs/figures/postures

void measure(Rows& rows, bool quick) {
  for (const StanceGroup& group : drawn_postures())
    for (Stance stance : group.stances)
      if (std::find(shown.begin(), shown.end(), group.name) != shown.end()) {
        stance.name = group.name;
        measure_stance(rows, stance, quick);
      }
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const char* name : shown) {
    const Row* areas = rows.find(name, "surefoot, subdivision (areas, proved)", "to 1e-6");
    const Row *grid = nullptr, *tree = nullptr;
    for (const Row& row : rows.all()) {
      if (row.scenario != name) continue;
      if (row.method.starts_with("grid")) grid = &row;
      if (row.method.starts_with("quadtree")) tree = &row;
    }
    text += fmt::format(
        "- {}: areas to 1e-6 in {:.3g} ms (error seen {:.1e}); the finest grid {:.1e} in {:.3g} ms ({}), the deepest "
        "quadtree {:.1e} in {:.3g} ms.\n",
        name, 1e3 * areas->time.seconds, areas->error, grid->error, 1e3 * grid->time.seconds, grid->parameter,
        tree->error, 1e3 * tree->time.seconds);
  }
  return text;
}

}  // namespace

const Item region_item{"region",
                       "Area of R(W): relative error against time",
                       "an integral of the oracle's exact verdicts over level lines "
                       "(tests/support/region_reference.hpp), good to the error in column "
                       "note: errors below it say no more",
                       "error of the area over that of R_SS(W)",
                       "time per stance",
                       1e-3,
                       measure,
                       findings};

}  // namespace surefoot::bench
