#include "planner/com_candidates.hpp"

#include <algorithm>
#include <cmath>

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

/// Stable. Mostly few, and in the order wanted or the reverse.
template <class Item>
void nearest_first(std::vector<Item>& items) {
  const auto nearer = [](const Item& a, const Item& b) { return a.to_goal < b.to_goal; };
  const auto not_farther = [](const Item& a, const Item& b) { return a.to_goal <= b.to_goal; };
  if (std::is_sorted(items.begin(), items.end(), nearer)) return;
  if (std::adjacent_find(items.begin(), items.end(), not_farther) == items.end())
    std::reverse(items.begin(), items.end());
  else std::stable_sort(items.begin(), items.end(), nearer);
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

ComCandidates::Pair ComCandidates::made(int foot, int other, int level) const {
  const double a = scene_->goal.distance((*lattice_)[foot].position),
               b = scene_->goal.distance((*lattice_)[other].position);
  return {std::min(foot, other), std::max(foot, other), level, std::max(a, b), std::min(a, b)};
}

int ComCandidates::pair(int foot, int other, int level) {
  const int low = std::min(foot, other), high = std::max(foot, other);
  const auto [at, fresh] = numbers_.try_emplace(key_of(low, high, level), static_cast<int>(pairs_.size()));
  if (!fresh) return at->second;
  pairs_.push_back(made(low, high, level));
  pairs_.back().shape = make_shape(pairs_.back());
  pairs_.back().balances = pairs_.back().shape >= 0;
  return at->second;
}

int ComCandidates::add(int foot, int other, const Vector2d& com) {
  const auto number = static_cast<std::int32_t>(coms_.size());
  coms_.push_back({com, scene_->goal.distance(com), -1, -1, Verdict::holds});
  pairs_.push_back(made(foot, other, 0));
  pairs_.back().first = pairs_.back().last = number;
  return number;
}

std::int32_t ComCandidates::next(int number, std::int32_t com) {
  Pair& pair = pairs_[static_cast<std::size_t>(number)];
  const auto known = [&] { return com < 0 ? pair.first : coms_[static_cast<std::size_t>(com)].after; };
  while (known() < 0 && pair.shape >= 0) make_coms(pair);
  return known();
}

gaits::Feet ComCandidates::feet_of(const Pair& pair) const {
  gaits::Feet feet;
  feet[0] = (*lattice_)[pair.first_foot];
  feet[1] = (*lattice_)[pair.second_foot];
  return feet;
}

std::int32_t ComCandidates::make_shape(const Pair& pair) {
  const gaits::Feet feet = feet_of(pair);
  if ((feet[0]->position - feet[1]->position).norm() >= 2 * robot_.reach_max) return -1;
  const Polygon window = reach_window(feet, robot_.reach_max);
  if (window.empty()) return -1;
  Shape shape;
  shape.whole = gaits::oracle_of(*scene_, feet, box_).equilibrium_polygon(window);
  if (shape.whole.empty()) return -1;
  if (scene_->goal.distance(0.5 * (feet[0]->position + feet[1]->position)) <= 2 * robot_.reach_max)
    shape.in_goal = clip_to_goal(shape.whole, scene_->goal);
  list_columns(pair.level, shape.whole, false, shape.columns);
  if (!shape.in_goal.empty()) list_columns(pair.level, shape.in_goal, true, shape.columns);
  nearest_first(shape.columns);
  std::reverse(shape.columns.begin(), shape.columns.end());
  if (free_shapes_.empty()) {
    shapes_.push_back(std::move(shape));
    return static_cast<std::int32_t>(shapes_.size()) - 1;
  }
  const std::int32_t number = free_shapes_.back();
  free_shapes_.pop_back();
  shapes_[static_cast<std::size_t>(number)] = std::move(shape);
  return number;
}

void ComCandidates::list_columns(int level, const Polygon& polygon, bool in_goal, std::vector<Column>& columns) const {
  const auto by_x = [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); };
  const auto [left, right] = std::minmax_element(polygon.begin(), polygon.end(), by_x);
  const double x_low = left->x(), width = right->x() - x_low;
  const int count = columns_ << level;
  columns.reserve(columns.size() + static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double x = x_low + width * (2 * i + 1) / (2 * count);
    // With a goal of heights, how near a column comes is not known before its COMs are.
    const double to_goal = scene_->goal.com_y ? 0 : scene_->goal.distance({x, 0});
    columns.push_back({x, to_goal, in_goal});
  }
}

/// Those of the next column; of all, where the columns do not lie in the order of their COMs.
void ComCandidates::make_coms(Pair& pair) {
  Shape& shape = shapes_[static_cast<std::size_t>(pair.shape)];
  const gaits::Feet feet = feet_of(pair);
  fresh_.clear();
  do {
    const Column column = shape.columns.back();
    shape.columns.pop_back();
    fill_column(pair.level, feet, column.in_goal ? shape.in_goal : shape.whole, column.x);
  } while (!shape.columns.empty() && (fresh_.empty() || scene_->goal.com_y));
  if (scene_->goal.com_y) nearest_first(fresh_);  // otherwise those of a column are equally near
  for (const Com& com : fresh_) {
    const auto number = static_cast<std::int32_t>(coms_.size());
    (pair.last < 0 ? pair.first : coms_[static_cast<std::size_t>(pair.last)].after) = number;
    pair.last = number;
    coms_.push_back(com);
  }
  if (!shape.columns.empty()) return;
  shape = {};
  free_shapes_.push_back(pair.shape);
  pair.shape = -1;
}

bool ComCandidates::holds(int number, std::int32_t of_com) {
  Com& com = coms_[static_cast<std::size_t>(of_com)];
  if (com.verdict != Verdict::open) return com.verdict == Verdict::holds;
  ++asked_;
  const gaits::Feet feet = feet_of(pairs_[static_cast<std::size_t>(number)]);
  if (scene_->terrain.distance(com.at, robot_.clearance) < robot_.clearance) com.verdict = Verdict::too_near;
  else
    com.verdict =
        gaits::is_stable(*scene_, gaits::oracle_of(*scene_, feet, box_), com.at) ? Verdict::holds : Verdict::unstable;
  return com.verdict == Verdict::holds;
}

std::int32_t ComCandidates::try_one(int number, const Vector2d& at) {
  if (!gaits::within_reach(robot_, feet_of(pairs_[static_cast<std::size_t>(number)]), at, at)) return -1;
  coms_.push_back({at, scene_->goal.distance(at)});
  const auto com = static_cast<std::int32_t>(coms_.size()) - 1;
  return holds(number, com) ? com : -1;
}

void ComCandidates::fill_column(int level, const gaits::Feet& feet, const Polygon& polygon, double x) {
  double low = 0, high = 0;
  if (!cut(polygon, x, low, high)) return;
  for (const auto& foot : feet)
    if (foot && !within_reach(foot->position, robot_.reach_max, x, low, high)) return;
  const double inset = draw_in * (high - low);
  low += inset, high -= inset;
  for (int k = 0; k < most_raises; ++k) {
    const double lacking = robot_.clearance - scene_->terrain.distance({x, low}, robot_.clearance);
    if (lacking <= 0) break;
    low += 1.01 * lacking;
  }
  if (low > high) return;
  // Low COMs reach farthest; above, the odd multiples of a fraction of the height that is halved with each level.
  const int parts = 2 << level;
  const auto note = [&](double y) {
    const Vector2d at(x, y);
    if (gaits::within_reach(robot_, feet, at, at)) fresh_.push_back({at, scene_->goal.distance(at)});
  };
  note(low);
  for (int j = 1; j <= parts; j += 2) note(low + (high - low) * j / parts);
  if (level == 0) note(high);
}

}  // namespace surefoot::planner
