#include "bench/glpk_verdict.hpp"

#include <glpk.h>

#include <cmath>
#include <limits>

#include "tests/support/sample_posture.hpp"

namespace surefoot::bench {
namespace {

using stability::Contact;
using stability::ContactMode;
using stability::ContactState;

constexpr int most_pivots = 1000;  // it runs in circles now and then
constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Arm {
  Eigen::Vector2d r, n, t;
  Arm(const Contact& contact, const Eigen::Vector2d& com)
      : r(contact.position - com), n(contact.normal.normalized()), t(n.y(), -n.x()) {}
  double moment(const Eigen::Vector2d& d) const { return r.x() * d.y() - r.y() * d.x(); }
};

const std::vector<ContactMode>& modes_of(std::size_t contacts) {
  static const std::vector<ContactMode> modes[]{testing::non_static_modes(1), testing::non_static_modes(2),
                                                testing::non_static_modes(3)};
  return modes[contacts - 1];
}

}  // namespace

GlpkVerdict::GlpkVerdict(double feasible_above, double tolerance)
    : feasible_above_(feasible_above), tolerance_(tolerance), problem_(glp_create_prob()) {
  glp_term_out(GLP_OFF);
}
GlpkVerdict::~GlpkVerdict() { glp_delete_prob(problem_); }

int GlpkVerdict::column(double low, double high) {
  const int index = glp_add_cols(problem_, 1);
  const bool from = std::isfinite(low), to = std::isfinite(high);
  glp_set_col_bnds(problem_, index, from ? (to ? (low == high ? GLP_FX : GLP_DB) : GLP_LO) : (to ? GLP_UP : GLP_FR),
                   low, high);
  return index;
}

int GlpkVerdict::row(double low, bool equality) {
  const int index = glp_add_rows(problem_, 1);
  glp_set_row_bnds(problem_, index, equality ? GLP_FX : GLP_LO, low, low);
  return index;
}

void GlpkVerdict::set(int row, int column, double value) {
  if (value == 0) return;
  rows_.push_back(row);
  columns_.push_back(column);
  values_.push_back(value);
}

bool GlpkVerdict::positive_slack(int slack) {
  glp_set_obj_dir(problem_, GLP_MAX);
  glp_set_obj_coef(problem_, slack, 1);
  glp_load_matrix(problem_, static_cast<int>(rows_.size()) - 1, rows_.data(), columns_.data(), values_.data());
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.tol_bnd = parameters.tol_dj = tolerance_;
  parameters.it_lim = most_pivots;
  const bool optimal = glp_simplex(problem_, &parameters) == 0 && glp_get_status(problem_) == GLP_OPT;
  return optimal && glp_get_obj_val(problem_) > feasible_above_;
}

// sum lambda_k ray_k = (p, 1, q) with lambda_k >= t.
bool GlpkVerdict::balances(const std::vector<Contact>& contacts, const Eigen::Vector2d& com, double p, double q) {
  glp_erase_prob(problem_);
  rows_.assign(1, 0), columns_.assign(1, 0), values_.assign(1, 0);
  const int slack = column(-unbounded, 1), x = row(p, true), y = row(1, true), moment = row(q, true);
  for (const Contact& contact : contacts) {
    const Arm arm(contact, com);
    for (const double side : {contact.friction, -contact.friction}) {
      const Eigen::Vector2d ray = arm.n + side * arm.t;
      const int lambda = column(0, unbounded);  // lambda + t is the multiplier
      set(x, lambda, ray.x()), set(y, lambda, ray.y()), set(moment, lambda, arm.moment(ray));
    }
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Contact& contact : contacts) {
    const Arm arm(contact, com);
    sum += 2 * Eigen::Vector3d(arm.n.x(), arm.n.y(), arm.moment(arm.n));
  }
  set(x, slack, sum.x()), set(y, slack, sum.y()), set(moment, slack, sum.z());
  return positive_slack(slack);
}

bool GlpkVerdict::feasible(const std::vector<Contact>& contacts, const Eigen::Vector2d& com, double rho,
                           const stability::DisturbanceBox& box, const ContactMode& mode) {
  glp_erase_prob(problem_);
  rows_.assign(1, 0), columns_.assign(1, 0), values_.assign(1, 0);
  const int p = column(-box.kappa, box.kappa), q = column(-box.nu, box.nu), slack = column(-unbounded, 1);
  const int ax = column(-unbounded, unbounded), ay = column(-unbounded, unbounded),
            beta = column(-unbounded, unbounded);
  const int x = row(0, true), y = row(-1, true), moment = row(0, true);
  set(x, ax, 1), set(x, p, 1), set(y, ay, 1), set(moment, beta, rho), set(moment, q, 1);
  for (int i = 0; i < mode.contacts; ++i) {
    const Arm arm(contacts[i], com);
    const auto acceleration = [&](const Eigen::Vector2d& d, bool strict) {
      const int index = row(0, !strict);
      set(index, ax, d.x()), set(index, ay, d.y()), set(index, beta, arm.moment(d) / rho);
      if (strict) set(index, slack, -1);
    };
    // The multiplier of a ray is lambda + t with lambda >= 0.
    const auto force = [&](const Eigen::Vector2d& ray) {
      const int lambda = column(0, unbounded);
      for (const int variable : {lambda, slack}) {
        set(x, variable, -ray.x()), set(y, variable, -ray.y()), set(moment, variable, -arm.moment(ray));
      }
    };
    const double mu = contacts[i].friction;
    switch (mode.at[i]) {
      case ContactState::breaks: acceleration(arm.n, true); break;
      case ContactState::rolls:
        acceleration(arm.n, false), acceleration(arm.t, false);
        force(arm.n + mu * arm.t);
        force(arm.n - mu * arm.t);
        break;
      case ContactState::slides_along:
        acceleration(arm.n, false), acceleration(arm.t, true), force(arm.n - mu * arm.t);
        break;
      case ContactState::slides_against:
        acceleration(arm.n, false), acceleration(-arm.t, true), force(arm.n + mu * arm.t);
        break;
    }
  }
  // A ray of each contact adds to the same coefficient of t: merge the triplets of column `slack`.
  std::vector<double> merged(static_cast<std::size_t>(glp_get_num_rows(problem_)) + 1, 0);
  std::size_t kept = 1;
  for (std::size_t k = 1; k < rows_.size(); ++k) {
    if (columns_[k] == slack) {
      merged[rows_[k]] += values_[k];
    } else {
      rows_[kept] = rows_[k], columns_[kept] = columns_[k], values_[kept] = values_[k], ++kept;
    }
  }
  rows_.resize(kept), columns_.resize(kept), values_.resize(kept);
  for (std::size_t k = 1; k < merged.size(); ++k) set(static_cast<int>(k), slack, merged[k]);
  return positive_slack(slack);
}

bool GlpkVerdict::robust(const std::vector<Contact>& contacts, const Eigen::Vector2d& com, double rho,
                         const stability::DisturbanceBox& box) {
  for (const double p : {-box.kappa, box.kappa}) {
    for (const double q : {-box.nu, box.nu}) {
      if (!balances(contacts, com, p, q)) return false;
    }
  }
  for (const ContactMode& mode : modes_of(contacts.size())) {
    if (feasible(contacts, com, rho, box, mode)) return false;
  }
  return true;
}

}  // namespace surefoot::bench
