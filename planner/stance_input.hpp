// The first stance of a scene, or the legs asked for by --stance, as contacts: what commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gaits/scene.hpp"
#include "stability/contact.hpp"

namespace surefoot::planner {

struct StanceInput {
  std::vector<int> legs;  ///< from 0, ascending
  std::vector<stability::Contact> contacts;
  std::vector<std::string> names;  ///< of the legs, from 1
  std::string title;
};

/// `stance` is LEG,LEG or LEG,LEG,LEG from 1; without it the legs that carry the first stance, as far as the scene
/// says. Throws InputError where it is neither, or a leg starts in the air.
StanceInput read_stance(const gaits::Scene& scene, const std::optional<std::string>& stance);

}  // namespace surefoot::planner
