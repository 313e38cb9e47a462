#include "planner/stance_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/console.hpp"
#include "planner/posture_input.hpp"

namespace surefoot::planner {
namespace {

using terrain::InputError;

std::vector<int> legs_of(const std::string& text) {
  const char* form = "two or three of the legs 1, 2, 3, as 1,2 or 1,2,3";
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (commas != 1 && commas != 2)
    throw InputError(fmt::format("--stance: found {}, expected {}", one_line(text), form));
  std::vector<int> legs;
  for (const double value : read_numbers("--stance", text, commas + 1, form)) {
    const int leg = value == 1 ? 0 : value == 2 ? 1 : value == 3 ? 2 : -1;
    if (leg < 0 || std::find(legs.begin(), legs.end(), leg) != legs.end())
      throw InputError(fmt::format("--stance: found {}, expected {}", one_line(text), form));
    legs.push_back(leg);
  }
  std::sort(legs.begin(), legs.end());
  return legs;
}

std::vector<int> first_legs(const gaits::Scene& scene) {
  if (scene.start.support) return {scene.start.support->first, scene.start.support->second};
  std::vector<int> planted;
  for (int leg = 0; leg < gaits::leg_count; ++leg)
    if (scene.start.feet[leg]) planted.push_back(leg);
  return planted;
}

}  // namespace

StanceInput read_stance(const gaits::Scene& scene, const std::optional<std::string>& stance) {
  StanceInput input;
  input.legs = stance ? legs_of(*stance) : first_legs(scene);
  for (const int leg : input.legs) {
    const auto& foot = scene.start.feet[leg];
    if (!foot) throw InputError(fmt::format("--stance: leg {} starts in the air ({})", leg + 1, scene.start.place));
    input.contacts.push_back(gaits::contact_at(*foot));
    input.names.push_back(std::to_string(leg + 1));
  }
  input.title = fmt::format("{}: start feet of legs {}", scene.name, fmt::join(input.names, ", "));
  return input;
}

}  // namespace surefoot::planner
