#include "gaits/place_names.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "terrain/back_faces.hpp"

namespace surefoot::gaits {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double name_width = 30;  // [px] of either

/// What letters cover [px] that stand on the middle of a line at `at`.
AlignedBox2d letters(const Vector2d& at, double width) {
  constexpr double height = 10;
  return {at - Vector2d(width / 2, height), at + Vector2d(width / 2, 0)};
}

/// The waypoints of a row and their numbers [px].
std::vector<AlignedBox2d> waypoint_boxes(const Plan& plan, const PageRow& row) {
  constexpr double number_width = 18;
  std::vector<AlignedBox2d> boxes;
  for (const int k : row.stances) {
    const Vector2d at = row.view(plan.stances[k].com);
    boxes.emplace_back(at.array() - ring_radius, at.array() + ring_radius);
    boxes.push_back(letters(at - Vector2d(0, number_above), number_width));
  }
  return boxes;
}

bool is_free(const AlignedBox2d& name, const std::vector<AlignedBox2d>& taken) {
  return std::none_of(taken.begin(), taken.end(), [&](const auto& box) { return box.intersects(name); });
}

/// Lines [px] on which the name of the goal may stand, the best first.
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

enum class Ground { none, crosses, covers };

/// Whether a name would stand in solid ground, in part at least, or a surface run through it.
Ground ground_at(const terrain::Terrain& terrain, const PageRow& row, const AlignedBox2d& name) {
  const Vector2d corner = row.view({row.window.min().x(), row.window.max().y()});
  const Vector2d opposite = row.view({row.window.max().x(), row.window.min().y()});
  const Vector2d scale = (opposite - corner).cwiseQuotient(row.window.sizes());  // [px/m]
  const double y = row.window.max().y() - (name.center().y() - corner.y()) / scale.y();
  const auto metres = [&](double px) { return Vector2d(row.window.min().x() + (px - corner.x()) / scale.x(), y); };
  for (const double px : {name.min().x(), name.center().x(), name.max().x()})
    if (terrain::solid_around(terrain, AlignedBox2d(metres(px)))) return Ground::covers;
  constexpr double hatch = 8;  // [px] that may be drawn beside the surface
  const double near = (name.sizes().y() / 2 + hatch) / scale.y();
  return terrain.distance(metres(name.min().x()), metres(name.max().x()), near) < near ? Ground::crosses : Ground::none;
}

}  // namespace

Vector2d start_name_place(const Plan& plan, const PageRow& row, const Vector2d& com) {
  const std::vector<AlignedBox2d> taken = waypoint_boxes(plan, row);
  const double aside = ring_radius + name_width / 2 + 2;
  const std::array<Vector2d, 4> lines{com - Vector2d(0, start_above), com + Vector2d(0, start_above - 2),
                                      com + Vector2d(-aside, 4), com + Vector2d(aside, 4)};
  const auto* const best =
      std::find_if(lines.begin(), lines.end(), [&](const auto& at) { return is_free(letters(at, name_width), taken); });
  return best == lines.end() ? lines.front() : *best;
}

Vector2d goal_name_place(const Scene& scene, const Plan& plan, const PageRow& row, const AlignedBox2d& goal,
                         const std::optional<Vector2d>& start) {
  constexpr std::size_t many = 100'000;  // segments, of which each line asks all
  const std::vector<Vector2d> lines = lines_of(row, goal);
  if (scene.terrain.segments().size() > many) return lines.front();
  std::vector<AlignedBox2d> taken = waypoint_boxes(plan, row);
  if (start) taken.push_back(letters(*start, name_width));
  const AlignedBox2d page(row.view({row.window.min().x(), row.window.max().y()}),
                          row.view({row.window.max().x(), row.window.min().y()}));
  std::optional<Vector2d> second_best;
  for (const Vector2d& at : lines) {
    const AlignedBox2d name = letters(at, name_width);
    const Ground ground = page.contains(name) ? ground_at(scene.terrain, row, name) : Ground::covers;
    if (ground == Ground::covers) continue;
    if (ground == Ground::none && is_free(name, taken)) return at;
    if (!second_best) second_best = at;
  }
  return second_best.value_or(lines.front());
}

}  // namespace surefoot::gaits
