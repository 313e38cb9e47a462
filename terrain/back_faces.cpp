#include "terrain/back_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace surefoot::terrain {

namespace {

constexpr std::size_t most_tests = 4'000'000;  ///< of a ray against a segment: tens of milliseconds
constexpr double rounding = 1e-9;              ///< relative to a length
constexpr double level = 0.7;                  ///< least |n_y| of a ceiling: less is a wall that leans

/// Distance along the ray (a unit vector) at which it meets the segment, ends and what rounding adds to them included;
/// infinity if it does not.
double meeting(const Point& from, const Point& direction, const Segment& segment) {
  const double t = segment.normal.dot(segment.a - from) / segment.normal.dot(direction);
  const double along = segment.tangent.dot(from + t * direction - segment.a), slack = rounding * segment.length;
  return t > 0 && along >= -slack && along <= segment.length + slack ? t : std::numeric_limits<double>::infinity();
}

/// What a ray of unit direction meets, if it is a back. Through a vertex it meets both neighbours, and what is solid
/// behind begins at the front.
std::optional<BackFace> back_face_along(const Terrain& terrain, const Point& from, const Point& direction,
                                        double within, const Segment* own) {
  double front = within, back = within;
  const Segment* met = nullptr;
  for (const Segment& other : terrain.segments()) {
    if (&other == own || std::abs(other.a.x() - from.x()) > within + other.length) continue;  // out of the ray's reach
    const double t = meeting(from, direction, other);
    if (other.normal.dot(direction) < 0) front = std::min(front, t);
    else if (t < back) back = t, met = &other;
  }
  if (met == nullptr || back >= front - rounding * within) return std::nullopt;
  return BackFace{met->chain, from + back * direction, own != nullptr ? own->chain : 0};
}

/// How many of `count` rays may be sent, one at least.
std::size_t rays_of(const Terrain& terrain, std::size_t count) {
  return std::clamp<std::size_t>(most_tests / terrain.segments().size(), 1, count);
}

}  // namespace

std::optional<BackFace> back_face_seen(const Terrain& terrain, double within) {
  const auto& segments = terrain.segments();
  const std::size_t rays = rays_of(terrain, segments.size());
  for (std::size_t k = 0; k < rays; ++k) {
    const Segment& ground = segments[k * segments.size() / rays];
    if (!ground.surface.foothold) continue;
    if (auto seen = back_face_along(terrain, 0.5 * (ground.a + ground.b), ground.normal, within, &ground)) return seen;
  }
  return std::nullopt;
}

std::optional<int> ceiling_over_nothing(const Terrain& terrain) {
  const auto& segments = terrain.segments();
  std::size_t rays_left = rays_of(terrain, segments.size());
  const auto over_something = [&](const Segment& ceiling) {
    const Point middle = 0.5 * (ceiling.a + ceiling.b);
    return std::any_of(segments.begin(), segments.end(), [&](const Segment& other) {
      return other.chain != ceiling.chain && other.normal.y() > 0 && std::isfinite(meeting(middle, {0, -1}, other));
    });
  };
  for (auto first = segments.begin(); first != segments.end() && rays_left > 0;) {
    const auto last = std::find_if(first, segments.end(), [&](const Segment& s) { return s.chain != first->chain; });
    const bool faces_up = std::any_of(first, last, [](const Segment& s) { return s.normal.y() > 0; });
    bool down = false, over = false;
    for (auto s = first; s != last && !faces_up && !over && rays_left > 0; ++s) {
      if (!(s->normal.y() < -level)) continue;
      down = true, over = over_something(*s), --rays_left;
    }
    if (down && !over && rays_left > 0) return first->chain;
    first = last;
  }
  return std::nullopt;
}

std::optional<BackFace> back_face_over(const Terrain& terrain, std::span<const Point> points, double within) {
  if (points.empty()) return std::nullopt;
  const std::size_t rays = rays_of(terrain, points.size());
  for (std::size_t k = 0; k < rays; ++k) {
    const std::size_t i = k * points.size() / rays;
    for (const double way : {1.0, -1.0}) {
      auto seen = back_face_along(terrain, points[i], Point(0, way), within, nullptr);
      if (!seen) continue;
      seen->index = static_cast<int>(i);
      return seen;
    }
  }
  return std::nullopt;
}

}  // namespace surefoot::terrain
