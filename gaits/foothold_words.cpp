#include "gaits/foothold_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {

using terrain::Segment;
using terrain::Terrain;

namespace {

bool spans(const Segment& segment, double x) {
  return std::min(segment.a.x(), segment.b.x()) <= x && x <= std::max(segment.a.x(), segment.b.x());
}

std::string name_of(const Segment& segment) {
  return fmt::format("segment {} of chain {}", segment.index, segment.chain);
}

/// A place on a vertical segment cannot be told by x.
std::string on_vertical_face(const Segment& face, double x) {
  const auto [low, high] = std::minmax(face.a.y(), face.b.y());
  std::string text = fmt::format("x: {} is on a vertical face from y = {:.6g} to {:.6g}, {}; expected another x", x,
                                 low, high, name_of(face));
  if (face.surface.foothold) {
    text += fmt::format(", or {{chain: {}, s}} with s between {:.6g} and {:.6g} to stand on the face", face.chain,
                        face.s_begin, face.s_begin + face.length);
  }
  return text;
}

/// Where no segment is: beyond the ends, or in a gap.
std::string off_the_ground(const Terrain& ground, double x) {
  const auto bounds = ground.bounds();
  if (x < bounds.min().x() || x > bounds.max().x()) {
    return fmt::format("x: {} is beyond the terrain; expected {:.6g} to {:.6g}", x, bounds.min().x(), bounds.max().x());
  }
  double left = bounds.min().x(), right = bounds.max().x();
  for (const Segment& segment : ground.segments()) {
    for (const double end : {segment.a.x(), segment.b.x()}) {
      if (end < x) left = std::max(left, end);
      if (end > x) right = std::min(right, end);
    }
  }
  return fmt::format("x: {} is in a gap of the terrain, from {:.6g} to {:.6g}; expected a point inside a segment", x,
                     left, right);
}

}  // namespace

std::string no_foothold_at_x(const Terrain& ground, double x) {
  const Segment *forbidden = nullptr, *face = nullptr, *any = nullptr;
  for (const Segment& segment : ground.segments()) {
    if (!spans(segment, x)) continue;
    const bool vertical = segment.a.x() == segment.b.x();
    const bool inside = !vertical && segment.a.x() != x && segment.b.x() != x;
    if (!any) any = &segment;
    if (vertical && !face) face = &segment;
    if (inside && !segment.surface.foothold && !forbidden) forbidden = &segment;
  }
  if (forbidden) {
    return fmt::format("x: {} is on {}, where no foot may stand (foothold: false); expected a foothold", x,
                       name_of(*forbidden));
  }
  if (face) return on_vertical_face(*face, x);
  if (any) return fmt::format("x: {} is on a vertex of chain {}; expected a point inside a segment", x, any->chain);
  return off_the_ground(ground, x);
}

bool cannot_push_up(const terrain::Foothold& foot) {
  // The forces n + m t with |m| <= mu and t = (n_y, -n_x) rise at most n_y + mu |n_x|.
  constexpr double rounding = 1e-12;  // [1], a few units in the last place of a normal
  return foot.normal.y() + foot.friction * std::abs(foot.normal.x()) < -rounding * (1 + foot.friction);
}

bool may_carry(const Start& start, int leg) {
  const bool chosen = !start.support || leg == start.support->first || leg == start.support->second;
  return chosen && start.feet[static_cast<std::size_t>(leg)];
}

std::optional<int> chain_above_start(const Start& start) {
  std::optional<int> chain;
  for (int leg = 0; leg < leg_count; ++leg) {
    if (!may_carry(start, leg)) continue;
    const auto& foot = start.feet[static_cast<std::size_t>(leg)];
    if (!cannot_push_up(*foot)) return std::nullopt;
    if (!chain) chain = foot->chain;
  }
  return chain;
}

}  // namespace surefoot::gaits
