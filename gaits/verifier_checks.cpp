#include "gaits/verifier_checks.hpp"

#include <algorithm>
#include <cmath>

#include "gaits/frictional_words.hpp"

namespace surefoot::gaits::bare {

using stability::RobustOracle;
using terrain::Segment;

namespace {

// Points of a line, ends included, at which the verdict of the straight-line test is looked at again.
constexpr int line_samples = 17;

}  // namespace

std::string show(const Point& p) { return fmt::format("({:.6g}, {:.6g})", p.x(), p.y()); }

bool same_factor(double stated, double found) {
  if (std::isinf(stated) || std::isinf(found)) return stated == found;
  return std::abs(stated - found) <= safety_factor_tolerance * std::max(std::abs(stated), std::abs(found));
}

void Checks::check_reach(const std::string& place, const Posture& feet, const Point& from, const Point& to) {
  const auto at = [&](double lambda) {
    return from == to ? std::string() : fmt::format(" at lambda = {:.6g}", lambda);
  };
  for (std::size_t leg = 0; leg < leg_count; ++leg) {
    if (!feet[leg]) continue;
    const Distances found = distances_along(feet[leg]->position, from, to);
    if (!(found.greatest <= scene_.robot.reach_max + slack_)) {
      note(Rule::reach, place, "foot {} is {:.9g} m from the COM{}; at most {} is allowed", leg + 1, found.greatest,
           at(found.lambda_greatest), scene_.robot.reach_max);
    }
    if (!(found.least >= scene_.robot.reach_min - slack_)) {
      note(Rule::reach, place, "foot {} is {:.9g} m from the COM{}; at least {} is required", leg + 1, found.least,
           at(found.lambda_least), scene_.robot.reach_min);
    }
  }
}

void Checks::check_clearance(const std::string& place, const Point& from, const Point& to) {
  double least = std::numeric_limits<double>::infinity();
  const Segment* nearest = nullptr;
  for (const Segment* segment : strips_.near({from, to}, scene_.robot.clearance)) {
    const double here = distance(from, to, segment->a, segment->b);
    if (here < least) {
      least = here;
      nearest = segment;
    }
  }
  if (nearest && meet(from, to, nearest->a, nearest->b)) {
    note(Rule::clearance, place, "the COM meets the terrain (chain {}, segment {})", nearest->chain, nearest->index);
  } else if (nearest && !(least >= scene_.robot.clearance - slack_)) {
    note(Rule::clearance, place, "the COM comes within {:.9g} m of the terrain (chain {}, segment {}); {} is required",
         least, nearest->chain, nearest->index, scene_.robot.clearance);
  }
}

void Checks::check_leg(const std::string& place, const char* when, int leg, const Point& com, const Foot& foot) {
  if (!(orientation(foot.segment->a, foot.segment->b, com) > 0)) {
    note(Rule::leg_visibility, place, "at {} leg {} comes through the ground it stands on (chain {}, segment {})", when,
         leg + 1, foot.segment->chain, foot.segment->index);
  }
  for (const Segment* segment : strips_.near({com, foot.position}, 0)) {
    if (segment == foot.segment || !meet(com, foot.position, segment->a, segment->b)) continue;
    note(Rule::leg_visibility, place, "at {} leg {} from {} to {} meets chain {}, segment {}", when, leg + 1, show(com),
         show(foot.position), segment->chain, segment->index);
    return;
  }
}

void Checks::check_swing(const std::string& place, const Point& com, const Foot& old_foot, const Foot& new_foot) {
  const double radius = scene_.robot.reach_min - slack_;
  if (radius <= 0) return;
  const Point from = old_foot.position - com, to = new_foot.position - com;
  const Segment *hit_left = nullptr, *hit_right = nullptr;
  for (const Segment* segment : strips_.near({com}, radius)) {
    if (!hit_left && meets_sector(com, radius, from, to, segment->a, segment->b)) hit_left = segment;
    if (!hit_right && meets_sector(com, radius, to, from, segment->a, segment->b)) hit_right = segment;
  }
  if (hit_left && hit_right) {
    note(Rule::swing, place,
         "the free leg, {} m long, cannot swing from {} to {} about {}: chain {}, segment {} and chain {}, segment {} "
         "are in the way",
         scene_.robot.reach_min, show(old_foot.position), show(new_foot.position), show(com), hit_left->chain,
         hit_left->index, hit_right->chain, hit_right->index);
  }
}

RobustOracle Checks::oracle_of_feet(const Posture& feet, double scale) const {
  std::vector<stability::Contact> contacts;
  for (const auto& foot : feet) {
    if (foot) contacts.push_back({foot->position, foot->segment->normal, foot->segment->surface.friction});
  }
  stability::DisturbanceBox box = scene_.disturbance;
  box.kappa *= scale, box.nu *= scale;
  return RobustOracle(contacts, scene_.robot.radius_of_gyration, box);
}

bool Checks::stable(const RobustOracle& oracle, const Point& com) const {
  return robust() ? oracle.robust(com) : oracle.equilibrium(com);
}

double Checks::factor(const RobustOracle& oracle, const Point& com) const {
  return (robust() ? oracle.safety_factor(com) : oracle.equilibrium_factor(com)).value;
}

void Checks::check_stance_stability(const std::string& place, const Posture& feet, const Point& com, double stated) {
  const RobustOracle oracle = oracle_of_feet(feet, 1);
  const double sigma = factor(oracle, com);
  const bool unstable = scene_.criterion != Criterion::frictional && !stable(oracle, com);
  if (unstable) {
    note(Rule::stance_stability, place, "not stable with the COM at {} (safety factor {:.6g})", show(com), sigma);
  }
  if (asks_frictional(scene_.criterion)) check_frictional(place, oracle, com);
  check_factor(Rule::stance_stability, place, stated, sigma, unstable);
}

void Checks::check_frictional(const std::string& place, const RobustOracle& oracle, const Point& com) {
  const std::string why = frictional_fault(oracle.posture(), com, scene_.restitution.value());
  if (why.empty()) return;
  note(Rule::stance_stability, place, "not frictionally stable with the COM at {}: {}", show(com), why);
}

void Checks::check_line_stability(const std::string& place, const Posture& feet, const Point& from, const Point& to,
                                  double stated) {
  using Outcome = stability::LineVerdict::Outcome;
  const RobustOracle oracle = oracle_of_feet(feet, 1);
  bool certified = false;
  double sigma = 0;
  if (robust()) {
    const stability::LineVerdict verdict = oracle.line(from, to);
    certified = verdict.stable();
    if (!certified) {
      note(Rule::transfer_stability, place, "{} at lambda = {:.6g} ({})",
           verdict.outcome == Outcome::unstable ? "not stable" : "not certified", verdict.lambda, verdict.cause.name());
    }
    sigma = oracle.line_safety_factor(from, to).least.value;
  } else {
    certified = oracle.line_equilibrium(from, to);
    if (!certified) {
      note(Rule::transfer_stability, place, "somewhere on the line the feet cannot balance every wrench of the box");
    }
    sigma = oracle.line_equilibrium_factor(from, to).least.value;
  }
  sample_line(place, feet, from, to, sigma, certified);
  check_factor(Rule::transfer_stability, place, stated, sigma, !certified);
}

// A second look at what the straight-line test says, by the verdicts at points: for the box, and for the box as large
// as the least factor says it may grow (what holds for a box holds for every smaller one).
void Checks::sample_line(const std::string& place, const Posture& feet, const Point& from, const Point& to,
                         double least_factor, bool certified) {
  const RobustOracle oracle = oracle_of_feet(feet, 1);
  const double scale = least_factor * (1 - safety_factor_tolerance);
  const double greatest = std::max(scene_.disturbance.kappa, scene_.disturbance.nu);
  const bool scaled = scale > 0 && greatest > 0 && std::isfinite(scale * greatest);
  const RobustOracle at_least = scaled ? oracle_of_feet(feet, scale) : oracle;
  for (int i = 0; i < line_samples; ++i) {
    const double lambda = static_cast<double>(i) / (line_samples - 1);
    const Point at = from + lambda * (to - from);
    const bool reaches = scaled && stable(at_least, at);
    if (reaches && scale >= 1) continue;
    if (certified && !stable(oracle, at)) {
      note(Rule::transfer_stability, place, "not stable at lambda = {:.6g}, though the straight-line test accepts",
           lambda);
      return;
    }
    if (reaches) continue;
    const double here = scale > 0 ? factor(oracle, at) : least_factor;
    if (here < least_factor && !same_factor(here, least_factor)) {
      note(Rule::transfer_stability, place,
           "the safety factor at lambda = {:.6g} is {}, below the least on the line, {}", lambda, here, least_factor);
      return;
    }
  }
}

void Checks::check_factor(Rule rule, const std::string& place, double stated, double found, bool unstable) {
  least_factor_ = std::min(least_factor_, found);
  if (!unstable && !same_factor(stated, found)) {
    note_stated(rule, place, "the stated safety factor is {}, but it is {}", stated, found);
  }
}

}  // namespace surefoot::gaits::bare
