// The robust verdict by general linear programs (GLPK), as lean as a general LP can be: the neighbour that
// bench_stability is compared with. One problem object is kept and refilled; one LP per wrench corner and per mode; it
// stops at the first mode found feasible. Unknowns of a mode: p, q, the ray multipliers of the contacts that touch, the
// twist, and the slack t of the strict rows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "stability/contact.hpp"

struct glp_prob;

namespace surefoot::bench {

class GlpkVerdict {
 public:
  /// A mode is feasible where the slack of its strict rows exceeds `feasible_above`; `tolerance`: the solver's own.
  explicit GlpkVerdict(double feasible_above = 1e-8, double tolerance = 1e-7);
  ~GlpkVerdict();
  GlpkVerdict(const GlpkVerdict&) = delete;
  GlpkVerdict& operator=(const GlpkVerdict&) = delete;

  bool robust(const std::vector<stability::Contact>& contacts, const Eigen::Vector2d& com, double rho,
              const stability::DisturbanceBox& box);

 private:
  bool balances(const std::vector<stability::Contact>& contacts, const Eigen::Vector2d& com, double p, double q);
  bool feasible(const std::vector<stability::Contact>& contacts, const Eigen::Vector2d& com, double rho,
                const stability::DisturbanceBox& box, const stability::ContactMode& mode);
  int column(double low, double high);
  int row(double low, bool equality);
  void set(int row, int column, double value);
  bool positive_slack(int slack);

  double feasible_above_, tolerance_;
  glp_prob* problem_;
  std::vector<int> rows_, columns_;  // triplets, from index 1 as GLPK counts
  std::vector<double> values_;
};

}  // namespace surefoot::bench
