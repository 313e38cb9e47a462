// Pieces of terrain for the proof of impossibility: made when they are looked at, halved where it matters.
#include <cmath>

#include "planner/infeasibility_graph.hpp"

namespace surefoot::planner::proof {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using terrain::SpatialIndex;

namespace {

AlignedBox2d box_of(const Piece& piece) { return AlignedBox2d(piece.a.cwiseMin(piece.b), piece.a.cwiseMax(piece.b)); }

SpatialIndex::Box index_box(const AlignedBox2d& box) {
  return {box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}

std::shared_ptr<const SpatialIndex> index_of(const terrain::Terrain& terrain) {
  std::vector<SpatialIndex::Piece> lines;
  for (const terrain::Segment& segment : terrain.segments()) lines.push_back({segment.a, segment.b});
  return std::make_shared<const SpatialIndex>(lines);
}

}  // namespace

Pieces::Pieces(const gaits::Scene& scene, double coarsest, double margin)
    : scene_(scene), coarsest_(coarsest), margin_(margin), index_(index_of(scene.terrain)) {}

Pieces::Pieces(const Pieces& other) = default;  // surroundings are shared, never changed

int Pieces::add(const Piece& piece, std::span<const terrain::Segment* const> around) {
  cells_.push_back({{piece, around}, {middle_of(piece), around}, -1, false});
  return size() - 1;
}

/// Terrain within reach of the piece: all that can come between it and a COM.
std::span<const terrain::Segment* const> Pieces::look_around(const Piece& piece) {
  AlignedBox2d box = box_of(piece);
  const Vector2d margin = Vector2d::Constant(margin_);
  box = AlignedBox2d(box.min() - margin, box.max() + margin);
  auto found = std::make_shared<std::vector<const terrain::Segment*>>();
  const auto wanted = index_box(box);
  index_->any([&](const SpatialIndex::Box& here) { return here.meets(wanted); },
              [&](std::int32_t id, const SpatialIndex::Piece& line) {
                if (line.box().meets(wanted)) found->push_back(&scene_.terrain.segments()[id]);
                return false;
              });
  surroundings_.push_back(found);
  return *found;
}

int Pieces::add_point(const terrain::Foothold& foothold) {
  const terrain::Segment& segment = scene_.terrain.segment(foothold.chain, foothold.segment);
  const double at = foothold.s - segment.s_begin;
  for (const int known : points_)
    if (foot(known).piece.segment == &segment && foot(known).piece.begin == at) return known;
  const Piece piece{&segment, at, at, foothold.position, foothold.position};
  const int id = add(piece, look_around(piece));
  cells_[id].middle.piece = piece;
  cells_[id].fixed = true;
  points_.push_back(id);
  return id;
}

void Pieces::halve(int id) {
  if (cells_[id].fixed || is_halved(id)) return;
  const Piece whole = cells_[id].foot.piece;
  const double middle = (whole.begin + whole.end) / 2;
  const bool known = whole.length() <= coarsest_;
  const auto around = cells_[id].foot.around;
  const Piece left = piece_of(*whole.segment, whole.begin, middle), right = piece_of(*whole.segment, middle, whole.end);
  const bool look = !known && left.length() <= coarsest_;
  const int child = add(left, look ? look_around(left) : around);
  add(right, look ? look_around(right) : around);
  cells_[id].child = child;
}

void Pieces::leaves(int id, std::vector<int>& found) const {
  if (!is_halved(id)) {
    found.push_back(id);
    return;
  }
  leaves(cells_[id].child, found);
  leaves(cells_[id].child + 1, found);
}

void Pieces::collect(int id, const AlignedBox2d& box, std::vector<int>& found) {
  if (!box_of(cells_[id].foot.piece).intersects(box)) return;
  if (!is_halved(id) && length(id) > coarsest_) halve(id);
  if (!is_halved(id)) {
    found.push_back(id);
    return;
  }
  const int child = cells_[id].child;
  collect(child, box, found);
  collect(child + 1, box, found);
}

void Pieces::in_box(const AlignedBox2d& box, std::vector<int>& found) {
  const auto wanted = index_box(box);
  std::vector<int> near;
  index_->any([&](const SpatialIndex::Box& here) { return here.meets(wanted); },
              [&](std::int32_t segment, const SpatialIndex::Piece& line) {
                if (scene_.terrain.segments()[segment].surface.foothold && line.box().meets(wanted))
                  near.push_back(segment);
                return false;
              });
  for (const int at : near) {
    auto [entry, is_new] = root_.try_emplace(at, 0);
    if (is_new) {
      const terrain::Segment& segment = scene_.terrain.segments()[at];
      const Piece whole = piece_of(segment, 0, segment.length);
      entry->second = segment.length <= coarsest_ ? add(whole, look_around(whole)) : add(whole, {});
    }
    collect(entry->second, box, found);
  }
  for (const int id : points_)
    if (box.contains(cells_[id].foot.piece.a)) found.push_back(id);
}

}  // namespace surefoot::planner::proof
