// Postures for guard_cost.hpp, which must not see the types of stability/ itself.
#pragma once

#include <vector>

#include "bench/guard_cost.hpp"
#include "tests/support/sample_posture.hpp"

namespace surefoot::bench {

inline PlainPosture plain_posture(const testing::SamplePosture& s) {
  PlainPosture p{
      static_cast<int>(s.contacts.size()), {}, {}, {}, {}, {}, s.com.x(), s.com.y(), s.rho, s.box.kappa, s.box.nu};
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    p.x[i] = s.contacts[i].position.x(), p.y[i] = s.contacts[i].position.y();
    p.nx[i] = s.contacts[i].normal.x(), p.ny[i] = s.contacts[i].normal.y();
    p.mu[i] = s.contacts[i].friction;
  }
  return p;
}

/// Random normals, friction, COM: nothing coincides. (Coincidences are what exact arithmetic is for.)
inline std::vector<PlainPosture> random_plain_postures(int contacts, std::size_t count) {
  testing::Sampler sampler(31 + static_cast<std::uint64_t>(contacts));
  std::vector<PlainPosture> made;
  while (made.size() < count) {
    const auto kind = made.size() % 2 == 0 ? testing::Kind::gentle : testing::Kind::any;
    made.push_back(plain_posture(sampler.posture(kind, contacts)));
  }
  return made;
}

}  // namespace surefoot::bench
