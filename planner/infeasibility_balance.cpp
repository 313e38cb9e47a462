// The moments that feet on two pieces can supply (infeasibility_bounds.hpp, "Balance of two pieces").
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/infeasibility_bounds.hpp"

namespace surefoot::planner::proof {

using Eigen::Vector2d;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Below this sine two cone edges count as parallel: what they span is then bounded without dividing by it.
constexpr double parallel_sine = 1e-4;
/// Far above the rounding of all that is divided by at least parallel_sine (1e-12), far below what matters.
constexpr double relative_margin = 1e-7;

struct Edge {
  Vector2d direction;
  double norm = 0, lo = 0, hi = 0;  // moments of `direction` about the origin over the piece
};

class MomentRange {
 public:
  MomentRange(const Piece& first, const Piece& second, const Vector2d& force, const Vector2d& about, double rounding)
      : force_(force), rounding_(rounding) {
    lever_ = std::max({(first.a - about).norm(), (first.b - about).norm(), (second.a - about).norm(),
                       (second.b - about).norm()}) +
             rounding;
    add_edges(first, about, 0);
    add_edges(second, about, 2);
    for (int k = 0; k < 4; ++k)
      for (int l = k + 1; l < 4; ++l) combine(edges_[k], edges_[l]);
    if (result_.possible) squeeze(first, second);
  }
  const Moments& result() const { return result_; }

 private:
  void add_edges(const Piece& piece, const Vector2d& about, int at) {
    const Vector2d n = piece.segment->normal, t(n.y(), -n.x());
    const double mu = piece.segment->surface.friction;
    for (const double sign : {1.0, -1.0}) {
      Edge edge{n + sign * mu * t, 0, 0, 0};
      edge.norm = edge.direction.norm();
      const double at_a = cross(piece.a - about, edge.direction), at_b = cross(piece.b - about, edge.direction);
      edge.lo = std::min(at_a, at_b) - rounding_ * edge.norm;
      edge.hi = std::max(at_a, at_b) + rounding_ * edge.norm;
      edges_[at++] = edge;
    }
  }

  void include(double lo, double hi, double size) {
    const double margin = relative_margin * lever_ * size;
    if (!result_.possible) result_ = {true, infinity, -infinity};
    result_.lo = std::min(result_.lo, lo - margin);
    result_.hi = std::max(result_.hi, hi + margin);
  }

  /// force = alpha k + beta l with alpha, beta >= 0.
  void combine(const Edge& k, const Edge& l) {
    const double turn = cross(k.direction, l.direction), size = force_.norm();
    if (std::abs(turn) < parallel_sine * k.norm * l.norm) return combine_parallel(k, l, size);
    double alpha = cross(force_, l.direction) / turn, beta = cross(k.direction, force_) / turn;
    if (alpha < -relative_margin * size / k.norm || beta < -relative_margin * size / l.norm) return;
    alpha = std::max(alpha, 0.0), beta = std::max(beta, 0.0);
    include(alpha * k.lo + beta * l.lo, alpha * k.hi + beta * l.hi, size + alpha * k.norm + beta * l.norm);
  }

  /// Nearly one direction: only a force along it, shared in some way. Nearly opposite: any moment, to be safe.
  void combine_parallel(const Edge& k, const Edge& l, double size) {
    if (k.direction.dot(l.direction) < 0) return include(-infinity, infinity, 0);
    const double aside = std::abs(cross(k.direction, force_));
    if (k.direction.dot(force_) < 0 || aside > 10 * parallel_sine * k.norm * size) return;
    include(size * std::min(k.lo / k.norm, l.lo / l.norm), size * std::max(k.hi / k.norm, l.hi / l.norm), size);
  }

  bool in_cone(const Vector2d& d, int at) const {
    const Edge &right = edges_[at], &left = edges_[at + 1];
    const double tolerance = 1e-6 * d.norm();
    return cross(right.direction, d) >= -tolerance * right.norm && cross(d, left.direction) >= -tolerance * left.norm &&
           d.dot(right.direction + left.direction) > 0;
  }

  /// Forces g at the first foot and -g at the second, of any size: their moment is (first - second) x g. The extreme
  /// directions of g are edges of one cone within the other's opposite.
  void squeeze(const Piece& first, const Piece& second) {
    const auto try_direction = [&](const Vector2d& g) {
      const double tolerance = (relative_margin * lever_ + 2 * rounding_) * g.norm();
      for (const Vector2d& at : {first.a, first.b})
        for (const Vector2d& opposite : {second.a, second.b}) {
          const double moment = cross(at - opposite, g);
          if (moment > -tolerance) result_.hi = infinity;
          if (moment < tolerance) result_.lo = -infinity;
        }
    };
    for (const int k : {0, 1})
      if (in_cone(-edges_[k].direction, 2)) try_direction(edges_[k].direction);
    for (const int k : {2, 3})
      if (in_cone(-edges_[k].direction, 0)) try_direction(-edges_[k].direction);
  }

  Vector2d force_;
  double rounding_, lever_ = 0;
  std::array<Edge, 4> edges_;  // right and left edge of the first cone, of the second
  Moments result_;
};

}  // namespace

Moments moments_of(const Piece& first, const Piece& second, const Vector2d& force, const Vector2d& about,
                   double rounding) {
  return MomentRange(first, second, force, about, rounding).result();
}

}  // namespace surefoot::planner::proof
