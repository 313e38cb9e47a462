#include "tests/support/extreme_lp.hpp"

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <map>

#include "tests/support/exact_posture.hpp"

namespace surefoot::testing {
namespace {

using Eigen::Vector2d;

constexpr double unbounded = HUGE_VAL;
constexpr int most_pivots = 1000;

std::jmp_buf failed;
/// GLPK ends the program where it is lost; it is left instead, as its manual says.
void leave(void*) {
  glp_free_env();
  std::longjmp(failed, 1);
}

/// Unknowns and rows of one LP, handed to GLPK at the end. `solve` keeps to plain data: it may be left by longjmp.
class Program {
 public:
  explicit Program(double tolerance) : tolerance_(tolerance) {}
  int column(double low, double high) {
    bounds_.push_back({low, high});
    return static_cast<int>(bounds_.size());
  }
  int row(double value, bool equality) {
    rows_.push_back({value, equality});
    return static_cast<int>(rows_.size());
  }
  void add(int row, int column, double value) { entries_[{row, column}] += value; }

  /// The greatest value of a column; `answered` is cleared where there is none though the LP is not infeasible.
  double greatest(int objective, bool& answered) {
    std::vector<int> i(1), j(1);
    std::vector<double> a(1);
    for (const auto& [place, value] : entries_) {
      if (!std::isfinite(value)) answered = false;
      if (value == 0) continue;
      i.push_back(place.first), j.push_back(place.second), a.push_back(value);
    }
    for (const auto& [value, equality] : rows_) answered = answered && std::isfinite(value);
    if (!answered) return -1;
    double result = -1;
    const int status = solve(objective, i.data(), j.data(), a.data(), static_cast<int>(i.size()) - 1, result);
    if (status != GLP_OPT && status != GLP_NOFEAS) answered = false;
    return status == GLP_OPT ? result : -1;
  }

 private:
  int solve(int objective, const int* i, const int* j, const double* a, int count, double& result) const {
    if (setjmp(failed) != 0) return GLP_UNDEF;
    glp_term_hook([](void*, const char*) { return 1; }, nullptr);  // it reports errors even when told to be silent
    glp_error_hook(leave, nullptr);
    glp_prob* problem = glp_create_prob();
    glp_add_cols(problem, static_cast<int>(bounds_.size()));
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      const auto [low, high] = bounds_[k];
      const bool from = std::isfinite(low), to = std::isfinite(high);
      const int type = from ? (to ? (low == high ? GLP_FX : GLP_DB) : GLP_LO) : (to ? GLP_UP : GLP_FR);
      glp_set_col_bnds(problem, static_cast<int>(k) + 1, type, low, high);
    }
    glp_add_rows(problem, static_cast<int>(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k)
      glp_set_row_bnds(problem, static_cast<int>(k) + 1, rows_[k].equality ? GLP_FX : GLP_LO, rows_[k].value,
                       rows_[k].value);
    glp_load_matrix(problem, count, i, j, a);
    glp_set_obj_dir(problem, GLP_MAX);
    glp_set_obj_coef(problem, objective, 1);
    glp_scale_prob(problem, GLP_SF_AUTO);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    parameters.tol_bnd = parameters.tol_dj = tolerance_;
    parameters.it_lim = most_pivots;
    const int ended = glp_simplex(problem, &parameters);
    const int status = ended == 0 ? glp_get_status(problem) : GLP_UNDEF;
    result = glp_get_obj_val(problem);
    glp_delete_prob(problem);
    return status;
  }

  struct Bounds {
    double low, high;
  };
  struct Right {
    double value;
    bool equality;
  };
  double tolerance_;
  std::vector<Bounds> bounds_;
  std::vector<Right> rows_;
  std::map<std::pair<int, int>, double> entries_;
};

struct Arm {
  Vector2d r, n, t;
  double mu;
  Arm(const Contact& contact, const Vector2d& com)
      : r(contact.position - com), n(contact.normal.stableNormalized()), t(n.y(), -n.x()), mu(contact.friction) {}
  double moment(const Vector2d& d) const { return r.x() * d.y() - r.y() * d.x(); }
};

struct Tolerances {
  double feasible_above, solver;
};

/// (p, 1, q) = sum lambda_k ray_k with lambda_k >= t.
bool balances(const std::vector<Arm>& arms, double p, double q, const Tolerances& tolerances, bool& answered) {
  Program program(tolerances.solver);
  const int slack = program.column(-unbounded, 1),
            rows[3]{program.row(p, true), program.row(1, true), program.row(q, true)};
  for (const Arm& arm : arms) {
    for (const double side : {arm.mu, -arm.mu}) {
      const Vector2d ray = arm.n + side * arm.t;
      const double values[3]{ray.x(), ray.y(), arm.moment(ray)};
      const int lambda = program.column(0, unbounded);  // lambda + t is the multiplier
      for (int k = 0; k < 3; ++k)
        for (const int column : {lambda, slack}) program.add(rows[k], column, values[k]);
    }
  }
  return program.greatest(slack, answered) > tolerances.feasible_above;
}

bool feasible(const std::vector<Arm>& arms, const SamplePosture& sample, const ExactMode& mode,
              const Tolerances& tolerances, bool& answered) {
  Program program(tolerances.solver);
  const double rho = sample.rho;
  const int slack = program.column(-unbounded, 1);
  const int p = program.column(-sample.box.kappa, sample.box.kappa), q = program.column(-sample.box.nu, sample.box.nu);
  const int ax = program.column(-unbounded, unbounded), ay = program.column(-unbounded, unbounded),
            beta = program.column(-unbounded, unbounded);  // rho alpha
  const int rows[3]{program.row(0, true), program.row(-1, true), program.row(0, true)};
  program.add(rows[0], ax, 1), program.add(rows[0], p, 1), program.add(rows[1], ay, 1);
  program.add(rows[2], beta, rho), program.add(rows[2], q, 1);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Arm& arm = arms[i];
    const bool dropped = mode.dropped >> i & 1u;
    const auto acceleration = [&](const Vector2d& d, bool strict) {
      if (strict && dropped) return;
      const int row = program.row(0, !strict);
      program.add(row, ax, d.x()), program.add(row, ay, d.y()), program.add(row, beta, arm.moment(d) / rho);
      if (strict) program.add(row, slack, -1);
    };
    const auto force = [&](double side) {
      const Vector2d ray = arm.n + side * arm.mu * arm.t;
      const double values[3]{ray.x(), ray.y(), arm.moment(ray)};
      const int lambda = program.column(0, unbounded);
      for (int k = 0; k < 3; ++k)
        for (const int column : {lambda, slack}) program.add(rows[k], column, -values[k]);
    };
    switch (mode.mode.at[i]) {
      case ContactState::breaks: acceleration(arm.n, true); break;
      case ContactState::rolls:
        acceleration(arm.n, false), acceleration(arm.t, false);
        force(1), force(-1);
        break;
      case ContactState::slides_along: acceleration(arm.n, false), acceleration(arm.t, true), force(-1); break;
      case ContactState::slides_against: acceleration(arm.n, false), acceleration(-arm.t, true), force(1); break;
    }
  }
  return program.greatest(slack, answered) > tolerances.feasible_above;
}

}  // namespace

LpVerdict lp_verdict(const SamplePosture& sample, double feasible_above, double tolerance) {
  const Tolerances tolerances{feasible_above, tolerance};
  std::vector<Arm> arms;
  for (const Contact& contact : sample.contacts) arms.emplace_back(contact, sample.com);
  bool answered = true;
  LpVerdict verdict;
  verdict.equilibrium = true;
  for (const double p : {-sample.box.kappa, sample.box.kappa})
    for (const double q : {-sample.box.nu, sample.box.nu})
      verdict.equilibrium = balances(arms, p, q, tolerances, answered) && verdict.equilibrium;
  const ExactPosture posture(sample);
  for (const ExactMode& mode : posture.modes())
    if (feasible(arms, sample, mode, tolerances, answered)) verdict.modes.push_back(mode.mode.name());
  std::sort(verdict.modes.begin(), verdict.modes.end());
  verdict.robust = verdict.equilibrium && verdict.modes.empty();
  verdict.unanswered = !answered;
  return verdict;
}

}  // namespace surefoot::testing
