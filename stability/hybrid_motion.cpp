#include "stability/hybrid_motion.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <vector>

namespace surefoot::stability {
namespace {

// r, theta, v, omega, then h, rate, slip of both contacts.
using Values = std::array<double, 12>;

Values pack(const BodyState& s) {
  return {s.r.x(), s.r.y(), s.theta,   s.v.x(),   s.v.y(),   s.omega,
          s.h[0],  s.h[1],  s.rate[0], s.rate[1], s.slip[0], s.slip[1]};
}

BodyState unpack(const Values& y) {
  BodyState s;
  s.r = {y[0], y[1]}, s.theta = y[2], s.v = {y[3], y[4]}, s.omega = y[5];
  s.h = {y[6], y[7]}, s.rate = {y[8], y[9]}, s.slip = {y[10], y[11]};
  return s;
}

class Motion {
 public:
  Motion(const HybridBody& body, const ContactMode& mode, const MotionLimits& limits)
      : body_(body), mode_(mode), limits_(limits) {}

  void operator()(const Values& y, Values& rates, double) const {
    const BodyState s = unpack(y);
    const auto motion = motion_in(body_, s, mode_);
    const ModeMotion m = motion.value_or(ModeMotion{});
    rates = {s.v.x(),   s.v.y(),   s.omega,   m.acceleration.x(), m.acceleration.y(), m.alpha,
             s.rate[0], s.rate[1], m.lift[0], m.lift[1],          m.slip[0],          m.slip[1]};
  }

  Values step(const Values& from, double s, Values* error = nullptr) const {
    boost::numeric::odeint::runge_kutta_fehlberg78<Values> stepper;
    Values to{}, unused{};
    stepper.do_step(*this, from, 0.0, to, s, error != nullptr ? *error : unused);
    return to;
  }

  struct Guard {
    MotionEnd::Cause cause;
    int contact;
  };
  /// All that may end the motion: each has a value that is positive until then.
  std::vector<Guard> guards() const {
    using enum MotionEnd::Cause;
    std::vector<Guard> list{{leaves, 0}};
    for (int i = 0; i < body_.contacts(); ++i) {
      if (mode_.at[i] == ContactState::breaks) {
        list.push_back({reaches, i});
        continue;
      }
      list.push_back({lifts, i});
      list.push_back({mode_.at[i] == ContactState::rolls ? slips : stops, i});
    }
    return list;
  }
  double value(const Guard& guard, const Values& y) const {
    const BodyState s = unpack(y);
    const int i = guard.contact;
    switch (guard.cause) {
      case MotionEnd::Cause::leaves: return limits_.excursion - body_.excursion(s);
      case MotionEnd::Cause::reaches: return s.h[i];
      case MotionEnd::Cause::stops: return mode_.at[i] == ContactState::slides_along ? s.slip[i] : -s.slip[i];
      default: break;
    }
    const auto m = motion_in(body_, s, mode_);
    if (!m) return -1;
    if (guard.cause == MotionEnd::Cause::lifts) return m->normal_force[i];
    return body_.friction(i) * m->normal_force[i] - std::abs(m->tangent_force[i]);
  }

  /// The first time in (0, s] at which the guard's value is no longer positive; s + 1 if it stays so.
  double crossing(const Guard& guard, const Values& from, const Values& to, double s) const {
    double low = 0, high = s, at_high = value(guard, to);
    if (at_high > 0) {
      // A height may have dipped below and come back.
      const std::size_t rate = 8 + static_cast<std::size_t>(guard.contact);
      if (guard.cause != MotionEnd::Cause::reaches || !(from[rate] < 0 && to[rate] > 0)) return s + 1;
      high = root([&](double t) { return step(from, t)[rate]; }, 0, s, from[rate], to[rate]).first;
      at_high = value(guard, step(from, high));
      if (at_high > 0) return s + 1;
    }
    double at_low = value(guard, from);
    for (int k = 0; k < 60 && !(at_low > 0); ++k) {  // begins at its limit, as a slide from rest does
      low = low == 0 ? 0.5 * high : 0.5 * low;
      at_low = value(guard, step(from, low));
    }
    if (!(at_low > 0)) return low;
    return root([&](double t) { return value(guard, step(from, t)); }, low, high, at_low, at_high).second;
  }

  /// The one step to take: grows and shrinks with the error. Counts what it tries; 0 when most_steps are reached.
  double advance(Values& y, double& s, int& tried) const {
    constexpr double tolerance = 1e-13, safety = 0.9, least_factor = 0.2, most_factor = 4;
    for (;;) {
      Values error{}, rates{};
      const Values to = step(y, s, &error);
      (*this)(y, rates, 0);
      double worst = 0;
      for (std::size_t k = 0; k < y.size(); ++k) {
        const double scale = std::max(std::abs(y[k]), std::abs(to[k])) + std::abs(rates[k] * s);
        if (scale > 0) worst = std::max(worst, std::abs(error[k]) / (tolerance * scale));
      }
      const double factor = safety * std::pow(std::max(worst, 1e-10), -0.125), taken = s;
      tried += worst <= 1 ? 1 : refused_step;
      if (tried >= most_steps) return 0;
      if (worst <= 1) {
        y = to;
        s *= std::clamp(factor, 1.0, most_factor);
        return taken;
      }
      s *= std::clamp(factor, least_factor, 1.0);
    }
  }

 private:
  template <class F>
  static std::pair<double, double> root(F&& f, double low, double high, double at_low, double at_high) {
    if (!((at_low > 0 && at_high < 0) || (at_low < 0 && at_high > 0))) return {high, high};
    boost::uintmax_t most = 100;
    return boost::math::tools::toms748_solve(f, low, high, at_low, at_high,
                                             boost::math::tools::eps_tolerance<double>(52), most);
  }

  const HybridBody& body_;
  const ContactMode& mode_;
  const MotionLimits& limits_;
};

/// Values that the mode holds at zero, free of rounding.
void tidy(const HybridBody& body, const ContactMode& mode, BodyState& state) {
  for (int i = 0; i < body.contacts(); ++i) {
    if (mode.at[i] == ContactState::breaks) continue;
    state.h[i] = state.rate[i] = 0;
    if (mode.at[i] == ContactState::rolls) state.slip[i] = 0;
  }
}

}  // namespace

MotionEnd move_in_mode(const HybridBody& body, BodyState& state, const ContactMode& mode, const MotionLimits& limits,
                       const std::function<void(double, const BodyState&)>& sample) {
  constexpr double first_step = 0.01;  // of the time scale of falling over
  const Motion motion(body, mode, limits);
  const auto guards = motion.guards();
  Values y = pack(state);
  int tried = 0;
  double time = 0, s = first_step * std::sqrt(body.rho() / body.gravity());
  for (;;) {
    s = std::min(s, limits.time - time);
    if (!(s > 0)) {
      state = unpack(y);
      tidy(body, mode, state);
      return {MotionEnd::Cause::time, 0, time};
    }
    const Values from = y;
    const double taken = motion.advance(y, s, tried);
    if (taken == 0) return {MotionEnd::Cause::work, 0, time};
    MotionEnd end;
    double first = taken + 1;
    for (const auto& guard : guards) {
      const double at = motion.crossing(guard, from, y, taken);
      if (at < first && at <= taken) first = at, end = {guard.cause, guard.contact, time + at};
    }
    const bool ends = first <= taken;
    state = unpack(ends ? motion.step(from, first) : y);
    tidy(body, mode, state);
    time += ends ? first : taken;
    if (!ends) y = pack(state);
    if (sample) sample(time, state);
    if (ends) return end;
  }
}

}  // namespace surefoot::stability
