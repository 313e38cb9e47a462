#include "gaits/terrain_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace surefoot::gaits {
namespace {

using terrain::Segment;

constexpr Paint ground{.fill = "#e9e4da"};
constexpr Paint usual_stroke{.stroke = "#4d4d4d", .width = 2.4};
constexpr Paint less_stroke{.stroke = "#56b4e9", .width = 3.4};
constexpr Paint more_stroke{.stroke = "#8c510a", .width = 3.4};
constexpr Paint hatching{.stroke = "#8a8578", .width = 1};
constexpr Paint no_foothold{.stroke = "#fff", .width = 1.6, .dash = "2 5"};

bool contains(const Polyline& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

double signed_area(const Polyline& polygon) {
  double twice = 0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    twice += (polygon[j] - polygon[0]).x() * (polygon[i] - polygon[0]).y() -
             (polygon[i] - polygon[0]).x() * (polygon[j] - polygon[0]).y();
  return twice / 2;
}

/// A chain that is closed by corners beyond its ends.
Polyline closed_by(const Polyline& chain, std::initializer_list<Eigen::Vector2d> corners) {
  Polyline solid = chain;
  solid.insert(solid.end(), corners);
  return solid;
}

/// Everything outside a closed chain, as far as can be seen: along the chain, and back along a rectangle.
Polyline outside_of(const Polyline& closed, double far) {
  const Eigen::Vector2d& p = closed.front();
  const Eigen::Vector2d right(far, 0), up(0, far);
  return closed_by(closed, {p - right - up, p - right + up, p + right + up, p + right - up, p - right - up});
}

constexpr std::size_t most_tests = 4'000'000;  // of a corner, for one guess

/// Whether two straight lines cross, ends aside.
bool cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const auto side = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& at) {
    return (to - from).x() * (at - from).y() - (to - from).y() * (at - from).x();
  };
  return side(p, q, a) * side(p, q, b) < 0 && side(a, b, p) * side(a, b, q) < 0;
}

/// Whether what closes a chain (all corners behind its own) crosses it.
bool is_crossed(const Polyline& guess, const Polyline& chain) {
  for (std::size_t i = chain.size() - 1; i < guess.size(); ++i)
    for (std::size_t k = 1; k < chain.size(); ++k)
      if (cross(guess[i], guess[(i + 1) % guess.size()], chain[k - 1], chain[k])) return true;
  return false;
}

/// Whether a guess has the left of its chain outside, beside the middles of the chain's segments (an even choice of
/// many): what closes the chain may meet it at a vertex.
bool keeps_left_free(const Polyline& guess, const Polyline& chain) {
  constexpr std::size_t fewest = 8;
  constexpr double beside = 1e-6;  // of the segment's length
  const std::size_t segments = chain.size() - 1;
  const std::size_t count = std::min(segments, std::max(fewest, most_tests / guess.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i * segments / count;
    const Eigen::Vector2d along = chain[k + 1] - chain[k], middle = chain[k] + along / 2;
    const Eigen::Vector2d left = beside * Eigen::Vector2d(-along.y(), along.x());
    if (contains(guess, middle + left)) return false;
  }
  return true;
}

/// What the solid to the right of a chain may be, the best guess first. A closed chain bounds it alone, and so does one
/// that nearly closes about it. Any other is taken to go on for ever in the direction to the right of its course, which
/// is down for ground, up for a ceiling; if both its ends are walls that face each other, behind these, too.
std::vector<Polyline> solids_of(const Polyline& chain, double far) {
  const Eigen::Vector2d &first = chain.front(), &last = chain.back(), course = last - first;
  if (chain.size() > 2 && course.isZero(0)) return {signed_area(chain) < 0 ? chain : outside_of(chain, far)};
  const Eigen::Vector2d away = std::abs(course.x()) >= 0.5 * std::abs(course.y())
                                   ? Eigen::Vector2d(0, course.x() > 0 ? -far : far)
                                   : Eigen::Vector2d(course.y() > 0 ? far : -far, 0);
  const Eigen::Vector2d onward(-away.y(), away.x());
  constexpr double steep = 0.8;  // sine of the angle between the course and a wall
  const auto rise = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    return -away.dot((to - from).normalized()) / far;
  };
  std::vector<Polyline> guesses;
  if (chain.size() > 2 && rise(first, chain[1]) < -steep && rise(chain[chain.size() - 2], last) > steep)
    guesses.push_back(closed_by(chain, {last + onward, last + onward + away, first - onward + away, first - onward}));
  double length = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  constexpr double nearly_closed = 0.1;  // share of the length
  if (chain.size() > 2 && course.norm() < nearly_closed * length) {
    if (signed_area(chain) < 0) guesses.push_back(chain);
  } else {
    guesses.push_back(closed_by(chain, {last + away, first + away}));
  }
  return guesses;
}

Eigen::AlignedBox2d bounds_of(const Polyline& points) {
  Eigen::AlignedBox2d box;
  for (const auto& p : points) box.extend(p);
  return box;
}

/// Whether the segment may show in the window (by its bounding box).
bool shows(const Segment& segment, const Eigen::AlignedBox2d& window) {
  return window.intersects(Eigen::AlignedBox2d(segment.a.cwiseMin(segment.b), segment.a.cwiseMax(segment.b)));
}

}  // namespace

TerrainPicture::TerrainPicture(const terrain::Terrain& terrain) : terrain_(terrain) {
  std::map<double, double> length_by_friction;
  for (std::size_t i = 0; i < terrain.segments().size(); ++i) {
    const Segment& segment = terrain.segments()[i];
    if (static_cast<std::size_t>(segment.chain) >= chains_.size()) {
      chains_.push_back({segment.a});
      chain_begin_.push_back(i);
    }
    chains_.back().push_back(segment.b);
    length_by_friction[segment.surface.friction] += segment.length;
  }
  chain_begin_.push_back(terrain.segments().size());
  const auto shorter = [](const auto& a, const auto& b) { return a.second < b.second; };
  usual_friction_ = std::max_element(length_by_friction.begin(), length_by_friction.end(), shorter)->first;

  constexpr double diagonals = 1000;  // as good as for ever: pictures show start and goal
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const Polyline& chain = chains_[c];
    const bool closed = chain.size() > 2 && chain.front() == chain.back();  // no guess
    const auto holds = [&](const Polyline& guess) {
      return (closed || (!is_crossed(guess, chain) && keeps_left_free(guess, chain))) && !has_others_inside(guess, c);
    };
    std::vector<Polyline> guesses = solids_of(chain, diagonals * terrain.bounds().diagonal().norm());
    const auto best = std::find_if(guesses.begin(), guesses.end(), holds);
    solids_.push_back(best == guesses.end() ? Polyline() : std::move(*best));
  }
}

bool TerrainPicture::has_others_inside(const Polyline& solid, std::size_t chain) const {
  const Eigen::AlignedBox2d box = bounds_of(solid);
  std::vector<const Eigen::Vector2d*> near;
  for (std::size_t other = 0; other < chains_.size(); ++other)
    for (const auto& p : chains_[other])
      if (other != chain && box.contains(p)) near.push_back(&p);
  const std::size_t each = 1 + near.size() * solid.size() / most_tests;  // an even choice of many
  for (std::size_t i = 0; i < near.size(); i += each)
    if (contains(solid, *near[i])) return true;
  return false;
}

std::vector<Polyline> TerrainPicture::ground_in(const Eigen::AlignedBox2d& window) const {
  std::vector<Polyline> ground;
  for (const Polyline& solid : solids_) {
    if (solid.empty()) continue;
    Polyline shown = clip(solid, Eigen::Vector2d::UnitX(), -window.min().x());
    shown = clip(shown, -Eigen::Vector2d::UnitX(), window.max().x());
    shown = clip(shown, Eigen::Vector2d::UnitY(), -window.min().y());
    shown = clip(shown, -Eigen::Vector2d::UnitY(), window.max().y());
    if (shown.size() > 2) ground.push_back(std::move(shown));
  }
  return ground;
}

void TerrainPicture::draw_ground(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window) const {
  for (const Polyline& solid : ground_in(window)) canvas.polygon(view(solid), ground);
  for (std::size_t c = 0; c < chains_.size(); ++c)
    if (solids_[c].empty()) hatch(canvas, view, window, static_cast<int>(c));
}

void TerrainPicture::hatch(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window, int chain) const {
  constexpr double spacing = 8, depth = 8, most = 1e4;  // [px], [px], ticks of a segment
  double next = 0.7 * spacing;                          // [px] along the segment, from its begin
  for (std::size_t i = chain_begin_[chain]; i < chain_begin_[chain + 1]; ++i) {
    const Segment& segment = terrain_.segments()[i];
    const double length = segment.length * view.scale, step = std::max(spacing, length / most);
    const Eigen::Vector2d slant = (-segment.normal - segment.tangent) * (depth / view.scale);
    for (; next < length; next += step) {
      const Eigen::Vector2d foot = segment.a + segment.tangent * (next / view.scale);
      if (window.contains(foot)) canvas.line(view(foot), view(foot + slant), hatching);
    }
    next -= length;
  }
}

TerrainPicture::Grip TerrainPicture::grip(const Segment& segment) const {
  const double friction = segment.surface.friction;
  return friction < usual_friction_ ? Grip::less : friction > usual_friction_ ? Grip::more : Grip::usual;
}

std::vector<TerrainPicture::Run> TerrainPicture::surface_in(const Eigen::AlignedBox2d& window) const {
  const auto alike = [&](const Segment& a, const Segment& b) {
    return a.chain == b.chain && grip(a) == grip(b) && a.surface.foothold == b.surface.foothold;
  };
  const auto& segments = terrain_.segments();
  std::vector<Run> runs;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!shows(segments[i], window)) continue;
    const Segment& first = segments[i];
    const bool hatched = solids_[static_cast<std::size_t>(first.chain)].empty();
    Run& run = runs.emplace_back(Run{grip(first), first.surface.foothold, hatched, {first.a, first.b}});
    for (; i + 1 < segments.size() && alike(first, segments[i + 1]) && shows(segments[i + 1], window); ++i)
      run.points.push_back(segments[i + 1].b);
  }
  return runs;
}

void TerrainPicture::draw_surface(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window) const {
  for (const Run& run : surface_in(window)) {
    const Polyline points = view(run.points);
    canvas.polyline(points, run.grip == Grip::usual  ? usual_stroke
                            : run.grip == Grip::less ? less_stroke
                                                     : more_stroke);
    if (!run.foothold) canvas.polyline(points, no_foothold);
  }
}

std::string TerrainPicture::friction_range(Grip wanted) const {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const Segment& segment : terrain_.segments()) {
    if (grip(segment) != wanted) continue;
    least = std::min(least, segment.surface.friction);
    greatest = std::max(greatest, segment.surface.friction);
  }
  if (least > greatest) return "";
  return least == greatest ? fmt::format("friction {:.3g}", least)
                           : fmt::format("friction {:.3g} to {:.3g}", least, greatest);
}

std::vector<TerrainPicture::Key> TerrainPicture::legend() const {
  std::vector<Key> keys{{usual_stroke, {}, friction_range(Grip::usual)}};
  for (const Grip g : {Grip::less, Grip::more})
    if (const std::string range = friction_range(g); !range.empty())
      keys.push_back({g == Grip::less ? less_stroke : more_stroke, {}, range});
  const auto barred = [](const Segment& s) { return !s.surface.foothold; };
  if (std::any_of(terrain_.segments().begin(), terrain_.segments().end(), barred))
    keys.push_back({usual_stroke, no_foothold, "no foothold"});
  const auto hatched = [](const Polyline& solid) { return solid.empty(); };
  if (std::any_of(solids_.begin(), solids_.end(), hatched)) keys.push_back({usual_stroke, {}, "solid side", hatching});
  return keys;
}

const Segment* TerrainPicture::segment_of(const terrain::Foothold& foot) const {
  if (foot.chain < 0 || foot.chain >= static_cast<int>(chains_.size()) || foot.segment < 0) return nullptr;
  const std::size_t at = chain_begin_[foot.chain] + static_cast<std::size_t>(foot.segment);
  return at < chain_begin_[foot.chain + 1] ? &terrain_.segments()[at] : nullptr;
}

std::vector<stability::Contact> TerrainPicture::contacts_of(const Feet& feet) const {
  std::vector<stability::Contact> contacts;
  for (const auto& foot : feet) {
    if (!foot) continue;
    const Segment* segment = segment_of(*foot);
    if (!segment) return {};
    contacts.push_back({foot->position, segment->normal, segment->surface.friction});
  }
  return contacts;
}

}  // namespace surefoot::gaits
