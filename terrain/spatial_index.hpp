// A packed binary tree of bounding boxes over segments. Memory is proportional to the number of segments whatever
// their lengths; queries allocate nothing. A box contains its segments exactly (only minima and maxima are taken),
// so what a query excludes by comparing coordinates is excluded exactly.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace surefoot::terrain {

class SpatialIndex {
 public:
  struct Box {
    double min_x, min_y, max_x, max_y;
    void include(const Box& other);
    bool meets(const Box& other) const {
      return min_x <= other.max_x && other.min_x <= max_x && min_y <= other.max_y && other.min_y <= max_y;
    }
    /// Squared distance to a point; 0 inside.
    double squared_distance(double x, double y) const {
      const double dx = std::max(std::max(min_x - x, x - max_x), 0.0);
      const double dy = std::max(std::max(min_y - y, y - max_y), 0.0);
      return dx * dx + dy * dy;
    }
  };
  struct Piece {
    Eigen::Vector2d a, b;
    Box box() const;
  };

  explicit SpatialIndex(const std::vector<Piece>& pieces);

  const Box& bounds() const { return nodes_.front().box; }

  /// Calls visit(id, piece) for every piece in boxes that enter(box) admits, until visit returns true.
  /// Returns whether it did. enter must admit every box that contains an admitted one.
  template <class Enter, class Visit>
  bool any(Enter&& enter, Visit&& visit) const;

  /// Calls visit(id, piece) for pieces in boxes with lower_bound(box) < limit, nearer boxes first; visit may
  /// lower the limit that it shares with the caller.
  template <class LowerBound, class Visit>
  void nearest(const double& limit, LowerBound&& lower_bound, Visit&& visit) const;

 private:
  struct Node {
    Box box;
    std::int32_t first;  // inner node: its children are first, first + 1; leaf: its first piece
    std::int32_t count;  // pieces of a leaf; 0 for an inner node
  };
  struct Sortable;
  static constexpr int leaf_size = 4;
  static constexpr int max_depth = 64;  // halving 2^31 pieces takes 29 levels

  void build(std::int32_t node, std::vector<Sortable>& items, std::int32_t begin, std::int32_t end);

  std::vector<Node> nodes_;
  std::vector<Piece> pieces_;      // in the order of the leaves
  std::vector<std::int32_t> ids_;  // position in the vector given
};

template <class Enter, class Visit>
bool SpatialIndex::any(Enter&& enter, Visit&& visit) const {
  std::array<std::int32_t, max_depth> stack;
  int depth = 0;
  if (enter(nodes_[0].box)) stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (node.count > 0) {
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        if (visit(ids_[i], pieces_[i])) return true;
      }
      continue;
    }
    for (const std::int32_t child : {node.first + 1, node.first}) {
      if (enter(nodes_[child].box)) stack[depth++] = child;
    }
  }
  return false;
}

template <class LowerBound, class Visit>
void SpatialIndex::nearest(const double& limit, LowerBound&& lower_bound, Visit&& visit) const {
  struct Entry {
    std::int32_t node;
    double bound;
  };
  std::array<Entry, max_depth> stack;
  int depth = 0;
  stack[depth++] = {0, lower_bound(nodes_[0].box)};
  while (depth > 0) {
    const Entry entry = stack[--depth];
    if (!(entry.bound < limit)) continue;
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) visit(ids_[i], pieces_[i]);
      continue;
    }
    Entry near{node.first, lower_bound(nodes_[node.first].box)};
    Entry far{node.first + 1, lower_bound(nodes_[node.first + 1].box)};
    if (far.bound < near.bound) std::swap(near, far);
    if (far.bound < limit) stack[depth++] = far;
    if (near.bound < limit) stack[depth++] = near;
  }
}

}  // namespace surefoot::terrain
