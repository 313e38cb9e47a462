#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "gaits/plan_io.hpp"

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

WeakestPlace weakest_place(const Plan& plan) {
  WeakestPlace least;
  for (int k = 0; k < static_cast<int>(plan.stances.size()); ++k) {
    const Stance& stance = plan.stances[k];
    if (least.index < 0 || stance.safety_factor < least.sigma)
      least = {stance.safety_factor, false, k, stance.limit};
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
  if (limit == "none") return "no disturbance, however large, moves the robot";
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

}  // namespace surefoot::gaits
