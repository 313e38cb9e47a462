#include "gaits/verifier_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace surefoot::gaits::bare {
namespace {

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }
double length(const Point& a) { return std::hypot(a.x(), a.y()); }

bool in_box(const Point& a, const Point& b, const Point& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

/// Angle [rad] from direction a counter-clockwise to direction b, in [0, 2 pi).
double turn(const Point& a, const Point& b) {
  const double angle = std::atan2(cross(a, b), a.dot(b));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

}  // namespace

Distances distances_along(const Point& point, const Point& a, const Point& b) {
  const double at_a = length(point - a), at_b = length(point - b);
  Distances result{std::min(at_a, at_b), std::max(at_a, at_b), at_a <= at_b ? 0.0 : 1.0, at_a >= at_b ? 0.0 : 1.0};
  const double span = length(b - a);
  if (span == 0) return result;
  const Point along = (b - a) / span;
  const double foot_of_perpendicular = (point - a).dot(along);
  if (foot_of_perpendicular > 0 && foot_of_perpendicular < span) {
    const double perpendicular = std::abs(cross(along, point - a));
    if (perpendicular < result.least) {
      result.least = perpendicular;
      result.lambda_least = foot_of_perpendicular / span;
    }
  }
  return result;
}

long double orientation(const Point& a, const Point& b, const Point& c) {
  const long double ax = a.x(), ay = a.y();
  return (b.x() - ax) * (c.y() - ay) - (b.y() - ay) * (c.x() - ax);
}

bool meet(const Point& p, const Point& q, const Point& a, const Point& b) {
  const long double a_side = orientation(p, q, a), b_side = orientation(p, q, b);
  const long double p_side = orientation(a, b, p), q_side = orientation(a, b, q);
  const bool apart = (a_side > 0) != (b_side > 0) && (p_side > 0) != (q_side > 0);
  if (apart && a_side != 0 && b_side != 0 && p_side != 0 && q_side != 0) return true;
  return (a_side == 0 && in_box(p, q, a)) || (b_side == 0 && in_box(p, q, b)) || (p_side == 0 && in_box(a, b, p)) ||
         (q_side == 0 && in_box(a, b, q));
}

// Two lines that do not meet are nearest at an end of one of them.
double distance(const Point& p, const Point& q, const Point& a, const Point& b) {
  if (meet(p, q, a, b)) return 0;
  return std::min({distances_along(p, a, b).least, distances_along(q, a, b).least, distances_along(a, p, q).least,
                   distances_along(b, p, q).least});
}

// The part of a-b inside the circle is a chord m + t d, t in [t0, t1]; seen from the centre it sweeps less than half a
// turn. It meets the sector iff one of its ends is in it, or it sweeps across the whole of it.
bool meets_sector(const Point& centre, double radius, const Point& from, const Point& to, const Point& a,
                  const Point& b) {
  // By lengths along the segment from the foot of the perpendicular: no square of the segment's length, which may be
  // millions of radii, is taken.
  const Point m = a - centre, along = (b - a).normalized(), across(-along.y(), along.x());
  const double distance = m.dot(across), begin = m.dot(along), end = begin + (b - a).norm();
  const double half_chord = std::sqrt(std::max(0.0, radius * radius - distance * distance));
  const double s0 = std::max(begin, -half_chord), s1 = std::min(end, half_chord);
  if (std::abs(distance) > radius || s0 > s1) return false;
  const Point first = distance * across + s0 * along, last = distance * across + s1 * along;
  const double opening = turn(from, to);
  if (turn(from, first) <= opening || turn(from, last) <= opening) return true;
  const double sweep = turn(first, last);
  if (sweep <= std::numbers::pi) return turn(first, from) <= sweep;
  return turn(last, from) <= 2 * std::numbers::pi - sweep;
}

// Borders are places where segments begin, every sixteenth of them; a terrain most of whose segments cross many strips
// is left in one.
Strips::Strips(const terrain::Terrain& terrain) {
  constexpr std::size_t per_strip = 16, most_entries_per_segment = 16;
  std::vector<double> begins;
  for (const terrain::Segment& segment : terrain.segments()) begins.push_back(std::min(segment.a.x(), segment.b.x()));
  std::sort(begins.begin(), begins.end());
  for (std::size_t i = per_strip; i < begins.size(); i += per_strip) borders_.push_back(begins[i]);
  std::size_t entries = 0;
  for (const terrain::Segment& segment : terrain.segments())
    entries += 1 + strip_of(std::max(segment.a.x(), segment.b.x())) - strip_of(std::min(segment.a.x(), segment.b.x()));
  if (entries > most_entries_per_segment * begins.size()) borders_.clear();
  strips_.resize(borders_.size() + 1);
  for (const terrain::Segment& segment : terrain.segments()) {
    const std::size_t last = strip_of(std::max(segment.a.x(), segment.b.x()));
    for (std::size_t k = strip_of(std::min(segment.a.x(), segment.b.x())); k <= last; ++k)
      strips_[k].push_back(&segment);
  }
}

std::size_t Strips::strip_of(double x) const {
  return static_cast<std::size_t>(std::upper_bound(borders_.begin(), borders_.end(), x) - borders_.begin());
}

std::vector<const terrain::Segment*> Strips::near(const std::vector<Point>& points, double margin) const {
  Point low = points.front(), high = points.front();
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  low.array() -= margin;
  high.array() += margin;
  std::vector<const terrain::Segment*> near;
  const std::size_t first = strip_of(low.x()), last = strip_of(high.x());
  for (std::size_t k = first; k <= last; ++k)
    for (const terrain::Segment* segment : strips_[k]) {
      const double begin = std::min(segment->a.x(), segment->b.x());
      if (k != std::max(first, strip_of(begin))) continue;  // seen in a strip before
      if (std::max(segment->a.x(), segment->b.x()) >= low.x() && begin <= high.x() &&
          std::max(segment->a.y(), segment->b.y()) >= low.y() && std::min(segment->a.y(), segment->b.y()) <= high.y())
        near.push_back(segment);
    }
  return near;
}

}  // namespace surefoot::gaits::bare
