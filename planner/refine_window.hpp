// A few neighbouring COMs of a plan, and the feet that are placed and lifted among them, as the variables of a
// refinement: reads and writes them in the plan, evaluates the safety factors they touch, asks the rules.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"
#include "planner/refine_model.hpp"

namespace surefoot::planner {

/// One stay of a foot on the ground.
struct Placement {
  int leg = 0;
  int placed_by = -1;  ///< transfer, -1: stands at the start
  int lifted_by = 0;   ///< transfer, or the number of transfers if never
};

/// Who stands where, as indices into `placements`; -1 where a leg is in the air.
struct Timeline {
  explicit Timeline(const gaits::Plan& plan);
  std::vector<Placement> placements;
  std::vector<std::array<int, gaits::leg_count>> stances, transfers;
  /// The placement that the leg of each transfer was lifted from; -1 if it has not stood since the start.
  std::vector<int> swing_from;
};

/// The safety factor of a stance or of a transfer, and how it changes with the COM or the COMs at both ends.
struct Factor {
  double value = 0;
  double lambda = 0;   ///< where on a transfer's line it is least
  bool bound = false;  ///< at a bound set by friction alone, the same for every COM: cannot rise
  Eigen::Vector2d from_gradient = Eigen::Vector2d::Zero(), to_gradient = Eigen::Vector2d::Zero();
};
Factor stance_factor(const gaits::Scene& scene, const gaits::Feet& feet, const Eigen::Vector2d& com);
Factor transfer_factor(const gaits::Scene& scene, const gaits::Feet& feet, const Eigen::Vector2d& from,
                       const Eigen::Vector2d& to);

/// Safety factors above this limit nothing and do not steer the refinement; `least` is the plan's least.
double factor_cap(double least);

class RefineWindow {
 public:
  /// COMs first..last (stance indices) of `plan` move, which this object changes. The start COM does not where the
  /// scene gives it, and stays out of the window.
  RefineWindow(const gaits::Scene& scene, gaits::Plan& plan, const Timeline& timeline, int first, int last, double cap);

  Eigen::Index variables() const { return lower_.size(); }
  const Eigen::VectorXd& start() const { return start_; }
  /// Bounds, reach limits and the least clearance; no cuts yet.
  RefineModel model() const;

  /// Writes the variables into the plan; false (plan may be half written) if a foot would leave its segment.
  bool write(const Eigen::VectorXd& x);

  struct Evaluation {
    std::vector<Cut> factors;  ///< of the elements that can rise and are below the cap
    std::vector<Cut> clearances;
    double least = 0, sum = 0;  ///< capped; `least` of the elements that can rise
    Eigen::VectorXd sum_gradient;
    bool in_reach = false;
  };
  /// At what was written last.
  Evaluation evaluate() const;
  /// Every rule that the variables can break.
  bool rules_hold() const;

 private:
  int first_transfer() const { return std::max(first_ - 1, 0); }
  int last_transfer() const { return std::min(last_, plan_.steps() - 1); }
  gaits::Feet feet_of(int transfer) const {
    return gaits::feet_during(plan_.stances[transfer], plan_.transfers[transfer]);
  }
  const terrain::Foothold& foothold(int placement) const;
  MovingPoint com(int stance) const;
  MovingPoint foot(int placement) const;
  void add_com_variables();
  void add_foot_variables();
  /// One stance, or the transfer that begins there, with its factor.
  struct Element {
    int stance = 0;
    bool transfer = false;
    Factor factor;
  };
  std::vector<Element> elements() const;
  Cut cut_of(const Element& element, int number, bool with_feet) const;
  double foot_slope(const Element& element, int placement) const;
  Eigen::VectorXd values() const;
  void add_clearances(Evaluation& out) const;
  bool within_reach() const;

  const gaits::Scene& scene_;
  gaits::Plan& plan_;
  const Timeline& timeline_;
  int first_, last_;
  double cap_;
  std::vector<int> foot_variables_;  // placements that move, in the order of their variables
  std::vector<MovingPoint> feet_;    // by foot_variables_
  Eigen::VectorXd start_, lower_, upper_;
};

}  // namespace surefoot::planner
