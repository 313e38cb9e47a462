#include "gaits/place_names.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "gaits/plan_heading.hpp"
#include "terrain/back_faces.hpp"

namespace surefoot::gaits {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double name_width = 30, name_height = 10;  // [px] of either

/// What letters cover [px] that stand on the middle of a line at `at`.
AlignedBox2d letters(const Vector2d& at, double width, double height) {
  return {at - Vector2d(width / 2, height), at + Vector2d(width / 2, 0)};
}

AlignedBox2d name_box(const Vector2d& at) { return letters(at, name_width, name_height); }

bool is_free(const AlignedBox2d& box, const std::vector<AlignedBox2d>& taken) {
  return std::none_of(taken.begin(), taken.end(), [&](const auto& other) { return other.intersects(box); });
}

/// Of lines about a point the first that is free: above it, beneath, to the right, to the left.
std::optional<Vector2d> free_line(const Vector2d& at, double above, double beneath, double aside, double width,
                                  double height, const std::vector<AlignedBox2d>& taken) {
  const double sideways = aside + width / 2, middle = height / 2;
  for (const Vector2d& offset :
       {Vector2d(0, -above), Vector2d(0, beneath), Vector2d(sideways, middle), Vector2d(-sideways, middle)})
    if (is_free(letters(at + offset, width, height), taken)) return at + offset;
  return std::nullopt;
}

/// Waypoints first, so that no number stands over one.
void place_numbers(const Plan& plan, const PageRow& row, RowNames& names) {
  constexpr double digit = 6.2, gap = 3, height = 8;    // [px]
  constexpr double above = 8, beneath = 16, aside = 6;  // [px] from the waypoint
  for (const int k : row.stances) {
    const Vector2d at = row.view(plan.stances[k].com);
    names.boxes.emplace_back(at.array() - dot_radius - 1, at.array() + dot_radius + 1);
  }
  for (const int k : row.stances) {
    const double width = digit * static_cast<double>(number_of(plan, k).size()) + gap;
    const auto line = free_line(row.view(plan.stances[k].com), above, beneath, aside, width, height, names.boxes);
    names.numbers.push_back(line);
    if (line) names.boxes.push_back(letters(*line, width, height));
  }
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
  for (const double px : {name.min().x(), name.max().x()})
    if (!metres(px).allFinite()) return Ground::covers;  // a plan that stands at the end of all numbers
  for (const double px : {name.min().x(), name.center().x(), name.max().x()})
    if (terrain::solid_around(terrain, AlignedBox2d(metres(px)))) return Ground::covers;
  constexpr double hatch = 8;  // [px] that may be drawn beside the surface
  const double near = (name.sizes().y() / 2 + hatch) / scale.y();
  return terrain.distance(metres(name.min().x()), metres(name.max().x()), near) < near ? Ground::crosses : Ground::none;
}

Vector2d place_goal(const Scene& scene, const PageRow& row, const AlignedBox2d& goal,
                    const std::vector<AlignedBox2d>& taken) {
  constexpr std::size_t many = 100'000;  // segments, of which each line asks all
  const std::vector<Vector2d> lines = lines_of(row, goal);
  if (scene.terrain.segments().size() > many) return lines.front();
  const AlignedBox2d page(row.view({row.window.min().x(), row.window.max().y()}),
                          row.view({row.window.max().x(), row.window.min().y()}));
  std::optional<Vector2d> second_best;
  for (const Vector2d& at : lines) {
    const AlignedBox2d name = name_box(at);
    const Ground ground = page.contains(name) ? ground_at(scene.terrain, row, name) : Ground::covers;
    if (ground == Ground::covers) continue;
    if (ground == Ground::none && is_free(name, taken)) return at;
    if (!second_best) second_best = at;
  }
  return second_best.value_or(lines.front());
}

}  // namespace

std::string number_of(const Plan& plan, int k) { return k > 0 && k == plan.steps() ? "end" : std::to_string(k + 1); }

RowNames name_places(const Scene& scene, const Plan& plan, const PageRow& row, const std::optional<Vector2d>& start,
                     const AlignedBox2d& goal) {
  constexpr double above = 22, beneath = 20, aside = 10;  // [px] from the waypoint; its number may stand between
  RowNames names;
  place_numbers(plan, row, names);
  if (start) {
    const auto line = free_line(*start, above, beneath, aside, name_width, name_height, names.boxes);
    names.start = line.value_or(*start - Vector2d(0, above));
    names.boxes.push_back(name_box(*names.start));
  }
  if (!goal.isEmpty()) {
    names.goal = place_goal(scene, row, goal, names.boxes);
    names.boxes.push_back(name_box(*names.goal));
  }
  return names;
}

}  // namespace surefoot::gaits
