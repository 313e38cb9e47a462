// A small writer of SVG: shapes in pixels, y down, numbers to a hundredth of a pixel. Knows nothing of gaits.
// Guarantee: well-formed XML whatever the texts hold; the same calls give the same bytes in every locale.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::gaits {

using Polyline = std::vector<Eigen::Vector2d>;

/// Presentation of a shape; what is left at its default is not written. Colours and dashes are SVG attribute values.
struct Paint {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double width = 1;    ///< of the stroke [px]
  double opacity = 1;  ///< of fill and stroke
  std::string_view dash = {};
};

struct TextStyle {
  double size = 12;  ///< [px]
  std::string_view colour = "#222";
  std::string_view anchor = "start";  ///< start | middle | end
  bool bold = false;
  bool halo = false;  ///< white outline, readable on any ground
};

class SvgCanvas {
 public:
  /// `name` becomes the document's title.
  SvgCanvas(double width, double height, std::string_view name);

  void open_group(std::string_view css_class, std::string_view clip_id = "");
  void close_group();
  /// Names a rectangle for open_group to clip to; inside <defs>.
  void define_clip(std::string_view id, const Eigen::Vector2d& corner, double width, double height);

  /// Names a filling of parallel strokes: fill = "url(#id)".
  void define_hatch(std::string_view id, std::string_view colour);

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Paint& paint);
  void polyline(const Polyline& points, const Paint& paint);
  void polygon(const Polyline& points, const Paint& paint, std::string_view css_class = "");
  void rectangle(const Eigen::Vector2d& corner, double width, double height, const Paint& paint);
  /// `tooltip` is shown by viewers that can; empty: none.
  void circle(const Eigen::Vector2d& centre, double radius, const Paint& paint, std::string_view tooltip = "");
  void text(const Eigen::Vector2d& at, std::string_view words, const TextStyle& style = {});

  /// The finished document.
  std::string finish();

 private:
  void shape(std::string_view name, const Polyline& points, const Paint& paint, std::string_view css_class);
  std::string body_;
};

/// Drops what XML forbids and escapes what it reserves; bytes that are not UTF-8 become U+FFFD.
std::string xml_escape(std::string_view text);

/// Points of the plane [m, y up] to pixels [y down], one scale for both axes.
struct View {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< [m], shown at `corner`
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< [px]
  double scale = 1;                                  ///< [px/m]
  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    return corner + scale * Eigen::Vector2d(p.x() - origin.x(), origin.y() - p.y());
  }
  Polyline operator()(const Polyline& points) const;
};

/// The part of a polygon where normal . x + offset >= 0 (Sutherland-Hodgman: a polygon that is not convex may come back
/// with edges that run along the cut twice; its filled area is right).
Polyline clip(const Polyline& polygon, const Eigen::Vector2d& normal, double offset);

/// The 1, 2 or 5 times a power of ten nearest below `length`.
double round_length(double length);

}  // namespace surefoot::gaits
