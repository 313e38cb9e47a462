#include "gaits/verifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gaits/verifier_checks.hpp"

namespace surefoot::gaits {
namespace {

using bare::Foot;
using bare::Point;
using bare::Posture;

std::string stance_name(std::size_t k) { return fmt::format("stance {}", k + 1); }
std::string transfer_name(std::size_t k, int leg) { return fmt::format("transfer {} (leg {})", k + 1, leg + 1); }
bool is_leg(int leg) { return leg >= 0 && leg < leg_count; }

bool same_foot(const std::optional<Foot>& a, const std::optional<Foot>& b) {
  if (!a || !b) return !a && !b;
  return a->segment == b->segment && a->s == b->s;
}

class Verifier {
 public:
  Verifier(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan), checks_(scene) {}

  Verification run() {
    Verification result;
    if (check_shape()) {
      rebuild_all();
      for (std::size_t k = 0; k < plan_.stances.size(); ++k, ++result.stances) {
        check_stance(k);
        result.stances_with_lost_feet += has_lost(k);
      }
      const std::size_t transfers = std::min(plan_.transfers.size(), plan_.stances.size() - 1);
      for (std::size_t k = 0; k < transfers; ++k, ++result.transfers) {
        check_transfer(k);
        result.transfers_with_lost_feet += has_lost(k) || !landing_[k] || swings_from_lost(k);
      }
      check_start();
      check_goal();
      check_least_factor();
    }
    result.least_factor = checks_.least_factor();
    result.faults = std::move(checks_.faults());
    // What breaks the plan comes before what it only states wrongly.
    std::stable_partition(result.faults.begin(), result.faults.end(), [](const Fault& fault) { return !fault.stated; });
    return result;
  }

 private:
  template <typename... Parts>
  void fault(const std::string& place, fmt::format_string<Parts...> format, Parts&&... parts) {
    checks_.note(Rule::gait, place, format, std::forward<Parts>(parts)...);
  }

  bool check_shape();
  void rebuild_all();
  void check_stance(std::size_t k);
  void check_transfer(std::size_t k);
  bool check_gait(std::size_t k, const std::string& place, const Posture& during);
  void check_legs(std::size_t k, const std::string& place, const Posture& during);
  void check_start();
  void check_start_foot(int leg);
  void check_goal();
  void check_least_factor();

  /// Whether stance k has a foot that could not be rebuilt.
  bool has_lost(std::size_t k) const;
  /// Whether the leg placed by transfer k was lifted from a foothold that could not be rebuilt.
  bool swings_from_lost(std::size_t k) const;
  std::optional<Foot> lifted_from(std::size_t k) const;
  const Point& com(std::size_t k) const { return plan_.stances[k].com; }
  bool can_ask(std::size_t k) const { return com(k).allFinite(); }

  const Scene& scene_;
  const Plan& plan_;
  bare::Checks checks_;
  std::vector<Posture> feet_;                 // by stance
  std::vector<std::optional<Foot>> landing_;  // by transfer
};

bool Verifier::check_shape() {
  if (plan_.status != Status::solved) {
    fault("plan", "status is {}; only a solved plan can hold", to_string(plan_.status));
  }
  if (plan_.stances.empty()) {
    fault("plan", "there are no stances; a plan has at least the first");
    return false;
  }
  if (plan_.stances.size() != plan_.transfers.size() + 1) {
    fault("plan", "{} stances and {} transfers; there must be one stance more than transfers", plan_.stances.size(),
          plan_.transfers.size());
  }
  for (std::size_t k = 0; k < plan_.stances.size(); ++k) {
    if (!can_ask(k)) fault(stance_name(k), "the COM is not a pair of finite numbers");
  }
  return true;
}

void Verifier::rebuild_all() {
  for (std::size_t k = 0; k < plan_.stances.size(); ++k) {
    Posture feet;
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      const auto& stated = plan_.stances[k].feet[leg];
      if (stated) feet[leg] = checks_.rebuild(stance_name(k), static_cast<int>(leg), *stated);
    }
    feet_.push_back(feet);
  }
  for (std::size_t k = 0; k < plan_.transfers.size(); ++k) {
    const Transfer& transfer = plan_.transfers[k];
    landing_.push_back(checks_.rebuild(transfer_name(k, transfer.leg), transfer.leg, transfer.foothold));
  }
  checks_.tell_lost_feet();
  checks_.tell_renumbered_feet();
}

bool Verifier::has_lost(std::size_t k) const {
  for (std::size_t leg = 0; leg < leg_count; ++leg)
    if (plan_.stances[k].feet[leg] && !feet_[k][leg]) return true;
  return false;
}

bool Verifier::swings_from_lost(std::size_t k) const {
  if (k == 0 || plan_.transfers[k - 1].lift != plan_.transfers[k].leg) return false;
  const auto leg = static_cast<std::size_t>(plan_.transfers[k].leg);
  if (plan_.transfers[k - 1].leg == plan_.transfers[k].leg) return !landing_[k - 1];
  return leg < leg_count && plan_.stances[k - 1].feet[leg] && !feet_[k - 1][leg];
}

void Verifier::check_stance(std::size_t k) {
  const std::string place = stance_name(k);
  const Stance& stance = plan_.stances[k];
  const auto planted = [](const auto& feet) {
    return std::count_if(feet.begin(), feet.end(), [](const auto& foot) { return foot.has_value(); });
  };
  if (planted(stance.feet) != 2)
    fault(place, "{} {} planted; a stance has exactly 2", planted(stance.feet),
          planted(stance.feet) == 1 ? "foot is" : "feet are");
  if (!can_ask(k)) return;
  checks_.check_reach(place, feet_[k], com(k), com(k));
  checks_.check_clearance(place, com(k), com(k));
  if (planted(feet_[k]) == 2) checks_.check_stance_stability(place, feet_[k], com(k), stance.safety_factor);
}

bool Verifier::check_gait(std::size_t k, const std::string& place, const Posture& during) {
  const Transfer& transfer = plan_.transfers[k];
  const std::size_t before = checks_.faults().size();
  if (plan_.stances[k].feet[static_cast<std::size_t>(transfer.leg)]) {
    fault(place, "leg {} is placed but stands already", transfer.leg + 1);
  }
  for (std::size_t leg = 0; leg < leg_count; ++leg) {
    const auto& next = feet_[k + 1][leg];
    const bool stands_next = plan_.stances[k + 1].feet[leg].has_value();
    if (static_cast<int>(leg) == transfer.lift) {
      if (stands_next) fault(place, "leg {} is lifted but stands in {}", leg + 1, stance_name(k + 1));
    } else if (!stands_next) {
      fault(place, "leg {} stands and is not lifted, but does not stand in {}", leg + 1, stance_name(k + 1));
    } else if (next && during[leg] && !same_foot(next, during[leg])) {
      fault(place, "foot {} stands at chain {}, s = {}, but in {} at chain {}, s = {}", leg + 1,
            during[leg]->segment->chain, during[leg]->s, stance_name(k + 1), next->segment->chain, next->s);
    }
  }
  return checks_.faults().size() == before;
}

/// Where the leg placed by transfer k stood before; nothing if it has been in the air from the start.
std::optional<Foot> Verifier::lifted_from(std::size_t k) const {
  const int leg = plan_.transfers[k].leg;
  const auto index = static_cast<std::size_t>(leg);
  if (k == 0) {
    const auto& start = scene_.start.feet[index];
    if (!start) return std::nullopt;
    return Foot{start->s, &scene_.terrain.segment(start->chain, start->segment), start->position};
  }
  const Transfer& before = plan_.transfers[k - 1];
  if (before.lift != leg) return std::nullopt;  // a fault of the gait, noted elsewhere
  return before.leg == leg ? landing_[k - 1] : feet_[k - 1][index];
}

void Verifier::check_transfer(std::size_t k) {
  const Transfer& transfer = plan_.transfers[k];
  const std::string place = transfer_name(k, transfer.leg);
  if (!is_leg(transfer.leg) || !is_leg(transfer.lift)) {
    fault(place, "legs are numbered 1 to {}: placed is {}, lifted is {}", leg_count, transfer.leg + 1,
          transfer.lift + 1);
    return;
  }
  Posture during = feet_[k];
  during[static_cast<std::size_t>(transfer.leg)] = landing_[k];
  const bool gait_holds = check_gait(k, place, during);
  if (!can_ask(k) || !can_ask(k + 1)) return;
  checks_.check_reach(place, during, com(k), com(k + 1));
  checks_.check_clearance(place, com(k), com(k + 1));
  check_legs(k, place, during);
  const bool three = std::all_of(during.begin(), during.end(), [](const auto& foot) { return foot.has_value(); });
  if (gait_holds && three) checks_.check_line_stability(place, during, com(k), com(k + 1), transfer.safety_factor);
}

void Verifier::check_legs(std::size_t k, const std::string& place, const Posture& during) {
  const Transfer& transfer = plan_.transfers[k];
  const auto& placed = during[static_cast<std::size_t>(transfer.leg)];
  const auto& lifted = during[static_cast<std::size_t>(transfer.lift)];
  if (placed) checks_.check_leg(place, "touch-down", transfer.leg, com(k), *placed);
  if (lifted) checks_.check_leg(place, "lift-off", transfer.lift, com(k + 1), *lifted);
  const std::optional<Foot> old_foot = lifted_from(k);
  if (placed && old_foot) checks_.check_swing(place, com(k), *old_foot, *placed);
}

void Verifier::check_start() {
  const auto& support = scene_.start.support;
  const std::string place = stance_name(0);
  for (int leg = 0; leg < leg_count; ++leg) {
    const bool stands = plan_.stances.front().feet[static_cast<std::size_t>(leg)].has_value();
    if (support && stands != (leg == support->first || leg == support->second)) {
      fault(place, "the first stance is carried by legs {} and {}, but leg {} {}", support->first + 1,
            support->second + 1, leg + 1, stands ? "stands" : "does not stand");
    }
    if (stands) check_start_foot(leg);
  }
  const auto& given = scene_.start.com;
  if (given && !((*given - com(0)).cwiseAbs().maxCoeff() <= checks_.slack())) {
    fault(place, "the COM is at ({}, {}), but starts at ({}, {})", com(0).x(), com(0).y(), given->x(), given->y());
  }
}

void Verifier::check_start_foot(int leg) {
  const std::string place = stance_name(0);
  const auto& foot = feet_[0][static_cast<std::size_t>(leg)];
  const auto& start = scene_.start.feet[static_cast<std::size_t>(leg)];
  if (!start) {
    fault(place, "leg {} stands, but it starts in the air", leg + 1);
  } else if (foot && !(foot->segment->chain == start->chain && std::abs(foot->s - start->s) <= checks_.slack())) {
    fault(place, "foot {} stands at chain {}, s = {}, but starts at chain {}, s = {}", leg + 1, foot->segment->chain,
          foot->s, start->chain, start->s);
  }
  if (foot && can_ask(0)) checks_.check_leg(place, "the start", leg, com(0), *foot);
}

void Verifier::check_goal() {
  const Point& last = com(plan_.stances.size() - 1);
  const auto check = [&](const auto& interval, const char* axis, double value) {
    if (!interval || (value >= interval->first && value <= interval->second)) return;
    fault(stance_name(plan_.stances.size() - 1), "the last COM has {} = {:.6g}, the goal is [{}, {}]", axis, value,
          interval->first, interval->second);
  };
  check(scene_.goal.com_x, "x", last.x());
  check(scene_.goal.com_y, "y", last.y());
}

void Verifier::check_least_factor() {
  // Where a fault has kept some factors from being computed, the least of all is not known.
  if (!checks_.faults().empty() || bare::same_factor(plan_.safety_factor, checks_.least_factor())) return;
  checks_.note_stated(Rule::gait, "plan", "the stated safety factor is {}, but the least of all is {}",
                      plan_.safety_factor, checks_.least_factor());
}

}  // namespace

std::string to_string(const Fault& fault) {
  return fmt::format("{}: {}: {}", fault.place, to_string(fault.rule), fault.message);
}

Verification verify(const Scene& scene, const Plan& plan) { return Verifier(scene, plan).run(); }

}  // namespace surefoot::gaits
