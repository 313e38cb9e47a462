// The picture of a plan. Layers from back to front: goal, R_SS(W), solid ground, legs, COM path, surface, feet, labels.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "gaits/place_names.hpp"
#include "gaits/plan_heading.hpp"
#include "gaits/plan_io.hpp"
#include "gaits/plan_page.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/svg_canvas.hpp"
#include "gaits/terrain_picture.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::gaits {
namespace {

using Eigen::Vector2d;

constexpr Paint support_fill{.fill = support_colour, .opacity = 0.1};

Paint leg_paint(int leg) { return {.stroke = leg_colour[leg], .width = 1.2, .opacity = 0.6}; }

/// With as many digits as tell ticks apart, up to the farthest one.
std::string tick_label(double x, double step, double farthest) {
  constexpr int most_decimals = 9;
  constexpr double too_long = 1e7;  // [m]
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  if (decimals <= most_decimals && farthest < too_long) return fmt::format("{:.{}f} m", x, decimals);
  const int digits = static_cast<int>(std::clamp(std::log10(farthest / step) + 2, 1.0, 17.0));
  return fmt::format("{:.{}g} m", x, digits);
}

class PlanPicture {
 public:
  PlanPicture(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults, std::string title)
      : scene_(scene), plan_(plan), faults_(faults), title_(std::move(title)), terrain_(scene.terrain),
        weakest_(weakest_place(plan)), page_(lay_out(scene, plan, heading_height)),
        canvas_(page_.width, page_.height, title_) {}

  std::string draw() {
    draw_heading(canvas_, page_, title_, plan_, faults_, weakest_, terrain_);
    for (std::size_t k = 0; k < page_.rows.size(); ++k) draw_row(page_.rows[k], fmt::format("row{}", k + 1));
    return canvas_.finish();
  }

 private:
  void draw_row(const PageRow& row, const std::string& clip_id) {
    const Vector2d corner = row.view({row.window.min().x(), row.window.max().y()});
    const Vector2d size = row.window.sizes() * page_.scale;
    canvas_.define_clip(clip_id, corner, size.x(), size.y());
    canvas_.open_group("row", clip_id);
    const Eigen::AlignedBox2d goal = goal_in(row);
    if (!goal.isEmpty()) draw_goal(row, goal, {.fill = goal_colour, .opacity = 0.3});
    for (const int k : row.stances) support(row, k);
    terrain_.draw_ground(canvas_, row.view, row.window);
    RowNames names = name_places(scene_, plan_, row, start_in(row), goal);
    if (names.goal) label_goal(row, goal, *names.goal);
    for (const int k : row.stances) stance(row, k);
    com_path(row);
    terrain_.draw_surface(canvas_, row.view, row.window);
    feet(row, names.boxes);
    waypoints(row, names.numbers);
    if (names.start) canvas_.text(*names.start, "start", {.anchor = "middle", .bold = true, .halo = true});
    canvas_.close_group();
    axis(row);
  }

  /// The part of the goal [m] that a row shows.
  Eigen::AlignedBox2d goal_in(const PageRow& row) const {
    Eigen::AlignedBox2d box = row.window;
    if (const auto& x = scene_.goal.com_x) box.min().x() = x->first, box.max().x() = x->second;
    if (const auto& y = scene_.goal.com_y) box.min().y() = y->first, box.max().y() = y->second;
    return box.intersection(row.window);
  }

  void draw_goal(const PageRow& row, const Eigen::AlignedBox2d& goal, const Paint& paint) {
    const Vector2d size = goal.sizes() * page_.scale;
    constexpr double thinnest = 2;  // [px] a goal may be a single abscissa
    canvas_.rectangle(row.view({goal.min().x(), goal.max().y()}), std::max(size.x(), thinnest),
                      std::max(size.y(), thinnest), paint);
  }

  /// Solid ground may hide the goal, but neither its name nor, where its height is given, its edges.
  void label_goal(const PageRow& row, const Eigen::AlignedBox2d& goal, const Vector2d& name) {
    if (scene_.goal.com_y) draw_goal(row, goal, {.stroke = goal_colour, .width = 1.5});
    canvas_.text(name, "goal", {.colour = "#6b6400", .anchor = "middle", .bold = true});
  }

  /// Where the COM can be: within reach of every planted foot (as a polygon of 32 corners for each).
  Polyline reachable(const Feet& feet) const {
    constexpr int corners = 32;
    Polyline region;
    for (const auto& foot : feet) {
      if (!foot) continue;
      const auto direction = [&](double k) -> Vector2d {
        const double angle = 2 * std::numbers::pi * k / corners;
        return {std::cos(angle), std::sin(angle)};
      };
      if (region.empty()) {
        for (int k = 0; k < corners; ++k) region.push_back(foot->position + scene_.robot.reach_max * direction(k));
        continue;
      }
      const double inner = scene_.robot.reach_max * std::cos(std::numbers::pi / corners);
      for (int k = 0; k < corners; ++k)
        region = clip(region, -direction(k + 0.5), direction(k + 0.5).dot(foot->position) + inner);
    }
    return region;
  }

  void support(const PageRow& row, int k) {
    const std::vector<stability::Contact> contacts = terrain_.contacts_of(plan_.stances[k].feet);
    const Polyline window = reachable(plan_.stances[k].feet);
    if (contacts.empty() || window.size() < 3) return;
    const stability::RobustOracle oracle(contacts, scene_.robot.radius_of_gyration, scene_.disturbance);
    const Polyline region = oracle.equilibrium_polygon(window);
    if (region.size() < 3) return;
    canvas_.polygon(row.view(region), support_fill, "support");
    canvas_.polygon(row.view(region), support_edge);
  }

  void stance(const PageRow& row, int k) {
    canvas_.open_group("stance");
    for (const int leg : planted_legs(plan_.stances[k].feet))
      canvas_.line(row.view(plan_.stances[k].com), row.view(plan_.stances[k].feet[leg]->position), leg_paint(leg));
    canvas_.close_group();
  }

  /// Transfers that begin or end here.
  void com_path(const PageRow& row) {
    const int count = static_cast<int>(plan_.stances.size());
    for (const bool weak : {true, false})
      for (int k = 0; k + 1 < count; ++k) {
        const Vector2d &from = plan_.stances[k].com, &to = plan_.stances[k + 1].com;
        const bool here = &page_.rows[page_.row_of(from.x())] == &row || &page_.rows[page_.row_of(to.x())] == &row;
        const bool is_weakest = weakest_.bounded() && weakest_.in_transfer && weakest_.index == k;
        if (here && (!weak || is_weakest)) canvas_.line(row.view(from), row.view(to), weak ? weak_line : com_line);
      }
  }

  /// A dot where a foot stands, and the number of the leg in the solid ground beneath; numbers that meet give way
  /// downwards.
  void foot(const PageRow& row, const terrain::Foothold& foothold, int leg, bool start,
            std::vector<Eigen::AlignedBox2d>& taken) {
    const Vector2d at = row.view(foothold.position);
    const terrain::Segment* segment = terrain_.segment_of(foothold);
    const Vector2d inwards = segment ? Vector2d(-segment->normal.x(), segment->normal.y()) : Vector2d(0, 1);
    canvas_.circle(at, dot_radius + (start ? 1.2 : 0),
                   start ? Paint{.fill = "#fff", .stroke = leg_colour[leg], .width = 2.2}
                         : Paint{.fill = leg_colour[leg]});
    constexpr int tries = 3;
    for (int k = 0; k < tries; ++k) {
      const Vector2d beneath = at + inwards * (badge_radius + 5 + k * (2 * badge_radius + 1));
      const Eigen::AlignedBox2d badge(beneath.array() - badge_radius, beneath.array() + badge_radius);
      if (std::any_of(taken.begin(), taken.end(), [&](const auto& box) { return box.intersects(badge); })) continue;
      taken.push_back(badge);
      draw_badge(canvas_, beneath, leg);
      return;
    }
  }

  void feet(const PageRow& row, std::vector<Eigen::AlignedBox2d>& taken) {
    std::set<std::tuple<int, int, double>> drawn;
    const auto once = [&](const terrain::Foothold& foothold, int leg, bool start) {
      if (drawn.emplace(leg, foothold.chain, foothold.s).second) foot(row, foothold, leg, start, taken);
    };
    for (int leg = 0; leg < leg_count; ++leg)
      if (const auto& first = scene_.start.feet[leg]; first && row.window.contains(first->position))
        once(*first, leg, true);
    for (const int k : row.stances) {
      for (const int leg : planted_legs(plan_.stances[k].feet)) once(*plan_.stances[k].feet[leg], leg, false);
      if (k < plan_.steps()) once(plan_.transfers[k].foothold, plan_.transfers[k].leg, false);
    }
  }

  std::string tooltip(int k) const {
    const Stance& stance = plan_.stances[k];
    std::string words = fmt::format("stance {}: COM ({:g}, {:g}), safety factor {}", k + 1, stance.com.x(),
                                    stance.com.y(), factor_in_words(stance.safety_factor));
    if (!stance.limit.empty())
      words += fmt::format(" ({}: {})", stance.limit, limit_in_words(stance.limit, planted_legs(stance.feet)));
    if (k < plan_.steps())
      words += fmt::format("; then leg {} is placed, leg {} lifted, safety factor {}", plan_.transfers[k].leg + 1,
                           plan_.transfers[k].lift + 1, factor_in_words(plan_.transfers[k].safety_factor));
    return words;
  }

  void waypoints(const PageRow& row, const std::vector<std::optional<Vector2d>>& numbers) {
    for (std::size_t i = 0; i < row.stances.size(); ++i) {
      const int k = row.stances[i];
      const Vector2d at = row.view(plan_.stances[k].com);
      const bool is_weakest = weakest_.bounded() && !weakest_.in_transfer && weakest_.index == k;
      if (is_weakest) canvas_.circle(at, ring_radius, {.fill = weak_colour});
      canvas_.circle(at, dot_radius, com_dot, tooltip(k));
      if (numbers[i]) canvas_.text(*numbers[i], number_of(plan_, k), {.size = 10, .anchor = "middle", .halo = true});
    }
  }

  /// Where a row draws the first COM [px].
  std::optional<Vector2d> start_in(const PageRow& row) const {
    std::optional<Vector2d> at = scene_.start.com;
    if (!plan_.stances.empty()) at = plan_.stances.front().com;
    if (!at || &page_.rows[page_.row_of(at->x())] != &row) return std::nullopt;
    return row.view(*at);
  }

  void axis(const PageRow& row) {
    const double step = round_length(200 / page_.scale);
    const double first = std::ceil(row.window.min().x() / step), last = row.window.max().x();
    const double farthest = std::max(std::abs(row.window.min().x()), std::abs(last));
    const double y = row.bottom() + 4;
    const Paint tick{.stroke = faint, .width = 1};
    canvas_.line({row.view(row.window.min()).x(), y}, {row.view(row.window.max()).x(), y}, tick);
    constexpr int most_ticks = 100;  // a page has room for fewer; so far away that k + 1 is k the last does not come
    for (int i = 0; i < most_ticks && (first + i) * step <= last; ++i) {
      const double k = first + i;
      const double x = row.view({k * step, 0}).x();
      canvas_.line({x, y}, {x, y + 4}, tick);
      canvas_.text({x, y + 15}, tick_label(k == 0 ? 0 : k * step, step, farthest),
                   {.size = 10, .colour = faint, .anchor = "middle"});
    }
  }

  const Scene& scene_;
  const Plan& plan_;
  const std::vector<std::string>& faults_;
  const std::string title_;
  TerrainPicture terrain_;
  WeakestPlace weakest_;
  Page page_;
  SvgCanvas canvas_;
};

}  // namespace

std::string to_svg(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults) {
  return PlanPicture(scene, plan, faults, title_of(plan, !faults.empty())).draw();
}

std::string to_svg(const Scene& scene) { return PlanPicture(scene, Plan{}, {}, scene.name).draw(); }

}  // namespace surefoot::gaits
