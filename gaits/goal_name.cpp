#include "gaits/goal_name.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "terrain/back_faces.hpp"

namespace surefoot::gaits {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double name_width = 30;  // [px]

/// What letters cover [px] that stand on the middle of a line at `at`.
AlignedBox2d letters(const Vector2d& at, double width) {
  constexpr double height = 10;
  return {at - Vector2d(width / 2, height), at + Vector2d(width / 2, 0)};
}

/// The waypoints of a row and their labels [px].
std::vector<AlignedBox2d> waypoint_boxes(const Plan& plan, const PageRow& row) {
  constexpr double number_width = 18, start_width = 30;
  std::vector<AlignedBox2d> boxes;
  for (const int k : row.stances) {
    const Vector2d at = row.view(plan.stances[k].com);
    boxes.emplace_back(at.array() - ring_radius, at.array() + ring_radius);
    boxes.push_back(letters(at - Vector2d(0, number_above), number_width));
    if (k == 0) boxes.push_back(letters(at - Vector2d(0, start_above), start_width));
  }
  return boxes;
}

/// Lines [px] on which the name may stand, the best first.
std::vector<Vector2d> lines_of(const PageRow& row, const AlignedBox2d& goal) {
  constexpr double line = 18, beneath_edge = 15, above_edge = 4;
  constexpr int most = 50;
  const Vector2d left = row.view({goal.min().x(), goal.max().y()}), right = row.view({goal.max().x(), goal.min().y()});
  const double x = (left.x() + right.x()) / 2, top = left.y(), bottom = right.y(), middle = (top + bottom) / 2 + 4;
  std::vector<Vector2d> lines{{x, top + beneath_edge}};
  for (int k = 1; k < most && top + (k + 1) * line <= bottom; ++k) lines.emplace_back(x, top + beneath_edge + k * line);
  for (const double further : {0.0, line, 2 * line}) {
    lines.emplace_back(x, top - above_edge - further);
    lines.emplace_back(x, bottom + beneath_edge + further);
    lines.emplace_back(right.x() + above_edge + name_width / 2 + further, middle);
    lines.emplace_back(left.x() - above_edge - name_width / 2 - further, middle);
  }
  return lines;
}

/// Whether a name would stand in solid ground, in part at least.
bool in_solid_ground(const terrain::Terrain& terrain, const PageRow& row, const AlignedBox2d& name) {
  const Vector2d corner = row.view({row.window.min().x(), row.window.max().y()});
  const Vector2d opposite = row.view({row.window.max().x(), row.window.min().y()});
  const Vector2d scale = (opposite - corner).cwiseQuotient(row.window.sizes());  // [px/m]
  const double y = row.window.max().y() - (name.center().y() - corner.y()) / scale.y();
  for (const double px : {name.min().x(), name.center().x(), name.max().x()}) {
    const Vector2d at(row.window.min().x() + (px - corner.x()) / scale.x(), y);
    if (terrain::solid_around(terrain, AlignedBox2d(at))) return true;
  }
  return false;
}

}  // namespace

Vector2d goal_name_place(const Scene& scene, const Plan& plan, const PageRow& row, const AlignedBox2d& goal) {
  constexpr std::size_t many = 100'000;  // segments, of which each line asks all
  const std::vector<Vector2d> lines = lines_of(row, goal);
  if (scene.terrain.segments().size() > many) return lines.front();
  const std::vector<AlignedBox2d> taken = waypoint_boxes(plan, row);
  const AlignedBox2d page(row.view({row.window.min().x(), row.window.max().y()}),
                          row.view({row.window.max().x(), row.window.min().y()}));
  std::optional<Vector2d> second_best;
  for (const Vector2d& at : lines) {
    const AlignedBox2d name = letters(at, name_width);
    if (!page.contains(name) || in_solid_ground(scene.terrain, row, name)) continue;
    if (std::none_of(taken.begin(), taken.end(), [&](const auto& box) { return box.intersects(name); })) return at;
    if (!second_best) second_best = at;
  }
  return second_best.value_or(lines.front());
}

}  // namespace surefoot::gaits
