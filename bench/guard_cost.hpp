// The robust verdict on many postures as one function, so that two builds of stability/ can stand in one program.
#pragma once

#include <cstddef>

namespace surefoot::bench {

/// Plain numbers of a posture with two or three contacts.
struct PlainPosture {
  int contacts;
  double x[3], y[3], nx[3], ny[3], mu[3];
  double com_x, com_y, rho, kappa, nu;
};

/// How many of them are robustly stable: by surefoot, and by the same code without error bounds and exact arithmetic.
std::size_t count_robust(const PlainPosture* postures, std::size_t count);
std::size_t count_robust_unguarded(const PlainPosture* postures, std::size_t count);

}  // namespace surefoot::bench
