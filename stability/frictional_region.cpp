#include "stability/frictional_region.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "stability/frictional_lines.hpp"
#include "stability/given.hpp"
#include "stability/region_setup.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

constexpr int first_panels = 32;
constexpr int most_panels = 200;           ///< bounds the work: 30 lines for each beyond the first; usual: 40 to 80
constexpr double narrowest_panel = 1e-13;  ///< relative to the strip: below, x has no digits left
constexpr int drawn_lines = 240;           ///< polygons follow the boundary at so many lines at least
constexpr double drawn_gap = 1e-5;         ///< relative to the strip: left open where a part begins or ends
constexpr int most_drawn_lines = 2000;     ///< beyond, gaps are left as they are

struct Panel {
  double from, to;
  FrictionalLengths area{}, error{};
  double worst() const { return *std::max_element(error.begin(), error.end()); }
  bool operator<(const Panel& other) const { return worst() < other.worst(); }
};

Panel integrate(FrictionalLines& lines, double from, double to) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
  using Gauss = boost::math::quadrature::gauss<double, 7>;
  Panel panel{from, to, {}, {}};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  FrictionalLengths gauss{};
  const auto add = [&](double x, std::size_t k) {
    const FrictionalLengths length = lines.at(x).lengths();
    for (int i = 0; i < frictional_part_count; ++i) {
      panel.area[i] += half * Kronrod::weights()[k] * length[i];
      if (k % 2 == 0) gauss[i] += half * Gauss::weights()[k / 2] * length[i];
    }
  };
  for (std::size_t k = 0; k < Kronrod::abscissa().size(); ++k) {
    const double offset = half * Kronrod::abscissa()[k];
    add(middle + offset, k);
    if (k > 0) add(middle - offset, k);
  }
  for (int i = 0; i < frictional_part_count; ++i) panel.error[i] = std::abs(panel.area[i] - gauss[i]);
  return panel;
}

/// Polygons of one part, as far as the sweep has come.
class Tracer {
 public:
  void advance(double x, const Intervals& now) {
    if (!continues(now)) close();
    if (open_.empty()) open_.resize(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      open_[k].low.push_back({x, now[k].low});
      open_[k].high.push_back({x, now[k].high});
    }
    last_ = now;
  }
  bool continues(const Intervals& now) const {
    if (now.size() != last_.size()) return false;
    for (std::size_t k = 0; k < now.size(); ++k)
      if (!(now[k].low < last_[k].high && last_[k].low < now[k].high)) return false;
    return true;
  }
  std::vector<RegionPolygon> finish() {
    close();
    return std::move(done_);
  }

 private:
  struct Open {
    RegionPolygon low, high;
  };
  void close() {
    for (Open& open : open_) {
      RegionPolygon polygon = std::move(open.low);
      polygon.insert(polygon.end(), open.high.rbegin(), open.high.rend());
      if (polygon.size() > 3) done_.push_back(std::move(polygon));
    }
    open_.clear();
    last_.clear();
  }
  std::vector<Open> open_;
  Intervals last_;
  std::vector<RegionPolygon> done_;
};

using Tracers = std::array<Tracer, frictional_part_count>;

/// From the line before, which the tracers have taken, to `line`: halved where a part begins, ends or divides,
/// while fewer than `last` lines were asked.
void trace_to(FrictionalLines& lines, double before, const FrictionalLine& line, double gap, int last,
              Tracers& tracers) {
  const auto goes_on = [&] {
    for (int k = 0; k < frictional_part_count; ++k)
      if (!tracers[k].continues(line.part[k])) return false;
    return true;
  };
  if (!goes_on() && line.x - before > gap && lines.asked() < last) {
    const FrictionalLine middle = lines.at(0.5 * (before + line.x));
    trace_to(lines, before, middle, gap, last, tracers);
    return trace_to(lines, middle.x, line, gap, last, tracers);
  }
  for (int k = 0; k < frictional_part_count; ++k) tracers[k].advance(line.x, line.part[k]);
}

std::array<std::vector<RegionPolygon>, frictional_part_count> trace(FrictionalLines& lines, double from, double to) {
  Tracers tracers;
  const double width = to - from, inset = drawn_gap * width;  // on the edges of the strip no verdict holds
  const int last = lines.asked() + most_drawn_lines;
  FrictionalLine line = lines.at(from + inset);
  for (int k = 0; k < frictional_part_count; ++k) tracers[k].advance(line.x, line.part[k]);
  for (int i = 1; i <= drawn_lines; ++i) {
    const double before = line.x;
    line = lines.at(from + inset + (width - 2 * inset) * i / drawn_lines);
    trace_to(lines, before, line, inset, last, tracers);
  }
  std::array<std::vector<RegionPolygon>, frictional_part_count> polygons;
  for (int k = 0; k < frictional_part_count; ++k) polygons[k] = tracers[k].finish();
  return polygons;
}

/// All of the strip: the panel with the greatest error is halved until the errors together are within the tolerance.
std::vector<Panel> integrate_strip(FrictionalLines& lines, double from, double to, double tolerance) {
  std::vector<Panel> panels;  // a heap
  const auto put = [&](double a, double b) {
    panels.push_back(integrate(lines, a, b));
    std::push_heap(panels.begin(), panels.end());
  };
  const auto edge = [&](int i) { return i < first_panels ? from + (to - from) * i / first_panels : to; };
  for (int i = 0; i < first_panels; ++i) put(edge(i), edge(i + 1));
  const auto error = [&] {
    double sum = 0;
    for (const Panel& panel : panels) sum += panel.worst();
    return sum;
  };
  // The sum is made anew, not kept up to date: subtracting would leave its rounding behind.
  for (int count = first_panels; count < most_panels && error() > tolerance; ++count) {
    std::pop_heap(panels.begin(), panels.end());
    const Panel panel = panels.back();
    const double middle = 0.5 * (panel.from + panel.to);
    if (panel.to - panel.from < narrowest_panel * (to - from)) break;
    panels.pop_back();
    put(panel.from, middle);
    put(middle, panel.to);
  }
  return panels;
}

}  // namespace

FrictionalRegion frictional_region(std::span<const Contact> contacts, double radius_of_gyration, double restitution,
                                   const FrictionalRegionOptions& options) {
  require(contacts.size() == 2, "frictional stability is about two contacts");
  require_restitution(restitution);
  require(positive(options.area_tolerance), "region: expected tolerances to be numbers > 0");
  require_window(options.window);
  const RobustOracle oracle(contacts, radius_of_gyration, DisturbanceBox{});
  FrictionalRegion region;
  region.restitution = restitution;
  region.window = options.window.value_or(default_window(contacts, radius_of_gyration));
  const Vector2d low = region.window.min(), high = region.window.max();
  for (const Vector2d& corner : oracle.equilibrium_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}))
    region.strip.extend(corner);
  if (region.strip.isEmpty() || !(region.strip.volume() > 0)) {
    region.strip.setEmpty();
    return region;
  }
  FrictionalLines lines(contacts, radius_of_gyration, restitution, region.strip);
  region.upward = lines.upward();
  const double from = region.strip.min().x(), to = region.strip.max().x();
  FrictionalPart* const parts[] = {&region.kinematic_strong, &region.clattering, &region.stable};
  for (const Panel& panel : integrate_strip(lines, from, to, options.area_tolerance * region.strip.volume()))
    for (int k = 0; k < frictional_part_count; ++k) {
      parts[k]->area += panel.area[k];
      parts[k]->error += panel.error[k];
    }
  if (options.polygons) {
    auto polygons = trace(lines, from, to);
    for (int k = 0; k < frictional_part_count; ++k) parts[k]->polygons = std::move(polygons[k]);
  }
  region.lines = lines.asked();
  return region;
}

}  // namespace surefoot::stability
