#include "gaits/svg_canvas.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>

namespace surefoot::gaits {
namespace {

/// To a hundredth of a pixel, without idle zeros.
std::string px(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attributes(const Paint& paint) {
  std::string text = fmt::format(" fill=\"{}\"", paint.fill);
  if (paint.stroke != "none") text += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", paint.stroke, px(paint.width));
  if (paint.opacity < 1) text += fmt::format(" opacity=\"{}\"", px(paint.opacity));
  if (!paint.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", paint.dash);
  return text;
}

/// Length of the UTF-8 sequence at the start of `text`, 0 if it is none; its code point.
std::size_t decode(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (length == 0 || length > text.size()) return 0;
  code = length == 1 ? first : first & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(i) >> 6 != 2) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  return code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

}  // namespace

std::string xml_escape(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t length = decode(text, code);
    if (length == 0) {
      result += "\xef\xbf\xbd";
    } else if (code == '&') {
      result += "&amp;";
    } else if (code == '<') {
      result += "&lt;";
    } else if (code == '>') {
      result += "&gt;";
    } else if (code == '"') {
      result += "&quot;";
    } else if (code < 0x20 || code == 0x7f) {
      result += ' ';
    } else if (code != 0xfffe && code != 0xffff) {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view name) {
  body_ = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      px(width), px(height), xml_escape(name));
}

void SvgCanvas::open_group(std::string_view css_class, std::string_view clip_id) {
  body_ += fmt::format("<g class=\"{}\"", css_class);
  if (!clip_id.empty()) body_ += fmt::format(" clip-path=\"url(#{})\"", clip_id);
  body_ += ">\n";
}

void SvgCanvas::close_group() { body_ += "</g>\n"; }

void SvgCanvas::define_clip(std::string_view id, const Eigen::Vector2d& corner, double width, double height) {
  body_ +=
      fmt::format("<defs><clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath></defs>\n",
                  id, px(corner.x()), px(corner.y()), px(width), px(height));
}

void SvgCanvas::define_hatch(std::string_view id, std::string_view colour) {
  body_ += fmt::format(
      "<defs><pattern id=\"{}\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><path d=\"M0 0V7\" stroke=\"{}\" stroke-width=\"1.6\"/></pattern></defs>\n",
      id, colour);
}

void SvgCanvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Paint& paint) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", px(from.x()), px(from.y()), px(to.x()),
                       px(to.y()), attributes(paint));
}

void SvgCanvas::shape(std::string_view name, const Polyline& points, const Paint& paint, std::string_view css_class) {
  body_ += fmt::format("<{}", name);
  if (!css_class.empty()) body_ += fmt::format(" class=\"{}\"", css_class);
  body_ += " points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    body_ += fmt::format("{}{},{}", i == 0 ? "" : " ", px(points[i].x()), px(points[i].y()));
  body_ += fmt::format("\"{}/>\n", attributes(paint));
}

void SvgCanvas::polyline(const Polyline& points, const Paint& paint) { shape("polyline", points, paint, ""); }

void SvgCanvas::polygon(const Polyline& points, const Paint& paint, std::string_view css_class) {
  shape("polygon", points, paint, css_class);
}

void SvgCanvas::rectangle(const Eigen::Vector2d& corner, double width, double height, const Paint& paint) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", px(corner.x()), px(corner.y()),
                       px(width), px(height), attributes(paint));
}

void SvgCanvas::circle(const Eigen::Vector2d& centre, double radius, const Paint& paint, std::string_view tooltip) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}", px(centre.x()), px(centre.y()), px(radius),
                       attributes(paint));
  body_ += tooltip.empty() ? "/>\n" : fmt::format("><title>{}</title></circle>\n", xml_escape(tooltip));
}

void SvgCanvas::text(const Eigen::Vector2d& at, std::string_view words, const TextStyle& style) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"", px(at.x()), px(at.y()), px(style.size),
                       style.colour);
  if (style.anchor != "start") body_ += fmt::format(" text-anchor=\"{}\"", style.anchor);
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.halo) body_ += " stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";
  body_ += fmt::format(">{}</text>\n", xml_escape(words));
}

std::string SvgCanvas::finish() { return body_ + "</svg>\n"; }

Polyline View::operator()(const Polyline& points) const {
  Polyline result;
  result.reserve(points.size());
  for (const auto& p : points) result.push_back((*this)(p));
  return result;
}

Polyline clip(const Polyline& polygon, const Eigen::Vector2d& normal, double offset) {
  Polyline result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double at_a = normal.dot(a) + offset;
    const double at_b = normal.dot(b) + offset;
    if (at_a >= 0) result.push_back(a);
    if ((at_a < 0) != (at_b < 0)) result.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return result;
}

double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

}  // namespace surefoot::gaits
