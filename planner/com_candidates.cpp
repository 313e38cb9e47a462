#include "planner/com_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "planner/com_window.hpp"

namespace surefoot::planner {

using Eigen::Vector2d;

namespace {

/// How far inside the ends of a column its ends are tried, as a share of its height: on the end itself some rule is
/// only just kept, or not.
constexpr double draw_in = 0.02;
/// Steps up, each by what clearance lacks, until a COM is clear of the terrain.
constexpr int most_raises = 6;

/// Footholds are fewer than 2^30, levels than 2^4.
std::uint64_t key_of(int low, int high, int level) {
  return static_cast<std::uint64_t>(low) << 34 | static_cast<std::uint64_t>(high) << 4 | static_cast<unsigned>(level);
}

/// The heights at which a vertical line meets a convex polygon.
bool cut(const Polygon& polygon, double x, double& low, double& high) {
  bool met = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    if ((a.x() < x && b.x() < x) || (a.x() > x && b.x() > x)) continue;
    const double y = a.x() == b.x() ? a.y() : a.y() + (b.y() - a.y()) * ((x - a.x()) / (b.x() - a.x()));
    low = met ? std::min(low, y) : y;
    high = met ? std::max(high, y) : y;
    met = true;
  }
  return met;
}

/// The part of a column within reach of a foot.
bool within_reach(const Vector2d& foot, double reach, double x, double& low, double& high) {
  const double d = x - foot.x(), square = reach * reach - d * d;
  if (square <= 0) return false;
  low = std::max(low, foot.y() - std::sqrt(square));
  high = std::min(high, foot.y() + std::sqrt(square));
  return low < high;
}

}  // namespace

ComCandidates::ComCandidates(const gaits::Scene& scene, const FootholdLattice& lattice, int columns,
                             const stability::DisturbanceBox& box)
    : scene_(&scene), lattice_(&lattice), robot_(gaits::drawn_in(scene.robot)), columns_(columns), box_(box) {}

int ComCandidates::pair(int foot, int other, int level) {
  const int low = std::min(foot, other), high = std::max(foot, other);
  const auto [at, fresh] = numbers_.try_emplace(key_of(low, high, level), static_cast<int>(pairs_.size()));
  if (!fresh) return at->second;
  Pair made{low, high, static_cast<std::int32_t>(coms_.size()), 0, level};
  fresh_.clear();
  make_coms(made, fresh_);
  std::stable_sort(fresh_.begin(), fresh_.end(), [](const Com& a, const Com& b) { return a.to_goal < b.to_goal; });
  made.count = static_cast<std::int32_t>(fresh_.size());
  coms_.insert(coms_.end(), fresh_.begin(), fresh_.end());
  pairs_.push_back(made);
  return at->second;
}

int ComCandidates::add(int foot, int other, const Vector2d& com) {
  const int low = std::min(foot, other), high = std::max(foot, other);
  const auto number = static_cast<std::int32_t>(coms_.size());
  coms_.push_back({com, scene_->goal.distance(com)});
  pairs_.push_back({low, high, number, 1, 0});
  return number;
}

void ComCandidates::try_com(const gaits::Feet& feet, const stability::RobustOracle& oracle, const Vector2d& at,
                            std::vector<Com>& coms) {
  if (!gaits::within_reach(robot_, feet, at, at)) return;
  ++asked_;
  if (!gaits::is_stable(*scene_, oracle, at)) return;
  if (scene_->terrain.distance(at, robot_.clearance) < robot_.clearance) return;
  coms.push_back({at, scene_->goal.distance(at)});
}

void ComCandidates::add_columns(int level, const gaits::Feet& feet, const stability::RobustOracle& oracle, const Polygon& polygon,
                                std::vector<Com>& coms) {
  const auto by_x = [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); };
  const auto [left, right] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
  const double x_low = left->x(), width = right->x() - x_low;
  const int columns = columns_ << level;
  for (int i = 0; i < columns; ++i) {
    const double x = x_low + width * (2 * i + 1) / (2 * columns);
    double low = 0, high = 0;
    if (!cut(polygon, x, low, high)) continue;
    bool reached = true;
    for (const auto& foot : feet)
      reached = reached && (!foot || within_reach(foot->position, robot_.reach_max, x, low, high));
    if (!reached) continue;
    const double inset = draw_in * (high - low);
    low += inset, high -= inset;
    for (int k = 0; k < most_raises; ++k) {
      const double lacking = robot_.clearance - scene_->terrain.distance({x, low}, robot_.clearance);
      if (lacking <= 0) break;
      low += 1.01 * lacking;
    }
    if (low > high) continue;
    // Low COMs reach farthest; above, the odd multiples of a fraction of the height that is halved with each level.
    const int parts = 2 << level;
    try_com(feet, oracle, {x, low}, coms);
    for (int j = 1; j <= parts; j += 2) try_com(feet, oracle, {x, low + (high - low) * j / parts}, coms);
    if (level == 0) try_com(feet, oracle, {x, high}, coms);
  }
}

void ComCandidates::make_coms(const Pair& pair, std::vector<Com>& coms) {
  gaits::Feet feet;
  feet[0] = (*lattice_)[pair.first_foot];
  feet[1] = (*lattice_)[pair.second_foot];
  if ((feet[0]->position - feet[1]->position).norm() >= 2 * robot_.reach_max) return;
  const Polygon window = reach_window(feet, robot_.reach_max);
  if (window.empty()) return;
  const auto oracle = gaits::oracle_of(*scene_, feet, box_);
  const Polygon polygon = oracle.equilibrium_polygon(window);
  if (polygon.empty()) return;
  add_columns(pair.level, feet, oracle, polygon, coms);
  if (const Polygon in_goal = clip_to_goal(polygon, scene_->goal); !in_goal.empty())
    add_columns(pair.level, feet, oracle, in_goal, coms);
}

}  // namespace surefoot::planner
