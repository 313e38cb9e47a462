// Why a stance of two contacts is not frictionally stable, in words.
#pragma once

#include <string>

#include "stability/posture.hpp"

namespace surefoot::gaits {

/// What [OR-H, Theorem 3] asks for and is missing; "" where it holds. Errors: as stability::frictional_verdict.
std::string frictional_fault(const stability::Posture& posture, const Eigen::Vector2d& com, double restitution);

}  // namespace surefoot::gaits
