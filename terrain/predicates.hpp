// Exact signs of planar cross products, and what follows from them: side of a line, meeting of segments.
// The answer is that of real arithmetic on the doubles given, for all finite doubles. Laws: cross_sign is
// antisymmetric in its two vectors; orientation is invariant under cyclic and changes sign under odd permutation.
#pragma once

#include <Eigen/Core>

namespace surefoot::terrain {

/// Sign (-1, 0, +1) of (a1 - a0) x (b1 - b0).
int cross_sign(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
               const Eigen::Vector2d& b1);

/// +1 if c lies to the left of the directed line a -> b, -1 to the right, 0 on it (or if a = b).
inline int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross_sign(a, b, a, c);
}

/// Whether the closed segments p-q and a-b have a point in common. Either may be a single point.
bool segments_meet(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& a,
                   const Eigen::Vector2d& b);

/// Whether u and v, known to be parallel and not zero, point the same way.
inline bool same_way(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() != 0 ? (u.x() > 0) == (v.x() > 0) && v.x() != 0 : (u.y() > 0) == (v.y() > 0);
}

namespace detail {

/// Which arithmetic decided, for tests and statistics.
enum class Precision { factor_signs, filter, expansion, rational };
int cross_sign(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
               const Eigen::Vector2d& b1, Precision& decided_by);

}  // namespace detail
}  // namespace surefoot::terrain
