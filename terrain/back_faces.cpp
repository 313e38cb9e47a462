#include "terrain/back_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace surefoot::terrain {

namespace {

constexpr std::size_t most_tests = 4'000'000;  ///< of a ray against a segment: tens of milliseconds

/// Distance along the ray (a unit vector) at which it meets the inside of the segment; infinity if it does not.
double meeting(const Point& from, const Point& direction, const Segment& segment) {
  const double t = segment.normal.dot(segment.a - from) / segment.normal.dot(direction);
  const double along = segment.tangent.dot(from + t * direction - segment.a);
  return t > 0 && along > 0 && along < segment.length ? t : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<BackFace> back_face_seen(const Terrain& terrain, double within) {
  const auto& segments = terrain.segments();
  const std::size_t rays = std::clamp<std::size_t>(most_tests / segments.size(), 1, segments.size());
  for (std::size_t k = 0; k < rays; ++k) {
    const Segment& ground = segments[k * segments.size() / rays];
    if (!ground.surface.foothold) continue;
    const Point middle = 0.5 * (ground.a + ground.b);
    double nearest = within;
    const Segment* met = nullptr;
    for (const Segment& other : segments) {
      if (&other == &ground) continue;
      const double t = meeting(middle, ground.normal, other);
      if (t < nearest) nearest = t, met = &other;
    }
    if (met != nullptr && met->normal.dot(ground.normal) > 0)
      return BackFace{met->chain, ground.chain, middle + nearest * ground.normal};
  }
  return std::nullopt;
}

}  // namespace surefoot::terrain
