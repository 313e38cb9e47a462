#include "gaits/plan_page.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

// All in pixels.
constexpr double widest_page = 1200, narrowest_page = 860, margin = 30;
constexpr double room_for_steps = 24;   // above what a row shows: their numbers
constexpr double room_for_legs = 48;    // below: numbers of legs, three of which may stand in a pile
constexpr double row_gap = 40;          // below each row, holds its axis
constexpr double tallest_single = 620;  // a journey shown in one row
constexpr double widest_reach = 240;    // a robot is not drawn larger than this
constexpr double least_reach = 90;      // below this the journey is broken into rows
constexpr double reach_in_rows = 100;
constexpr double level = 0.5;  // [1] least |n_y| of a ceiling: less is a wall that leans
constexpr int most_rows = 24;  // a longer journey is drawn smaller

void extend(AlignedBox2d& box, const Feet& feet) {
  for (const auto& foot : feet)
    if (foot) box.extend(foot->position);
}

AlignedBox2d box_of(const Plan& plan, int k) {
  AlignedBox2d box(plan.stances[k].com);
  extend(box, plan.stances[k].feet);
  if (k < plan.steps()) box.extend(plan.transfers[k].foothold.position);
  return box;
}

/// Terrain vertices between two abscissae.
AlignedBox2d ground_between(const Scene& scene, double x_from, double x_to) {
  AlignedBox2d box;
  for (const auto& segment : scene.terrain.segments())
    for (const Vector2d& p : {segment.a, segment.b})
      if (p.x() >= x_from && p.x() <= x_to) box.extend(p);
  return box;
}

/// Raises the box to the lowest level terrain above it (a ceiling, or one the wrong way round) that the COMs in it may
/// reach; without any, the feet's COMs.
void show_ceiling(AlignedBox2d& box, const Scene& scene, const Plan& plan, double x_from, double x_to) {
  double lowest = box.max().y() + (plan.stances.empty() ? 2 : 1) * scene.robot.reach_max;
  bool found = false;
  for (const auto& segment : scene.terrain.segments()) {
    const double first = std::min(segment.a.x(), segment.b.x()), last = std::max(segment.a.x(), segment.b.x());
    if (first > x_to || last < x_from || std::abs(segment.normal.y()) < level) continue;
    const auto height = [&](double x) {
      return segment.a.y() + (x - segment.a.x()) / (segment.b.x() - segment.a.x()) * (segment.b.y() - segment.a.y());
    };
    const double y = std::min(height(std::max(first, x_from)), height(std::min(last, x_to)));
    if (y <= box.max().y() || y > lowest) continue;
    lowest = y, found = true;
  }
  if (found) box.max().y() = lowest;
}

int rows_needed(double scale, double reach, double length) {
  const double home = (widest_page - 2 * margin) / scale - 2 * reach;  // a reach is shown on either side
  const int too_many = most_rows + 1;
  return home > 0 && length / home < too_many ? static_cast<int>(std::ceil(length / home)) : too_many;
}

}  // namespace

AlignedBox2d contents(const Scene& scene, const Plan& plan) {
  AlignedBox2d box;
  extend(box, scene.start.feet);
  if (scene.start.com) box.extend(*scene.start.com);
  for (int k = 0; k < static_cast<int>(plan.stances.size()); ++k) box.extend(box_of(plan, k));
  if (box.isEmpty()) box.extend(scene.terrain.bounds());
  const Vector2d centre = box.center();
  if (scene.goal.com_x)
    for (const double x : {scene.goal.com_x->first, scene.goal.com_x->second}) box.extend(Vector2d(x, centre.y()));
  if (scene.goal.com_y)
    for (const double y : {scene.goal.com_y->first, scene.goal.com_y->second}) box.extend(Vector2d(centre.x(), y));
  AlignedBox2d ground = ground_between(scene, box.min().x(), box.max().x());
  if (plan.status == Status::solved && !ground.isEmpty()) {  // ditches are shown, chasms begin
    const double reach = scene.robot.reach_max;
    ground.min().y() = std::max(ground.min().y(), box.min().y() - reach);
    ground.max().y() = std::min(ground.max().y(), box.max().y());
    if (ground.min().y() > ground.max().y()) ground.setEmpty();
  }
  box.extend(ground);
  show_ceiling(box, scene, plan, box.min().x(), box.max().x());
  return box;
}

int Page::row_of(double x) const {
  const double share = (x - rows.front().x_from) / (rows.back().x_to - rows.front().x_from);
  const double last = static_cast<double>(rows.size()) - 1;
  return share > 0 ? static_cast<int>(std::min(share * (last + 1), last)) : 0;  // numbers that overflow too
}

Page lay_out(const Scene& scene, const Plan& plan, double top) {
  const double reach = scene.robot.reach_max;
  const AlignedBox2d all = contents(scene, plan);
  const double length = std::max(all.sizes().x(), 1e-3 * reach);
  const double pad = 0.35 * reach;
  double free_width = widest_page - 2 * margin;
  const double scale_by_width = free_width / (length + 2 * pad);
  const double scale_by_height = std::max(tallest_single / (all.sizes().y() + 2 * pad), least_reach / reach);

  Page page;
  page.scale = std::min({scale_by_width, scale_by_height, widest_reach / reach});
  int count = 1;
  if (page.scale * reach < least_reach) {
    page.scale = reach_in_rows / reach;
    count = rows_needed(page.scale, reach, length);
    if (count > most_rows) {
      page.scale = free_width / (length / most_rows + 2 * reach);
      count = most_rows;
    } else if (count > 1) {  // as large as fits: rows overlap by two reaches
      page.scale = std::min(free_width / (length / count + 2 * reach), widest_reach / reach);
    }
  }
  free_width = std::min(free_width, std::max(narrowest_page - 2 * margin, page.scale * (length + 2 * pad)));
  page.width = free_width + 2 * margin;
  page.rows.resize(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    page.rows[k].x_from = all.min().x() + length * k / count;
    page.rows[k].x_to = all.min().x() + length * (k + 1) / count;
  }
  for (int k = 0; k < static_cast<int>(plan.stances.size()); ++k)
    page.rows[page.row_of(plan.stances[k].com.x())].stances.push_back(k);

  double y = top;
  for (PageRow& row : page.rows) {
    AlignedBox2d box;
    for (const int k : row.stances) box.extend(box_of(plan, k));
    if (count == 1) box = all;
    if (row.stances.empty() || plan.status != Status::solved)
      box.extend(ground_between(scene, row.x_from - pad, row.x_to + pad));
    if (box.isEmpty()) box = all;
    if (count > 1) show_ceiling(box, scene, plan, row.x_from - pad, row.x_to + pad);
    const double half_width = free_width / page.scale / 2;
    const double middle = (row.x_from + row.x_to) / 2;
    row.window =
        AlignedBox2d(Vector2d(middle - half_width, box.min().y() - std::max(pad, room_for_legs / page.scale)),
                     Vector2d(middle + half_width, box.max().y() + std::max(pad, room_for_steps / page.scale)));
    row.view = {{row.window.min().x(), row.window.max().y()}, {margin, y}, page.scale};
    y = row.bottom() + row_gap;
  }
  page.height = y;
  return page;
}

}  // namespace surefoot::gaits
