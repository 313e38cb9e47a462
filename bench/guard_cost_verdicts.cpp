// Compiled twice: with the library, and with the copy without guards (bench/CMakeLists.txt).
#include "bench/guard_cost.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::bench {

#ifdef SUREFOOT_UNGUARDED
std::size_t count_robust_unguarded(const PlainPosture* postures, std::size_t count) {
#else
std::size_t count_robust(const PlainPosture* postures, std::size_t count) {
#endif
  std::size_t robust = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const PlainPosture& p = postures[k];
    std::array<stability::Contact, 3> contacts;
    for (int i = 0; i < p.contacts; ++i) contacts[i] = {{p.x[i], p.y[i]}, {p.nx[i], p.ny[i]}, p.mu[i]};
    robust += stability::robust({contacts.data(), static_cast<std::size_t>(p.contacts)}, p.rho, {p.kappa, p.nu},
                                {p.com_x, p.com_y});
  }
  return robust;
}

}  // namespace surefoot::bench
