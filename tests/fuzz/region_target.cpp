#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/posture_input.hpp"
#include "stability/region.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

namespace {

using stability::Region;
using stability::RobustOracle;

/// Of areas that are sums of many: far above the rounding of a sum.
double slack(const Region& region) { return 1e-9 * region.equilibrium_area; }

void expect_sound_areas(const Region& region, const stability::RegionAreas& areas) {
  const double error = region.area_error + areas.error + slack(region);
  expect(region.area_error >= 0 && region.cells_error >= 0 && areas.error >= 0, "errors are bounds");
  expect(std::abs(region.equilibrium_area - areas.equilibrium) <= error, "one area of equilibria");
  expect(std::abs(region.robust_area - areas.robust) <= error, "one robust area");
  expect(region.robust_area <= region.equilibrium_area + error, "what is robust is in equilibrium");
  double sum = 0;
  for (const auto& cell : region.cells) sum += cell.area;
  expect(std::abs(sum - region.equilibrium_area) <= region.cells_error + error, "cells make up the region");
}

void expect_sound_cells(const Region& region, const RobustOracle& oracle) {
  for (const auto& cell : region.cells) {
    if (!cell.confirmed) continue;
    expect(oracle.equilibrium(cell.inside), "a cell is in equilibrium");
    expect(oracle.robust(cell.inside) == cell.modes.empty(), "a cell without modes is robust, and no other");
    auto modes = oracle.feasible_modes(cell.inside);
    expect(std::is_permutation(modes.begin(), modes.end(), cell.modes.begin(), cell.modes.end()), "a cell's modes");
  }
}

/// Where squares of areas are ordinary doubles; of others it is promised that they are survived.
bool ordinary(const planner::DisturbedPosture& posture) {
  constexpr double most = 1e6, least = 1e-6;
  if (posture.rho < least || posture.rho > most || posture.box.kappa > most || posture.box.nu > most) return false;
  return std::all_of(posture.contacts.begin(), posture.contacts.end(), [](const stability::Contact& contact) {
    return contact.position.lpNorm<Eigen::Infinity>() <= most && contact.friction <= most;
  });
}

}  // namespace

void region(std::string_view bytes) {
  const auto posture = read_located(bytes, planner::read_disturbed_posture);
  if (!posture) return;
  stability::RegionOptions options;
  options.area_tolerance = options.curve_tolerance = 1e-2;  // cheap
  const stability::WrenchBox box{{}, posture->box.kappa, posture->box.nu};
  const Region region = stability::region(posture->contacts, posture->rho, box, options);
  const auto areas = stability::region_areas(posture->contacts, posture->rho, box, options);
  if (!ordinary(*posture)) return;
  expect_sound_areas(region, areas);
  expect_sound_cells(region, RobustOracle(posture->contacts, posture->rho, posture->box));
}

}  // namespace surefoot::fuzz
