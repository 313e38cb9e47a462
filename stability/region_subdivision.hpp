// The subdivision of region.hpp: a convex polygon of COMs is halved into rectangles until in each of them every mode is
// decided (region_rectangle.hpp) and every curve, of modes and of the polygon, is a graph (region_graph.hpp). The
// rectangle that adds most to the error is halved next, until the error asked for is reached. What is then undecided
// counts as error with all its area, and so does the distance of the graphs from the curves: `error()` is a bound.
#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "stability/region_graph.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {

/// A curve in a rectangle: its mode is feasible, or the polygon lies, where sign * curve > 0.
struct LocalCurve {
  CurveId curve;
  int sign = 1;
  Graph graph;
  bool holds(double sigma, double tau) const { return sign * graph.rising * (tau - graph.at(sigma)) > 0; }
};

/// A decided rectangle. In local coordinates, exchanged where `swapped`: sigma along t and tau along s.
struct Leaf {
  Rectangle box;
  bool swapped = false;
  std::uint32_t everywhere = 0;  ///< modes feasible in all of it: bit k for modes()[k]
  std::vector<LocalCurve> curves;
  Eigen::Vector2d point(double sigma, double tau) const {
    const double s = swapped ? tau : sigma, t = swapped ? sigma : tau;
    return {box.s() + s * box.ds(), box.t() + t * box.dt()};
  }
};

class Subdivision {
 public:
  /// `polygon` counter-clockwise in (s, t); its edges are those set in `modes`. `robust_only`: rectangles in which some
  /// mode is feasible everywhere are not looked into further.
  Subdivision(const RegionModes& modes, const std::vector<Eigen::Vector2d>& polygon, bool robust_only);
  /// Until error() <= error, or `most` rectangles have been looked at.
  void run(double error, int most);

  const std::vector<Leaf>& leaves() const { return leaves_; }
  double error() const { return error_; }
  int rectangles() const { return rectangles_; }
  /// [m^2] of the rectangles left undecided, part of error(); with `robust_only` half of it, for an area given in the
  /// middle.
  double open_area() const { return open_area_; }

 private:
  struct Node {
    Leaf leaf;
    std::uint32_t unknown = 0;
    std::uint64_t edges = 0;  // of the polygon, that cross the rectangle
    bool decided = false;
    double error = 0;  // negative: halved
  };
  void add(const Rectangle& box, const Node& parent);
  bool keep_edges(Node& node, const Node& parent) const;
  void decide_modes(Node& node, const Node& parent);
  bool find_graphs(Node& node) const;
  double area_inside(const Node& node) const;

  const RegionModes& modes_;
  bool robust_only_;
  Rectangle root_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::priority_queue<std::pair<double, int>> open_;
  double error_ = 0, strips_ = 0, open_area_ = 0;
  int rectangles_ = 0;
};

}  // namespace surefoot::stability
