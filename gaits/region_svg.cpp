#include "gaits/region_svg.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gaits/frictional_panel.hpp"
#include "gaits/stance_picture.hpp"

namespace surefoot::gaits {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using stability::Region;
using stability::RegionCell;

namespace {

constexpr std::string_view robust_fill = "#7fc8a9", robust_edge = "#00684b";
// Light enough for black numbers, told apart by colour-blind eyes; used again from the start where cells are many.
constexpr std::array<std::string_view, 10> shades{"#f6c98f", "#a9cdea", "#e8b4cf", "#f4ec9a", "#e9a58c",
                                                  "#c7c3e6", "#d2b48c", "#bfd9a0", "#f2d5d5", "#b9d5d8"};
constexpr double left = 30, top = 110, gap = 26, key_width = 372;  // [px]
constexpr double bottom_room = 78;                                 // [px]
constexpr std::size_t most_in_key = 24;

class Picture {
 public:
  Picture(const RegionFigure& figure, const Region& region,
          const std::optional<stability::FrictionalRegion>& frictional)
      : figure_(figure), region_(region), stance_(figure, bounds_of(region.equilibrium), {left, top}),
        window_(stance_.window()), view_(stance_.view()), size_(stance_.size()) {
    if (frictional) panel_.emplace(figure, *frictional, Vector2d(left, own_height()));
    const double panel_width = panel_ ? panel_->size().x() : 0;
    canvas_.emplace(left + std::max(size_.x() + gap + key_width, panel_width),
                    own_height() + (panel_ ? panel_->size().y() : 0), figure.title);
  }

  std::string draw() {
    heading();
    stance_.open_frame(*canvas_, "frame");
    stance_.ground(*canvas_);
    cells();
    curves();
    stance_.surface(*canvas_);
    stance_.contacts(*canvas_);
    numbers();
    stance_.com(*canvas_);
    stance_.close_frame(*canvas_);
    stance_.lengths(*canvas_, {{figure_.radius_of_gyration, fmt::format("rho = {:.3g} m", figure_.radius_of_gyration)},
                               {figure_.box.nu, fmt::format("nu = {:.3g} m", figure_.box.nu)}});
    key();
    if (panel_) panel_->draw(*canvas_);
    return canvas_->finish();
  }

 private:
  double own_height() const { return top + std::max(size_.y() + bottom_room, key_height()); }
  double key_height() const {
    return 150 + 34.0 * static_cast<double>(std::min(region_.cells.size(), most_in_key + 1));
  }

  std::string share(double area) const {
    return region_.equilibrium_area > 0 ? fmt::format("{:.3g} %", 100 * area / region_.equilibrium_area) : "-";
  }

  void heading() {
    canvas_->text({left, 36}, figure_.title, {.size = 20, .bold = true});
    const auto& box = figure_.box;
    std::string words = fmt::format("rho = {:.4g} m, ", figure_.radius_of_gyration);
    if (box.one_wrench() && box.centred()) words += "gravity alone";
    else if (box.one_wrench()) words += fmt::format("wrench p = {:.4g}, q = {:.4g} m", box.centre.p, box.centre.q);
    else
      words += fmt::format("W: {} <= {:.4g}, {} <= {:.4g} m", box.centre.p == 0 ? "|p|" : "|p - p0|", box.kappa,
                           box.centre.q == 0 ? "|q|" : "|q - q0|", box.nu);
    canvas_->text({left, 58}, words, {.size = 13, .colour = faint});
    std::string result =
        region_.empty()
            ? "No COM can be balanced under every wrench of W."
            : fmt::format("{}: {:.5g} m^2.  {}: {:.5g} m^2, {} of it.", equilibrium_name(box), region_.equilibrium_area,
                          robust_name(box), region_.robust_area, share(region_.robust_area));
    canvas_->text({left, 79}, result, {.size = 13});
    std::string more;
    if (region_.window)
      more = fmt::format("Clipped to x {:.4g} .. {:.4g}, y {:.4g} .. {:.4g} m.  ", region_.window->min().x(),
                         region_.window->max().x(), region_.window->min().y(), region_.window->max().y());
    if (figure_.terrain != nullptr) more += "COMs below the ground or out of reach count too.  ";
    if (!region_.empty() && !window_.contains(bounds_of(region_.equilibrium))) more += "Goes on beyond the picture.";
    canvas_->text({left, 98}, more, {.size = 12, .colour = faint});
  }

  std::string_view shade(std::size_t k) const {
    if (region_.cells[k].modes.empty()) return robust_fill;
    std::size_t unstable = 0;
    for (std::size_t i = 0; i < k; ++i) unstable += !region_.cells[i].modes.empty();
    return shades[unstable % shades.size()];
  }

  /// Outer rings, greatest first: what lies in a hole is drawn over it.
  void cells() {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < region_.cells.size(); ++k)
      if (!region_.cells[k].rings.empty()) order.push_back(k);
    const auto extent = [&](std::size_t k) { return bounds_of(region_.cells[k].rings.front()).volume(); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return extent(a) > extent(b); });
    for (const std::size_t k : order) {
      const std::string_view fill = shade(k);
      canvas_->polygon(view_(region_.cells[k].rings.front()),
                       {.fill = fill, .stroke = fill, .width = 0.4, .opacity = 0.82}, "cell");
    }
  }

  void curves() {
    for (const auto& boundary : region_.boundaries) {
      const bool edge = boundary.curve.kind == stability::CurveId::edge;
      if (!edge) canvas_->polyline(view_(boundary.polyline), {.stroke = "#555", .width = 0.9});
      else if (boundary.label == "window")
        canvas_->polyline(view_(boundary.polyline), {.stroke = faint, .width = 1, .dash = "5 4"});
      else canvas_->polyline(view_(boundary.polyline), {.stroke = robust_edge, .width = 1.8});
    }
  }

  /// A point of the cell that the picture shows: its own, else the middle of what is shown, if that lies in the cell.
  std::optional<Vector2d> shown_point(const RegionCell& cell) const {
    const AlignedBox2d frame(window_.min() + 0.03 * window_.sizes(), window_.max() - 0.03 * window_.sizes());
    if (frame.contains(cell.inside) || cell.rings.empty()) return cell.inside;
    Polyline part = clip(cell.rings.front(), Vector2d::UnitX(), -frame.min().x());
    part = clip(part, -Vector2d::UnitX(), frame.max().x());
    part = clip(part, Vector2d::UnitY(), -frame.min().y());
    part = clip(part, -Vector2d::UnitY(), frame.max().y());
    if (part.size() < 3) return std::nullopt;
    Vector2d middle = Vector2d::Zero();
    double twice = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vector2d p = part[k] - part[0], q = part[(k + 1) % part.size()] - part[0];
      const double cross = p.x() * q.y() - p.y() * q.x();
      twice += cross;
      middle += cross * (p + q) / 3;
    }
    if (!(std::abs(twice) > 0)) return std::nullopt;
    return part[0] + middle / twice;
  }

  struct Number {
    std::size_t cell;
    Vector2d at, place;  // [px] in the cell, of the number
  };

  /// Inside the cell where there is room, else beside it on a leader.
  void numbers() {
    constexpr double least_room = 500, aside = 44;  // [px^2], [px]
    std::vector<Vector2d> taken;
    for (const auto& contact : figure_.contacts) {
      const Vector2d at = view_(contact.position), n = contact.normal.stableNormalized();
      for (const double along : {-34.0, -17.0, 0.0, 17.0, 34.0}) taken.push_back(at + along * Vector2d(n.y(), n.x()));
    }
    std::vector<Number> inside, beside;
    for (std::size_t k = 0; k < std::min(region_.cells.size(), most_in_key); ++k) {
      const std::optional<Vector2d> shown = shown_point(region_.cells[k]);
      if (!shown) continue;
      const Vector2d at = view_(*shown);
      if (region_.cells[k].area * view_.scale * view_.scale >= least_room) {
        inside.push_back({k, at, free_place(at, taken)});
        taken.push_back(inside.back().place);
      } else {
        beside.push_back({k, at, at + Vector2d(at.x() < left + 0.5 * size_.x() ? -aside : aside, 0)});
      }
    }
    move_apart(beside);
    for (const Number& number : inside) write(number);
    for (const Number& number : beside) write(number);
  }

  static Vector2d free_place(Vector2d place, const std::vector<Vector2d>& taken) {
    for (int tries = 0; tries < 12; ++tries, place.y() += 16)
      if (std::none_of(taken.begin(), taken.end(), [&](const Vector2d& p) { return (p - place).norm() < 16; })) break;
    return place;
  }

  /// From top to bottom in the order of their cells, so that leaders do not cross.
  static void move_apart(std::vector<Number>& numbers) {
    constexpr double line = 15, column = 40;  // [px]
    constexpr int rounds = 200;
    std::sort(numbers.begin(), numbers.end(), [](const Number& a, const Number& b) { return a.at.y() < b.at.y(); });
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < numbers.size(); ++i)
        for (std::size_t k = i + 1; k < numbers.size(); ++k) {
          Vector2d &upper = numbers[i].place, &lower = numbers[k].place;
          const double missing = line - (lower.y() - upper.y());
          if (std::abs(lower.x() - upper.x()) > column || missing <= 0) continue;
          const bool right = upper.x() > numbers[i].at.x();  // one below the other
          upper.x() = lower.x() = right ? std::max(upper.x(), lower.x()) : std::min(upper.x(), lower.x());
          upper.y() -= 0.5 * missing, lower.y() += 0.5 * missing;
        }
  }

  void write(const Number& number) {
    const Vector2d way = number.place - number.at;
    if (way.norm() > 20) canvas_->line(number.at, number.place - 9 * way.normalized(), {.stroke = faint, .width = 0.7});
    canvas_->text(number.place + Vector2d(0, 4), std::to_string(number.cell + 1),
                  {.size = 12, .anchor = "middle", .bold = true, .halo = true});
  }

  void key() {
    const double x = left + size_.x() + gap;
    double y = top + 14;
    canvas_->text({x, y}, fmt::format("Cells of {} and what may happen there", equilibrium_name(figure_.box)),
                  {.size = 13, .bold = true});
    y += 24;
    for (std::size_t k = 0; k < region_.cells.size(); ++k) {
      const RegionCell& cell = region_.cells[k];
      if (k == most_in_key) {
        canvas_->text({x, y}, fmt::format("and {} smaller ones", region_.cells.size() - k), {.colour = faint});
        y += 20;
        break;
      }
      canvas_->rectangle({x, y - 11}, 20, 14, {.fill = shade(k), .stroke = "#777", .width = 0.6});
      canvas_->text({x + 28, y}, std::to_string(k + 1), {.bold = true});
      std::string modes;
      for (const auto& mode : cell.modes) modes.append(modes.empty() ? "" : " ").append(mode.name());
      canvas_->text({x + 52, y}, modes.empty() ? robust_name(figure_.box) + ": stays at rest" : modes,
                    {.size = modes.size() > 34 ? 9.0 : 12.0, .bold = modes.empty()});
      canvas_->text({x + 52, y + 14}, fmt::format("{:.4g} m^2, {}", cell.area, share(cell.area)),
                    {.size = 10, .colour = faint});
      y += 34;
    }
    y += 4;
    for (const char* words :
         {"One letter per contact, in their order:", "F breaks away, R rolls or stays, U slides along +t, W along -t;",
          "t is the contact's normal turned clockwise.", "Black discs: contacts; grey fans: their friction cones.",
          "Green line: where R_SS ends; thin: where a mode begins."}) {
      canvas_->text({x, y}, words, {.size = 10.5, .colour = faint});
      y += 15;
    }
  }

  const RegionFigure& figure_;
  const Region& region_;
  StancePicture stance_;
  AlignedBox2d window_;
  View view_;
  Vector2d size_;
  std::optional<FrictionalPanel> panel_;
  std::optional<SvgCanvas> canvas_;
};

}  // namespace

std::string robust_name(const stability::WrenchBox& box) { return box.one_wrench() ? "R(w)" : "R(W)"; }
std::string equilibrium_name(const stability::WrenchBox& box) { return box.one_wrench() ? "R_SS(w)" : "R_SS(W)"; }

std::string to_svg(const RegionFigure& figure, const Region& region,
                   const std::optional<stability::FrictionalRegion>& frictional) {
  return Picture(figure, region, frictional).draw();
}

}  // namespace surefoot::gaits
