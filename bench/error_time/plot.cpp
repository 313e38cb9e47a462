#include "bench/error_time/plot.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "gaits/svg_canvas.hpp"

namespace surefoot::bench {
namespace {

using Eigen::Vector2d;
using gaits::Paint;
using gaits::Polyline;
using gaits::SvgCanvas;
using gaits::TextStyle;

// All in pixels.
constexpr double left = 58, right = 16, head = 56, above_panel = 34, below_panel = 46;
constexpr double zero_band = 20;  // between the axis and the line for an error of zero, and above for no answer
constexpr double key_line = 17, caption_line = 14;
constexpr int most_columns = 3;
/// Okabe and Ito: told apart by the colour-blind.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                             "#56b4e9", "#000000", "#8c6d31", "#7f7f7f"};

std::vector<std::string> distinct(const Rows& rows, std::string Row::*member) {
  std::vector<std::string> found;
  for (const Row& row : rows.all())
    if (std::find(found.begin(), found.end(), row.*member) == found.end()) found.push_back(row.*member);
  return found;
}

/// Whole decades around values.
struct Decades {
  int low = 0, high = 1;
  void include(double value, bool& any) {
    if (!(value > 0) || !std::isfinite(value)) return;
    const double exponent = std::log10(value);
    const int from = static_cast<int>(std::floor(exponent - 0.05)), to = static_cast<int>(std::ceil(exponent + 0.05));
    low = any ? std::min(low, from) : from;
    high = any ? std::max(high, to) : to;
    any = true;
  }
  double share(double value) const { return (std::log10(value) - low) / (high - low); }
};

class Plot {
 public:
  Plot(const Item& item, const Rows& rows)
      : item_(item), rows_(rows), cases_(distinct(rows, &Row::scenario)), methods_(distinct(rows, &Row::method)),
        columns_(cases_.size() == 4 ? 2 : std::min<int>(most_columns, static_cast<int>(cases_.size()))),
        lines_((static_cast<int>(cases_.size()) + columns_ - 1) / columns_),
        panel_width_(cases_.size() == 1 ? 580 : 300), panel_height_(cases_.size() == 1 ? 330 : 230),
        canvas_(width(), height(), item.what) {
    bool any_time = false, any_error = false;
    for (const Row& row : rows.all()) {
      time_.include(row.time.seconds / item.time_unit, any_time);
      for (const double error : {row.error, row.low, row.high}) error_.include(error, any_error);
      zero_ |= row.error == 0, none_ |= std::isinf(row.error);
    }
  }

  std::string draw() {
    canvas_.text({12, 22}, item_.what, {15, "#111", "start", true});
    canvas_.text({12, 40}, fmt::format("up: {}; right: {} [{}]", item_.error, item_.time, unit()), {12, "#444"});
    for (std::size_t k = 0; k < cases_.size(); ++k) panel(k);
    key();
    caption();
    return canvas_.finish();
  }

 private:
  double width() const { return std::max(columns_ * (left + panel_width_ + right), 660.0); }
  double cell_height() const { return above_panel + panel_height_ + below_panel; }
  int key_columns() const { return columns_ == 1 ? 2 : columns_; }
  int key_lines() const { return (static_cast<int>(methods_.size()) + key_columns() - 1) / key_columns(); }
  double height() const {
    return head + lines_ * cell_height() + key_lines() * key_line + 14 +
           caption_line * static_cast<double>(caption_lines().size());
  }
  /// The reference, broken into lines.
  std::vector<std::string> caption_lines() const {
    const std::string text = fmt::format("Reference: {}.", item_.reference);
    const auto most = static_cast<std::size_t>((width() - 24) / 5.6);  // characters, at 11 px
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = std::min(at + most, text.size());
      if (end < text.size()) end = text.rfind(' ', end);
      lines.push_back(text.substr(at, end - at));
      at = end + 1;
    }
    return lines;
  }
  void caption() {
    double y = head + lines_ * cell_height() + key_lines() * key_line + 14;
    for (const std::string& line : caption_lines()) canvas_.text({12, y}, line, {11, "#555"}), y += caption_line;
  }
  const char* unit() const { return item_.time_unit == 1 ? "s" : item_.time_unit == 1e-3 ? "ms" : "µs"; }

  Vector2d corner(std::size_t k) const {
    const int column = static_cast<int>(k) % columns_, line = static_cast<int>(k) / columns_;
    return {left + column * (left + panel_width_ + right), head + above_panel + line * cell_height()};
  }
  double axis_top() const { return none_ ? zero_band : 0; }
  double axis_bottom() const { return panel_height_ - (zero_ ? zero_band : 0); }

  Vector2d place(const Vector2d& at, double seconds, double error) const {
    const double x = std::clamp(time_.share(seconds / item_.time_unit), 0.0, 1.0) * panel_width_;
    const double y = error == 0          ? panel_height_ - 0.3 * zero_band
                     : std::isinf(error) ? 0.3 * zero_band
                                         : axis_bottom() - error_.share(error) * (axis_bottom() - axis_top());
    return at + Vector2d(x, y);
  }

  void tick_labels(const Vector2d& at) {
    const auto power = [](int exponent) {
      return exponent >= -2 && exponent <= 3 ? fmt::format("{:g}", std::pow(10.0, exponent))
                                             : fmt::format("1e{}", exponent);
    };
    const Paint grid{.stroke = "#e4e4e4"};
    const int error_step = (error_.high - error_.low + 7) / 8, time_step = (time_.high - time_.low + 7) / 8;
    for (int k = error_.low; k <= error_.high; ++k) {
      const double y = place(at, item_.time_unit, std::pow(10.0, k)).y();
      canvas_.line({at.x(), y}, {at.x() + panel_width_, y}, grid);
      if ((k - error_.low) % error_step == 0) canvas_.text({at.x() - 6, y + 4}, power(k), {11, "#333", "end"});
    }
    for (int k = time_.low; k <= time_.high; ++k) {
      const double x = at.x() + (k - time_.low) * panel_width_ / (time_.high - time_.low);
      canvas_.line({x, at.y()}, {x, at.y() + panel_height_}, grid);
      if ((k - time_.low) % time_step == 0)
        canvas_.text({x, at.y() + panel_height_ + 15}, power(k), {11, "#333", "middle"});
    }
    canvas_.text({at.x() + 0.5 * panel_width_, at.y() + panel_height_ + 31}, fmt::format("{} [{}]", item_.time, unit()),
                 {11, "#555", "middle"});
  }

  void special_line(const Vector2d& at, double error, const char* label) {
    const double y = place(at, item_.time_unit, error).y();
    canvas_.line({at.x(), y}, {at.x() + panel_width_, y}, {.stroke = "#999", .width = 1, .dash = "4 3"});
    canvas_.text({at.x() - 6, y + 4}, label, {11, "#333", "end"});
  }

  void panel(std::size_t k) {
    const Vector2d at = corner(k);
    canvas_.text({at.x(), at.y() - 10}, cases_[k], {13, "#111", "start", true});
    tick_labels(at);
    if (zero_) special_line(at, 0, "none");
    if (none_) special_line(at, INFINITY, "failed");
    canvas_.rectangle(at, panel_width_, panel_height_, {.stroke = "#666"});
    for (std::size_t m = 0; m < methods_.size(); ++m) curve(at, cases_[k], m);
    // Labels last, above all curves.
    for (std::size_t m = 0; m < methods_.size(); ++m) ends(at, cases_[k], m);
  }

  std::vector<const Row*> points(const std::string& scenario, std::size_t method) const {
    std::vector<const Row*> found;
    for (const Row& row : rows_.all())
      if (row.scenario == scenario && row.method == methods_[method]) found.push_back(&row);
    return found;
  }

  void curve(const Vector2d& at, const std::string& scenario, std::size_t method) {
    const char* colour = colours[method % colours.size()];
    Polyline path;
    for (const Row* row : points(scenario, method)) {
      const Vector2d here = place(at, row->time.seconds, row->error);
      if (row->low < row->high) {  // confidence
        const double low = place(at, row->time.seconds, row->low).y(),
                     high = place(at, row->time.seconds, row->high).y();
        canvas_.line({here.x(), low}, {here.x(), high}, {.stroke = colour, .width = 1.2, .opacity = 0.6});
      }
      path.push_back(here);
      taken_.emplace_back(here - Vector2d(4, 4), here + Vector2d(4, 4));
    }
    if (path.size() > 1) canvas_.polyline(path, {.stroke = colour, .width = 1.6, .opacity = 0.85});
    std::size_t k = 0;
    for (const Row* row : points(scenario, method))
      marker(path[k++], method,
             fmt::format("{} {}: error {:.3g}, {:.3g} {}", row->method, row->parameter, row->error,
                         row->time.seconds / item_.time_unit, unit()));
  }

  /// The first and the last accuracy level of a curve in words, where there is room.
  void ends(const Vector2d& at, const std::string& scenario, std::size_t method) {
    const auto found = points(scenario, method);
    if (found.size() < 2) return;
    for (const Row* row : {found.front(), found.back()})
      label(at, place(at, row->time.seconds, row->error), row->parameter, colours[method % colours.size()]);
  }

  void label(const Vector2d& panel, const Vector2d& point, const std::string& words, const char* colour) {
    constexpr double size = 9.5, letter = 5.2, gap = 6;
    const double length = letter * static_cast<double>(words.size());
    for (const auto& [onward, dy] :
         {std::pair{true, -5.0}, {false, -5.0}, {true, 12.0}, {false, 12.0}, {true, -16.0}, {true, 23.0}}) {
      const Vector2d anchor = point + Vector2d(onward ? gap : -gap, dy);
      Eigen::AlignedBox2d box(Vector2d(onward ? anchor.x() : anchor.x() - length, anchor.y() - size));
      box.extend(Vector2d(onward ? anchor.x() + length : anchor.x(), anchor.y()));
      const Eigen::AlignedBox2d frame(panel, panel + Vector2d(panel_width_, panel_height_));
      if (!frame.contains(box) ||
          std::any_of(taken_.begin(), taken_.end(), [&box](const auto& other) { return other.intersects(box); }))
        continue;
      taken_.push_back(box);
      TextStyle style{size, colour, onward ? "start" : "end"};
      style.halo = true;
      canvas_.text(anchor, words, style);
      return;
    }
  }

  void marker(const Vector2d& at, std::size_t method, const std::string& tooltip) {
    const Paint paint{.fill = colours[method % colours.size()], .stroke = "#fff", .width = 0.8};
    constexpr double r = 4;
    switch (method % 4) {
      case 0: canvas_.circle(at, r, paint, tooltip); break;
      case 1: canvas_.rectangle(at - Vector2d(3.6, 3.6), 7.2, 7.2, paint); break;
      case 2: canvas_.polygon({at + Vector2d(0, -5), at + Vector2d(4.6, 3.4), at + Vector2d(-4.6, 3.4)}, paint); break;
      default:
        canvas_.polygon({at + Vector2d(0, -5.2), at + Vector2d(5.2, 0), at + Vector2d(0, 5.2), at + Vector2d(-5.2, 0)},
                        paint);
    }
  }

  void key() {
    const double top = head + lines_ * cell_height() + 4, column = (width() - 24) / key_columns();
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const int k = static_cast<int>(m);
      const Vector2d at(24 + column * (k / key_lines()), top + key_line * (k % key_lines()));
      const char* colour = colours[m % colours.size()];
      canvas_.line(at - Vector2d(12, 0), at + Vector2d(12, 0), {.stroke = colour, .width = 1.6});
      marker(at, m, methods_[m]);
      canvas_.text(at + Vector2d(18, 4), methods_[m], {12, "#222"});
    }
  }

  const Item& item_;
  const Rows& rows_;
  std::vector<std::string> cases_, methods_;
  int columns_, lines_;
  double panel_width_, panel_height_;  // [px]
  SvgCanvas canvas_;
  Decades time_, error_;
  bool zero_ = false, none_ = false;
  std::vector<Eigen::AlignedBox2d> taken_;  ///< by markers and labels
};

}  // namespace

std::string work_precision_plot(const Item& item, const Rows& rows) {
  return rows.all().empty() ? std::string() : Plot(item, rows).draw();
}

}  // namespace surefoot::bench
