#include "stability/region_subdivision.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

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
  asked_ = error;
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
    Rectangle one = parent.box, two = one;
    if (one.b - one.a > one.hi - one.lo) one.b = two.a = one.s();
    else one.hi = two.lo = one.t();
    add(one, parent);
    add(two, parent);
  }
  error_ = robust_error_ = strips_;
  for (Node& node : nodes_)
    if (node.error >= 0) finish(node);
}

void Subdivision::finish(Node& node) {
  error_ += node.error;
  robust_ += node.areas.robust + 0.5 * node.areas.open;
  robust_error_ += node.areas.loose + 0.5 * node.areas.open;
  pieces_.insert(pieces_.end(), node.pieces.begin(), node.pieces.end());
}

void Subdivision::add(const Rectangle& box, const Node& parent) {
  ++rectangles_;
  Node node;
  node.box = box;
  node.everywhere = parent.everywhere;
  if (!keep_edges(node, parent)) return;
  decide_modes(node, parent);
  if (robust_only_ && node.everywhere != 0) return;
  measure(node);
  if (node.error == 0) {
    finish(node);
    return;
  }
  error_ += node.error;
  open_.push({node.error, static_cast<int>(nodes_.size())});
  nodes_.push_back(std::move(node));
}

/// Areas by pieces, or all open where that says no more.
void Subdivision::measure(Node& node) {
  const double area = area_inside(node);
  node.areas = {0, area, area, 0};
  const auto error_of = [this](const Areas& areas) {
    return areas.loose + (robust_only_ ? 0.5 * areas.open : areas.unsure);
  };
  if (find_graphs(node)) {
    const Areas areas = cut(leaf_, node.pieces);
    if (error_of(areas) <= error_of(node.areas)) node.areas = areas;
    else node.pieces.clear();
  }
  node.error = error_of(node.areas);
  if (robust_only_) node.pieces.clear();
}

/// The edges that cross the rectangle; false where it lies outside of the polygon.
bool Subdivision::keep_edges(Node& node, const Node& parent) const {
  const Rectangle& box = node.box;
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
  local_edges_.clear();
  for (std::uint64_t left = node.edges; left != 0; left &= left - 1)
    local_edges_.push_back(local(modes_.edges()[std::countr_zero(left)], node.box));
  const auto keep = [&](int mode, const ModeThere& there) {
    if (there.kind == ModePart::nowhere) return;
    if (there.kind == ModePart::everywhere) {
      node.everywhere |= 1u << mode;
      return;
    }
    if (there.kind == ModePart::unknown) node.unknown |= 1u << mode;
    node.modes.push_back({mode, there});
  };
  for (const LeafMode& known : parent.modes)
    if (!(parent.unknown >> known.mode & 1)) keep(known.mode, narrowed(modes_, known.mode, known.there, node.box));
  for (std::uint32_t left = parent.unknown; left != 0; left &= left - 1) {
    if (robust_only_ && node.everywhere != 0) return;
    const int k = std::countr_zero(left);
    const bool curves = node.unknown == 0 ? !very_large(node) : !large(node);
    const ModeThere there = mode_there(modes_, k, node.box, local_edges_, curves);
    if (there.kind != ModePart::unknown) strips_ += std::min(there.strip, 1.0) * node.box.area();
    keep(k, there);
  }
}

/// Puts the rectangle into leaf_. False where its curves are no graphs, or tell nothing.
bool Subdivision::find_graphs(const Node& node) {
  if (node.unknown != 0 && large(node)) return false;
  leaf_.box = node.box, leaf_.everywhere = node.everywhere, leaf_.modes = node.modes;
  leaf_.curves.clear(), leaf_.conditions.clear(), leaf_.graphs.clear();
  for (const LeafMode& mode : node.modes)
    mode.list([&](const CurveCondition& c) { leaf_.add(curve_there(modes_, c.curve, node.box), c.sign); });
  leaf_.of_modes = leaf_.conditions.size();
  if (leaf_.of_modes == 0 && node.unknown != 0) return false;
  for (std::uint64_t left = node.edges; left != 0; left &= left - 1) {
    const CurveId id{CurveId::edge, -1, static_cast<std::int8_t>(std::countr_zero(left)), -1, -1, 0};
    leaf_.add(curve_there(modes_, id, node.box), 1);
  }
  constexpr double share = 1e-4, least = 1e-15;  // of the error asked for, for one curve; rounding
  return leaf_.find_graphs(std::max(share * asked_ / node.box.area(), least));
}

/// Of the part of the rectangle on the inner side of the edges that cross it.
double Subdivision::area_inside(const Node& node) {
  const Rectangle& box = node.box;
  if (node.edges == 0) return box.area();
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
