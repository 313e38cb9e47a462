#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gaits/plan_words.hpp"

namespace surefoot::gaits {
namespace {

struct Verb {
  const char *singular, *plural;
};

/// [OR-P, Table I]
const std::map<char, Verb>& verbs() {
  static const std::map<char, Verb> table{{'F', {"breaks away", "break away"}},
                                          {'R', {"rolls or sticks", "roll or stick"}},
                                          {'U', {"slides along +t", "slide along +t"}},
                                          {'W', {"slides along -t", "slide along -t"}}};
  return table;
}

/// "foot 1", "feet 1 and 3", "feet 1, 2 and 3".
std::string feet_in_words(const std::vector<int>& legs) {
  std::string text = legs.size() == 1 ? "foot " : "feet ";
  for (std::size_t i = 0; i < legs.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 == legs.size() ? " and " : ", ", legs[i] + 1);
  return text;
}

}  // namespace

std::string title_of(const Plan& plan, bool refused) {
  switch (plan.status) {
    case Status::solved:
      return fmt::format("{}: {} step{}, safety factor {}{}", plan.scene, plan.steps(), plan.steps() == 1 ? "" : "s",
                         factor_in_words(plan.safety_factor), refused ? " as stated" : "");
    case Status::no_plan_found: return plan.scene + ": no plan found";
    case Status::infeasible: return plan.scene + ": infeasible";
  }
  return plan.scene;
}

WeakestPlace weakest_place(const Plan& plan) {
  WeakestPlace least;
  for (int k = 0; k < static_cast<int>(plan.stances.size()); ++k) {
    const Stance& stance = plan.stances[k];
    if (least.index < 0 || stance.safety_factor < least.sigma) least = {stance.safety_factor, false, k, stance.limit};
    if (k < plan.steps() && plan.transfers[k].safety_factor < least.sigma)
      least = {plan.transfers[k].safety_factor, true, k, plan.transfers[k].limit};
  }
  return least;
}

std::string place_in_words(const WeakestPlace& place, int steps) {
  if (!place.in_transfer && place.index == steps) return "the last stance";
  return fmt::format("the {} of step {}", place.in_transfer ? "transfer" : "stance", place.index + 1);
}

std::string limit_in_words(const std::string& limit, const std::vector<int>& legs) {
  if (limit == "none") return "no multiple of kappa and nu is too much";
  if (limit == "equilibrium") return "the feet cannot balance a larger disturbance";
  if (limit.size() != legs.size()) return limit;
  std::vector<std::pair<char, std::vector<int>>> groups;  // legs by state, in order of appearance
  for (std::size_t i = 0; i < limit.size(); ++i) {
    if (!verbs().contains(limit[i])) return limit;
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == limit[i]; });
    if (group == groups.end()) group = groups.insert(groups.end(), {limit[i], {}});
    group->second.push_back(legs[i]);
  }
  if (groups.size() == 1 && legs.size() > 1)
    return fmt::format("{} feet {}", legs.size() == 2 ? "both" : "all", verbs().at(groups[0].first).plural);
  std::string text;
  for (const auto& [state, group] : groups) {
    const Verb& verb = verbs().at(state);
    text += fmt::format("{}{} {}", text.empty() ? "" : " while ", feet_in_words(group),
                        group.size() == 1 ? verb.singular : verb.plural);
  }
  return text;
}

std::string factor_in_words(double sigma) {
  constexpr double rounds_to_one = 0.9995, reads_as_one = 1.005;  // between them three digits would read 1.00
  if (std::isinf(sigma)) return "inf";
  if (sigma < 1 && sigma >= rounds_to_one) return "<1.00";
  if (sigma > 1 && sigma < reads_as_one) return ">1.00";
  if (sigma == 0) return "0";
  if (sigma < 1e-3 || sigma >= 1e5) return fmt::format("{:.2e}", sigma);
  const int before_point = static_cast<int>(std::floor(std::log10(sigma))) + 1;
  return fmt::format("{:.{}f}", sigma, std::max(0, 3 - before_point));
}

int decimals_for(double reach) {
  constexpr int millimetres = 3;
  return reach > 0 ? std::max(2 - static_cast<int>(std::floor(std::log10(reach))), millimetres) : millimetres;
}

bool is_told_in_decimals(double reach) {
  constexpr int most = 9;
  constexpr double giant = 1e6;  // [m]
  return decimals_for(reach) <= most && reach < giant;
}

std::string length_in_words(double length, double reach) {
  if (!is_told_in_decimals(reach)) return fmt::format("{:.6g}", length);
  const std::string text = fmt::format("{:.{}f}", length, decimals_for(reach));
  return text.find_first_not_of("-0.") == std::string::npos && text.starts_with("-") ? text.substr(1) : text;
}

std::vector<int> planted_legs(const Feet& feet) {
  std::vector<int> legs;
  for (int leg = 0; leg < leg_count; ++leg)
    if (feet[leg]) legs.push_back(leg);
  return legs;
}

}  // namespace surefoot::gaits
