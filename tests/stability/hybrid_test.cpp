// Hybrid dynamics against closed forms, and against flights and collisions computed in 50 digits from the printed
// formulas of [OR-H].
#include "stability/hybrid_dynamics.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "stability/frictional.hpp"
#include "stability/hybrid_impact.hpp"
#include "stability/robust_oracle.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sample_posture.hpp"

using namespace surefoot::stability;
using surefoot::test::rounds;
using surefoot::testing::Sampler;
using Big = boost::multiprecision::cpp_bin_float_50;
using Eigen::Vector2d;

namespace {

constexpr double g = 9.81;

std::vector<Contact> feet(double left_lean, double right_lean, double mu) {
  return {{{-0.5, 0}, {std::sin(left_lean), std::cos(left_lean)}, mu},
          {{0.6, 0.1}, {std::sin(right_lean), std::cos(right_lean)}, mu}};
}

/// Rod of [OR-H, section IV.C]: half length L = 1, psi = (1 - rho^2) / (1 + rho^2).
HybridBody rod(double psi) {
  const std::vector<Contact> ends{{{-1, 0}, {0, 1}, 0.5}, {{1, 0}, {0, 1}, 0.5}};
  return {ends, {0, 0}, std::sqrt((1 - psi) / (1 + psi)), g, true};
}

/// h_i, u_i of [OR-H, (5)-(6)], flown and collided in 50 digits.
struct LinearReference {
  Big h[2], u[2], gravity[2], psi[2], e;
  Big time = 0;

  Big soonest(int i) const {  // from h >= 0; h = 0 means just bounced
    const Big root = sqrt(u[i] * u[i] + 2 * gravity[i] * h[i]);
    return (u[i] + root) / gravity[i];
  }
  int collide() {
    const Big s[2] = {soonest(0), soonest(1)};
    const int a = s[0] <= s[1] ? 0 : 1, b = 1 - a;
    for (int i : {0, 1}) {
      h[i] += s[a] * (u[i] - gravity[i] * s[a] / 2);
      u[i] -= gravity[i] * s[a];
    }
    time += s[a];
    h[a] = 0;
    u[b] += (1 + e) * psi[a] * u[a];
    u[a] *= -e;
    return a;
  }
};

LinearReference reference_of(const HybridBody& body, const std::vector<Contact>& contacts, const BodyState& start,
                             double e) {
  LinearReference reference;
  reference.e = e;
  Big b[2], n[2][2];
  for (int i : {0, 1}) {
    const Vector2d arm = contacts[i].position - body.com();
    const Big x = contacts[i].normal.x(), y = contacts[i].normal.y(), size = sqrt(x * x + y * y);
    n[i][0] = x / size, n[i][1] = y / size;
    b[i] = n[i][1] * arm.x() - n[i][0] * arm.y();  // t . (x_i - x)
    reference.h[i] = start.h[i], reference.u[i] = start.rate[i];
    reference.gravity[i] = Big(body.gravity()) * n[i][1];
  }
  const Big rho2 = Big(body.rho()) * body.rho(), across = n[0][0] * n[1][0] + n[0][1] * n[1][1];
  for (int i : {0, 1}) reference.psi[i] = -(b[0] * b[1] + across * rho2) / (b[i] * b[i] + rho2);
  return reference;
}

/// h_i = n . (r + (R - 1) d) after a time in free flight.
Big height_in_flight(const HybridBody& body, const Vector2d& arm, int i, const BodyState& s, const Big& t) {
  const Big angle = Big(s.theta) + Big(s.omega) * t, c = cos(angle) - 1, d = sin(angle);
  const Big x = Big(s.r.x()) + t * s.v.x() + c * arm.x() - d * arm.y();
  const Big y = Big(s.r.y()) + t * s.v.y() - Big(body.gravity()) * t * t / 2 + d * arm.x() + c * arm.y();
  return x * body.normal(i).x() + y * body.normal(i).y();
}

}  // namespace

TEST_CASE("A bouncing ball ends at t0 + 2 u0 / (g (1 - e)), whatever its restitution and height", "[hybrid]") {
  const std::vector<Contact> contact{{{0, 0}, {0, 1}, 0}};
  const HybridBody body(contact, {0, 0.3}, 0.1, g);
  HybridOptions options;
  options.neighbourhood = 10, options.time_limit = 1e12;
  for (const double e : {1e-9, 0.1, 0.5, 0.9, 0.999999, 1 - 1e-9})
    for (const double height : {1.0, 1e-3, 1e-12}) {
      options.restitution = e;
      const double fall = std::sqrt(2 * height / g), limit = fall + 2 * e * fall / (1 - e);
      INFO("e " << e << ", height " << height);
      // It arrives sliding at 0.2 m/s and slides on: what counts is the end of the bouncing.
      HybridEvent end;
      simulate(body, body.state_at({0.1, height, 0}, {0.2, 0, 0}), options, [&end](const HybridEvent& event) {
        if (event.kind == HybridEvent::Kind::bouncing && end.time == 0) end = event;
      });
      CHECK(end.time == Approx(limit).epsilon(1e-12).margin(0));
      CHECK(end.state.v.x() == Approx(0.2).epsilon(1e-12).margin(0));
      CHECK(end.state.r.x() == Approx(0.1 + 0.2 * limit).epsilon(1e-12).margin(0));
      CHECK(end.state.h[0] == 0);
    }
}

TEST_CASE("Collisions of the linearised body are those of 50 digits, and the Poincare map steps between them",
          "[hybrid]") {
  Sampler sampler(301);
  int clatterings = 0;
  for (int k = 0; k < rounds(200); ++k) {
    const auto contacts = feet(sampler.uniform(-0.6, 0.6), sampler.uniform(-0.6, 0.6), 0.5);
    const double rho = sampler.uniform(0.05, 0.5), e = sampler.uniform(0.05, 0.8);
    const HybridBody body(contacts, {sampler.uniform(-0.3, 0.3), sampler.uniform(-0.1, 0.4)}, rho, g, true);
    const BodyState start = body.state_at_heights({sampler.uniform(0, 1e-3), sampler.uniform(0, 1e-3), 0},
                                                  {sampler.uniform(-0.1, 0.1), sampler.uniform(-0.1, 0.1), 0});
    LinearReference reference = reference_of(body, contacts, start, e);
    HybridOptions options;
    options.restitution = e, options.neighbourhood = 1;
    std::vector<HybridEvent> events;
    simulate(body, start, options, [&events](const HybridEvent& event) { events.push_back(event); });
    int last = -1;
    for (std::size_t n = 0; n < std::min<std::size_t>(events.size(), 12); ++n) {
      if (events[n].kind != HybridEvent::Kind::collision) break;
      const LinearReference before = reference;
      const int a = reference.collide();
      INFO("round " << k << ", collision " << n);
      REQUIRE(events[n].contact == a);
      // Each collision may amplify what the one before was wrong by.
      for (int i : {0, 1}) {
        const double size =
            std::abs(static_cast<double>(reference.u[0])) + std::abs(static_cast<double>(reference.u[1]));
        CHECK(std::abs(events[n].state.rate[i] - static_cast<double>(reference.u[i])) < 1e-10 * size);
      }
      CHECK(events[n].time == Approx(static_cast<double>(reference.time)).epsilon(1e-11));
      if (last == 1 - a && before.u[a] < 0) {  // clattering: b of the map is the contact that collides now
        ++clatterings;
        const auto plain = [](const Big& x) { return static_cast<double>(x); };
        const Clattering step =
            clatter({plain(before.u[last]), plain(before.u[a]), plain(before.h[a])}, e, plain(reference.psi[a]),
                    plain(reference.gravity[last]), plain(reference.gravity[a]));
        CHECK(step.persists);
        CHECK(step.u_a == Approx(plain(reference.u[a])).epsilon(1e-11));
        CHECK(step.u_b == Approx(plain(reference.u[last])).epsilon(1e-9).margin(1e-14));
        CHECK(step.h_b == Approx(plain(reference.h[last])).epsilon(1e-9).margin(1e-18));
      }
      last = a;
    }
  }
  CHECK(clatterings > rounds(200) / 2);
}

TEST_CASE("Heights in flight are those of 50 digits, and the first contact is the first", "[hybrid]") {
  Sampler sampler(302);
  int hits = 0;
  for (int k = 0; k < rounds(60); ++k) {
    const auto contacts = feet(sampler.uniform(-0.6, 0.6), sampler.uniform(-0.6, 0.6), 0.5);
    const Vector2d com(sampler.uniform(-0.3, 0.3), sampler.uniform(0, 0.6));
    const HybridBody body(contacts, com, 0.2, g);
    const BodyState start = body.state_at({0, sampler.uniform(0.3, 1), sampler.uniform(-0.2, 0.2)},
                                          {sampler.uniform(-1, 1), sampler.uniform(-1, 3), sampler.uniform(-30, 30)});
    for (int i : {0, 1}) {
      const Vector2d arm = contacts[static_cast<std::size_t>(i)].position - com;
      if (start.h[i] <= 0) continue;
      BodyState later = start;
      const double t = sampler.uniform(0, 0.1);
      body.fly(later, t);
      CHECK(later.h[i] ==
            Approx(static_cast<double>(height_in_flight(body, arm, i, start, t))).epsilon(1e-12).margin(1e-14));
      const double horizon = 1, found = time_to_contact(body, start, i, horizon);
      constexpr int steps = 2000;
      double first = HUGE_VAL;
      for (int s = 1; s <= steps && first > horizon; ++s)
        if (height_in_flight(body, arm, i, start, Big(horizon) * s / steps) < 0) first = horizon * s / steps;
      INFO("round " << k << ", contact " << i << ", found " << found << ", scan " << first);
      if (first <= horizon) {
        ++hits;
        CHECK(found <= first);
      }
      if (found <= horizon) {  // there it is at the ground, and not before
        CHECK(std::abs(static_cast<double>(height_in_flight(body, arm, i, start, found))) < 1e-13);
        CHECK(found >= std::min(first, horizon) - horizon / steps - 1e-12);
      }
    }
  }
  CHECK(hits > rounds(60) / 2);
}

TEST_CASE("Chattering goes on for ever just where 400 collisions in zero time do, never below the dashed curve",
          "[hybrid]") {
  // The rod at rest on both ends, one of them hit: [OR-H, (9)] without heights.
  int yes = 0, no = 0;
  for (double e = 0.05; e < 1; e += 0.05)
    for (double psi = 0.02; psi < 1; psi += 0.03) {
      for (const double begin : {0.0, 0.3, 0.9}) {  // rate of the other end, over that of the impact
        const double dashed = 2 * std::sqrt(e) / (1 + e);
        if (std::abs(psi - dashed) < 1e-3) continue;
        const HybridBody body = rod(psi);
        BodyState state = body.state_at({0, 0, 0}, {0, 0, 0});
        state.rate = {begin, -1};
        collide(body, state, 1, e);
        long double u_a = e, u_b = begin - (1 + static_cast<long double>(e)) * psi;
        bool goes_on = u_b < 0;
        for (int k = 0; k < 400 && goes_on; ++k) {
          const long double a = -e * u_b, b = u_a + (1 + static_cast<long double>(e)) * psi * u_b;
          const long double size = std::abs(a) + std::abs(b);
          u_a = a / size, u_b = b / size;
          goes_on = u_b < 0;
        }
        INFO("e " << e << ", psi " << psi << ", begin " << begin);
        CHECK(chatters(body, state, 1, e) == goes_on);
        if (psi < dashed) CHECK_FALSE(goes_on);
        (goes_on ? yes : no) += 1;
      }
    }
  CHECK(yes > 100);
  CHECK(no > 100);
}

TEST_CASE("Above (10) every clattering of the rod under gravity comes to its limit", "[hybrid]") {
  Sampler sampler(303);
  for (int k = 0; k < rounds(300); ++k) {
    const double e = sampler.uniform(0.01, 0.9), threshold = (std::cbrt(e) + std::cbrt(e * e)) / (1 + e);
    const double psi = sampler.uniform(threshold, 1);
    const HybridBody body = rod(std::min(psi, 0.9999));
    const double lift = sampler.uniform(1e-4, 1e-2), turn = sampler.uniform(-0.9, 0.9) * lift;
    HybridOptions options;
    options.restitution = e, options.neighbourhood = 1, options.time_limit = 1e4;
    const HybridRun run = simulate(body, body.state_at({0, lift, turn}, {0, 0, sampler.uniform(-0.1, 0.1)}), options);
    INFO("e " << e << ", psi " << psi);
    CHECK(run.accumulations >= 1);
    CHECK(run.outcome == HybridRun::Outcome::rest);
  }
}

TEST_CASE("Every push within the guarantee of Theorem 3 ends at rest near the start, and energy never grows",
          "[hybrid]") {
  Sampler sampler(304);
  int inside = 0;
  for (int k = 0; k < rounds(40000) && inside < rounds(200); ++k) {
    std::vector<Contact> contacts;
    for (const int side : {-1, 1}) {
      const double lean = sampler.uniform(-0.9, 0.9);
      contacts.push_back({{side * sampler.uniform(0.3, 1), sampler.uniform(-0.2, 0.2)},
                          {std::sin(lean), std::cos(lean)},
                          sampler.uniform(0.2, 1.5)});
    }
    const Vector2d com(sampler.uniform(-0.2, 0.2), sampler.uniform(-0.1, 0.6));
    const double rho = sampler.uniform(0.02, 0.4), e = sampler.uniform(0.02, 0.6);
    if (!frictional_verdict(Posture(contacts, rho), com, e).stable()) continue;
    ++inside;
    const HybridBody body(contacts, com, rho, g);
    constexpr double size = 1e-7;
    HybridOptions options;
    options.restitution = e, options.neighbourhood = 1e-2;
    const BodyState start =
        body.state_at_heights({sampler.uniform(0, size), sampler.uniform(0, size), sampler.uniform(-size, size)},
                              {sampler.uniform(-size, size), sampler.uniform(-size, size),
                               sampler.uniform(-size, size)});
    const HybridRun run = simulate(body, start, options);
    INFO("round " << k);
    CHECK(run.outcome == HybridRun::Outcome::rest);
    CHECK(run.greatest_excursion < 1e-3);
    CHECK(run.energy_growth < 1e-12 * g * run.greatest_excursion);
  }
  CHECK(inside > rounds(40));
}

TEST_CASE("A turn about a rolling foot keeps its energy until the other foot comes down", "[hybrid]") {
  const auto contacts = feet(0, 0, 5);
  const HybridBody body(contacts, {0, 0.3}, 0.3, g);
  // Turned up about the left foot by 0.05 rad, standing still.
  const Vector2d arm = contacts[0].position - body.com();
  const double turn = 0.05, half = std::sin(0.5 * turn);
  const Vector2d shift = -(-2 * half * half * arm + std::sin(turn) * quarter(arm));
  const BodyState start = body.state_at({shift.x(), shift.y(), turn}, {0, 0, 0});
  REQUIRE(start.h[0] == 0);
  REQUIRE(start.h[1] > 0);
  HybridOptions options;
  options.restitution = 0.3;
  double before = HUGE_VAL;
  simulate(body, start, options, [&](const HybridEvent& event) {
    if (event.kind == HybridEvent::Kind::reaches && before == HUGE_VAL) before = body.energy(event.state);
  });
  CHECK(before == Approx(body.energy(start)).epsilon(1e-11));
}

TEST_CASE("A body thrown up leaves its neighbourhood at the height of it, also if it would fall back", "[hybrid]") {
  const auto contacts = feet(0, 0, 0.5);
  const HybridBody body(contacts, {0, 0.3}, 0.3, g);
  const double speed = 3, apex = speed * speed / (2 * g);
  const BodyState start = body.state_at({0, 0, 0}, {0, speed, 0});
  HybridOptions options;
  options.restitution = 0.1;
  for (const double height : {0.01, 0.3, 0.999 * apex}) {
    options.neighbourhood = height;
    const HybridRun run = simulate(body, start, options);
    INFO("neighbourhood " << height);
    CHECK(run.outcome == HybridRun::Outcome::left);
    CHECK(run.time == Approx((speed - std::sqrt(speed * speed - 2 * g * height)) / g).epsilon(1e-6));
    CHECK(run.greatest_excursion == Approx(height).epsilon(1e-12));
  }
  options.neighbourhood = 1.001 * apex;
  const HybridRun fallen = simulate(body, start, options);
  CHECK(fallen.outcome == HybridRun::Outcome::rest);
  CHECK(fallen.greatest_excursion == Approx(apex).epsilon(1e-12));
  // From above the ground, so that the way down is longer than the way up.
  const BodyState above = body.state_at({0, 0.1, 0}, {0, speed, 0});
  options.neighbourhood = (0.1 + apex) * (1 - 1e-9);
  CHECK(simulate(body, above, options).outcome == HybridRun::Outcome::left);
  options.neighbourhood = (0.1 + apex) * (1 + 1e-9);
  CHECK(simulate(body, above, options).outcome == HybridRun::Outcome::rest);
}

TEST_CASE("A foot whose force reaches the edge of its cone slides, and does not roll and slip by turns for ever",
          "[hybrid]") {
  // Rods that tip about one foot: round numbers, for which rounding on the edge of the cone went either way.
  for (const double x : {0.3, 0.35, 0.4, 0.45, 0.5})
    for (const double mu : {0.2, 0.3, 0.4})
      for (const double height : {0.02, 0.05, 0.1, 0.15}) {
        const std::vector<Contact> foot{{{x, 0}, {0, 1}, mu}};
        const HybridBody body(foot, {0, height}, 0.3, g);
        HybridOptions options;
        options.restitution = 0.1, options.neighbourhood = 0.3;
        int slips = 0, slides_after = 0;
        bool slipped = false;
        const HybridRun run = simulate(body, body.state_at({0, 0, 0}, {0, 0, 0}), options, [&](const HybridEvent& e) {
          if (slipped && e.kind == HybridEvent::Kind::mode) slides_after += e.mode.at[0] != ContactState::rolls;
          slipped = e.kind == HybridEvent::Kind::slips;
          slips += slipped;
        });
        INFO("foot " << x << ", mu " << mu << ", height " << height);
        CHECK(run.outcome == HybridRun::Outcome::left);
        CHECK(slips <= 1);
        CHECK(slides_after == slips);
        CHECK(run.energy_growth < 1e-12);
        CHECK(run.state.omega > 0);  // it tips away from its foot
      }
}

TEST_CASE("A foot that lifts is gone until it comes down, and no run of round numbers is undecided", "[hybrid]") {
  struct Start {
    std::vector<Contact> contacts;
    Vector2d com;
    double rho;
  };
  std::vector<Start> starts{
      {{{{-0.15, 0}, {0, 1}, 0.5}, {{0.1, 0.08}, {-0.5, 1}, 0.1}}, {0.22, 0.46}, 0.3},
      {{{{-0.26, 0}, {1.4, 1}, 0.1}, {{0.46, 0.08}, {0, 1}, 1}}, {0.09, 0.33}, 0.2},
  };
  Sampler sampler(91);
  const auto round_number = [&](double low, double high) { return std::round(100 * sampler.uniform(low, high)) / 100; };
  for (int k = 0; k < rounds(200); ++k)
    starts.push_back(
        {{{{round_number(-0.5, -0.1), 0}, {round_number(-0.5, 1), 1}, round_number(0.1, 1)},
          {{round_number(0.1, 0.5), round_number(0, 0.1)}, {round_number(-1, 0.5), 1}, round_number(0.1, 1)}},
         {round_number(-0.3, 0.3), round_number(0.15, 0.5)},
         round_number(0.1, 0.3)});
  HybridOptions options;
  options.restitution = 0.1, options.neighbourhood = 0.3, options.time_limit = 5;
  int lifts = 0, undecided = 0;
  for (const Start& start : starts) {
    const HybridBody body(start.contacts, start.com, start.rho, g);
    int lifted = -1;
    const HybridRun run = simulate(body, body.state_at({0, 0, 0}, {0, 0, 0}), options, [&](const HybridEvent& event) {
      if (lifted >= 0 && event.kind == HybridEvent::Kind::mode) CHECK(event.mode.at[lifted] == ContactState::breaks);
      lifted = event.kind == HybridEvent::Kind::lifts ? event.contact : -1;
      lifts += lifted >= 0;
    });
    undecided += run.outcome == HybridRun::Outcome::undecided && run.time < options.time_limit;
  }
  CHECK(lifts > rounds(10));
  CHECK(undecided == 0);
}

TEST_CASE("Linearised and nonlinear runs agree to the order of the push", "[hybrid]") {
  const auto contacts = feet(0.3, -0.2, 0.5);
  const HybridBody exact(contacts, {0.02, 0.1}, 0.15, g), linear(contacts, {0.02, 0.1}, 0.15, g, true);
  const auto first_end = [](const HybridBody& body, double size) {
    HybridOptions options;
    options.restitution = 0.1, options.neighbourhood = 10;
    double time = 0;
    const auto start = body.state_at_heights({size, 0.7 * size, 0.1 * size}, {0, 0, 0});
    simulate(body, start, options, [&time](const HybridEvent& event) {
      const bool ends = event.kind == HybridEvent::Kind::bouncing || event.kind == HybridEvent::Kind::clattering;
      if (ends && time == 0) time = event.time;
    });
    REQUIRE(time > 0);
    return time;
  };
  double last = 0;
  for (const double size : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double time = first_end(linear, size), difference = std::abs(first_end(exact, size) / time - 1);
    INFO("size " << size << ", difference " << difference);
    if (last > 0) CHECK(std::log10(last / difference) > 0.8);
    last = difference;
  }
}

TEST_CASE("From rest the consistent modes are those that the oracle finds feasible under gravity", "[hybrid]") {
  Sampler sampler(305);
  int moving = 0;
  for (int k = 0; k < rounds(4000); ++k) {
    const auto contacts = feet(sampler.uniform(-1.2, 1.2), sampler.uniform(-1.2, 1.2), sampler.uniform(0.05, 1.5));
    const Vector2d com(sampler.uniform(-1, 1), sampler.uniform(-0.5, 1.5));
    const double rho = sampler.uniform(0.05, 0.5);
    const HybridBody body(contacts, com, rho, g);
    const ModeChoice choice = choose_mode(body, body.state_at({0, 0, 0}, {0, 0, 0}));
    const auto feasible = RobustOracle(contacts, rho, {0, 0}).feasible_modes(com);
    INFO("round " << k);
    CHECK(choice.consistent == static_cast<int>(feasible.size()));
    if (choice.mode) CHECK(std::count(feasible.begin(), feasible.end(), *choice.mode) == 1);
    moving += !feasible.empty();
  }
  CHECK(moving > rounds(1000));
}

TEST_CASE("A block slides v^2 / 2 (mu g cos - g sin) down an incline and stops for good", "[hybrid]") {
  for (const double slope : {0.0, 0.1, 0.3}) {
    const Vector2d down(std::cos(slope), -std::sin(slope)), up(std::sin(slope), std::cos(slope));
    const std::vector<Contact> contacts{{-0.5 * down, up, 0.6}, {0.5 * down, up, 0.6}};
    const HybridBody body(contacts, 0.1 * up, 0.3, g);
    const double v = 0.2, slowing = g * (0.6 * std::cos(slope) - std::sin(slope));
    HybridOptions options;
    options.restitution = 0.3;
    const HybridRun run = simulate(body, body.state_at({0, 0, 0}, {v * down.x(), v * down.y(), 0}), options);
    CHECK(run.outcome == HybridRun::Outcome::rest);
    CHECK(run.time == Approx(v / slowing).epsilon(1e-12));
    CHECK(run.state.r.dot(down) == Approx(v * v / (2 * slowing)).epsilon(1e-12));
    CHECK(run.collisions == 0);
  }
}
