#include "gaits/stance_picture.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "gaits/terrain_picture.hpp"

namespace surefoot::gaits {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

constexpr double widest = 680, tallest = 620;  // [px]
constexpr double contact_radius = 7.5;         // [px]: the contact's name stands inside

AlignedBox2d shown_window(const RegionFigure& figure, const AlignedBox2d& content) {
  AlignedBox2d feet;
  for (const auto& contact : figure.contacts) feet.extend(contact.position);
  const double unit = std::max({feet.sizes().maxCoeff(), 2 * figure.radius_of_gyration, 1e-300});
  AlignedBox2d shown = feet.merged(content);
  if (figure.com) shown.extend(*figure.com);
  const Vector2d most = Vector2d::Constant(3 * unit);
  AlignedBox2d near(feet.min() - most, feet.max() + most);
  if (!content.isEmpty() && !near.intersects(content)) near = shown;
  shown = shown.intersection(near);
  const Vector2d room(0.6 * unit, 0.25 * unit);
  return {shown.min() - room, shown.max() + room};
}

}  // namespace

AlignedBox2d bounds_of(const Polyline& points) {
  AlignedBox2d box;
  for (const Vector2d& p : points) box.extend(p);
  return box;
}

StancePicture::StancePicture(const RegionFigure& figure, const AlignedBox2d& content, const Vector2d& corner)
    : figure_(figure), corner_(corner), window_(shown_window(figure, content)) {
  const double scale = std::min(widest / window_.sizes().x(), tallest / window_.sizes().y());
  view_ = {{window_.min().x(), window_.max().y()}, corner, scale};
}

void StancePicture::open_frame(SvgCanvas& canvas, std::string_view clip_id) const {
  canvas.define_clip(clip_id, corner_, size().x(), size().y());
  canvas.open_group("figure", clip_id);
}

void StancePicture::close_frame(SvgCanvas& canvas) const {
  canvas.close_group();
  canvas.rectangle(corner_, size().x(), size().y(), {.stroke = faint, .width = 0.8});
}

void StancePicture::ground(SvgCanvas& canvas) const {
  if (figure_.terrain != nullptr) TerrainPicture(*figure_.terrain).draw_ground(canvas, view_, window_);
}

void StancePicture::com(SvgCanvas& canvas) const {
  if (figure_.com) canvas.circle(view_(*figure_.com), 4, {.fill = "#fff", .stroke = ink, .width = 1.6}, "COM");
}

void StancePicture::surface(SvgCanvas& canvas) const {
  if (figure_.terrain != nullptr) {
    TerrainPicture(*figure_.terrain).draw_surface(canvas, view_, window_);
    return;
  }
  for (const auto& contact : figure_.contacts) {
    const Vector2d n = contact.normal.stableNormalized(), at = view_(contact.position);
    const Vector2d along(n.y(), n.x()), into(-n.x(), n.y());  // in pixels, y down
    canvas.line(at - 34 * along, at + 34 * along, {.stroke = "#4d4d4d", .width = 2.4});
    for (int k = -4; k <= 4; ++k)
      canvas.line(at + 8.0 * k * along, at + 8.0 * k * along + 7 * into - 5 * along, {.stroke = "#8a8578", .width = 1});
  }
}

void StancePicture::contacts(SvgCanvas& canvas) const {
  constexpr double cone = 52;  // [px]
  for (std::size_t i = 0; i < figure_.contacts.size(); ++i) {
    const auto& contact = figure_.contacts[i];
    const Vector2d at = view_(contact.position), n = contact.normal.stableNormalized(), t(n.y(), -n.x());
    const auto edge = [&](double sign) {
      const Vector2d c = (n + sign * contact.friction * t).stableNormalized();
      return Vector2d(at + cone * Vector2d(c.x(), -c.y()));
    };
    canvas.polygon({at, edge(1), edge(-1)}, {.fill = "#999", .opacity = 0.3}, "cone");
    for (const double sign : {1.0, -1.0}) canvas.line(at, edge(sign), {.stroke = "#333", .width = 1.1});
    canvas.circle(at, contact_radius, {.fill = ink});
    canvas.text(at + Vector2d(0, 4),
                i < figure_.contact_names.size() ? figure_.contact_names[i] : std::to_string(i + 1),
                {.size = 11, .colour = "#fff", .anchor = "middle", .bold = true});
  }
}

void StancePicture::lengths(SvgCanvas& canvas, const std::vector<std::pair<double, std::string>>& shown) const {
  double x = corner_.x();
  const double y = corner_.y() + size().y() + 22;
  const auto bar = [&](double length, const std::string& words) {
    const double px = length * view_.scale;
    if (!(px > 0.5) || px > size().x()) return;
    const Paint paint{.stroke = ink, .width = 1.6};
    canvas.line({x, y}, {x + px, y}, paint);
    for (const double end : {x, x + px}) canvas.line({end, y - 4}, {end, y + 4}, paint);
    canvas.text({x, y + 18}, words, {.size = 12});
    x += std::max(px, 7.0 * static_cast<double>(words.size())) + 24;
  };
  const double scale = round_length(110 / view_.scale);
  bar(scale, fmt::format("{:g} m", scale));
  for (const auto& [length, words] : shown) bar(length, words);
}

}  // namespace surefoot::gaits
