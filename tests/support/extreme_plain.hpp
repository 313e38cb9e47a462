// Theory sections 3 to 5 written down in doubles as they stand, without error bounds: what docs/extremes.md compares
// with. For comparison only. Whether rays lie in a plane, normals are parallel or rows vanish is asked to 1e-12 of the
// terms, since without such a tolerance level ground already fails; all else is asked as the formulas ask it.
#pragma once

#include <string>
#include <vector>

#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

struct PlainVerdict {
  bool equilibrium = false, robust = false;
  std::vector<std::string> modes;
  bool not_a_number = false;  ///< some row was not finite
};
/// In float, double or long double.
template <class S>
PlainVerdict plain_verdict_in(const SamplePosture& sample);
inline PlainVerdict plain_verdict(const SamplePosture& sample) { return plain_verdict_in<double>(sample); }

}  // namespace surefoot::testing
