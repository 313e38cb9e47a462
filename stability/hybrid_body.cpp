#include "stability/hybrid_body.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/given.hpp"

namespace surefoot::stability {

using Eigen::Vector2d;
using Eigen::Vector3d;

double sin_minus(double x) {
  constexpr double small = 1;  // below, twelve terms of the series reach rounding
  if (std::abs(x) > small) return std::sin(x) - x;
  double term = -x * x * x / 6, sum = 0;
  for (int k = 4; k < 28; k += 2) {
    sum += term;
    term *= -x * x / (k * (k + 1));
  }
  return sum;
}

HybridBody::HybridBody(std::span<const Contact> contacts, const Vector2d& com, double radius_of_gyration,
                       double gravity, bool linearised)
    : count_(static_cast<int>(contacts.size())), com_(com), rho_(radius_of_gyration), rho2_(rho_ * rho_),
      gravity_(gravity), extent_(rho_), linearised_(linearised) {
  require(contacts.size() == 1 || contacts.size() == 2, "contacts: expected 1 or 2");
  require_radius_of_gyration(rho_);
  require(positive(gravity), "gravity: expected a number > 0 [m/s^2]");
  require(com.allFinite(), "COM: expected finite numbers");
  require_contacts(contacts);
  for (int i = 0; i < count_; ++i) {
    ground_[i] = contacts[i].position;
    arm_[i] = ground_[i] - com;
    normal_[i] = contacts[i].normal.stableNormalized();
    tangent_[i] = {normal_[i].y(), -normal_[i].x()};
    friction_[i] = contacts[i].friction;
  }
  if (count_ == 2) extent_ = std::max(rho_, (ground_[1] - ground_[0]).norm());
}

/// (R(angle) - 1) a without cancellation; its first-order part in the linearised body.
Vector2d HybridBody::turned_by(const Vector2d& arm, double angle) const {
  if (linearised_) return angle * quarter(arm);
  const double half = std::sin(0.5 * angle);
  return -2 * half * half * arm + std::sin(angle) * quarter(arm);
}

Vector2d HybridBody::arm(int i, double theta) const {
  return linearised_ ? arm_[i] : Vector2d(arm_[i] + turned_by(arm_[i], theta));
}

BodyState HybridBody::state_at(const Vector3d& q, const Vector3d& q_rate) const {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();  // of the terms of h
  BodyState state;
  state.r = q.head<2>(), state.theta = q.z();
  state.v = q_rate.head<2>(), state.omega = q_rate.z();
  for (int i = 0; i < count_; ++i) {
    const Vector2d turn = turned_by(arm_[i], state.theta),
                   velocity = state.v + state.omega * quarter(arm(i, state.theta));
    const double h = normal_[i].dot(state.r) + normal_[i].dot(turn), size = state.r.norm() + turn.norm();
    state.h[i] = std::abs(h) <= rounding * size ? 0 : h;
    const double rate = normal_[i].dot(velocity);
    state.rate[i] = std::abs(rate) <= rounding * (state.v.norm() + std::abs(state.omega) * arm_[i].norm()) ? 0 : rate;
    state.slip[i] = tangent_[i].dot(velocity);
  }
  return state;
}

bool is_finite(const HybridBody& body, const BodyState& state) {
  double zero = 0 * state.theta + 0 * state.omega;  // zero times a number is zero only if it is finite
  for (int i = 0; i < body.contacts(); ++i) zero += 0 * state.h[i] + 0 * state.rate[i] + 0 * state.slip[i];
  return zero == 0 && state.r.allFinite() && state.v.allFinite();
}

bool HybridBody::parallel_normals() const {
  constexpr double least = 1e-12;  // sine of the angle: beyond, r would not be determined to a few digits
  return count_ < 2 || std::abs(cross(normal_[0], normal_[1])) < least;
}

BodyState HybridBody::state_at_heights(const Vector3d& heights, const Vector3d& heights_rate) const {
  require(!parallel_normals(), "heights do not tell the place where the normals are parallel");
  Eigen::Matrix2d normals;
  normals << normal_[0].transpose(), normal_[1].transpose();
  const double theta = heights.z(), omega = heights_rate.z();
  Vector2d lift, lift_rate;
  for (int i : {0, 1}) {
    lift[i] = heights[i] - normal_[i].dot(turned_by(arm_[i], theta));
    lift_rate[i] = heights_rate[i] - omega * normal_[i].dot(quarter(arm(i, theta)));
  }
  const Eigen::Matrix2d inverse = normals.inverse();
  const Vector2d r = inverse * lift, v = inverse * lift_rate;
  BodyState state = state_at({r.x(), r.y(), theta}, {v.x(), v.y(), omega});
  for (int i : {0, 1}) state.h[i] = heights[i], state.rate[i] = heights_rate[i];
  return state;
}

Vector2d HybridBody::point(const BodyState& state, int i) const {
  return ground_[i] + state.r + turned_by(arm_[i], state.theta);
}

double HybridBody::excursion(const BodyState& state) const {
  double most = state.r.norm();
  for (int i = 0; i < count_; ++i) most = std::max(most, (state.r + turned_by(arm_[i], state.theta)).norm());
  return most;
}

double HybridBody::energy(const BodyState& state) const {
  return 0.5 * (state.v.squaredNorm() + rho2_ * state.omega * state.omega) + gravity_ * state.r.y();
}

double HybridBody::speed(const BodyState& state) const {
  double arm = rho_;
  for (int i = 0; i < count_; ++i) arm = std::max(arm, arm_[i].norm());
  return std::max(state.v.norm(), std::abs(state.omega) * arm);
}

double HybridBody::free_acceleration(const BodyState& state, int i) const {
  return -gravity_ * normal_[i].y() - turning(state) * normal_[i].dot(arm(i, state.theta));
}

double HybridBody::response(double theta, int i, const Vector2d& d, int j, const Vector2d& e) const {
  return d.dot(e) + cross(arm(i, theta), d) * cross(arm(j, theta), e) / rho2_;
}

void HybridBody::push(BodyState& state, int j, const Vector2d& e) const {
  for (int i = 0; i < count_; ++i) {
    state.rate[i] += response(state.theta, i, normal_[i], j, e);
    state.slip[i] += response(state.theta, i, tangent_[i], j, e);
  }
  state.v += e;
  state.omega += cross(arm(j, state.theta), e) / rho2_;
}

/// h changes by rate s - g n_y s^2 / 2 and by what turning adds beyond its first order: n . ((cos - 1) a + (sin -
/// angle) a').
void HybridBody::fly(BodyState& state, double s) const {
  const double angle = state.omega * s;
  for (int i = 0; i < count_; ++i) {
    const Vector2d a = arm(i, state.theta);
    state.h[i] += state.rate[i] * s - 0.5 * gravity_ * normal_[i].y() * s * s;
    state.rate[i] -= gravity_ * normal_[i].y() * s;
    state.slip[i] -= gravity_ * tangent_[i].y() * s;
    if (linearised_) continue;
    const double half = std::sin(0.5 * angle);
    state.h[i] += -2 * half * half * normal_[i].dot(a) + sin_minus(angle) * normal_[i].dot(quarter(a));
    const Vector2d change = state.omega * quarter(turned_by(a, angle));
    state.rate[i] += normal_[i].dot(change);
    state.slip[i] += tangent_[i].dot(change);
  }
  state.r += s * state.v;
  state.r.y() -= 0.5 * gravity_ * s * s;
  state.v.y() -= gravity_ * s;
  state.theta += angle;
}

}  // namespace surefoot::stability
