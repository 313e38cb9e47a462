#include "terrain/back_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace surefoot::terrain {

namespace {

constexpr std::size_t most_tests = 4'000'000;  ///< of a ray against a segment: tens of milliseconds
constexpr double rounding = 1e-9;              ///< relative to a length

/// Distance along the ray (a unit vector) at which it meets the segment, ends and what rounding adds to them included;
/// infinity if it does not.
double meeting(const Point& from, const Point& direction, const Segment& segment) {
  const double t = segment.normal.dot(segment.a - from) / segment.normal.dot(direction);
  const double along = segment.tangent.dot(from + t * direction - segment.a), slack = rounding * segment.length;
  return t > 0 && along >= -slack && along <= segment.length + slack ? t : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<BackFace> back_face_seen(const Terrain& terrain, double within) {
  const auto& segments = terrain.segments();
  const std::size_t rays = std::clamp<std::size_t>(most_tests / segments.size(), 1, segments.size());
  for (std::size_t k = 0; k < rays; ++k) {
    const Segment& ground = segments[k * segments.size() / rays];
    if (!ground.surface.foothold) continue;
    const Point middle = 0.5 * (ground.a + ground.b);
    double front = within, back = within;
    const Segment* met = nullptr;
    for (const Segment& other : segments) {
      if (&other == &ground) continue;
      const double t = meeting(middle, ground.normal, other);
      if (other.normal.dot(ground.normal) < 0) front = std::min(front, t);
      else if (t < back) back = t, met = &other;
    }
    // Through a vertex the ray meets both neighbours; the solid behind begins at the front.
    if (met != nullptr && back < front - rounding * within)
      return BackFace{met->chain, ground.chain, middle + back * ground.normal};
  }
  return std::nullopt;
}

}  // namespace surefoot::terrain
