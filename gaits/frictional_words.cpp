#include "gaits/frictional_words.hpp"

#include <fmt/format.h>

#include "stability/frictional.hpp"

namespace surefoot::gaits {

std::string frictional_fault(const stability::Posture& posture, const Eigen::Vector2d& com, double restitution) {
  const auto verdict = stability::frictional_verdict(posture, com, restitution);
  if (verdict.stable()) return "";
  if (!verdict.upward) return "the ground does not face upward under both feet";
  if (!verdict.equilibrium) return "gravity alone cannot be balanced";
  if (verdict.failed_mode) return fmt::format("no kinematic-strong equilibrium, mode {}", verdict.failed_mode->name());
  const auto [psi_1, psi_2] = stability::psi(posture, com);
  return fmt::format("clattering with psi = {:.6g}, {:.6g} need not die out", psi_1, psi_2);
}

}  // namespace surefoot::gaits
