#include "stability/region_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "stability/region.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {
namespace {

/// A square |x - centre| <= half in both coordinates, about the COM.
struct Square {
  double s, t, half;
  double distance() const { return std::hypot(std::max(std::abs(s) - half, 0.0), std::max(std::abs(t) - half, 0.0)); }
  friend bool operator<(const Square& a, const Square& b) { return a.distance() > b.distance(); }  // nearest first
};

/// Least distance at which the mode cannot be excluded, at most `limit`. Nearest squares first: when one that is small
/// enough comes up, all that is nearer has been excluded.
double distance_to(const RegionModes& modes, int mode, double limit) {
  constexpr int most_squares = 2000;  // of one mode; typical: 1 to 300; beyond it the answer is safe but not sharp
  std::priority_queue<Square> open;
  open.push({0, 0, limit});
  for (int count = 0; !open.empty(); ++count) {
    const Square square = open.top();
    const double distance = square.distance();
    if (distance >= limit) return limit;
    if (count == most_squares || square.half < 0.5 * disc_precision * distance) return distance;
    open.pop();
    const ModeThere there =
        mode_there(modes, mode,
                   {square.s - square.half, square.s + square.half, square.t - square.half, square.t + square.half});
    if (there.kind == ModePart::nowhere) continue;
    if (there.kind == ModePart::everywhere) limit = std::min(limit, distance);
    if (there.feasible_in_middle) limit = std::min(limit, std::hypot(square.s, square.t));
    if (square.half < 1e-300) return 0;
    const double half = 0.5 * square.half;
    for (const double s : {-half, half})
      for (const double t : {-half, half}) open.push({square.s + s, square.t + t, half});
  }
  return limit;
}

}  // namespace

double com_tolerance(std::span<const Contact> contacts, double radius_of_gyration, const DisturbanceBox& box,
                     const Eigen::Vector2d& com) {
  if (!RobustOracle(contacts, radius_of_gyration, box).robust(com)) return 0;
  const Posture posture(contacts, radius_of_gyration);
  const WrenchBox wrenches{{}, box.kappa, box.nu};
  double limit = radius_of_gyration;
  for (const Contact& contact : contacts) limit = std::max(limit, (contact.position - com).norm());
  limit *= greatest_disc;
  for (const LabelledHalfPlane& half : equilibrium_half_planes(posture, wrenches)) {
    const double slope = half.plane.normal.norm();
    if (slope > 0) limit = std::min(limit, std::max(0.0, (half.plane.normal.dot(com) + half.plane.offset) / slope));
  }
  const RegionModes modes(posture, wrenches, com, Eigen::Vector2d::UnitX());
  for (int k = 0; k < static_cast<int>(modes.modes().size()); ++k) limit = distance_to(modes, k, limit);
  return limit;
}

}  // namespace surefoot::stability
