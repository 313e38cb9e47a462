// The subdivision of region.hpp: a convex polygon of COMs is halved into rectangles until in each of them every mode is
// decided (region_rectangle.hpp) and every curve, of modes and of the polygon, is a graph (region_graph.hpp). The
// rectangle that adds most to the error is halved next, until the error asked for is reached. What is then undecided
// counts as error with all its area, and so does the distance of the graphs from the curves: `error()` is a bound.
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "stability/region_pieces.hpp"

namespace surefoot::stability {

class Subdivision {
 public:
  /// `polygon` counter-clockwise in (s, t); its edges are those set in `modes`. `robust_only`: which modes are feasible
  /// does not matter, only whether any is.
  Subdivision(const RegionModes& modes, const std::vector<Eigen::Vector2d>& polygon, bool robust_only);
  /// Until error() <= error, or `most` rectangles have been looked at.
  void run(double error, int most);

  double error() const { return error_; }  ///< [m^2] of any sum of the pieces' areas; robust_only: of robust()
  int rectangles() const { return rectangles_; }
  /// [m^2] without modes, in the middle of what is proved, and its error.
  double robust() const { return robust_; }
  double robust_error() const { return robust_error_; }
  /// What rectangles were cut into, but for those left undecided; not with robust_only.
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  struct Node {
    Rectangle box;
    std::uint32_t everywhere = 0;
    std::vector<LeafMode> modes;  // neither everywhere nor nowhere
    std::uint32_t unknown = 0;    // modes to look at again in parts of it
    std::uint64_t edges = 0;      // of the polygon, that cross the rectangle
    std::vector<Piece> pieces;
    Areas areas;
    double error = 0;  // negative: halved
  };
  void add(const Rectangle& box, const Node& parent);
  bool keep_edges(Node& node, const Node& parent) const;
  void decide_modes(Node& node, const Node& parent);
  /// If a mode is unknown, it will be halved anyway: other modes are not looked at closely, nor is it cut.
  bool large(const Node& node) const { return node.box.area() > root_.area() / 65536; }
  /// Modes are hardly ever decided by curves. Both bounds are where most of bench_region --stances takes least time.
  bool very_large(const Node& node) const { return node.box.area() > root_.area() / 256; }
  void measure(Node& node);
  bool find_graphs(const Node& node);
  double area_inside(const Node& node);
  void finish(Node& node);

  const RegionModes& modes_;
  bool robust_only_;
  Rectangle root_;
  std::vector<Node> nodes_;
  std::vector<Piece> pieces_;
  std::priority_queue<std::pair<double, int>> open_;
  std::vector<Bivariate<2>> local_edges_;
  Leaf leaf_;  // of the rectangle that is measured
  double asked_ = 0, error_ = 0, strips_ = 0, robust_ = 0, robust_error_ = 0;
  int rectangles_ = 0;
};

}  // namespace surefoot::stability
