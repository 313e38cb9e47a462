// The inner problem of refinement, solved by NLopt: within a trust region, maximise the least of the cuts that
// earlier evaluations left (epigraph variable t), subject to reach. Nothing here asks the oracle; all functions are
// smooth.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace surefoot::planner {

/// A point that moves with the variables: base + columns . x. COMs and feet are such points.
struct MovingPoint {
  Eigen::Vector2d base = Eigen::Vector2d::Zero();
  int first = -1;                                        ///< first variable, -1 if the point is fixed
  int count = 0;                                         ///< 2 for a COM (columns are x and y), 1 for a foot
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of a foot's variable
  Eigen::Vector2d at(const Eigen::VectorXd& x) const;
  /// gradient += d(direction . point)/dx
  void add_gradient(const Eigen::Vector2d& along, Eigen::Ref<Eigen::VectorXd> gradient) const;
};

/// least <= |x - foot| <= greatest for every x on the line from - to.
struct ReachLimit {
  MovingPoint from, to, foot;
  /// How far a limit is passed [m^2], <= 0 where it holds: sign 1 for the greatest distance `bound`, at the farther
  /// end; sign -1 for the least, at the nearest point, whose derivative is that of the fixed mixture of the ends
  /// (envelope theorem). Sets the gradient in x.
  double excess(int sign, double bound, const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const;
};

/// value(x) <= offset + gradient . x, believed near the point where it was taken.
struct Cut {
  int element = 0;
  double offset = 0;
  Eigen::VectorXd gradient;
  double at(const Eigen::VectorXd& x) const { return offset + gradient.dot(x); }
};

struct RefineModel {
  std::vector<Cut> factors;     ///< t <= cut
  std::vector<Cut> clearances;  ///< least_clearance <= cut
  std::vector<ReachLimit> reach;
  double reach_min = 0, reach_max = 0, least_clearance = 0;  ///< [m]
  Eigen::VectorXd sum_gradient;                              ///< of the sum of factors, decides ties
  Eigen::VectorXd lower, upper;                              ///< bounds of the variables
};

/// A maximiser near `centre`, |x - centre| <= radius in every variable, within the bounds. Returns `centre` itself
/// where NLopt fails. `gain` is the rise of t that the cuts promise over `least`.
Eigen::VectorXd maximise(const RefineModel& model, const Eigen::VectorXd& centre, double least, double radius,
                         double& gain);

}  // namespace surefoot::planner
