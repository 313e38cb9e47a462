#include "gaits/frictional_panel.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace surefoot::gaits {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using stability::FrictionalPart;
using stability::FrictionalRegion;

namespace {

constexpr double head = 66, foot = 78, gap = 26, key_width = 372, key_height = 260;  // [px]
constexpr std::string_view strong_fill = "#a9cdea", strong_edge = "#2b6ca3", hatch_ink = "#8a3d00",
                           stable_edge = "#00684b";
constexpr std::string_view hatch_id = "hatch", hatch_fill = "url(#hatch)";

/// The regions of Theorem 3, and of the clattering region, which is often endless downwards, what is near the feet.
AlignedBox2d content(const RegionFigure& figure, const FrictionalRegion& region) {
  AlignedBox2d box, near;
  for (const auto& contact : figure.contacts) near.extend(contact.position);
  const Vector2d extent = Vector2d::Constant(std::max(near.sizes().maxCoeff(), figure.radius_of_gyration));
  near = {near.min() - extent, near.max() + extent};
  for (const auto* part : {&region.kinematic_strong, &region.stable})
    for (const auto& polygon : part->polygons) box.extend(bounds_of(polygon));
  for (const auto& polygon : region.clattering.polygons)
    if (const AlignedBox2d bounds = bounds_of(polygon); bounds.intersects(near)) box.extend(bounds.intersection(near));
  if (!region.strip.isEmpty() && box.isEmpty()) box = region.strip;
  return box;
}

}  // namespace

FrictionalPanel::FrictionalPanel(const RegionFigure& figure, const FrictionalRegion& region, const Vector2d& corner)
    : figure_(figure), region_(region), corner_(corner),
      stance_(figure, content(figure, region), corner + Vector2d(0, head)) {}

Vector2d FrictionalPanel::size() const {
  return {stance_.size().x() + gap + key_width, head + std::max(stance_.size().y() + foot, key_height)};
}

void FrictionalPanel::draw(SvgCanvas& canvas) const {
  heading(canvas);
  canvas.define_hatch(hatch_id, hatch_ink);
  stance_.open_frame(canvas, "frictional");
  stance_.ground(canvas);
  parts(canvas);
  stance_.surface(canvas);
  stance_.contacts(canvas);
  stance_.com(canvas);
  stance_.close_frame(canvas);
  stance_.lengths(canvas, {{figure_.radius_of_gyration, fmt::format("rho = {:.3g} m", figure_.radius_of_gyration)}});
  key(canvas);
}

void FrictionalPanel::heading(SvgCanvas& canvas) const {
  canvas.text(corner_ + Vector2d(0, 26),
              fmt::format("Frictional stability, restitution e = {:.4g}", region_.restitution),
              {.size = 16, .bold = true});
  std::string words = "No COM can be balanced under gravity alone.";
  if (!region_.strip.isEmpty())
    words =
        fmt::format("Areas within x {:.4g} .. {:.4g}, y {:.4g} .. {:.4g} m.{}", region_.window.min().x(),
                    region_.window.max().x(), region_.window.min().y(), region_.window.max().y(),
                    region_.upward ? "" : "  The ground does not face upward under both feet: Theorem 3 is silent.");
  canvas.text(corner_ + Vector2d(0, 48), words, {.size = 12, .colour = faint});
}

void FrictionalPanel::parts(SvgCanvas& canvas) const {
  const View& view = stance_.view();
  const auto fill = [&](const FrictionalPart& part, const Paint& paint, std::string_view name) {
    for (const auto& polygon : part.polygons) canvas.polygon(view(polygon), paint, name);
  };
  // Lower and upper sides only: where a part divides, polygons meet along a vertical line that is no boundary.
  const auto outline = [&](const FrictionalPart& part, std::string_view colour, double width) {
    for (const auto& polygon : part.polygons) {
      const auto middle = polygon.begin() + static_cast<std::ptrdiff_t>(polygon.size() / 2);
      canvas.polyline(view(Polyline(polygon.begin(), middle)), {.stroke = colour, .width = width});
      canvas.polyline(view(Polyline(middle, polygon.end())), {.stroke = colour, .width = width});
    }
  };
  fill(region_.kinematic_strong, {.fill = strong_fill, .stroke = strong_fill, .width = 0.5}, "kinematic-strong");
  outline(region_.kinematic_strong, strong_edge, 1);
  fill(region_.clattering, {.fill = hatch_fill}, "clattering");
  outline(region_.clattering, hatch_ink, 0.8);
  outline(region_.stable, stable_edge, 2.4);
  if (region_.strip.isEmpty()) return;
  for (const double x : {region_.strip.min().x(), region_.strip.max().x()})
    canvas.line(view(Vector2d(x, region_.strip.min().y())), view(Vector2d(x, region_.strip.max().y())),
                {.stroke = ink, .width = 1, .dash = "6 4"});
}

void FrictionalPanel::key(SvgCanvas& canvas) const {
  const double x = corner_.x() + stance_.size().x() + gap;
  double y = corner_.y() + head + 14;
  const double whole = region_.equilibrium_area();
  const auto entry = [&](const Paint& paint, const char* words, double area) {
    canvas.rectangle({x, y - 11}, 20, 14, paint);
    canvas.text({x + 28, y}, words, {.bold = true});
    canvas.text({x + 28, y + 14},
                whole > 0 ? fmt::format("{:.4g} m^2, {:.3g} %", area, 100 * area / whole)
                          : fmt::format("{:.4g} m^2", area),
                {.size = 10, .colour = faint});
    y += 36;
  };
  entry({.stroke = ink, .width = 1, .dash = "6 4"}, "R_EQ: balanced under gravity", whole);
  entry({.fill = strong_fill, .stroke = strong_edge, .width = 1}, "kinematic-strong equilibrium",
        region_.kinematic_strong.area);
  entry({.fill = hatch_fill, .stroke = hatch_ink, .width = 0.8}, "clattering converges (10)", region_.clattering.area);
  entry({.stroke = stable_edge, .width = 2.4}, "both: frictionally stable (Theorem 3)", region_.stable.area);
  y += 4;
  for (const char* words :
       {"After every small enough push, which may slide or lift feet,", "the body comes to rest near where it was."}) {
    canvas.text({x, y}, words, {.size = 10.5, .colour = faint});
    y += 15;
  }
}

}  // namespace surefoot::gaits
