// The picture of a simulated motion: heights of the contacts and the angle over time, phases marked by colour.
#pragma once

#include <string>
#include <vector>

#include "stability/hybrid_dynamics.hpp"

namespace surefoot::gaits {

struct MotionFigure {
  std::string title, result;  ///< above the panels
  int contacts = 2;
  stability::BodyState start;
  std::vector<stability::HybridEvent> events;  ///< all that the run told, or the first of them
};

std::string to_svg(const MotionFigure& figure);

/// What an event is, in a few words: "contact 1 collides".
std::string words(const stability::HybridEvent& event);

}  // namespace surefoot::gaits
