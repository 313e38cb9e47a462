#include "gaits/motion_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "gaits/svg_canvas.hpp"

namespace surefoot::gaits {

using Eigen::Vector2d;
using stability::BodyState;
using stability::HybridEvent;

namespace {

constexpr std::string_view faint = "#666", curve = "#0b5394", grid = "#ccc";
constexpr std::string_view flight_fill = "#ffffff", accumulation_fill = "#f6c98f", one_fill = "#d9e8f5",
                           two_fill = "#bfe3d0";
constexpr double left = 96, right = 24, top = 92, panel = 150, gap = 26, wide = 760;  // [px]

bool accumulates(HybridEvent::Kind kind) {
  using Kind = HybridEvent::Kind;
  return kind == Kind::bouncing || kind == Kind::clattering || kind == Kind::chattering || kind == Kind::dies_out;
}

/// One quantity over time.
struct Curve {
  std::string label;
  std::function<double(const BodyState&)> value, rate;
};

class Picture {
 public:
  explicit Picture(const MotionFigure& figure)
      : figure_(figure), panels_(figure.contacts + 1),
        end_(figure.events.empty() ? 1 : std::max(figure.events.back().time, 1e-300)),
        canvas_(left + wide + right, top + panels_ * (panel + gap) + 66, figure.title) {}

  std::string draw() {
    canvas_.text({left, 32}, figure_.title, {.size = 20, .bold = true});
    canvas_.text({left, 56}, figure_.result, {.size = 13});
    phases();
    for (int i = 0; i < figure_.contacts; ++i) {
      const auto k = static_cast<std::size_t>(i);
      curves(i, {fmt::format("h{} [m]", i + 1), [k](const BodyState& s) { return s.h[k]; },
                 [k](const BodyState& s) { return s.rate[k]; }});
    }
    curves(figure_.contacts,
           {"theta [rad]", [](const BodyState& s) { return s.theta; }, [](const BodyState& s) { return s.omega; }});
    axis();
    key();
    return canvas_.finish();
  }

 private:
  double x_of(double time) const { return left + wide * time / end_; }
  double top_of(int row) const { return top + row * (panel + gap); }
  double bottom() const { return top_of(panels_ - 1) + panel; }

  void band(double from, double to, std::string_view fill) {
    if (!(to > from)) return;
    for (int row = 0; row < panels_; ++row)
      canvas_.rectangle({x_of(from), top_of(row)}, x_of(to) - x_of(from), panel, {.fill = fill});
  }

  /// Bands: flight, one contact closed, both closed, an accumulation.
  void phases() {
    std::string_view fill = flight_fill;
    double from = 0;
    for (const HybridEvent& event : figure_.events) {
      if (event.kind == HybridEvent::Kind::sample) continue;
      band(from, event.time, fill);
      if (accumulates(event.kind)) band(event.time - event.duration, event.time, accumulation_fill);
      int held = 0;
      for (int i = 0; i < event.mode.contacts; ++i) held += event.mode.at[i] != stability::ContactState::breaks;
      fill = event.kind != HybridEvent::Kind::mode ? flight_fill
             : held == 2                           ? two_fill
             : held == 1                           ? one_fill
                                                   : flight_fill;
      from = event.time;
    }
    band(from, end_, fill);
  }

  void curves(int row, const Curve& what) {
    double low = std::min(0.0, what.value(figure_.start)), high = std::max(0.0, what.value(figure_.start));
    const auto points = trace(what, low, high);
    constexpr double visible = 1e-6;  // of the range: less below zero is rounding
    if (-low < visible * high) low = 0;
    if (high < visible * -low) high = 0;
    if (!(high > low)) high = low + 1;
    const auto y_of = [&](double v) { return top_of(row) + panel - (panel - 12) * (v - low) / (high - low) - 6; };
    canvas_.line({left, y_of(0)}, {left + wide, y_of(0)}, {.stroke = grid, .width = 1});
    Polyline line;
    for (const Vector2d& p : points) line.push_back({x_of(p.x()), y_of(p.y())});
    canvas_.polyline(line, {.stroke = curve, .width = 1.4});
    if (figure_.events.empty()) canvas_.circle(line.front(), 3, {.fill = curve});  // it ends where it begins
    canvas_.rectangle({left, top_of(row)}, wide, panel, {.stroke = faint, .width = 0.8});
    canvas_.text({left, top_of(row) - 6}, what.label, {.size = 13, .bold = true});
    for (const double v : {low, high})
      canvas_.text({left - 8, y_of(v) + 4}, v == 0 ? "0" : fmt::format("{:.3g}", v),
                   {.size = 12, .colour = faint, .anchor = "end"});
  }

  /// Between events the parabola through both values with the rate at the begin: exact for flights but for turning.
  std::vector<Vector2d> trace(const Curve& what, double& low, double& high) const {
    constexpr int pieces = 12;
    std::vector<Vector2d> points{{0, what.value(figure_.start)}};
    const BodyState* from = &figure_.start;
    double begin = 0;
    for (const HybridEvent& event : figure_.events) {
      const double span = event.time - begin, v0 = what.value(*from), v1 = what.value(event.state),
                   r = what.rate(*from);
      const bool straight = accumulates(event.kind) || !(x_of(event.time) - x_of(begin) > 1);
      for (int k = 1; k <= pieces && !straight; ++k) {
        const double s = static_cast<double>(k) / pieces, v = v0 + r * span * s + (v1 - v0 - r * span) * s * s;
        points.emplace_back(begin + s * span, v);
        low = std::min(low, v), high = std::max(high, v);
      }
      points.emplace_back(event.time, v1);
      low = std::min(low, v1), high = std::max(high, v1);
      from = &event.state, begin = event.time;
    }
    return points;
  }

  void axis() {
    const double step = round_length(end_ / 4);
    for (int k = 0; k * step <= end_ * (1 + 1e-9); ++k) {
      const double x = x_of(k * step);
      canvas_.line({x, bottom()}, {x, bottom() + 5}, {.stroke = faint});
      canvas_.text({x, bottom() + 20}, fmt::format("{:.4g}", k * step),
                   {.size = 12, .colour = faint, .anchor = "middle"});
    }
    canvas_.text({left + wide, bottom() + 38}, "time [s]", {.size = 12, .anchor = "end"});
  }

  void key() {
    double x = left;
    const auto entry = [&](std::string_view fill, std::string_view label) {
      canvas_.rectangle({x, bottom() + 28}, 16, 12, {.fill = fill, .stroke = faint, .width = 0.7});
      canvas_.text({x + 22, bottom() + 39}, label, {.size = 12});
      x += 40 + 6.6 * static_cast<double>(label.size());
    };
    entry(flight_fill, "flight and collisions");
    entry(accumulation_fill, "accumulation completed");
    entry(one_fill, "one contact closed");
    if (figure_.contacts == 2) entry(two_fill, "both closed");
  }

  const MotionFigure& figure_;
  int panels_;
  double end_;
  SvgCanvas canvas_;
};

}  // namespace

std::string words(const HybridEvent& event) {
  const int contact = event.contact + 1;
  using Kind = HybridEvent::Kind;
  switch (event.kind) {
    case Kind::collision: return fmt::format("contact {} collides", contact);
    case Kind::bouncing: return fmt::format("bouncing at contact {} ends", contact);
    case Kind::clattering: return "clattering ends";
    case Kind::chattering: return "chattering in zero time ends";
    case Kind::dies_out: return "collisions and slides die out";
    case Kind::mode: return fmt::format("mode {}{}", event.mode.name(), event.ambiguous ? " (one of several)" : "");
    case Kind::sample: return "moves";
    case Kind::stops: return fmt::format("sliding at contact {} stops", contact);
    case Kind::lifts: return fmt::format("contact {} lifts off", contact);
    case Kind::slips: return fmt::format("contact {} begins to slide", contact);
    case Kind::reaches: return fmt::format("contact {} comes down", contact);
  }
  return "";
}

std::string to_svg(const MotionFigure& figure) { return Picture(figure).draw(); }

}  // namespace surefoot::gaits
