// A small scene as text, for tests that spoil it.
#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace surefoot::tests {

/// Five metres of flat ground. Its keys stand on the lines that tests name: friction on 3, feet on 9, goal on 11.
inline const std::string flat_scene = R"(surefoot: 1
terrain:
  friction: 0.6
  chains:
    - vertices: [[-1, 0], [4, 0]]
robot: {radius_of_gyration: 0.15, reach: [0.2, 0.9], clearance: 0.1}
disturbance: {kappa: 0.1, nu: 0.03}
start:
  feet: [{x: -0.3}, {x: 0.25}, {x: 0}]
  support: [1, 2]
goal: {com_x: [1.5, 2]}
)";

/// `text` with its first `piece` replaced.
inline std::string with(const std::string& piece, const std::string& other, std::string text = flat_scene) {
  const auto at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), other);
}

}  // namespace surefoot::tests
