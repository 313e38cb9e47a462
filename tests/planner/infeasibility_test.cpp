// The proof of impossibility: what it says of the canned scenes, that it objects to no scene with a plan, and that each
// bound contains what the rules and the oracle allow.
#include "planner/infeasibility.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "planner/infeasibility_bounds.hpp"
#include "planner/search.hpp"
#include "tests/support/known_plan.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/sample_scene.hpp"

using namespace surefoot;
using Eigen::Vector2d;
using planner::Impossibility;
using planner::Obstacle;
using planner::prove_infeasible;
using planner::proof::Bounds;
using planner::proof::Convex;
using planner::proof::Foot;
using planner::proof::Piece;
using planner::proof::piece_of;
using surefoot::testing::sample_scene;
using surefoot::testing::SceneKind;

namespace {

std::vector<std::string> maps(const std::string& first_word) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS))
    if (entry.path().extension() == ".yaml" && test::read_text(entry.path()).starts_with("# " + first_word + ":"))
      names.push_back(entry.path().stem());
  return names;
}
gaits::Scene canned(const std::string& name) {
  return gaits::load_scene(std::string(SUREFOOT_MAPS) + "/" + name + ".yaml");
}

struct Expected {
  const char* scene;
  Obstacle obstacle;
  const char* words;    // in the reason
  double x_from, x_to;  // [m] the place lies within
};
constexpr double any = 1e9;

/// What the first lines of the maps say, in numbers: where the obstacle is and which rule makes it one.
const Expected expected[] = {
    {"gap_too_wide", Obstacle::barrier, "no support pair within reach 0.9 spans the gap of 2.1 m", 1, 3.1},
    {"no_footholds", Obstacle::barrier, "no support pair within reach 0.9 spans the gap of 1.9 m", 1, 2.9},
    {"start_island", Obstacle::barrier, "spans the gap of 1.85 m", 0.4, 2.25},
    {"too_slippery", Obstacle::barrier, "balances the weight at friction 0.35", 0.8, 3.8},
    {"ice_too_long", Obstacle::barrier, "balances every disturbance (kappa 0.1, nu 0.03 m) at friction 0.05", 1, 3.2},
    {"wind_too_strong", Obstacle::barrier, "balances every disturbance (kappa 0.2, nu 0.03 m)", 0.8, 3.8},
    {"drop_too_deep", Obstacle::barrier, "sees the foot", 1.2, 1.2},
    {"step_too_high", Obstacle::barrier, "balances the weight", 1.2, 1.2},
    {"wall_too_high", Obstacle::barrier, "keeps the clearance 0.15", 1.6, 1.9},
    {"ceiling_too_low", Obstacle::barrier, "keeps the clearance 0.15", 1.4, 4},
    {"chimney_too_slippery", Obstacle::barrier, "balances the weight at friction 0.2", -any, any},
    {"chimney_too_wide", Obstacle::goal, "balances the weight", -any, any},
    {"goal_off_the_edge", Obstacle::goal, "balances the weight", 3.35, 3.6},
    {"goal_too_high", Obstacle::goal, "no two footholds are within reach 0.9", -any, any},
};

}  // namespace

TEST_CASE("every canned impossible scene is proven impossible, where and why its first line says", "[infeasible]") {
  CHECK(maps("Impossible").size() == std::size(expected));
  for (const Expected& e : expected) {
    CAPTURE(e.scene);
    const auto proof = prove_infeasible(canned(e.scene));
    REQUIRE(proof);
    CAPTURE(proof->reason);
    CHECK(proof->obstacle == e.obstacle);
    CHECK(proof->reason.find(e.words) != std::string::npos);
    if (proof->x && e.x_to < any) {
      CHECK(proof->x->first >= e.x_from - 1e-9);
      CHECK(proof->x->second <= e.x_to + 1e-9);
    }
  }
}

TEST_CASE("no canned scene that has a stored plan is called impossible", "[infeasible]") {
  for (const std::string& name : maps("Exercises")) {
    CAPTURE(name);
    CHECK_FALSE(prove_infeasible(canned(name)));
  }
}

TEST_CASE("the proof gives the same answer twice and stops at its limits", "[infeasible]") {
  const gaits::Scene scene = canned("gap_too_wide");
  const auto first = prove_infeasible(scene), second = prove_infeasible(scene);
  REQUIRE((first && second));
  CHECK(first->reason == second->reason);
  CHECK(first->work == second->work);
  planner::ProofLimits little;
  little.work = 100;
  CHECK_FALSE(prove_infeasible(scene, little));
  planner::ProofLimits late;
  late.deadline = std::chrono::steady_clock::now();
  CHECK_FALSE(prove_infeasible(scene, late));
}

TEST_CASE("a start that no COM balances is proven, one that some COM does is not", "[infeasible]") {
  const auto scene = [](double mu) {
    return gaits::parse_scene("surefoot: 1\nterrain:\n  friction: " + std::to_string(mu) +
                                  "\n  chains:\n    - vertices: [[-2, 0], [6, 0]]\n"
                                  "robot: {radius_of_gyration: 0.2, reach: [0.2, 0.9]}\n"
                                  "disturbance: {kappa: 0.3, nu: 0.02}\n"
                                  "start: {feet: [{x: -0.3}, {x: 0.3}, {x: 0}], support: [1, 2]}\n"
                                  "goal: {com_x: [3, 4]}\n",
                              "start");
  };
  const auto proof = prove_infeasible(scene(0.29));  // level ground bears |p| <= mu
  REQUIRE(proof);
  CHECK(proof->obstacle == Obstacle::start);
  CHECK(proof->reason ==
        "at the start, between x = -0.3 and 0.3: no COM within reach 0.9 of two start feet balances every disturbance "
        "(kappa 0.3, nu 0.02 m) at friction 0.29");
  CHECK_FALSE(prove_infeasible(scene(0.31)));
}

TEST_CASE("a gap is passable or proven impassable on either side of twice the reach, shifted far out too",
          "[infeasible]") {
  for (const double shift : {0.0, 1e5, -1e6}) {
    const auto scene = [&](double width) {
      const auto at = [&](double x) { return fmt::format("{:.17g}", x + shift); };
      return gaits::parse_scene(
          "surefoot: 1\nterrain:\n  friction: 0.6\n  chains:\n    - vertices: [[" + at(-1.2) + ", 0], [" + at(1) +
              ", 0]]\n    - vertices: [[" + at(1 + width) + ", 0], [" + at(3 + width) + ", 0]]\n" +
              "robot: {radius_of_gyration: 0.2, reach: [0.2, 0.9]}\ndisturbance: {kappa: 0.05, nu: 0.02}\n" +
              "start: {feet: [{x: " + at(-0.4) + "}, {x: " + at(0.2) + "}, null]}\ngoal: {com_x: [" + at(2 + width) +
              ", " + at(2.5 + width) + "]}\n",
          "gap");
    };
    CAPTURE(shift);
    CHECK(prove_infeasible(scene(1.81)));
    CHECK_FALSE(prove_infeasible(scene(0.6)));
  }
}

TEST_CASE("a window between start and goal is proven impassable where the barrier is, at the same cost on long terrain",
          "[infeasible]") {
  const auto scene = [](double length) {  // level ground with a gap of 2 m in its middle
    const auto at = [](double x) { return fmt::format("{:.17g}", x); };
    return gaits::parse_scene("surefoot: 1\nterrain:\n  friction: 0.6\n  chains:\n    - vertices: [[-2, 0], [" +
                                  at(length / 2 - 1) + ", 0]]\n    - vertices: [[" + at(length / 2 + 1) + ", 0], [" +
                                  at(length + 2) + ", 0]]\n" +
                                  "robot: {radius_of_gyration: 0.2, reach: [0.2, 0.9], clearance: 0.1}\n"
                                  "disturbance: {kappa: 0.05, nu: 0.02}\n"
                                  "start: {feet: [{x: -0.4}, {x: 0.2}, null]}\ngoal: {com_x: [" +
                                  at(length) + ", " + at(length + 0.5) + "]}\n",
                              "long");
  };
  planner::ProofLimits limits;
  std::uint64_t work = 0;
  for (const double length : {40.0, 10000.0}) {
    CAPTURE(length);
    limits.window = planner::ProofWindow{length / 2 - 3, length / 2 + 3};
    const auto proof = prove_infeasible(scene(length), limits);
    REQUIRE(proof);
    CHECK(proof->obstacle == Obstacle::barrier);
    CHECK(proof->x->first == Approx(length / 2 - 1));
    CHECK(proof->x->second == Approx(length / 2 + 1));
    if (work > 0) CHECK(2 * proof->work < 3 * work);
    work = proof->work;
    limits.window = planner::ProofWindow{length / 2 + 3, length / 2 + 7};
    CHECK_FALSE(prove_infeasible(scene(length), limits));
  }
  limits.window = planner::ProofWindow{-5, -3};  // the start is not on one side of it
  CHECK_FALSE(prove_infeasible(scene(40), limits));
}

TEST_CASE("no sampled scene with a plan is called impossible, nor a harder one that the plan still solves",
          "[infeasible][property]") {
  planner::ProofLimits limits;
  limits.work = 40000;
  planner::SearchOptions options;
  options.effort = 0;
  options.prove = false;
  int hard = 0;
  for (int kind = 0; kind < testing::scene_kinds; ++kind)
    for (std::uint32_t seed = 5000; seed < 5000 + static_cast<std::uint32_t>(test::rounds(2)); ++seed) {
      const std::string text = sample_scene(static_cast<SceneKind>(kind), seed);
      CAPTURE(to_string(static_cast<SceneKind>(kind)), seed);
      try {
        const gaits::Scene scene = gaits::parse_scene(text, "sample");
        const gaits::Plan plan = planner::search(scene, options);
        if (plan.status != gaits::Status::solved || !verify(scene, plan).holds()) continue;
        for (const auto& known : testing::hard_scenes(text, plan)) {
          CAPTURE(known.what);
          ++hard;
          limits.window.reset();
          CHECK_FALSE(prove_infeasible(known.scene, limits));
          const auto [from, to] = testing::crossing(known.scene);
          if (from == to) continue;
          limits.window = planner::ProofWindow{from, to};
          CHECK_FALSE(prove_infeasible(known.scene, limits));
        }
      } catch (const terrain::InputError&) {  // the loader refuses it, or its start is bad input
      }
    }
  CHECK(hard > test::enough(40));
}

TEST_CASE("Where the start reaches every foothold of the goal's side, it is the goal that is called impossible",
          "[infeasible]") {
  const auto proven = [](const std::string& goal) {
    const gaits::Scene scene = gaits::parse_scene(
        "surefoot: 1\nterrain: {friction: 0.6, chains: [{vertices: [[-1, 0], [5, 0]]}]}\n"
        "robot: {radius_of_gyration: 0.18, reach: [0.25, 0.9], clearance: 0.1}\n"
        "disturbance: {kappa: 0.1, nu: 0.03}\n"
        "start: {feet: [{x: -0.5}, {x: 0.1}, {x: -0.2}]}\ngoal: {" +
            goal + "}\n",
        "level");
    return prove_infeasible(scene);
  };
  // The ground is walked from end to end: nothing on it is in the way.
  for (const std::string low : {"com_x: [3, 3.4], com_y: [-0.5, 0.09]", "com_x: [3, 3.4], com_y: [-0.5, -0.2]",
                                "com_x: [0, 0.2], com_y: [-0.5, -0.2]"}) {
    const auto reason = proven(low);
    INFO(low);
    REQUIRE(reason);
    INFO(reason->reason);
    CHECK(reason->reason.starts_with("in the goal, between x = "));
    CHECK(reason->reason.find("across") == std::string::npos);
    CHECK(reason->reason.find("clearance 0.1") != std::string::npos);
    CHECK(reason->reason.find("at friction 0.6") != std::string::npos);
  }
  CHECK_FALSE(proven("com_x: [4.5, 4.7]"));
}

// ---- bounds -----------------------------------------------------------------------------------------------------

namespace {

class Dice {
 public:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

 private:
  std::mt19937 engine_{12345};
};

/// A scene of separate segments of any direction.
gaits::Scene two_segments(Dice& dice, double mu_first, double mu_second) {
  std::vector<terrain::Chain> chains;
  for (const double mu : {mu_first, mu_second}) {
    const Vector2d a(dice.in(-0.4, 0.4), dice.in(-0.4, 0.4) + (chains.empty() ? 0.0 : 1.7));
    const double angle = dice.in(0, 2 * std::numbers::pi);
    chains.push_back({{a, a + 0.4 * Vector2d(std::cos(angle), std::sin(angle))}, {{mu, true}}});
  }
  const stability::DisturbanceBox box{dice.in(0, 0.4), dice.in(0, 0.2)};
  return {"", "", terrain::Terrain(std::move(chains)), {0.2, 0, 2, 0, {}}, box, gaits::Criterion::equilibrium, {}, {},
          {}, {}};
}

/// How deep [m] a point lies inside a polygon; negative outside.
double depth(const Convex& coms, const Vector2d& point) {
  const auto corners = coms.corners();
  double least = coms.empty() ? -1 : 10;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d& a = corners[k];
    const Vector2d along = corners[k + 1 < corners.size() ? k + 1 : 0] - a;
    if (along.norm() < 1e-9) continue;
    least = std::min(least, (along.x() * (point - a).y() - along.y() * (point - a).x()) / along.norm());
  }
  return least;
}

}  // namespace

TEST_CASE("the balance bound of two pieces contains every COM that the oracle balances on feet of the pieces",
          "[infeasible]") {
  Dice dice;
  int balanced = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double mu = dice.below(4) == 0 ? 0 : dice.in(0, 2);
    const gaits::Scene scene = two_segments(dice, mu, dice.below(4) == 0 ? mu : dice.in(0, 2));
    const Bounds bounds(scene, {});
    std::array<Piece, 2> pieces;
    for (int k = 0; k < 2; ++k) {
      const auto& segment = scene.terrain.segment(dice.below(5) == 0 ? 0 : k, 0);
      const double from = dice.in(0, segment.length), to = dice.below(3) == 0 ? from : dice.in(0, segment.length);
      pieces[static_cast<std::size_t>(k)] = piece_of(segment, std::min(from, to), std::max(from, to));
    }
    Convex coms = bounds.reachable(pieces[0], pieces[1]);
    bounds.clip_to_balance(coms, pieces[0], pieces[1]);
    for (int foot = 0; foot < 6; ++foot) {
      std::array<stability::Contact, 2> contacts;
      for (std::size_t k = 0; k < 2; ++k) {
        const auto& segment = *pieces[k].segment;
        const double s = dice.in(pieces[k].begin, std::nextafter(pieces[k].end, 9));
        contacts[k] = {segment.a + s * segment.tangent, segment.normal, segment.surface.friction};
      }
      const stability::RobustOracle oracle(contacts, 0.2, scene.disturbance);
      for (int k = 0; k < 20; ++k) {
        const Vector2d com(dice.in(-1.5, 1.5), dice.in(-1, 2));
        const bool in_reach = (com - contacts[0].position).norm() < 2 && (com - contacts[1].position).norm() < 2;
        if (!in_reach || !oracle.equilibrium(com)) continue;
        ++balanced;
        CAPTURE(trial, com.x(), com.y());
        REQUIRE(depth(coms, com) >= -1e-9);
      }
    }
  }
  CHECK(balanced > 5000);
}

TEST_CASE("for feet at points the balance bound is R_SS(W) itself", "[infeasible]") {
  Dice dice;
  int outside = 0, inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const gaits::Scene scene = two_segments(dice, dice.in(0.05, 1), dice.in(0.05, 1));
    const Bounds bounds(scene, {});
    std::array<Piece, 2> pieces;
    std::array<stability::Contact, 2> contacts;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& segment = scene.terrain.segment(static_cast<int>(k), 0);
      pieces[k] = piece_of(segment, 0.2, 0.2);
      contacts[k] = {pieces[k].a, segment.normal, segment.surface.friction};
    }
    Convex coms = bounds.reachable(pieces[0], pieces[1]);
    bounds.clip_to_balance(coms, pieces[0], pieces[1]);
    // Drawn in by more than the bound's margins: what is inside then must balance.
    const stability::RobustOracle oracle(contacts, 0.2, scene.disturbance);
    if (coms.empty()) {
      for (int k = 0; k < 50; ++k) {
        const Vector2d com(dice.in(-1.5, 1.5), dice.in(-1, 2));
        if ((com - contacts[0].position).norm() > 2 || (com - contacts[1].position).norm() > 2) continue;
        REQUIRE_FALSE(oracle.equilibrium(com));
      }
      ++outside;
      continue;
    }
    const Vector2d centre = coms.centre();
    for (const Vector2d& corner : coms.corners()) {
      const Vector2d com = centre + 0.999 * (corner - centre);
      if (depth(coms, com) < 1e-4) continue;
      ++inside;
      CAPTURE(trial, com.x(), com.y());
      REQUIRE(oracle.equilibrium(com));
    }
  }
  CHECK(outside > 300);
  CHECK(inside > 3000);
}

TEST_CASE("no placement that the rules allow is excluded by the bounds of pieces around it", "[infeasible]") {
  Dice dice;
  int allowed = 0;
  for (const char* name : {"stairs_up", "gap", "vee", "chimney", "rubble", "ceiling_too_low", "wall_too_high"}) {
    const gaits::Scene scene = canned(name);
    const Bounds bounds(scene, {});
    auto field = bounds.field();
    std::vector<const terrain::Segment*> all;
    for (const auto& segment : scene.terrain.segments()) all.push_back(&segment);
    for (int trial = 0; trial < 20000; ++trial) {
      // A COM and three feet near it.
      const auto box = scene.terrain.bounds();
      const Vector2d com(dice.in(box.min().x(), box.max().x()), dice.in(box.min().y() - 0.5, box.max().y() + 0.9));
      const auto stretches = scene.terrain.stretches_within(com, scene.robot.reach_min, scene.robot.reach_max);
      if (stretches.empty()) continue;
      gaits::Stance stance;
      std::array<Foot, 3> feet;
      std::array<std::optional<terrain::Foothold>, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& stretch = stretches[static_cast<std::size_t>(dice.below(static_cast<int>(stretches.size())))];
        at[k] = scene.terrain.foothold_at(stretch.segment->chain, dice.in(stretch.s_begin, stretch.s_end));
        if (!at[k]) break;
        const double s = at[k]->s - stretch.segment->s_begin;
        const double from = std::max(0.0, s - dice.in(0, 0.1));
        const double to = std::min(stretch.segment->length, s + dice.in(0, 0.1));
        feet[k] = {piece_of(*stretch.segment, from, to), all};
      }
      if (!at[0] || !at[1] || !at[2]) continue;
      stance.feet = {at[0], at[1], std::nullopt};
      stance.com = com;
      if (gaits::broken_stance_rule(scene, stance) || gaits::broken_placement_rule(scene, com, *at[2], {})) continue;
      ++allowed;
      Convex coms = bounds.reachable(feet[0].piece, feet[1].piece);
      const auto region = field.region_of(coms);
      bounds.clip_to_balance(coms, feet[0].piece, feet[1].piece);
      bounds.clip_to_reach(coms, feet[2].piece);
      bounds.clip_to_sight(coms, feet[2].piece);
      const std::array three{&feet[0], &feet[1], &feet[2]}, seen{&feet[2], &feet[0], &feet[1]};
      std::uint64_t work = 0;
      const unsigned parts = bounds.may_hold(coms, {three, {seen.data(), 1}}, region, 0.002, work);
      CAPTURE(name, trial, com.x(), com.y());
      REQUIRE((region.parts_in({com, com}, 0) & parts) != 0);
    }
  }
  CHECK(allowed > 1000);
}
