#include "stability/hybrid_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/region_poly.hpp"

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {
constexpr double never = HUGE_VAL;
constexpr double last_place = std::numeric_limits<double>::epsilon();
}  // namespace

double time_to_contact(const HybridBody& body, const BodyState& start, int i, double horizon) {
  constexpr int most_steps = 2000;  // a few for a crossing; more only where h touches without crossing
  const double swing = body.linearised() ? 0 : std::abs(start.omega), arm = body.arm(i, 0).norm();
  const double third = swing * swing * swing * arm;  // bounds |h'''|
  double s = 0;
  for (int k = 0; k < most_steps; ++k) {
    BodyState state = start;
    if (s > 0) body.fly(state, s);
    const double h = std::max(0.0, state.h[i]), rate = state.rate[i], second = body.free_acceleration(state, i);
    if (s > 0 && state.h[i] <= 0 && rate < 0) return s;
    // h(s + d) >= h + rate d + least d^2 / 2 for d <= reach.
    double reach = std::min(horizon - s, first_root({-h, -rate, -0.5 * second}));
    if (h == 0 && rate > 0) reach = second < 0 ? std::min(horizon - s, -2 * rate / second) : horizon - s;
    if (third > 0) {
      reach = std::min(reach, 0.5 / swing);
      if (h == 0 && rate == 0 && second > 0) reach = std::min(reach, 0.5 * second / third);
    }
    if (!(reach > 0)) {
      if (s > 0 || rate < 0) return s;
      reach = 1e-12 * std::sqrt(arm / body.gravity());  // let go of without acceleration: look a moment later
    }
    const double least = second - third * std::min(reach, 1e100);
    double step = reach;
    if (h == 0 && rate > 0) {
      if (least < 0) step = std::min(reach, -2 * rate / least);
    } else if (h > 0 || rate > 0) {
      step = std::min(reach, first_root({-h, -rate, -0.5 * least}));
    }
    s += step;
    if (s >= horizon) return never;
    if (step <= 2 * last_place * s) return s;
  }
  return s;
}

void collide(const HybridBody& body, BodyState& state, int i, double restitution) {
  const Vector2d& n = body.normal(i);
  const double rate = state.rate[i], impulse = -(1 + restitution) * rate / body.response(state.theta, i, n, i, n);
  body.push(state, i, impulse * n);
  state.rate[i] = -restitution * rate;
}

void settle(const HybridBody& body, BodyState& state) {
  if (body.contacts() == 1) {
    collide(body, state, 0, 0);
  } else {
    const Vector2d &n0 = body.normal(0), &n1 = body.normal(1);
    const double a = body.response(state.theta, 0, n0, 0, n0), b = body.response(state.theta, 0, n0, 1, n1),
                 c = body.response(state.theta, 1, n1, 1, n1), determinant = a * c - b * b;
    if (determinant > 4 * last_place * a * c) {  // else one normal line carries both: one impulse does
      const double p0 = (b * state.rate[1] - c * state.rate[0]) / determinant,
                   p1 = (b * state.rate[0] - a * state.rate[1]) / determinant;
      body.push(state, 0, p0 * n0);
      body.push(state, 1, p1 * n1);
    } else {
      body.push(state, 0, -state.rate[0] / a * n0);
    }
  }
  for (int i = 0; i < body.contacts(); ++i) state.h[i] = state.rate[i] = 0;
}

bool chatters(const HybridBody& body, const BodyState& state, int a, double restitution) {
  const int b = 1 - a;
  if (state.h[a] != 0 || state.h[b] != 0 || !(state.rate[b] < 0)) return false;
  const Vector2d &na = body.normal(a), &nb = body.normal(b);
  const double mixed =
      -(1 + restitution) * body.response(state.theta, a, na, b, nb);  // (1 + e) psi times the own entry
  const double ka = mixed / body.response(state.theta, a, na, a, na),
               kb = mixed / body.response(state.theta, b, nb, b, nb);
  if (!(mixed > 0) || ka * kb < 4 * restitution) return false;
  const double greatest = 0.5 * kb * (1 + std::sqrt(1 - 4 * restitution / (ka * kb)));
  return state.rate[a] <= greatest * -state.rate[b];
}

/// The k-th bounce from now rises with u e^k: times 2 u e^k / g, impulses (1 + e) e^(k-1) u / W, k = 1, 2, ...
Bouncing bouncing(const HybridBody& body, const BodyState& state, int i, double restitution) {
  const double g = -body.free_acceleration(state, i), u = state.rate[i];
  if (!(g > 0)) return {never, 0, false};
  Bouncing result;
  result.time = 2 * u / (g * (1 - restitution));
  const Vector2d& n = body.normal(i);
  const double impulse = (1 + restitution) * u / ((1 - restitution) * body.response(state.theta, i, n, i, n));
  if (!body.linearised()) {
    const double arm = body.arm(i, 0).norm(),
                 spin = std::abs(cross(body.arm(i, state.theta), n)) * impulse / body.rho2(),
                 turn = (std::abs(state.omega) + spin) * result.time;
    const double change = arm * ((2 * std::abs(state.omega) + spin) * spin + state.omega * state.omega * turn);
    result.error = change / g + turn;
  }
  result.alone = true;
  for (int j = 0; j < body.contacts(); ++j) {
    if (j == i) continue;
    const double push = std::min(0.0, body.response(state.theta, j, body.normal(j), i, n) * impulse);
    const double least = state.h[j] + std::min(0.0, state.rate[j] + push) * result.time +
                         0.5 * std::min(0.0, body.free_acceleration(state, j)) * result.time * result.time;
    result.alone = least > 0;
  }
  return result;
}

/// Impulses add up to I = (1 + e) u / ((1 - e) W) and, weighted with the time left after each, to
/// J = u time e / ((1 - e) W): what they add to velocities and to positions.
void finish_bouncing(const HybridBody& body, BodyState& state, int i, double restitution, double time) {
  const Vector2d& n = body.normal(i);
  const double theta = state.theta, own = body.response(theta, i, n, i, n), u = state.rate[i];
  const double scale = u / ((1 - restitution) * own), sum = (1 + restitution) * scale,
               moment = time * restitution * scale;
  body.fly(state, time);
  for (int j = 0; j < body.contacts(); ++j) {
    state.h[j] += body.response(theta, j, body.normal(j), i, n) * moment;
    state.rate[j] += body.response(theta, j, body.normal(j), i, n) * sum;
    state.slip[j] += body.response(theta, j, body.tangent(j), i, n) * sum;
  }
  const double spin = cross(body.arm(i, theta), n) / body.rho2();
  state.r += moment * n, state.v += sum * n;
  state.theta += spin * moment, state.omega += spin * sum;
  state.h[i] = state.rate[i] = 0;
}

Clattering clatter(const Clattering& from, double restitution, double psi_b, double g_a, double g_b) {
  const double fall = std::sqrt(from.u_b * from.u_b + 2 * g_b * from.h_b);
  Clattering to;
  // (u_b + fall) / g_b, without cancellation for u_b < 0.
  to.time = from.u_b < 0 ? 2 * from.h_b / (fall - from.u_b) : (from.u_b + fall) / g_b;
  to.persists = to.time * g_a < 2 * from.u_a;
  to.u_a = restitution * fall;
  to.u_b = from.u_a - g_a * to.time - (1 + restitution) * psi_b * fall;
  to.h_b = to.time * (from.u_a - 0.5 * g_a * to.time);
  return to;
}

}  // namespace surefoot::stability
