// Plane geometry for the verifier alone: formulas of its own, no tree of boxes, none of the predicates that the search
// uses. Signs of orientation are taken in long double, whose rounding (about 1e-19 relative) is the only error; a touch
// counts as a meeting.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/terrain.hpp"

namespace surefoot::gaits::bare {

using Point = Eigen::Vector2d;

/// Extreme distances between a fixed point and the points a + lambda (b - a), lambda in [0, 1].
struct Distances {
  double least, greatest;  ///< [m]
  double lambda_least, lambda_greatest;
};
Distances distances_along(const Point& point, const Point& a, const Point& b);

/// Twice the signed area of a, b, c: positive if c lies to the left of a -> b.
long double orientation(const Point& a, const Point& b, const Point& c);
/// Whether the closed straight lines p-q and a-b have a point in common.
bool meet(const Point& p, const Point& q, const Point& a, const Point& b);
/// Least distance [m] between two straight lines.
double distance(const Point& p, const Point& q, const Point& a, const Point& b);
/// Whether the straight line a-b has a point in the closed sector of radius [m] about `centre`, counter-clockwise from
/// direction `from` to direction `to`.
bool meets_sector(const Point& centre, double radius, const Point& from, const Point& to, const Point& a,
                  const Point& b);

/// The segments of a terrain in upright strips, so that a look at a place does not look at all of them.
class Strips {
 public:
  explicit Strips(const terrain::Terrain& terrain);
  /// The terrain that has a part in the box of `points` grown by `margin` [m] on every side, each segment once.
  std::vector<const terrain::Segment*> near(const std::vector<Point>& points, double margin) const;

 private:
  std::size_t strip_of(double x) const;

  std::vector<double> borders_;  ///< strip k lies between borders k - 1 and k [m]
  std::vector<std::vector<const terrain::Segment*>> strips_;
};

}  // namespace surefoot::gaits::bare
