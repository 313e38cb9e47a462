#include "tests/support/lp_reference.hpp"

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace surefoot::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double simplex_tolerance = 1e-10;  // bound and dual tolerance asked of GLPK; its default is 1e-7

/// A linear program under construction; columns and rows count from 1 as in GLPK.
class Program {
 public:
  Program() : problem_(glp_create_prob()) { glp_term_out(GLP_OFF); }
  ~Program() { glp_delete_prob(problem_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  int variable(double low, double high, double cost = 0) {
    const int column = glp_add_cols(problem_, 1);
    const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
    const int type = has_low && has_high ? (low == high ? GLP_FX : GLP_DB)
                     : has_low           ? GLP_LO
                     : has_high          ? GLP_UP
                                         : GLP_FR;
    glp_set_col_bnds(problem_, column, type, low, high);
    glp_set_obj_coef(problem_, column, cost);
    return column;
  }
  struct Term {
    int column;
    double factor;
  };
  void equal(const std::vector<Term>& terms, double value) { row(terms, GLP_FX, value); }
  void at_least(const std::vector<Term>& terms, double value) { row(terms, GLP_LO, value); }

  /// The greatest objective; nothing where infeasible, infinite where unbounded.
  std::optional<double> maximum() {
    glp_set_obj_dir(problem_, GLP_MAX);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    parameters.tol_bnd = parameters.tol_dj = simplex_tolerance;
    glp_adv_basis(problem_, 0);
    if (glp_simplex(problem_, &parameters) != 0) {
      glp_std_basis(problem_);
      glp_simplex(problem_, &parameters);
    }
    switch (glp_get_status(problem_)) {
      case GLP_OPT: return glp_get_obj_val(problem_);
      case GLP_UNBND: return infinity;
      default: return std::nullopt;
    }
  }

 private:
  void row(const std::vector<Term>& terms, int type, double value) {
    std::vector<int> index(1, 0);
    std::vector<double> factor(1, 0);
    for (const Term& term : terms) {
      const auto seen = std::find(index.begin() + 1, index.end(), term.column);
      if (seen != index.end()) {
        factor[seen - index.begin()] += term.factor;
      } else if (term.factor != 0) {
        index.push_back(term.column);
        factor.push_back(term.factor);
      }
    }
    const int number = glp_add_rows(problem_, 1);
    glp_set_row_bnds(problem_, number, type, value, value);
    glp_set_mat_row(problem_, number, static_cast<int>(index.size()) - 1, index.data(), factor.data());
  }
  glp_prob* problem_;
};
using Term = Program::Term;

struct Frame {
  Eigen::Vector2d r, n, t;
  double mu;
  Frame(const Contact& contact, const Eigen::Vector2d& com)
      : r(contact.position - com), n(contact.normal.normalized()), t(n.y(), -n.x()), mu(contact.friction) {}
  double moment(const Eigen::Vector2d& d) const { return r.x() * d.y() - r.y() * d.x(); }
};

/// Columns of the full problem. beta = rho alpha keeps the columns of one size.
struct Unknowns {
  int ax, ay, beta, p, q, gravity, slack;
  std::vector<std::array<int, 2>> force;
};

// Equations of motion:  a = sum f_i - (p, g),  rho beta = sum r_i x f_i - q;  g is 1, or a variable where the factor is
// sought.
void equations_of_motion(Program& program, const Unknowns& u, const std::vector<Frame>& frames, double rho) {
  std::vector<Term> x{{u.ax, 1}, {u.p, 1}}, y{{u.ay, 1}, {u.gravity, 1}}, moment{{u.beta, rho}, {u.q, 1}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    x.push_back({u.force[i][0], -1});
    y.push_back({u.force[i][1], -1});
    moment.push_back({u.force[i][0], frames[i].r.y()});
    moment.push_back({u.force[i][1], -frames[i].r.x()});
  }
  program.equal(x, 0);
  program.equal(y, 0);
  program.equal(moment, 0);
}

// [OR-P, Table I] for contact i; strict conditions leave room for the slack t.
void contact_conditions(Program& program, const Unknowns& u, const Frame& at, int i, ContactState state, bool dropped,
                        double rho) {
  const auto acceleration = [&](const Eigen::Vector2d& d) {
    return std::vector<Term>{{u.ax, d.x()}, {u.ay, d.y()}, {u.beta, at.moment(d) / rho}};
  };
  const auto force = [&](const Eigen::Vector2d& d) {
    return std::vector<Term>{{u.force[i][0], d.x()}, {u.force[i][1], d.y()}};
  };
  const auto positive = [&](std::vector<Term> terms) {
    double size = 0;
    for (const Term& term : terms) size = std::max(size, std::abs(term.factor));
    for (Term& term : terms) term.factor /= size;
    terms.push_back({u.slack, -1});
    program.at_least(terms, 0);
  };
  if (state == ContactState::breaks) {
    program.equal(force({1, 0}), 0);
    program.equal(force({0, 1}), 0);
    if (!dropped) positive(acceleration(at.n));
    return;
  }
  program.equal(acceleration(at.n), 0);
  if (state == ContactState::rolls) {
    program.equal(acceleration(at.t), 0);
    positive(force(at.mu * at.n + at.t));
    positive(force(at.mu * at.n - at.t));
    return;
  }
  const double sign = state == ContactState::slides_along ? 1 : -1;
  const Eigen::Vector2d edge = at.n - sign * at.mu * at.t;
  program.equal(force({edge.y(), -edge.x()}), 0);
  positive(force(at.n));
  if (!dropped) positive(acceleration(sign * at.t));
}

std::vector<Frame> frames_of(const SamplePosture& sample, const Eigen::Vector2d& com) {
  std::vector<Frame> frames;
  for (const Contact& contact : sample.contacts) frames.emplace_back(contact, com);
  return frames;
}

enum class Aim { slack, gravity };

// Aim::slack: greatest t with gravity up to `most_gravity` (1 fixed where fixed_gravity). Aim::gravity: greatest g with
// t = 0.
std::optional<double> solve_mode(const SamplePosture& sample, const Eigen::Vector2d& com, const ModeStructure& mode,
                                 Aim aim, bool fixed_gravity, double kappa, double nu) {
  Program program;
  Unknowns u{};
  u.ax = program.variable(-infinity, infinity);
  u.ay = program.variable(-infinity, infinity);
  u.beta = program.variable(-infinity, infinity);
  u.p = program.variable(-kappa, kappa);
  u.q = program.variable(-nu, nu);
  u.gravity = program.variable(fixed_gravity ? 1 : 0, fixed_gravity ? 1 : infinity, aim == Aim::gravity);
  u.slack = program.variable(aim == Aim::slack ? -infinity : 0, aim == Aim::slack ? 1 : 0, aim == Aim::slack);
  const std::vector<Frame> frames = frames_of(sample, com);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int first = program.variable(-infinity, infinity);
    u.force.push_back({first, program.variable(-infinity, infinity)});
  }
  equations_of_motion(program, u, frames, sample.rho);
  for (int i = 0; i < mode.mode.contacts; ++i) {
    contact_conditions(program, u, frames[i], i, mode.mode.at[i], mode.dropped >> i & 1u, sample.rho);
  }
  return program.maximum();
}

// sum lambda_k ray_k = (p, 1, q) + s (dp, 0, dq): the greatest t with lambda_k >= t, or the greatest s with t = 0.
std::optional<double> solve_equilibrium(const SamplePosture& sample, const Eigen::Vector2d& com, const Wrench& wrench,
                                        const Wrench& growth, Aim aim) {
  Program program;
  const int slack = program.variable(aim == Aim::slack ? -infinity : 0, aim == Aim::slack ? 1 : 0, aim == Aim::slack);
  const int scale = program.variable(0, aim == Aim::gravity ? infinity : 0, aim == Aim::gravity);
  std::vector<Term> x{{scale, -growth.p}}, y, moment{{scale, -growth.q}};
  for (const Frame& at : frames_of(sample, com)) {
    for (int side : {1, -1}) {
      const Eigen::Vector2d ray = at.n + side * at.mu * at.t;
      const int lambda = program.variable(-infinity, infinity);
      x.push_back({lambda, ray.x()});
      y.push_back({lambda, ray.y()});
      moment.push_back({lambda, at.moment(ray)});
      program.at_least({{lambda, 1}, {slack, -1}}, 0);
    }
  }
  program.equal(x, wrench.p);
  program.equal(y, 1);
  program.equal(moment, wrench.q);
  return program.maximum();
}

constexpr std::array<std::array<int, 2>, 4> corners{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

}  // namespace

double LpReference::equilibrium_margin(const Eigen::Vector2d& com, const Wrench& wrench) const {
  if (!structure_.full_rank) return -1;
  return solve_equilibrium(sample_, com, wrench, {0, 0}, Aim::slack).value_or(-1);
}

double LpReference::equilibrium_margin(const Eigen::Vector2d& com) const {
  double least = infinity;
  for (const auto& c : corners) {
    least = std::min(least, equilibrium_margin(com, {c[0] * sample_.box.kappa, c[1] * sample_.box.nu}));
  }
  return least;
}

double LpReference::mode_margin(const Eigen::Vector2d& com, const ModeStructure& mode) const {
  if (!mode.exists) return -1;
  return solve_mode(sample_, com, mode, Aim::slack, true, sample_.box.kappa, sample_.box.nu).value_or(-1);
}

double LpReference::equilibrium_factor(const Eigen::Vector2d& com) const {
  double least = infinity;
  for (const auto& c : corners) {
    const Wrench growth{c[0] * sample_.box.kappa, c[1] * sample_.box.nu};
    least = std::min(least, solve_equilibrium(sample_, com, {0, 0}, growth, Aim::gravity).value_or(0));
  }
  return least;
}

// With w = -(p, g, q) and (p, q) in W, homogeneity makes the least s the inverse of the greatest g.
double LpReference::mode_factor(const Eigen::Vector2d& com, const ModeStructure& mode, bool& decided) const {
  if (!mode.exists) return infinity;
  const auto near = [](double t) { return t > lp_infeasible_below && t < lp_feasible_above; };
  const double at_rest = solve_mode(sample_, com, mode, Aim::slack, true, 0, 0).value_or(-1);
  decided = decided && !near(at_rest);
  if (at_rest > lp_feasible_above) return 0;
  const double somewhere =
      solve_mode(sample_, com, mode, Aim::slack, false, sample_.box.kappa, sample_.box.nu).value_or(-1);
  decided = decided && !near(somewhere);
  if (somewhere < lp_feasible_above) return infinity;
  const double gravity =
      solve_mode(sample_, com, mode, Aim::gravity, false, sample_.box.kappa, sample_.box.nu).value_or(0);
  return 1 / gravity;
}

LpReference::Factor LpReference::safety_factor(const Eigen::Vector2d& com) const {
  Factor factor;
  const double at_rest = equilibrium_margin(com, {0, 0});
  if (at_rest <= lp_feasible_above) return {0, at_rest < -lp_feasible_above};
  factor.value = equilibrium_factor(com);
  for (const ModeStructure& mode : structure_.modes) {
    factor.value = std::min(factor.value, mode_factor(com, mode, factor.decided));
  }
  return factor;
}

}  // namespace surefoot::testing
