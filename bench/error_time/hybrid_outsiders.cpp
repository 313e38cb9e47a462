#include "bench/error_time/hybrid_outsiders.hpp"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace surefoot::bench {
namespace {

using Eigen::Vector2d;
using stability::BodyState;
using stability::HybridBody;

/// A body of one or two contacts in numbers of type S.
template <class S>
struct Body {
  int count;
  S gravity, rho2;
  std::array<std::array<S, 2>, 2> arm, normal;
  S x, y, theta, vx, vy, omega;

  Body(const HybridBody& body, const BodyState& start)
      : count(body.contacts()), gravity(body.gravity()), rho2(S(body.rho()) * S(body.rho())), x(start.r.x()),
        y(start.r.y()), theta(start.theta), vx(start.v.x()), vy(start.v.y()), omega(start.omega) {
    using std::sqrt;
    for (int i = 0; i < count; ++i) {
      const Vector2d d = body.ground(i) - body.com();
      const S nx(body.normal(i).x()), ny(body.normal(i).y()), size = sqrt(nx * nx + ny * ny);
      arm[i] = {S(d.x()), S(d.y())};
      normal[i] = {nx / size, ny / size};
    }
  }

  /// R(theta) d_i
  std::array<S, 2> turned(int i, const S& angle) const {
    using std::cos, std::sin;
    const S c = cos(angle), s = sin(angle);
    return {c * arm[i][0] - s * arm[i][1], s * arm[i][0] + c * arm[i][1]};
  }
  S height(int i) const {
    const auto a = turned(i, theta);
    return normal[i][0] * (x + a[0] - arm[i][0]) + normal[i][1] * (y + a[1] - arm[i][1]);
  }
  /// r x n at contact i.
  S lever(int i) const {
    const auto a = turned(i, theta);
    return a[0] * normal[i][1] - a[1] * normal[i][0];
  }
  S rate(int i) const { return normal[i][0] * vx + normal[i][1] * vy + lever(i) * omega; }
  /// Minus the second derivative of the height in flight.
  S fall(int i) const {
    const auto a = turned(i, theta);
    return normal[i][1] * gravity + omega * omega * (normal[i][0] * a[0] + normal[i][1] * a[1]);
  }
  /// N_i . M^-1 N_j
  S response(int i, int j) const {
    return normal[i][0] * normal[j][0] + normal[i][1] * normal[j][1] + lever(i) * lever(j) / rho2;
  }
  void push(int i, const S& impulse) {
    vx += impulse * normal[i][0], vy += impulse * normal[i][1], omega += impulse * lever(i) / rho2;
  }
  void fly(const S& s) { x += s * vx, y += s * vy - gravity * s * s / 2, theta += s * omega, vy -= gravity * s; }
};

/// Speeds fall to 1e-22 of what they were, heights may fall to 1e-130 of the arms they are read off from.
using Big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>, boost::multiprecision::et_off>;

/// From a parabola, then Newton; -1 if the contact does not come down.
template <class S>
S time_to_contact(const Body<S>& body, int i, bool just_bounced) {
  using std::sqrt, std::abs;
  const S h = just_bounced ? S(0) : body.height(i), u = body.rate(i), g = body.fall(i);
  if (g <= 0 || (just_bounced && u <= 0)) return S(-1);
  S s = (u + sqrt(u * u + 2 * g * h)) / g;
  constexpr int most = 8;  // quadratic convergence from a parabola
  for (int k = 0; k < most; ++k) {
    Body<S> later = body;
    later.fly(s);
    const S change = later.height(i) / later.rate(i);
    s -= change;
    if (abs(change) <= 16 * s * std::numeric_limits<S>::epsilon()) break;
  }
  return s;
}

/// Flights and collisions until `most` of them, or until less than `share` of the first one's speed is left.
template <class S>
ZenoPoint collided(const HybridBody& given, const BodyState& start, double restitution, int most, double share) {
  Body<S> body(given, start);
  ZenoPoint end;
  S time(0), first_speed(0);
  const S e(restitution);
  int last = -1;
  for (bool left = true; left && end.collisions < most;) {
    int hit = -1;
    S soonest(0);
    for (int i = 0; i < body.count; ++i) {
      const S s = time_to_contact(body, i, i == last);
      if (s >= 0 && (hit < 0 || s < soonest)) hit = i, soonest = s;
    }
    if (hit < 0) break;
    body.fly(soonest);
    time += soonest;
    const S speed = -body.rate(hit);
    body.push(hit, (1 + e) * speed / body.response(hit, hit));
    if (end.collisions++ == 0) first_speed = speed;
    last = hit;
    left = speed > first_speed * S(share);
  }
  end.time = static_cast<double>(time);
  end.velocity = {static_cast<double>(body.vx), static_cast<double>(body.vy), static_cast<double>(body.omega)};
  return end;
}

/// 0 <= u+ + e u- and impulses >= 0, one of them zero, for the active contacts; `free`: rates without impulse.
std::array<double, 2> impulses(const Body<double>& body, const std::array<bool, 2>& active,
                               const std::array<double, 2>& free, const std::array<double, 2>& before, double e) {
  const std::array<double, 2> lack{-(free[0] + e * before[0]), -(free[1] + e * before[1])};
  const auto alone = [&](int i) {
    std::array<double, 2> found{};
    if (active[i]) found[i] = std::max(lack[i] / body.response(i, i), 0.0);
    return found;
  };
  if (!active[0] || !active[1]) return alone(active[0] ? 0 : 1);
  for (const int i : {0, 1}) {  // one pushes, the other opens by itself
    const auto found = alone(i);
    if (found[i] * body.response(1 - i, i) >= lack[1 - i]) return found;
  }
  const double a = body.response(0, 0), b = body.response(0, 1), c = body.response(1, 1), det = a * c - b * b;
  return {(c * lack[0] - b * lack[1]) / det, (a * lack[1] - b * lack[0]) / det};
}

}  // namespace

ZenoPoint zeno_in_many_digits(const HybridBody& given, const BodyState& start, double restitution) {
  constexpr int most = 100'000;
  return collided<Big>(given, start, restitution, most, 1e-22);
}

ZenoPoint zeno_by_plain_events(const HybridBody& given, const BodyState& start, double restitution, int most) {
  return collided<double>(given, start, restitution, most, 0);
}

ZenoPoint zeno_by_time_stepping(const HybridBody& given, const BodyState& start, double restitution, double step,
                                double horizon) {
  Body<double> body(given, start);
  ZenoPoint end;
  constexpr double still =
      20;  // times what gravity makes in one step: two feet of the scheme rattle on with some 10 of it
  const auto drift = [&body, step] {
    body.x += 0.5 * step * body.vx, body.y += 0.5 * step * body.vy, body.theta += 0.5 * step * body.omega;
  };
  for (std::int64_t k = 1; static_cast<double>(k) * step <= horizon; ++k) {
    drift();
    std::array<bool, 2> active{};
    std::array<double, 2> before{}, free{};
    for (int i = 0; i < body.count; ++i) {
      active[i] = body.height(i) <= 0;
      before[i] = body.rate(i);
    }
    body.vy -= step * body.gravity;
    for (int i = 0; i < body.count; ++i) free[i] = body.rate(i);
    const auto pushes = impulses(body, active, free, before, restitution);
    for (int i = 0; i < body.count; ++i)
      if (pushes[i] > 0) body.push(i, pushes[i]), ++end.collisions;
    drift();
    bool moving = false;
    for (int i = 0; i < body.count; ++i) moving |= std::abs(body.rate(i)) > still * step * body.gravity;
    if (moving) end.time = static_cast<double>(k) * step, end.velocity = {body.vx, body.vy, body.omega};
  }
  return end;
}

}  // namespace surefoot::bench
