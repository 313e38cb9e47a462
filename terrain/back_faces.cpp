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

/// Whether a segment and a box, ends and border included, have a point in common (where rounding decides: maybe).
bool meets(const Eigen::AlignedBox2d& box, const Segment& segment) {
  if (!box.intersects(Eigen::AlignedBox2d(segment.a.cwiseMin(segment.b), segment.a.cwiseMax(segment.b)))) return false;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;  // of the corners, along the normal
  for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                            Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const double height = segment.normal.dot(box.corner(corner) - segment.a);
    least = std::min(least, height), greatest = std::max(greatest, height);
  }
  return least <= 0 && greatest >= 0;
}

/// How many of `count` rays may be sent, one at least.
std::size_t rays_of(const Terrain& terrain, std::size_t count) {
  return std::clamp<std::size_t>(most_tests / terrain.segments().size(), 1, count);
}

struct ChainShape {
  const Segment *first = nullptr, *last = nullptr;
  Eigen::AlignedBox2d extent;
  double twice_area = 0;  // [m^2] counterclockwise positive, of the chain closed by a straight line
  bool faces_up = false, faces_down = false;

  bool is_closed() const { return first->a == last->b; }
  void add(const Segment& segment) {
    if (first == nullptr) first = &segment;
    last = &segment;
    extent.extend(segment.a).extend(segment.b);
    const Point a = segment.a - first->a, b = segment.b - first->a;
    twice_area += a.x() * b.y() - a.y() * b.x();
    faces_up = faces_up || segment.normal.y() > 0;
    faces_down = faces_down || segment.normal.y() < -level;
  }
};

/// Whether one of the boxes meets the extent of a chain, or lies below an open one: in a trench that it covers, say.
bool is_inhabited(const ChainShape& shape, std::span<const Eigen::AlignedBox2d> boxes) {
  Eigen::AlignedBox2d room = shape.extent;
  if (!shape.is_closed()) room.min().y() = -greatest_coordinate;
  return std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) { return box.intersects(room); });
}

/// Both ends stand on other ground, or at most `room` above it.
bool stands_on_ground(const Terrain& terrain, const ChainShape& shape, double room) {
  const auto is_low = [&](const Point& end, const Segment& own) {
    const Sight sight = look(terrain, end, Point(0, -1), room, &own);
    return sight.met != nullptr && !sight.back && sight.met->chain != own.chain;
  };
  return is_low(shape.first->a, *shape.first) && is_low(shape.last->b, *shape.last);
}

std::vector<ChainShape> shapes_of_chains(const Terrain& terrain) {
  std::vector<ChainShape> chains(static_cast<std::size_t>(terrain.chain_count()));
  for (const Segment& segment : terrain.segments()) chains[static_cast<std::size_t>(segment.chain)].add(segment);
  return chains;
}

}  // namespace

std::optional<BackFace> back_face_seen(const Terrain& terrain, double within, std::span<const Foothold> feet,
                                       double room) {
  const auto& segments = terrain.segments();
  const std::size_t rays = rays_of(terrain, segments.size());  // of each kind
  const auto chains = shapes_of_chains(terrain);
  std::vector<bool> is_obstacle(chains.size(), false);  // as far as is known: open below, and so its inside is seen
  const auto counts = [&](int chain) {
    if (is_obstacle[static_cast<std::size_t>(chain)]) return false;
    const ChainShape& shape = chains[static_cast<std::size_t>(chain)];
    const auto is_inside = [&](const Foothold& foot) {
      const Eigen::AlignedBox2d at(foot.position);
      return foot.chain != chain && is_inhabited(shape, {&at, 1});
    };
    if (shape.twice_area >= 0 || std::any_of(feet.begin(), feet.end(), is_inside) ||
        !stands_on_ground(terrain, shape, room))
      return true;
    is_obstacle[static_cast<std::size_t>(chain)] = true;
    return false;
  };
  for (std::size_t k = 0; k < rays; ++k) {
    const Segment& own = segments[k * segments.size() / rays];
    const Point middle = 0.5 * (own.a + own.b);
    if (own.surface.foothold)
      if (auto seen = back_face_along(terrain, middle, own.normal, within, &own); seen && counts(seen->chain))
        return seen;
    // What looks at this one's back, be it ground or ceiling: a wall that stands for a cliff has nothing behind it. Its
    // own chain does not, but is met where the ray leaves its solid at a vertex.
    if (std::abs(own.normal.y()) < level) continue;
    const Sight behind = look(terrain, middle, -own.normal, within, &own);
    const bool is_front = behind.met != nullptr && !behind.back && behind.met->chain != own.chain;
    if (is_front && behind.met->surface.foothold && counts(own.chain))
      return BackFace{own.chain, middle, behind.met->chain};
  }
  return std::nullopt;
}

std::optional<int> ground_upside_down(const Terrain& terrain, double near, double room) {
  const auto chains = shapes_of_chains(terrain);
  std::size_t tests = 0;
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    const ChainShape& shape = chains[chain];
    if (shape.faces_up || !shape.faces_down) continue;
    const Point least = shape.extent.min(), most = shape.extent.max();
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

std::vector<int> obstacles_inside_out(const Terrain& terrain, std::span<const Eigen::AlignedBox2d> start,
                                      const Eigen::AlignedBox2d& goal, double room) {
  const auto chains = shapes_of_chains(terrain);
  std::size_t rays = rays_of(terrain, 2 * chains.size());
  std::vector<int> found;
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    const ChainShape& shape = chains[chain];
    if (!(shape.twice_area > 0)) continue;  // free space is outside
    if (is_inhabited(shape, start) || (!shape.is_closed() && is_inhabited(shape, {&goal, 1}))) continue;
    if (!shape.is_closed()) {
      if (shape.first->a.x() <= shape.last->b.x()) continue;  // ground with a hollow
      if (rays < 2) break;
      rays -= 2;
      if (!stands_on_ground(terrain, shape, room)) continue;
    }
    found.push_back(static_cast<int>(chain));
  }
  return found;
}

std::optional<int> solid_around(const Terrain& terrain, const Eigen::AlignedBox2d& area) {
  const auto cuts = [&](const Segment& s) { return meets(area, s); };
  const auto& segments = terrain.segments();
  if (std::any_of(segments.begin(), segments.end(), cuts)) return std::nullopt;
  // As much of the area as lies near the terrain: a goal without a lower limit may be said to begin very far down.
  const Eigen::AlignedBox2d bounds = terrain.bounds();
  const Point near = Point::Constant(bounds.diagonal().norm() + bounds.exteriorDistance(area));
  const Eigen::AlignedBox2d here = area.intersection({bounds.min() - near, bounds.max() + near});
  const double far = 2 * terrain.bounds().extend(here).sizes().norm();
  std::optional<int> above_or_below;
  // A ray that only grazes a vertex would see its front: rays pass aside of vertices level with the middle, by far more
  // than what `look` takes for the same distance.
  const double aside = 100 * rounding * far;
  for (const Point& way : {Point(0, 1), Point(0, -1), Point(1, 0), Point(-1, 0)}) {
    const Sight sight = look(terrain, here.center() + aside * Point(way.y(), way.x()), way, far, nullptr);
    if (sight.met == nullptr) continue;
    if (!sight.back) return std::nullopt;
    if (way.x() == 0 && !above_or_below) above_or_below = sight.met->chain;
  }
  return above_or_below;
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
