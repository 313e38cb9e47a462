#include "stability/hybrid_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "stability/given.hpp"
#include "stability/hybrid_flight.hpp"
#include "stability/hybrid_impact.hpp"
#include "stability/hybrid_motion.hpp"
#include "stability/point_test.hpp"

namespace surefoot::stability {
namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
constexpr double died_out = 1e-12;  ///< of the greatest speed of a run: ten local errors of motion with closed contacts

/// A change of mode costs about as much as this many collisions.
constexpr std::uint64_t work_of_mode = 1000;

class Run {
 public:
  Run(const HybridBody& body, const BodyState& start, const HybridOptions& options,
      const std::function<void(const HybridEvent&)>& watch)
      : body_(body), options_(options), watch_(watch), state_(start), energy_(body.energy(start)) {
    speed_ = body.speed(start);
  }

  HybridRun go() {
    using enum HybridRun::Outcome;
    measure(state_);
    while (!ended_) {
      if (!(time_ < options_.time_limit) || run_.collisions + work_of_mode * run_.modes > options_.most_collisions)
        end(undecided);
      else if (!(body_.excursion(state_) <= options_.neighbourhood)) end(left);  // so do numbers that overflow
      else if (!impacts()) none_closed() ? fly() : move();
    }
    measure(state_);
    run_.state = state_;
    run_.time = time_;
    return run_;
  }

 private:
  using Kind = HybridEvent::Kind;

  void end(HybridRun::Outcome outcome) {
    run_.outcome = outcome;
    ended_ = true;
  }
  bool none_closed() const {
    for (int i = 0; i < body_.contacts(); ++i)
      if (state_.closed(i)) return false;
    return true;
  }
  bool all_closed() const {
    for (int i = 0; i < body_.contacts(); ++i)
      if (!state_.closed(i)) return false;
    return true;
  }

  /// The compensated sum of times, which never runs back by what it makes up for.
  void pass(double duration) {
    const double add = duration - lost_, sum = std::max(time_, time_ + add);
    lost_ = (sum - time_) - add;
    time_ = sum;
  }

  void measure(const BodyState& state) {
    run_.greatest_excursion = std::max(run_.greatest_excursion, body_.excursion(state));
  }

  void tell(Kind kind, int contact, double speed = 0, double duration = 0, const ModeChoice* choice = nullptr) {
    speed_ = std::max(speed_, body_.speed(state_));
    measure(state_);
    const double energy = body_.energy(state_);
    run_.energy_growth = std::max(run_.energy_growth, energy - energy_);
    energy_ = energy;
    if (!watch_) return;
    HybridEvent event{kind, time_, contact, speed, duration, {}, false, state_};
    if (choice != nullptr) event.mode = *choice->mode, event.ambiguous = choice->consistent > 1;
    watch_(event);
  }

  void collide_at(int i) {
    const double speed = -state_.rate[i];
    collide(body_, state_, i, options_.restitution);
    ++run_.collisions;
    tell(Kind::collision, i, speed);
  }

  /// Collisions of contacts that touch and approach, in zero time. True if there were any.
  bool impacts() {
    int next = approaching();
    if (next < 0) return false;
    for (; next >= 0; next = approaching()) {
      collide_at(next);
      if (body_.contacts() == 2 && chatters(body_, state_, next, options_.restitution)) {
        accumulate(Kind::chattering);
        return true;
      }
    }
    complete();
    return true;
  }

  /// The contact that touches and approaches fastest, -1 if none does.
  int approaching() const {
    int next = -1;
    for (int i = 0; i < body_.contacts(); ++i)
      if (state_.h[i] == 0 && state_.rate[i] < 0 && (next < 0 || state_.rate[i] < state_.rate[next])) next = i;
    return next;
  }

  /// What is left of a speed when the rest of the collisions does not count.
  double left_over(double speed) const { return rounding * (1 - options_.restitution) * speed; }

  void accumulate(Kind kind) {
    settle(body_, state_);
    ++run_.accumulations;
    tell(kind, 0);
  }

  /// After collisions: is what follows an accumulation that can be completed?
  void complete() {
    bool clatters = true;
    double longest = 0;
    for (int i = 0; i < body_.contacts(); ++i) {
      if (state_.closed(i)) continue;
      const double g = -body_.free_acceleration(state_, i);
      const double reach = std::sqrt(state_.rate[i] * state_.rate[i] + 2 * std::abs(g) * state_.h[i]);
      clatters &= g > 0 && reach <= left_over(speed_);
      if (g > 0) longest = std::max(longest, 2 * reach / g);
    }
    if (clatters && body_.contacts() == 2) {
      pass(longest / (1 - options_.restitution));
      accumulate(Kind::clattering);
      return;
    }
    for (int i = 0; i < body_.contacts(); ++i) {
      if (state_.h[i] != 0 || !(state_.rate[i] > 0)) continue;
      const Bouncing rest = bouncing(body_, state_, i, options_.restitution);
      if (!rest.alone || rest.error * rest.time > rounding * (time_ + rest.time) ||
          rest.error * 2 * state_.rate[i] > (1 - options_.restitution) * rounding * speed_)
        continue;
      finish_bouncing(body_, state_, i, options_.restitution, rest.time);
      pass(rest.time);
      ++run_.accumulations;
      tell(Kind::bouncing, i, 0, rest.time);
      return;
    }
  }

  void fly() {
    // By then the body has fallen or risen out of the neighbourhood.
    const double v = state_.v.norm(), g = body_.gravity(), wide = options_.neighbourhood + state_.r.norm();
    const double horizon = std::min((v + std::sqrt(v * v + 4 * g * wide)) / g, options_.time_limit - time_);
    double soonest = horizon;
    int next = -1;
    for (int i = 0; i < body_.contacts(); ++i) {
      const double s = time_to_contact(body_, state_, i, horizon);
      if (s < soonest) soonest = s, next = i;
    }
    if (const auto out = time_to_leave(body_, state_, soonest, options_.neighbourhood)) {
      body_.fly(state_, *out);
      pass(*out);
      tell(Kind::sample, 0);
      return end(HybridRun::Outcome::left);
    }
    if (farthest_in_flight(body_, state_, soonest) > run_.greatest_excursion)
      for (const double s : moments_of_flight(body_, state_, soonest)) measure(flown(body_, state_, s));
    body_.fly(state_, soonest);
    pass(soonest);
    for (int i = 0; i < body_.contacts(); ++i) state_.h[i] = std::max(0.0, state_.h[i]);
    if (next >= 0) {
      state_.h[next] = 0;
      state_.rate[next] = std::min(0.0, state_.rate[next]);
    }
  }

  bool still() const { return state_.v.isZero(0) && state_.omega == 0; }

  void stop() {
    state_.v.setZero();
    state_.omega = 0;
    state_.slip = {};
  }

  /// A closed contact that does not slide stands still: the body turns about it.
  void hold() {
    for (int i = 0; i < body_.contacts(); ++i)
      if (state_.closed(i) && state_.slip[i] == 0) state_.v = -state_.omega * quarter(body_.arm(i, state_.theta));
  }

  /// Balance by friction where the body stands now, exactly for the doubles of that place.
  bool balanced() const {
    std::vector<Contact> contacts;
    contacts.reserve(static_cast<std::size_t>(body_.contacts()));
    for (int i = 0; i < body_.contacts(); ++i)
      contacts.push_back({body_.point(state_, i), body_.normal(i), body_.friction(i)});
    const Posture posture(contacts, body_.rho(), Posture::Modes::deferred);
    const Eigen::Vector2d com = body_.com() + state_.r;
    constexpr DisturbanceBox gravity{};
    return PointQuery(posture, com, gravity).equilibrium();
  }

  /// Nothing but numerical error is left of the motion: impacts and friction by turns have died out.
  bool has_died_out() const {
    if (still() && all_closed()) return false;
    double most = body_.speed(state_);
    for (int i = 0; i < body_.contacts(); ++i)
      most = std::max({most, std::abs(state_.rate[i]), std::abs(state_.slip[i]),
                       std::sqrt(2 * body_.gravity() * std::abs(state_.h[i]))});
    return most <= died_out * speed_;
  }

  void move() {
    if (has_died_out()) {
      for (int i = 0; i < body_.contacts(); ++i) state_.h[i] = state_.rate[i] = 0;
      stop();
      ++run_.accumulations;
      tell(Kind::dies_out, 0);
    }
    if (all_closed()) {
      bool slides = false;
      for (int i = 0; i < body_.contacts(); ++i) slides |= state_.slip[i] != 0;
      if (!slides && body_.contacts() == 2) stop();
      if (!slides && still() && balanced()) return end(HybridRun::Outcome::rest);
    }
    hold();
    const ModeChoice choice = choose_mode(body_, state_, std::exchange(leaving_, {}));
    if (!choice.mode) return end(HybridRun::Outcome::inconsistent);
    if (still() && choice.motion.acceleration.isZero(0) && choice.motion.alpha == 0)
      return end(HybridRun::Outcome::rest);
    ++run_.modes;
    run_.ambiguous += choice.consistent > 1;
    tell(Kind::mode, 0, 0, 0, &choice);
    bool holds = false;
    for (int i = 0; i < body_.contacts(); ++i) holds |= choice.mode->at[i] != ContactState::breaks;
    if (!holds) return fly();
    move_in(*choice.mode);
  }

  void move_in(const ContactMode& mode) {
    const double begin = time_, begin_lost = lost_;
    const auto sample = [&](double time, const BodyState& state) {
      time_ = begin, lost_ = begin_lost;
      pass(time);  // as at the end, so that time never runs back by a rounding
      state_ = state;
      tell(Kind::sample, 0);
    };
    BodyState state = state_;
    const MotionEnd last =
        move_in_mode(body_, state, mode, {options_.neighbourhood, options_.time_limit - time_}, sample);
    state_ = state;
    time_ = begin, lost_ = begin_lost;
    pass(last.time);
    settle_end(last, mode);
  }

  void settle_end(const MotionEnd& last, const ContactMode& mode) {
    const int i = last.contact;
    bool both = body_.contacts() == 2;
    for (int j = 0; j < body_.contacts(); ++j) both &= mode.at[j] != ContactState::breaks;
    using enum MotionEnd::Cause;
    switch (last.cause) {
      case stops:
        state_.slip[i] = 0;
        if (both) stop();  // with two closed contacts there is one motion: both stop
        return tell(Kind::stops, i);
      case lifts: leaving_ = {i, true}; return tell(Kind::lifts, i);
      case slips: leaving_ = {i, false}; return tell(Kind::slips, i);
      case reaches: state_.h[i] = 0; return tell(Kind::reaches, i);
      case leaves: return end(HybridRun::Outcome::left);
      case work:
      case time: return end(HybridRun::Outcome::undecided);
    }
  }

  const HybridBody& body_;
  const HybridOptions& options_;
  const std::function<void(const HybridEvent&)>& watch_;
  BodyState state_;
  HybridRun run_;
  double time_ = 0, lost_ = 0, speed_ = 0, energy_;
  bool ended_ = false;
  Leaving leaving_;  ///< at the next choice of a mode
};

void require_start(const HybridBody& body, const BodyState& start) {
  require(is_finite(body, start), "start: expected finite numbers");
  for (int i = 0; i < body.contacts(); ++i) require(start.h[i] >= 0, "start: expected heights >= 0");
}

}  // namespace

const char* name(HybridRun::Outcome outcome) {
  switch (outcome) {
    case HybridRun::Outcome::rest: return "rest";
    case HybridRun::Outcome::left: return "left";
    case HybridRun::Outcome::inconsistent: return "inconsistent";
    default: return "undecided";
  }
}

HybridRun simulate(const HybridBody& body, const BodyState& start, const HybridOptions& options,
                   const std::function<void(const HybridEvent&)>& watch) {
  require_restitution(options.restitution);
  require(options.neighbourhood > 0 && options.time_limit > 0, "limits of a run: expected numbers > 0");
  require_start(body, start);
  return Run(body, start, options, watch).go();
}

}  // namespace surefoot::stability
