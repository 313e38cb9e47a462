#include "planner/refine_model.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlopt.hpp>

namespace surefoot::planner {

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// Weight of the mean of the factors against the least: small enough not to trade the least for it in practice (the
/// caller compares exactly), large enough to decide where the least is indifferent.
constexpr double sum_weight = 0.05;
/// Weight of |step|^2 / 2 (step in units of the radius): makes the maximiser unique and short where nothing is gained.
/// The objective is divided by it, so that its Hessian in the steps is the identity, from which SLSQP starts: its
/// first subproblem is then nearly the whole problem.
constexpr double step_weight = 0.02;
constexpr int most_evaluations = 60;     // of the model, not of the oracle
constexpr double step_tolerance = 1e-4;  // in units of the radius: the trust region shrinks, so no more is needed

/// The model in scaled variables: u = (x - centre) / radius, tau = (t - least) / (radius * slope).
struct Scaled {
  const RefineModel* model = nullptr;
  VectorXd centre;
  double radius = 1, least = 0, slope = 0, elements = 1;
  std::vector<const Cut*> factors, clearances;
  std::vector<const ReachLimit*> farthest, nearest;  // where the greatest, the least reach can bind
  VectorXd x, gradient;                              // scratch
  std::size_t count() const { return factors.size() + clearances.size() + farthest.size() + nearest.size(); }

  void set(const double* z) { x = centre + radius * Eigen::Map<const VectorXd>(z, centre.size()); }

  /// One constraint <= 0, its gradient in x taken from `gradient`, both divided by `scale`.
  void put(double value, double tau_slope, double scale, double* value_out, double* row) const {
    *value_out = value / scale;
    if (row == nullptr) return;
    Eigen::Map<VectorXd>(row, gradient.size()) = gradient * (radius / scale);
    row[gradient.size()] = tau_slope;
  }
};

double objective(unsigned n, const double* z, double* gradient, void* data) {
  const auto& scaled = *static_cast<const Scaled*>(data);
  const Eigen::Index m = n - 1;
  const Eigen::Map<const VectorXd> u(z, m);
  const VectorXd slope = scaled.model->sum_gradient * (sum_weight / (scaled.slope * scaled.elements));
  if (gradient != nullptr) {
    Eigen::Map<VectorXd>(gradient, m) = u - slope / step_weight;
    gradient[m] = -1 / step_weight;
  }
  return 0.5 * u.squaredNorm() - (z[m] + slope.dot(u)) / step_weight;
}

/// Nearest point of the line from - to to the foot: lambda in [0, 1].
double nearest(const Vector2d& from, const Vector2d& to, const Vector2d& foot) {
  const Vector2d line = to - from;
  const double length2 = line.squaredNorm();
  return length2 > 0 ? std::clamp((foot - from).dot(line) / length2, 0.0, 1.0) : 0.0;
}

void put_reach(Scaled& s, const ReachLimit& limit, int sign, double* value, double* row) {
  const double excess = limit.excess(sign, sign < 0 ? s.model->reach_min : s.model->reach_max, s.x, s.gradient);
  s.put(excess, 0, 2 * s.model->reach_max * s.radius, value, row);
}

void constraints(unsigned, double* values, unsigned n, const double* z, double* rows, void* data) {
  auto& s = *static_cast<Scaled*>(data);
  s.set(z);
  const auto row = [&](std::size_t k) { return rows == nullptr ? nullptr : rows + k * n; };
  std::size_t k = 0;
  for (const Cut* cut : s.factors) {
    const double t = s.least + s.radius * s.slope * z[n - 1];
    s.gradient = -cut->gradient;
    s.put(t - cut->at(s.x), 1, s.radius * s.slope, values + k, row(k));
    ++k;
  }
  for (const Cut* cut : s.clearances) {
    s.gradient = -cut->gradient;
    s.put(s.model->least_clearance - cut->at(s.x), 0, s.radius, values + k, row(k));
    ++k;
  }
  for (const ReachLimit* limit : s.farthest) {
    put_reach(s, *limit, 1, values + k, row(k));
    ++k;
  }
  for (const ReachLimit* limit : s.nearest) {
    put_reach(s, *limit, -1, values + k, row(k));
    ++k;
  }
}

/// Keeps what can bind within the trust region.
void select(Scaled& s, double radius) {
  const RefineModel& model = *s.model;
  const double turn = (std::sqrt(2.0) + 1) * radius;  // how much the distance of a COM and a foot may change
  for (const Cut& cut : model.factors)
    if (cut.at(s.centre) - radius * cut.gradient.lpNorm<1>() < s.least + radius * s.slope) s.factors.push_back(&cut);
  for (const Cut& cut : model.clearances)
    if (cut.at(s.centre) - radius * cut.gradient.lpNorm<1>() < model.least_clearance) s.clearances.push_back(&cut);
  for (const ReachLimit& limit : model.reach) {
    const Vector2d from = limit.from.at(s.centre), to = limit.to.at(s.centre), foot = limit.foot.at(s.centre);
    const double far = std::sqrt(std::max((from - foot).squaredNorm(), (to - foot).squaredNorm()));
    const double near = (from + nearest(from, to, foot) * (to - from) - foot).norm();
    if (far + turn > model.reach_max) s.farthest.push_back(&limit);
    if (near - turn < model.reach_min) s.nearest.push_back(&limit);
  }
}

}  // namespace

Vector2d MovingPoint::at(const VectorXd& x) const {
  if (count == 2) return x.segment<2>(first);
  return count == 1 ? Vector2d(base + x[first] * direction) : base;
}

void MovingPoint::add_gradient(const Vector2d& along, Eigen::Ref<VectorXd> gradient) const {
  if (count == 2) gradient.segment<2>(first) += along;
  if (count == 1) gradient[first] += along.dot(direction);
}

double ReachLimit::excess(int sign, double bound, const VectorXd& x, VectorXd& gradient) const {
  const Vector2d a = from.at(x), b = to.at(x), standing = foot.at(x);
  const bool far_end = (b - standing).squaredNorm() > (a - standing).squaredNorm();
  const double lambda = sign < 0 ? nearest(a, b, standing) : far_end ? 1.0 : 0.0;
  const Vector2d r = a + lambda * (b - a) - standing;
  gradient.setZero(x.size());
  from.add_gradient(2 * sign * (1 - lambda) * r, gradient);
  to.add_gradient(2 * sign * lambda * r, gradient);
  foot.add_gradient(-2 * sign * r, gradient);
  return sign * (r.squaredNorm() - bound * bound);
}

VectorXd maximise(const RefineModel& model, const VectorXd& centre, double least, double radius, double& gain) {
  gain = 0;
  const Eigen::Index m = centre.size();
  Scaled scaled;
  scaled.model = &model;
  scaled.centre = scaled.x = centre;
  scaled.radius = radius;
  scaled.least = least;
  for (const Cut& cut : model.factors) {
    scaled.slope = std::max(scaled.slope, cut.gradient.lpNorm<1>());
    scaled.elements = std::max(scaled.elements, 1.0 + cut.element);
  }
  if (!(scaled.slope > 0) || !std::isfinite(scaled.slope)) return centre;
  select(scaled, radius);
  std::vector<double> lower(m + 1), upper(m + 1), z(m + 1, 0.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    lower[i] = std::clamp((model.lower[i] - centre[i]) / radius, -1.0, 0.0);
    upper[i] = std::clamp((model.upper[i] - centre[i]) / radius, 0.0, 1.0);
  }
  lower[m] = -1, upper[m] = 1;
  try {
    nlopt::opt problem(nlopt::LD_SLSQP, static_cast<unsigned>(m + 1));
    problem.set_min_objective(objective, &scaled);
    if (scaled.count() > 0)
      problem.add_inequality_mconstraint(constraints, &scaled, std::vector<double>(scaled.count(), 1e-6));
    problem.set_lower_bounds(lower);
    problem.set_upper_bounds(upper);
    problem.set_xtol_abs(step_tolerance);
    problem.set_ftol_abs(step_tolerance / step_weight);
    problem.set_maxeval(most_evaluations);
    double least_objective = 0;
    problem.optimize(z, least_objective);
  } catch (const std::exception&) {
    // SLSQP throws roundoff_limited with a usable z; what it is worth is for the caller to find out.
  }
  VectorXd x = centre;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (!std::isfinite(z[i])) return centre;
    x[i] = std::clamp(centre[i] + radius * std::clamp(z[i], lower[i], upper[i]), model.lower[i], model.upper[i]);
  }
  double promised = least + radius * scaled.slope;
  for (const Cut& cut : model.factors) promised = std::min(promised, cut.at(x));
  gain = promised - least;
  return x;
}

}  // namespace surefoot::planner
