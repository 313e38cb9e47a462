#include "terrain/back_faces.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

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

struct Sight {
  const Segment* met = nullptr;  ///< nothing is seen without
  Point at;
  bool back = false;
};

/// What a ray of unit direction meets first. Through a vertex it meets both neighbours, and what is solid behind begins
/// at the front.
Sight look(const Terrain& terrain, const Point& from, const Point& direction, double within, const Segment* own) {
  double nearest[2] = {within, within};  // front, back
  const Segment* met[2] = {nullptr, nullptr};
  for (const Segment& other : terrain.segments()) {
    if (&other == own || std::abs(other.a.x() - from.x()) > within + other.length) continue;  // out of the ray's reach
    const double t = meeting(from, direction, other);
    const int side = other.normal.dot(direction) < 0 ? 0 : 1;
    if (t < nearest[side]) nearest[side] = t, met[side] = &other;
  }
  const bool back = met[1] != nullptr && nearest[1] < nearest[0] - rounding * within;
  return {met[back], from + nearest[back] * direction, back};
}

/// What such a ray meets, if it is a back.
std::optional<BackFace> back_face_along(const Terrain& terrain, const Point& from, const Point& direction,
                                        double within, const Segment* own) {
  const Sight sight = look(terrain, from, direction, within, own);
  if (!sight.back) return std::nullopt;
  return BackFace{sight.met->chain, sight.at, own != nullptr ? own->chain : 0};
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

namespace {

struct ChainBox {
  Eigen::AlignedBox2d extent;
  bool faces_up = false, faces_down = false;
};

std::vector<ChainBox> boxes_of_chains(const Terrain& terrain) {
  std::vector<ChainBox> boxes(static_cast<std::size_t>(terrain.chain_count()));
  for (const Segment& s : terrain.segments()) {
    ChainBox& box = boxes[static_cast<std::size_t>(s.chain)];
    box.extent.extend(s.a).extend(s.b);
    box.faces_up = box.faces_up || s.normal.y() > 0;
    box.faces_down = box.faces_down || s.normal.y() < -level;
  }
  return boxes;
}

}  // namespace

std::optional<int> ground_upside_down(const Terrain& terrain, double near, double room) {
  const auto boxes = boxes_of_chains(terrain);
  std::size_t tests = 0;
  for (std::size_t chain = 0; chain < boxes.size(); ++chain) {
    const ChainBox& box = boxes[chain];
    if (box.faces_up || !box.faces_down) continue;
    const Point least = box.extent.min(), most = box.extent.max();
    bool below = false, beside = false;
    for (const Segment& other : terrain.segments()) {
      if (++tests > most_tests) return std::nullopt;
      if (!(other.normal.y() > 0)) continue;  // no ground; the chain itself has none
      const double from = std::min(other.a.x(), other.b.x()), to = std::max(other.a.x(), other.b.x());
      const double low = std::min(other.a.y(), other.b.y()), high = std::max(other.a.y(), other.b.y());
      below = below || (from < most.x() && to > least.x() && low < most.y());
      beside = beside || (from < most.x() + near && to > least.x() - near && high + room >= most.y());
    }
    if (beside && !below) return static_cast<int>(chain);
  }
  return std::nullopt;
}

std::optional<BackFace> wall_back_seen(const Terrain& terrain, double within) {
  const auto boxes = boxes_of_chains(terrain);
  std::size_t rays = rays_of(terrain, terrain.segments().size());
  for (const Segment& wall : terrain.segments()) {
    const ChainBox& box = boxes[static_cast<std::size_t>(wall.chain)];
    if (box.faces_up || !box.faces_down || std::abs(wall.normal.y()) > level) continue;
    if (rays-- == 0) return std::nullopt;
    constexpr double behind = 1e-6;  // of the wall's length
    const Point from = 0.5 * (wall.a + wall.b) - behind * wall.length * wall.normal;
    const Sight sight = look(terrain, from, Point(0, -1), within, nullptr);  // a wall that leans may be met itself
    if (sight.met != nullptr && !sight.back) return BackFace{wall.chain, from, sight.met->chain};
  }
  return std::nullopt;
}

std::optional<BackFace> solid_around(const Terrain& terrain, std::span<const Point> points) {
  auto extent = terrain.bounds();
  for (const Point& point : points) extent.extend(point);
  const double far = 2 * extent.sizes().norm();
  std::optional<BackFace> seen;
  const std::size_t rays = rays_of(terrain, points.size());
  for (std::size_t k = 0; k < std::min(rays, points.size()); ++k) {
    const Point& point = points[k * points.size() / rays];
    const Sight up = look(terrain, point, Point(0, 1), far, nullptr);
    const Sight down = look(terrain, point, Point(0, -1), far, nullptr);
    const bool sees_front = (up.met != nullptr && !up.back) || (down.met != nullptr && !down.back);
    if (sees_front || (!up.back && !down.back)) return std::nullopt;
    const Sight& back = up.back ? up : down;
    seen = BackFace{back.met->chain, back.at, 0};
  }
  return seen;
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
