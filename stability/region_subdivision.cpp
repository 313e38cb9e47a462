#include "stability/region_subdivision.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace surefoot::stability {

using Eigen::Vector2d;

Subdivision::Subdivision(const RegionModes& modes, const std::vector<Vector2d>& polygon, bool robust_only)
    : modes_(modes), robust_only_(robust_only), root_{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL} {
  for (const Vector2d& corner : polygon) {
    root_.a = std::min(root_.a, corner.x()), root_.b = std::max(root_.b, corner.x());
    root_.lo = std::min(root_.lo, corner.y()), root_.hi = std::max(root_.hi, corner.y());
  }
  // Uneven room, so that halving does not hit what is symmetric.
  const double wide = root_.b - root_.a, high = root_.hi - root_.lo;
  root_ = {root_.a - 0.0137 * wide, root_.b + 0.0211 * wide, root_.lo - 0.0173 * high, root_.hi + 0.0119 * high};
}

void Subdivision::run(double error, int most) {
  Node whole;
  const std::size_t edges = modes_.edges().size();
  whole.edges = edges >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << edges) - 1;
  for (std::size_t k = 0; k < modes_.modes().size(); ++k)
    if (!modes_.modes()[k].impossible) whole.unknown |= 1u << k;
  add(root_, whole);
  while (error_ > error && rectangles_ < most && !open_.empty()) {
    const int index = open_.top().second;
    open_.pop();
    const Node parent = std::move(nodes_[index]);
    nodes_[index].error = -1;  // gone
    error_ -= parent.error;
    Rectangle one = parent.leaf.box, two = one;
    if (one.b - one.a > one.hi - one.lo)
      one.b = two.a = one.s();
    else
      one.hi = two.lo = one.t();
    add(one, parent);
    add(two, parent);
  }
  error_ = strips_;
  for (Node& node : nodes_) {
    if (node.error < 0) continue;
    error_ += node.error;
    if (node.decided)
      leaves_.push_back(std::move(node.leaf));
    else
      open_area_ += node.error;
  }
}

void Subdivision::add(const Rectangle& box, const Node& parent) {
  ++rectangles_;
  Node node;
  node.leaf.box = box;
  node.leaf.everywhere = parent.leaf.everywhere;
  if (!keep_edges(node, parent)) return;
  decide_modes(node, parent);
  if (robust_only_ && node.leaf.everywhere != 0) return;
  if (node.unknown == 0 && node.leaf.curves.empty() && node.edges == 0) {
    leaves_.push_back(std::move(node.leaf));
    return;
  }
  node.decided = node.unknown == 0 && find_graphs(node);
  node.error = area_inside(node);
  if (node.decided) {
    double distance = 0;
    for (const LocalCurve& curve : node.leaf.curves) distance += 2 * curve.graph.error * box.ds() * box.dt();
    node.error = std::min(node.error, distance);
  } else if (robust_only_) {
    node.error *= 0.5;
  }
  error_ += node.error;
  open_.push({node.error, static_cast<int>(nodes_.size())});
  nodes_.push_back(std::move(node));
}

/// The edges that cross the rectangle; false where it lies outside of the polygon.
bool Subdivision::keep_edges(Node& node, const Node& parent) const {
  const Rectangle& box = node.leaf.box;
  for (std::uint64_t left = parent.edges; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    const Poly2& edge = modes_.edges()[k];
    const double middle = edge.at(box.s(), box.t()), spread = std::abs(edge.s) * box.ds() + std::abs(edge.t) * box.dt();
    if (middle <= -spread) return false;
    if (middle < spread) node.edges |= std::uint64_t{1} << k;
  }
  return true;
}

void Subdivision::decide_modes(Node& node, const Node& parent) {
  Leaf& leaf = node.leaf;
  std::vector<Bivariate<2>> edges;
  for (std::uint64_t left = node.edges; left != 0; left &= left - 1)
    edges.push_back(local(modes_.edges()[std::countr_zero(left)], leaf.box));
  const auto beyond = [&](const CurveId& curve, int sign) {
    const int there = sign * sign_there(curve_there(modes_, curve, leaf.box));
    if (there > 0) leaf.everywhere |= 1u << curve.mode;
    if (there == 0) leaf.curves.push_back({curve, sign, {}});
  };
  for (const LocalCurve& known : parent.leaf.curves)
    if (known.curve.kind != CurveId::edge) beyond(known.curve, known.sign);
  for (std::uint32_t left = parent.unknown; left != 0; left &= left - 1) {
    if (robust_only_ && leaf.everywhere != 0) return;
    const int k = std::countr_zero(left);
    const ModeThere there = mode_there(modes_, k, leaf.box, edges);
    if (there.kind != ModeThere::unknown) strips_ += std::min(there.strip, 1.0) * leaf.box.area();
    if (there.kind == ModeThere::everywhere) leaf.everywhere |= 1u << k;
    if (there.kind == ModeThere::unknown) node.unknown |= 1u << k;
    if (there.kind == ModeThere::beyond_curve) beyond(there.curve, there.sign);
  }
}

/// All curves as graphs over s, or all over t.
bool Subdivision::find_graphs(Node& node) const {
  Leaf& leaf = node.leaf;
  std::vector<CurvePolynomial> curves;
  double level = 0, upright = 0;
  const auto list = [&](const CurveId& id) {
    curves.push_back(curve_there(modes_, id, leaf.box));
    level += std::abs(curves.back().f.c[place(0, 1)]) > std::abs(curves.back().f.c[place(1, 0)]);
    upright += std::abs(curves.back().f.c[place(0, 1)]) < std::abs(curves.back().f.c[place(1, 0)]);
  };
  for (const LocalCurve& curve : leaf.curves) list(curve.curve);
  for (std::uint64_t left = node.edges; left != 0; left &= left - 1) {
    const CurveId id{CurveId::edge, -1, static_cast<signed char>(std::countr_zero(left)), -1, -1, 0};
    leaf.curves.push_back({id, 1, {}});
    list(id);
  }
  const auto attempt = [&](bool exchanged) {
    leaf.swapped = exchanged;
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const std::optional<Graph> graph = graph_of(exchanged ? swapped(curves[k]) : curves[k]);
      if (!graph) return false;
      leaf.curves[k].graph = *graph;
    }
    return true;
  };
  return attempt(upright > level) || attempt(upright <= level);
}

/// Of the part of the rectangle on the inner side of the edges that cross it.
double Subdivision::area_inside(const Node& node) const {
  const Rectangle& box = node.leaf.box;
  std::vector<Vector2d> part{{box.a, box.lo}, {box.b, box.lo}, {box.b, box.hi}, {box.a, box.hi}}, kept;
  for (std::uint64_t left = node.edges; left != 0; left &= left - 1) {
    const Poly2& edge = modes_.edges()[std::countr_zero(left)];
    kept.clear();
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vector2d &p = part[k], &q = part[(k + 1) % part.size()];
      const double vp = edge.at(p.x(), p.y()), vq = edge.at(q.x(), q.y());
      if (vp >= 0) kept.push_back(p);
      if ((vp >= 0) != (vq >= 0)) kept.push_back(p + (q - p) * (vp / (vp - vq)));
    }
    part.swap(kept);
  }
  double twice = 0;
  for (std::size_t k = 2; k < part.size(); ++k) {
    const Vector2d p = part[k - 1] - part[0], q = part[k] - part[0];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return std::max(0.5 * twice, 0.0);
}

}  // namespace surefoot::stability
