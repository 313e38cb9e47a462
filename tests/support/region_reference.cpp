#include "tests/support/region_reference.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::testing {
namespace {

using Eigen::Vector2d;
using stability::RobustOracle;

class Line {
 public:
  Line(const RobustOracle& oracle, double y) : oracle_(oracle), y_(y) {}

  double robust_length(double from, double to) {
    constexpr int samples = 48;
    Sample before = at(from);
    for (int k = 1; k <= samples; ++k) {
      const Sample here = at(from + (to - from) * k / samples);
      between(before, here, 12);
      before = here;
    }
    return length_;
  }

 private:
  struct Sample {
    double x;
    bool robust;
    std::string modes;
  };
  Sample at(double x) const {
    Sample sample{x, oracle_.robust({x, y_}), {}};
    if (!sample.robust)
      for (const auto& mode : oracle_.feasible_modes({x, y_})) sample.modes += mode.name();
    return sample;
  }
  void between(const Sample& a, const Sample& b, int depth) {
    if (a.robust != b.robust) {
      double in = a.robust ? a.x : b.x, out = a.robust ? b.x : a.x;
      const double start = in;
      for (int halving = 0; halving < 48; ++halving) {
        const double middle = 0.5 * (in + out);
        (oracle_.robust({middle, y_}) ? in : out) = middle;
      }
      length_ += std::abs(in - start);
      return;
    }
    if (a.robust && oracle_.line({a.x, y_}, {b.x, y_}).stable()) {
      length_ += b.x - a.x;
      return;
    }
    if (!a.robust && (a.modes == b.modes || depth == 0)) return;
    if (a.robust && depth == 0) {
      length_ += b.x - a.x;
      return;
    }
    const Sample middle = at(0.5 * (a.x + b.x));
    between(a, middle, depth - 1);
    between(middle, b, depth - 1);
  }
  const RobustOracle& oracle_;
  double y_, length_ = 0;
};

class Area {
 public:
  Area(const RobustOracle& oracle, const std::vector<Vector2d>& polygon) : oracle_(oracle), polygon_(polygon) {}

  double length(double y) const {
    double from = HUGE_VAL, to = -HUGE_VAL;
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      const Vector2d &p = polygon_[k], &q = polygon_[(k + 1) % polygon_.size()];
      if ((p.y() <= y) == (q.y() <= y)) continue;
      const double x = p.x() + (q.x() - p.x()) * ((y - p.y()) / (q.y() - p.y()));
      from = std::min(from, x), to = std::max(to, x);
    }
    return from < to ? Line(oracle_, y).robust_length(from, to) : 0;
  }

  ReferenceArea integral(double a, double b, double tolerance) {
    found_ = {};
    constexpr int parts = 8;  // so that no rule is fooled at the start
    for (int k = 0; k < parts; ++k) {
      const double from = a + (b - a) * k / parts, to = a + (b - a) * (k + 1) / parts, middle = 0.5 * (from + to);
      simpson({from, length(from)}, {middle, length(middle)}, {to, length(to)}, tolerance / parts, 24);
    }
    return found_;
  }

 private:
  struct Point {
    double y, f;
  };
  void simpson(const Point& a, const Point& m, const Point& b, double allowed, int depth) {
    const Point l{0.5 * (a.y + m.y), length(0.5 * (a.y + m.y))}, r{0.5 * (m.y + b.y), length(0.5 * (m.y + b.y))};
    const double coarse = (b.y - a.y) / 6 * (a.f + 4 * m.f + b.f);
    const double fine = (b.y - a.y) / 12 * (a.f + 4 * l.f + 2 * m.f + 4 * r.f + b.f);
    const double difference = std::abs(fine - coarse);
    if (depth == 0 || difference <= allowed) {
      found_.area += fine;
      found_.error += difference;
      return;
    }
    simpson(a, l, m, 0.5 * allowed, depth - 1);
    simpson(m, r, b, 0.5 * allowed, depth - 1);
  }
  const RobustOracle& oracle_;
  const std::vector<Vector2d>& polygon_;
  ReferenceArea found_;
};

}  // namespace

ReferenceArea reference_area(const RobustOracle& oracle, const std::vector<Vector2d>& polygon, double tolerance) {
  std::vector<double> heights;
  for (const Vector2d& corner : polygon) heights.push_back(corner.y());
  std::sort(heights.begin(), heights.end());
  ReferenceArea sum;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    if (!(heights[k] < heights[k + 1])) continue;
    const double share = tolerance * (heights[k + 1] - heights[k]) / (heights.back() - heights.front());
    const ReferenceArea part = Area(oracle, polygon).integral(heights[k], heights[k + 1], share);
    sum.area += part.area, sum.error += part.error;
  }
  return sum;
}

}  // namespace surefoot::testing
