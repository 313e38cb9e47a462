// Is a posture safe, how safe, what limits it, and is the straight way to another COM safe?
// Prints:
//   low: robust, 1.9165 times the disturbances, limited by equilibrium
//   high: not robust, these motions are possible: FF UF
//   the straight way there: FF is possible at COM (0.450, 0.850)
#include <cstdio>
#include <surefoot/stability/robust_oracle.hpp>
#include <vector>

using namespace surefoot::stability;

int main() {
  const std::vector<Contact> feet{{.position = {0, 0}, .normal = {0.574, 0.819}, .friction = 0.5},
                                  {.position = {1, 0.1}, .normal = {-0.174, 0.985}, .friction = 0.5}};
  const RobustOracle oracle(feet, 0.1, {.kappa = 0.17, .nu = 0.1});  // radius of gyration 0.1 m, disturbances
  const Eigen::Vector2d low(0.64, 0.38), high(0.45, 0.85);           // two places of the COM [m]

  const SafetyFactor factor = oracle.safety_factor(low);
  std::printf("low: %s, %.4f times the disturbances, limited by %s\n", oracle.robust(low) ? "robust" : "not robust",
              factor.value, factor.critical.name().c_str());

  std::printf("high: %s, these motions are possible:", oracle.robust(high) ? "robust" : "not robust");
  for (const ContactMode& mode : oracle.feasible_modes(high)) std::printf(" %s", mode.name().c_str());

  const LineVerdict way = oracle.line(low, high);
  const Eigen::Vector2d place = low + way.lambda * (high - low);
  std::printf("\nthe straight way there: ");
  if (way.stable()) std::printf("safe\n");
  else std::printf("%s is possible at COM (%.3f, %.3f)\n", way.cause.name().c_str(), place.x(), place.y());
}
