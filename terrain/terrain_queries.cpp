// The geometric questions of terrain.hpp. Every query walks the box tree once and allocates nothing.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "terrain/predicates.hpp"
#include "terrain/spatial_index.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::terrain {
namespace {

using Box = SpatialIndex::Box;
using Piece = SpatialIndex::Piece;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// A distance along or across a segment is the end of fewer than ten roundings of numbers no larger than the
// coordinates and arc lengths at hand: relative to those. Reach limits and sectors are narrowed and widened by it.
constexpr double rounding_slack = 16 * epsilon;
// A box corner's cross product with a line is the end of eight roundings: relative to the magnitudes multiplied.
constexpr double separation_slack = 16 * epsilon;

double cross(const Point& u, const Point& v) { return u.x() * v.y() - u.y() * v.x(); }

/// The point of a-b nearest to p.
Point nearest_point(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double squared = along.squaredNorm();
  if (squared == 0) return a;
  const double t = (p - a).dot(along) / squared;
  if (t <= 0) return a;
  if (t >= 1) return b;
  return a + t * along;
}

double squared_distance(const Point& p, const Point& a, const Point& b) {
  return (p - nearest_point(p, a, b)).squaredNorm();
}

double squared_distance(const Point& p, const Point& q, const Point& a, const Point& b) {
  if (segments_meet(p, q, a, b)) return 0;
  return std::min(
      {squared_distance(p, a, b), squared_distance(q, a, b), squared_distance(a, p, q), squared_distance(b, p, q)});
}

/// A straight query line and what a box must pass to be of interest to it.
class Probe {
 public:
  Probe(const Point& a, const Point& b) : a_(a), step_(b - a), box_(Piece{a, b}.box()), length_(step_.norm()) {}

  /// False only if the line certainly misses the box.
  bool may_meet(const Box& box) const { return box.meets(box_) && gap_across(box) <= 0; }

  /// A lower bound of the squared distance between the line and anything in the box.
  double squared_distance(const Box& box) const {
    const double dx = std::max({box.min_x - box_.max_x, box_.min_x - box.max_x, 0.0});
    const double dy = std::max({box.min_y - box_.max_y, box_.min_y - box.max_y, 0.0});
    const double by_axes = dx * dx + dy * dy;
    const double across = gap_across(box);
    if (!(across > 0)) return by_axes;
    return std::max(by_axes, (across / length_) * (across / length_));
  }

 private:
  /// Length of the line times its distance across itself to the box, less a bound of the rounding error; not
  /// positive if the line's extension may cut the box.
  double gap_across(const Box& box) const {
    const double x = (box.min_x / 2 + box.max_x / 2) - a_.x(), y = (box.min_y / 2 + box.max_y / 2) - a_.y();
    const double half_x = box.max_x / 2 - box.min_x / 2, half_y = box.max_y / 2 - box.min_y / 2;
    const double size = std::abs(step_.x()) * half_y + std::abs(step_.y()) * half_x;
    const double middle = std::abs(step_.x() * y - step_.y() * x);
    const double scale_x = std::max(std::abs(box.min_x), std::abs(box.max_x)) + std::abs(a_.x());
    const double scale_y = std::max(std::abs(box.min_y), std::abs(box.max_y)) + std::abs(a_.y());
    const double error =
        separation_slack * (std::abs(step_.x()) * scale_y + std::abs(step_.y()) * scale_x) + least_normal;
    return middle - size - error;
  }
  static constexpr double least_normal = std::numeric_limits<double>::min();

  Point a_, step_;
  Box box_;
  double length_;
};

/// A closed circular sector; `radius` is widened by its rounding error already.
struct Sector {
  Point centre, from, to, from_end, to_end;
  double radius;
  int turn;        // sign of from x to
  bool full_turn;  // from and to are parallel and point opposite ways: a half disc. If the same way: one ray

  bool holds_direction(const Point& p) const {
    const Point zero = Point::Zero();
    const int from_p = cross_sign(zero, from, centre, p), p_to = cross_sign(centre, p, zero, to);
    if (turn > 0) return from_p >= 0 && p_to >= 0;
    if (turn < 0) return from_p >= 0 || p_to >= 0;
    return full_turn ? from_p >= 0 : from_p == 0 && (p == centre || same_way(p - centre, from));
  }

  /// Within the disc, a segment that meets neither bounding ray is on one side of them: any of its points decides.
  bool meets(const Piece& piece) const {
    const Point near = nearest_point(centre, piece.a, piece.b);
    const auto within = [&](const Point& p) { return (p - centre).squaredNorm() <= radius * radius; };
    if (!within(near)) return false;
    return holds_direction(near) || (within(piece.a) && holds_direction(piece.a)) ||
           (within(piece.b) && holds_direction(piece.b)) || segments_meet(centre, from_end, piece.a, piece.b) ||
           segments_meet(centre, to_end, piece.a, piece.b);
  }
};

double magnitude(const Point& p) { return p.cwiseAbs().maxCoeff(); }

/// Appends the stretches of one segment that faces `centre`. With t the centre's coordinate along the segment and h
/// its height above it, |s - t| must lie between the half chords that the two circles cut from the segment's line.
/// `end_of_segment` is the arc length at which the next segment begins (by rounding not
/// quite s_begin + length).
void append_stretches(const Segment& segment, double end_of_segment, const Point& centre, double least, double greatest,
                      std::vector<Stretch>& stretches) {
  const Point from_a = centre - segment.a;
  const double t = from_a.dot(segment.tangent), h = std::abs(cross(segment.tangent, from_a));
  const double scale = magnitude(centre) + magnitude(segment.a) + segment.s_begin + segment.length;
  const double outer_radius = greatest - rounding_slack * scale, inner_radius = least + rounding_slack * scale;
  if (!(h < outer_radius)) return;
  const double outer = std::sqrt((outer_radius - h) * (outer_radius + h));
  const double inner = least > 0 && inner_radius > h ? std::sqrt((inner_radius - h) * (inner_radius + h)) : 0;
  const auto append = [&](double begin, double end) {
    const double s_begin = segment.s_begin + std::max(begin, 0.0);
    const double s_end = std::min(segment.s_begin + std::min(end, segment.length), end_of_segment);
    if (s_begin < s_end) stretches.push_back({&segment, s_begin, s_end});
  };
  if (inner == 0) return append(t - outer, t + outer);
  append(t - outer, t - inner);
  append(t + inner, t + outer);
}

}  // namespace

std::vector<Stretch> Terrain::stretches_within(const Point& centre, double least, double greatest) const {
  std::vector<Stretch> stretches;
  stretches_within(centre, least, greatest, stretches);
  return stretches;
}

void Terrain::stretches_within(const Point& centre, double least, double greatest,
                               std::vector<Stretch>& stretches) const {
  assert(centre.allFinite() && !std::isnan(least) && !std::isnan(greatest));
  stretches.clear();
  if (!(greatest > 0)) return;
  const double limit = greatest * greatest;
  index_->any([&](const Box& box) { return box.squared_distance(centre.x(), centre.y()) <= limit; },
              [&](std::int32_t id, const Piece& piece) {
                if (piece.box().squared_distance(centre.x(), centre.y()) > limit) return false;
                const Segment& segment = segments_[id];
                if (!segment.surface.foothold || orientation(piece.a, piece.b, centre) <= 0) return false;
                const bool last = id + 1 == chain_begin_[segment.chain + 1];
                const double end = last ? segment.s_begin + segment.length : segments_[id + 1].s_begin;
                append_stretches(segment, end, centre, least, greatest, stretches);
                return false;
              });
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& l, const Stretch& r) {
    return l.segment != r.segment ? l.segment < r.segment : l.s_begin < r.s_begin;
  });
}

double Terrain::distance(const Point& point, double greatest) const {
  assert(point.allFinite() && greatest >= 0);
  double least = greatest * greatest;
  index_->nearest(
      least, [&](const Box& box) { return box.squared_distance(point.x(), point.y()); },
      [&](std::int32_t, const Piece& piece) { least = std::min(least, squared_distance(point, piece.a, piece.b)); });
  return std::sqrt(least);
}

double Terrain::distance(const Point& a, const Point& b, double greatest) const {
  if (a == b) return distance(a, greatest);
  assert(a.allFinite() && b.allFinite() && greatest >= 0);
  const Probe probe(a, b);
  double least = greatest * greatest;
  index_->nearest(
      least, [&](const Box& box) { return probe.squared_distance(box); },
      [&](std::int32_t, const Piece& piece) {
        if (!(probe.squared_distance(piece.box()) < least)) return;
        least = std::min(least, squared_distance(a, b, piece.a, piece.b));
      });
  return std::sqrt(least);
}

bool Terrain::leg_is_free(const Point& com, const Foothold& foot) const {
  assert(com.allFinite() && foot.position.allFinite());
  const Segment& own = segment(foot.chain, foot.segment);
  if (orientation(own.a, own.b, com) <= 0) return false;
  const std::int32_t own_id = static_cast<std::int32_t>(&own - segments_.data());
  const Probe leg(com, foot.position);
  return !index_->any([&](const Box& box) { return leg.may_meet(box); },
                      [&](std::int32_t id, const Piece& piece) {
                        return id != own_id && segments_meet(com, foot.position, piece.a, piece.b);
                      });
}

bool Terrain::blocks(const Point& a, const Point& b) const {
  assert(a.allFinite() && b.allFinite());
  const Probe probe(a, b);
  return index_->any([&](const Box& box) { return probe.may_meet(box); },
                     [&](std::int32_t, const Piece& piece) { return segments_meet(a, b, piece.a, piece.b); });
}

bool Terrain::sector_is_free(const Point& centre, double radius, const Point& from, const Point& to) const {
  assert(centre.allFinite() && std::isfinite(radius) && from.allFinite() && to.allFinite());
  assert(!from.isZero(0) && !to.isZero(0));
  Sector sector;
  sector.centre = centre;
  sector.from = from;
  sector.to = to;
  sector.radius = radius + rounding_slack * (radius + magnitude(centre));
  sector.from_end = centre + sector.radius * from.stableNormalized();
  sector.to_end = centre + sector.radius * to.stableNormalized();
  sector.turn = cross_sign(Point::Zero(), from, Point::Zero(), to);
  sector.full_turn = sector.turn == 0 && !same_way(from, to);
  const double limit = sector.radius * sector.radius;
  return !index_->any([&](const Box& box) { return box.squared_distance(centre.x(), centre.y()) <= limit; },
                      [&](std::int32_t, const Piece& piece) { return sector.meets(piece); });
}

}  // namespace surefoot::terrain
