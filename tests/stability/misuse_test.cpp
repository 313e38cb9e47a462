// What callers must not do is refused: in every build where it is seen when an object is made, by assertions where a
// check would cost what the answer does.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "stability/frictional.hpp"
#include "stability/frictional_region.hpp"
#include "stability/hybrid_dynamics.hpp"
#include "stability/region.hpp"
#include "stability/region_tolerance.hpp"
#include "stability/robust_oracle.hpp"
#include "tests/support/aborts.hpp"

using namespace surefoot::stability;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
const Vector2d com(0.5, 0.4);
const DisturbanceBox small{0.1, 0.1};

std::vector<Contact> feet(std::size_t count) {
  const std::vector<Contact> four{{{0, 0}, {0, 1}, 0.5},
                                  {{1, 0}, {0, 1}, 0.5},
                                  {{2, 0}, {0, 1}, 0.5},
                                  {{3, 0}, {0, 1}, 0.5}};
  return {four.begin(), four.begin() + static_cast<std::ptrdiff_t>(count)};
}
std::vector<Contact> with(const Contact& second) { return {feet(1)[0], second}; }

/// The ways in: every one of them takes contacts and a radius of gyration.
struct Entry {
  std::string name;
  bool asserts;  // what it does with numbers that are none; the others throw
  std::function<void(const std::vector<Contact>&, double rho)> call;
};
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"robust", true, [](const auto& contacts, double rho) { robust(contacts, rho, small, com); }},
      {"RobustOracle", false, [](const auto& contacts, double rho) { RobustOracle(contacts, rho, small); }},
      {"Posture", true,
       [](const auto& contacts, double rho) {
         Posture{contacts, rho};
       }},
      {"region", false,
       [](const auto& contacts, double rho) {
         region(contacts, rho, {{}, 0.1, 0.1});
       }},
      {"region_areas", false,
       [](const auto& contacts, double rho) {
         region_areas(contacts, rho, {{}, 0.1, 0.1});
       }},
      {"com_tolerance", false, [](const auto& contacts, double rho) { com_tolerance(contacts, rho, small, com); }},
      {"frictional_region", false, [](const auto& contacts, double rho) { frictional_region(contacts, rho, 0.5); }},
      {"HybridBody", false, [](const auto& contacts, double rho) { HybridBody(contacts, com, rho, 9.81); }}};
  return all;
}

void refused(const std::function<void()>& call, const std::string& words) {
  CHECK_THROWS_WITH(call(), Catch::Contains(words));
  CHECK_THROWS_AS(call(), std::invalid_argument);
}

/// Refused as this entry does it.
void refused(const Entry& entry, const std::vector<Contact>& contacts, double rho, const std::string& words) {
  const auto call = [&] { entry.call(contacts, rho); };
  if (!entry.asserts) return refused(call, words);
#ifndef NDEBUG
  CHECK(surefoot::test::aborts(call));
#endif
}

}  // namespace

TEST_CASE("No posture is made of contacts that are none", "[misuse]") {
  for (const Entry& entry : entries()) {
    INFO(entry.name);
    CHECK_NOTHROW(entry.call(feet(2), 0.2));
    const auto contacts_are_refused = [&](const std::vector<Contact>& contacts, const std::string& words) {
      refused(entry, contacts, 0.2, words);
    };
    const bool frictional = entry.name == "frictional_region";
    for (const std::size_t count : {0, 4}) refused([&] { entry.call(feet(count), 0.2); }, "contacts");
    for (const double bad : {no_number, inf, -inf}) {
      contacts_are_refused(with({{bad, 0}, {0, 1}, 0.5}), "contact 2: a number is not finite");
      contacts_are_refused(with({{1, bad}, {0, 1}, 0.5}), "contact 2: a number is not finite");
      contacts_are_refused(with({{1, 0}, {bad, 1}, 0.5}), "contact 2: a number is not finite");
      contacts_are_refused(with({{1, 0}, {0, bad}, 0.5}), "contact 2: a number is not finite");
      contacts_are_refused(with({{1, 0}, {0, 1}, bad}), "contact 2: a number is not finite");
      refused(entry, feet(2), bad, "radius of gyration");
    }
    contacts_are_refused(with({{1, 0}, {0, 0}, 0.5}), "contact 2: the normal is zero");
    contacts_are_refused(with({{1, 0}, {0, 1}, -1e-300}), "contact 2: friction is negative");
    for (const double rho : {0.0, -0.2}) refused(entry, feet(2), rho, "radius of gyration");
    if (frictional || entry.name == "HybridBody") contacts_are_refused(feet(3), "contacts");
  }
}

TEST_CASE("Normals of any length are lawful, and no verdict depends on it", "[misuse]") {
  for (const double length : {0x1p-1074, 0x1p-600, 0x1p-3, 8.0, 0x1p1000}) {
    auto contacts = feet(2);
    for (Contact& contact : contacts) contact.normal *= length;
    for (const double x : {-0.1, 0.05, 0.5, 0.97})
      CHECK(robust(contacts, 0.2, small, {x, 0.4}) == robust(feet(2), 0.2, small, {x, 0.4}));
  }
}

TEST_CASE("No disturbance, window or tolerance that is none", "[misuse]") {
  for (const double bad : {no_number, inf, -0.1}) {
    for (const DisturbanceBox& box : {DisturbanceBox{bad, 0}, DisturbanceBox{0, bad}}) {
      refused([&] { RobustOracle(feet(2), 0.2, box); }, "disturbance");
      refused([&] { com_tolerance(feet(2), 0.2, box, com); }, "disturbance");
      refused([&] { region(feet(2), 0.2, {{}, box.kappa, box.nu}); }, "wrenches");
      refused([&] { region_areas(feet(2), 0.2, {{}, box.kappa, box.nu}); }, "wrenches");
    }
    RegionOptions options;
    options.area_tolerance = bad;
    refused([&] { region(feet(2), 0.2, {}, options); }, "tolerances");
    FrictionalRegionOptions frictional;
    frictional.area_tolerance = bad;
    refused([&] { frictional_region(feet(2), 0.2, 0.5, frictional); }, "tolerances");
  }
  refused([] { region(feet(2), 0.2, {{no_number, 0}, 0, 0}); }, "wrenches");
  for (const AlignedBox2d& window :
       {AlignedBox2d(), AlignedBox2d(Vector2d(0, 0), Vector2d(0, 1)), AlignedBox2d(Vector2d(0, 0), Vector2d(1, inf)),
        AlignedBox2d(Vector2d(no_number, 0), Vector2d(1, 1))}) {
    RegionOptions options;
    options.window = window;
    refused([&] { region(feet(2), 0.2, {}, options); }, "window");
    refused([&] { region_areas(feet(2), 0.2, {}, options); }, "window");
    FrictionalRegionOptions frictional;
    frictional.window = window;
    refused([&] { frictional_region(feet(2), 0.2, 0.5, frictional); }, "window");
  }
}

TEST_CASE("Frictional stability is about two contacts and a restitution", "[misuse]") {
  for (const std::size_t count : {1, 3}) {
    const Posture posture(feet(count), 0.2);
    refused([&] { psi(posture, com); }, "two contacts");
    refused([&] { kinematic_strong(posture, com); }, "two contacts");
    refused([&] { clattering_converges(posture, com, 0.5); }, "two contacts");
    refused([&] { frictional_verdict(posture, com, 0.5); }, "two contacts");
    refused([&] { frictionally_stable(posture, com, 0.5); }, "two contacts");
    refused([&] { frictional_margins(posture, com, 0.5); }, "two contacts");
  }
  const Posture posture(feet(2), 0.2);
  for (const double bad : {0.0, 1.0, -0.5, no_number, inf}) {
    refused([&] { clattering_converges(posture, com, bad); }, "restitution");
    refused([&] { frictional_verdict(posture, com, bad); }, "restitution");
    refused([&] { frictionally_stable(posture, com, bad); }, "restitution");
    refused([&] { frictional_margins(posture, com, bad); }, "restitution");
    refused([&] { frictional_region(feet(2), 0.2, bad); }, "restitution");
  }
}

TEST_CASE("No motion without a body, a start and an end", "[misuse]") {
  for (const double bad : {no_number, inf, 0.0, -9.81}) refused([&] { HybridBody(feet(2), com, 0.2, bad); }, "gravity");
  refused([] { HybridBody(feet(2), {no_number, 0}, 0.2, 9.81); }, "COM");
  const HybridBody body(feet(2), com, 0.2, 9.81);
  refused([&] { body.state_at_heights(Vector3d::Zero(), Vector3d::Zero()); }, "parallel");
  const BodyState rest = body.state_at(Vector3d::Zero(), Vector3d::Zero());
  HybridOptions options;
  CHECK(simulate(body, rest, options).outcome == HybridRun::Outcome::rest);
  for (const double bad : {no_number, inf, -1.0}) {
    BodyState start = rest;
    start.h[1] = bad;
    refused([&] { simulate(body, start, options); }, bad == -1 ? "heights" : "finite");
    if (bad == -1) continue;
    for (double* number : {&start.r.x(), &start.theta, &start.v.y(), &start.omega, &start.rate[0], &start.slip[1]}) {
      start = rest;
      *number = bad;
      refused([&] { simulate(body, start, options); }, "finite");
    }
  }
  for (const double bad : {0.0, 1.0, no_number}) {
    HybridOptions wrong;
    wrong.restitution = bad;
    refused([&] { simulate(body, rest, wrong); }, "restitution");
  }
  for (double HybridOptions::*limit : {&HybridOptions::neighbourhood, &HybridOptions::time_limit})
    for (const double bad : {0.0, -1.0, no_number}) {
      HybridOptions wrong;
      wrong.*limit = bad;
      refused([&] { simulate(body, rest, wrong); }, "limits");
    }
}

#ifndef NDEBUG
TEST_CASE("A COM that is not finite stops a build with assertions", "[misuse]") {
  const RobustOracle oracle(feet(3), 0.2, small);
  const Posture two(feet(2), 0.2);
  for (const Vector2d& bad : {Vector2d(no_number, 0), Vector2d(0, inf)}) {
    const std::vector<std::function<void()>> calls{[&] { oracle.equilibrium(bad); },
                                                   [&] { oracle.robust(bad); },
                                                   [&] { oracle.feasible_modes(bad); },
                                                   [&] { oracle.safety_factor(bad); },
                                                   [&] { oracle.equilibrium_factor(bad); },
                                                   [&] { oracle.line(com, bad); },
                                                   [&] { oracle.line_equilibrium(com, bad); },
                                                   [&] { oracle.line_feasible_modes(bad, com); },
                                                   [&] { oracle.line_safety_factor(com, bad); },
                                                   [&] { oracle.line_equilibrium_factor(com, bad); },
                                                   [&] { robust(feet(2), 0.2, small, bad); },
                                                   [&] { com_tolerance(feet(2), 0.2, small, bad); },
                                                   [&] { psi(two, bad); },
                                                   [&] { kinematic_strong(two, bad); },
                                                   [&] { frictional_margins(two, bad, 0.5); }};
    for (std::size_t k = 0; k < calls.size(); ++k) {
      INFO("call " << k);
      CHECK(surefoot::test::aborts(calls[k]));
    }
  }
}
#endif
