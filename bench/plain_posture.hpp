#pragma once

#include "bench/guard_cost.hpp"
#include "tests/support/sample_posture.hpp"

namespace surefoot::bench {

inline PlainPosture plain_posture(const testing::SamplePosture& s) {
  PlainPosture p{static_cast<int>(s.contacts.size()), {}, {}, {}, {}, {}, s.com.x(), s.com.y(), s.rho, s.box.kappa, s.box.nu};
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    p.x[i] = s.contacts[i].position.x(), p.y[i] = s.contacts[i].position.y();
    p.nx[i] = s.contacts[i].normal.x(), p.ny[i] = s.contacts[i].normal.y();
    p.mu[i] = s.contacts[i].friction;
  }
  return p;
}

}  // namespace surefoot::bench
