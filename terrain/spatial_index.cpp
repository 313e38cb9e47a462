#include "terrain/spatial_index.hpp"

#include <algorithm>
#include <limits>

namespace surefoot::terrain {

struct SpatialIndex::Sortable {
  double x, y;  // middle of the piece's box
  std::int32_t id;
};

void SpatialIndex::Box::include(const Box& other) {
  min_x = std::min(min_x, other.min_x);
  min_y = std::min(min_y, other.min_y);
  max_x = std::max(max_x, other.max_x);
  max_y = std::max(max_y, other.max_y);
}

SpatialIndex::Box SpatialIndex::Piece::box() const {
  return {std::min(a.x(), b.x()), std::min(a.y(), b.y()), std::max(a.x(), b.x()), std::max(a.y(), b.y())};
}

SpatialIndex::SpatialIndex(const std::vector<Piece>& pieces) {
  std::vector<Sortable> items;
  items.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    const Box box = piece.box();
    items.push_back(
        {box.min_x / 2 + box.max_x / 2, box.min_y / 2 + box.max_y / 2, static_cast<std::int32_t>(items.size())});
  }
  nodes_.reserve(pieces.size());
  ids_.resize(pieces.size());
  pieces_.assign(pieces.begin(), pieces.end());  // build() reads boxes by id, then puts them in leaf order
  nodes_.emplace_back();
  build(0, items, 0, static_cast<std::int32_t>(items.size()));
  for (std::size_t i = 0; i < ids_.size(); ++i) pieces_[i] = pieces[ids_[i]];
}

/// Halves at the median of the wider extent of the middles: balanced whatever the input.
void SpatialIndex::build(std::int32_t node, std::vector<Sortable>& items, std::int32_t begin, std::int32_t end) {
  if (end - begin <= leaf_size) {
    std::sort(items.begin() + begin, items.begin() + end, [](const auto& l, const auto& r) { return l.id < r.id; });
    Box box = pieces_[items[begin].id].box();
    for (std::int32_t i = begin; i < end; ++i) {
      box.include(pieces_[items[i].id].box());
      ids_[i] = items[i].id;
    }
    nodes_[node] = {box, begin, end - begin};
    return;
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box middles{infinity, infinity, -infinity, -infinity};
  for (std::int32_t i = begin; i < end; ++i) middles.include({items[i].x, items[i].y, items[i].x, items[i].y});
  const auto first = items.begin();
  const std::int32_t half = begin + (end - begin) / 2;
  // Ties are broken by id, here and in the leaves: the tree does not depend on the selection algorithm.
  if (middles.max_x - middles.min_x >= middles.max_y - middles.min_y) {
    std::nth_element(first + begin, first + half, first + end,
                     [](const Sortable& l, const Sortable& r) { return l.x != r.x ? l.x < r.x : l.id < r.id; });
  } else {
    std::nth_element(first + begin, first + half, first + end,
                     [](const Sortable& l, const Sortable& r) { return l.y != r.y ? l.y < r.y : l.id < r.id; });
  }
  const auto child = static_cast<std::int32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  build(child, items, begin, half);
  build(child + 1, items, half, end);
  Box box = nodes_[child].box;
  box.include(nodes_[child + 1].box);
  nodes_[node] = {box, child, 0};
}

}  // namespace surefoot::terrain
