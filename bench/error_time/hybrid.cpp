// Hybrid dynamics: error at the Zeno point, where infinitely many collisions have ended, over the time to get there.
#include <fmt/format.h>

#include <cmath>

#include "bench/error_time/hybrid_outsiders.hpp"
#include "bench/error_time/items.hpp"
#include "stability/frictional.hpp"
#include "stability/hybrid_dynamics.hpp"
#include "stability/hybrid_impact.hpp"

namespace surefoot::bench {
namespace {

using stability::BodyState;
using stability::Contact;
using stability::HybridBody;
using stability::HybridEvent;

constexpr double gravity = 9.81;  // [m/s^2]
constexpr double horizon = 4;     // of time stepping, in durations up to the limit: it may settle late

struct Case {
  const char* name;
  std::vector<Contact> contacts;
  Eigen::Vector2d com;
  double rho, restitution;
  double height;              ///< [m] size of the push
  Eigen::Vector3d direction;  ///< of (h_1, h_2, theta), or of (r_x, r_y, theta)
  bool heights;               ///< which
  bool closed_form = false;

  HybridBody body(bool linearised = false) const { return {contacts, com, rho, gravity, linearised}; }
  BodyState start(const HybridBody& of) const {
    const Eigen::Vector3d q = height * direction;
    return heights ? of.state_at_heights(q, Eigen::Vector3d::Zero()) : of.state_at(q, Eigen::Vector3d::Zero());
  }
  double speed() const { return std::sqrt(2 * gravity * height); }
};

std::vector<Case> cases() {
  const std::vector<Contact> ends{{{-1, 0}, {0, 1}, 0.5}, {{1, 0}, {0, 1}, 0.5}};
  const std::vector<Contact> vee{{{-0.5, 0.15}, {0.4, 1}, 0.5}, {{0.5, 0.15}, {-0.4, 1}, 0.5}};
  const double psi = 0.9;  // of the rod [OR-H, section IV.C]; above (10) for e = 0.3
  return {{"ball, e = 0.7, from 0.2 m", {{{0, 0}, {0, 1}, 0}}, {0, 0.3}, 0.1, 0.7, 0.2, {0, 1, 0}, false, true},
          {"rod, e = 0.3, from 1 cm", ends, {0, 0}, std::sqrt((1 - psi) / (1 + psi)), 0.3, 0.01, {0, 1, 0.3}, false},
          {"V, e = 0.3, from 1 cm", vee, {0, 0.18}, 0.1, 0.3, 0.01, {1, 1.3, 0.5}, true},
          {"V, e = 0.3, from 0.1 mm", vee, {0, 0.18}, 0.1, 0.3, 1e-4, {1, 1.3, 0.5}, true}};
}

ZenoPoint reference(const Case& given) {
  const HybridBody body = given.body();
  if (!given.closed_form) return zeno_in_many_digits(body, given.start(body), given.restitution);
  const double fall = std::sqrt(2 * given.height / gravity);
  return {fall + 2 * given.restitution * fall / (1 - given.restitution), Eigen::Vector3d::Zero(), 0};
}

/// By simulate(): the limit of the first accumulation.
ZenoPoint by_events(const Case& given, bool linearised) {
  const HybridBody body = given.body(linearised);
  stability::HybridOptions options;
  options.restitution = given.restitution;
  options.neighbourhood = 1;
  ZenoPoint end;
  bool ended = false;
  simulate(body, given.start(body), options, [&](const HybridEvent& event) {
    using Kind = HybridEvent::Kind;
    if (ended) return;
    ended = event.kind == Kind::bouncing || event.kind == Kind::clattering || event.kind == Kind::chattering;
    end = {event.time,
           {event.state.v.x(), event.state.v.y(), event.state.omega},
           end.collisions + (event.kind == Kind::collision)};
  });
  return end;
}

/// The first `most` collisions by the linearised Poincare map [OR-H, (7)]; only times. Nothing if it does not persist.
std::optional<double> by_map(const Case& given, int most) {
  const HybridBody body = given.body(true);
  const stability::Posture posture(given.contacts, given.rho);
  const auto psi = stability::psi(posture, given.com);
  BodyState state = given.start(body);
  const double first = time_to_contact(body, state, 0, 1e3), second = time_to_contact(body, state, 1, 1e3);
  int a = first <= second ? 0 : 1;
  double time = std::min(first, second);
  body.fly(state, time);
  collide(body, state, a, given.restitution);
  stability::Clattering map{state.rate[a], state.rate[1 - a], state.h[1 - a]};
  for (int k = 1; k < most; ++k) {
    const int b = 1 - a;
    map = clatter(map, given.restitution, psi[b], -body.free_acceleration(state, a), -body.free_acceleration(state, b));
    if (!map.persists) return std::nullopt;
    time += map.time;
    a = b;
  }
  return time;
}

void measure_case(Rows& rows, const Case& given, bool quick) {
  const ZenoPoint truth = reference(given);
  const auto error = [&](const ZenoPoint& found) {
    return std::max(std::abs(found.time / truth.time - 1),
                    (found.velocity - truth.velocity).cwiseAbs().maxCoeff() / given.speed());
  };
  const auto add = [&](const char* method, const std::string& parameter, auto&& find) {
    const ZenoPoint found = find();
    const Timing time = median_time(
        [&] {
          for (int k = 0; k < 4; ++k) keep(find());
        },
        {quick ? 0.02 : 0.2, 3, 101});
    rows.add(given.name, method, parameter, error(found), time.each(4),
             fmt::format("limit at {:.15g} s, reference {:.15g} s", found.time, truth.time));
  };
  const HybridBody body = given.body();
  for (const int n : {2, 4, 8, 16, 32, 64, 128})
    add("plain event-driven, n collisions", fmt::format("n = {}", n),
        [&, n] { return zeno_by_plain_events(body, given.start(body), given.restitution, n); });
  add("surefoot, event-driven, completed", "complete", [&] { return by_events(given, false); });
  if (given.contacts.size() == 2) {
    for (const int n : {2, 4, 8, 16, 32}) {
      if (!by_map(given, n)) break;
      add("linearised map, n collisions (time only)", fmt::format("n = {}", n), [&, n] {
        return ZenoPoint{*by_map(given, n), truth.velocity, n};
      });
    }
    add("surefoot, linearised body, completed", "complete", [&] { return by_events(given, true); });
  }
  for (const double share : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    if (quick && share < 1e-4) break;
    const double step = share * truth.time;
    add("time stepping (Moreau), h over the whole T", fmt::format("h = T/{:g}", std::round(1 / share)), [&, step] {
      return zeno_by_time_stepping(body, given.start(body), given.restitution, step, horizon * truth.time);
    });
  }
}

void measure(Rows& rows, bool quick) {
  for (const Case& given : cases()) measure_case(rows, given, quick);
}

std::string findings(const Rows& rows) {
  std::string text;
  for (const Case& given : cases()) {
    const Row* ours = rows.find(given.name, "surefoot, event-driven, completed");
    const Row* stepping = nullptr;
    for (const Row& row : rows.all())
      if (row.scenario == given.name && row.method.starts_with("time stepping")) stepping = &row;
    text += fmt::format("- {}: surefoot error {:.1e} in {:.3g} µs; time stepping at best {:.1e} in {:.3g} µs ({})",
                        given.name, ours->error, 1e6 * ours->time.seconds, stepping->error,
                        1e6 * stepping->time.seconds, stepping->parameter);
    if (const Row* linear = rows.find(given.name, "surefoot, linearised body, completed"))
      text += fmt::format("; the linearised body {:.1e}", linear->error);
    text += ".\n";
  }
  return text;
}

}  // namespace

const Item hybrid_item{
    "hybrid",
    "Hybrid dynamics: error at the Zeno point against time",
    "ball: t_1 + 2 e u_1 / (g (1 - e)); bodies with two contacts: flights and collisions in 200 digits "
    "(bench/error_time/hybrid_outsiders.cpp)",
    "relative error of time and velocity of the limit, the greater",
    "time per run",
    1e-6,
    measure,
    findings};

}  // namespace surefoot::bench
