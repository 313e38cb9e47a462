#include "tests/support/mode_brute_force.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace surefoot::testing {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
bool slides(char state) { return state == 'U' || state == 'W'; }
double sense(char state) { return state == 'U' ? 1 : -1; }

}  // namespace

ModeBruteForce::ModeBruteForce(const std::vector<stability::Contact>& contacts, const Vector2d& com, double rho)
    : rho_(rho) {
  for (std::size_t i : {0, 1}) {
    n_[i] = contacts[i].normal.normalized();
    t_[i] = {n_[i].y(), -n_[i].x()};
    r_[i] = contacts[i].position - com;
    mu_[i] = contacts[i].friction;
    normal_[i] << n_[i], cross(r_[i], n_[i]);
    tangent_[i] << t_[i], cross(r_[i], t_[i]);
  }
}

bool ModeBruteForce::positive(double value) {
  near_ |= !(std::abs(value) > 1e-9);
  return value > 0;
}

bool ModeBruteForce::equilibrium() {
  bool balanced = false;
  for (int left_out = 0; left_out < 4; ++left_out) {
    Eigen::Matrix3d edges;
    for (int ray = 0, column = 0; ray < 4; ++ray) {
      const auto i = static_cast<std::size_t>(ray / 2);
      if (ray != left_out) edges.col(column++) = normal_[i] + (ray % 2 ? -mu_[i] : mu_[i]) * tangent_[i];
    }
    const Vector3d force = edges.fullPivLu().solve(Vector3d(0, 1, 0));
    for (int k = 0; k < 3; ++k) positive(force[k]);
    balanced |= force.minCoeff() > 0;
  }
  return balanced;
}

bool ModeBruteForce::every_mode_leads_back() {
  // Both slide along the one motion that keeps both contacts, +- turn.
  const Vector3d turn = normal_[0].cross(normal_[1]);
  for (const char a : {'F', 'R', 'U', 'W'}) {
    for (const char b : {'F', 'R', 'U', 'W'}) {
      if ((a == 'R' && b != 'F') || (b == 'R' && a != 'F')) continue;  // static, or not possible in general
      if (slides(a) && slides(b) && !positive(sense(a) * tangent_[0].dot(turn) * sense(b) * tangent_[1].dot(turn)))
        continue;
      if (!leads_back({a, b})) return false;
    }
  }
  return true;
}

/// Unknowns: the acceleration (a_x, a_y, alpha) and the two contact forces; g = m = 1.
bool ModeBruteForce::leads_back(std::array<char, 2> mode) {
  Eigen::Matrix<double, 7, 7> m = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> rhs = Eigen::Matrix<double, 7, 1>::Zero();
  m(0, 0) = m(1, 1) = 1, m(2, 2) = rho_ * rho_, rhs(1) = -1;
  for (std::size_t i : {0, 1}) {
    const int at = 3 + 2 * static_cast<int>(i);
    m(0, at) = m(1, at + 1) = -1, m(2, at) = r_[i].y(), m(2, at + 1) = -r_[i].x();
    if (mode[i] == 'F') {
      m(at, at) = m(at + 1, at + 1) = 1;
      continue;
    }
    m.row(at).head<3>() = normal_[i].transpose();
    if (mode[i] == 'R') m.row(at + 1).head<3>() = tangent_[i].transpose();
    else m.row(at + 1).segment<2>(at) = (t_[i] + sense(mode[i]) * mu_[i] * n_[i]).transpose();
  }
  const Eigen::Matrix<double, 7, 1> x = m.fullPivLu().solve(rhs);
  bool possible = true, back = false;
  for (std::size_t i : {0, 1}) {
    const Vector2d force = x.segment<2>(3 + 2 * static_cast<int>(i));
    const double pressure = force.dot(n_[i]), drag = force.dot(t_[i]);
    if (mode[i] == 'F') back |= !positive(normal_[i].dot(x.head<3>()));
    if (mode[i] == 'R') possible &= positive(mu_[i] * pressure - std::abs(drag));
    if (!slides(mode[i])) continue;
    possible &= positive(pressure);
    back |= !positive(sense(mode[i]) * tangent_[i].dot(x.head<3>()));
  }
  return possible && back;
}

}  // namespace surefoot::testing
