// What tests of the verifier ask of its faults.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "gaits/verifier.hpp"

namespace surefoot::gaits::testing {

inline std::string all_faults(const Verification& verification) {
  std::string text;
  for (const Fault& fault : verification.faults) text += to_string(fault) + "\n";
  return text;
}

/// Every fault is of this rule, and there is one at this place that says this.
inline void require_only(const Verification& verification, Rule rule, const std::string& place,
                         const std::string& part) {
  INFO(all_faults(verification));
  REQUIRE_FALSE(verification.holds());
  bool found = false;
  for (const Fault& fault : verification.faults) {
    CHECK(fault.rule == rule);
    found = found || (fault.place == place && fault.message.find(part) != std::string::npos);
  }
  CHECK(found);
}

/// One such fault, whatever else is broken with it.
inline void require_fault(const Verification& verification, Rule rule, const std::string& place,
                          const std::string& part) {
  INFO(all_faults(verification));
  bool found = false;
  for (const Fault& fault : verification.faults) {
    found = found || (fault.rule == rule && fault.place == place && fault.message.find(part) != std::string::npos);
  }
  CHECK(found);
}

inline void require_holds(const Verification& verification) {
  INFO(all_faults(verification));
  CHECK(verification.holds());
}

}  // namespace surefoot::gaits::testing
