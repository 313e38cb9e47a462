// How many decisions each stage of the oracle has made on this thread: what the fast stages leave over, and how often
// exact arithmetic was needed. Counting costs an increment per decision.
#pragma once

#include <cstdint>

namespace surefoot::stability {

struct Decisions {
  // Geometry of a set of contacts: sides of rays, signs that do not depend on the COM.
  std::uint64_t signs = 0, signs_exactly = 0;
  // Equilibrium at a COM: facets.
  std::uint64_t facets = 0, facets_exactly = 0;
  // Non-static modes at a COM: by a shared certificate, by rows in doubles, exactly.
  std::uint64_t modes_by_screen = 0, modes_by_rows = 0, modes_exactly = 0;
  // Non-static modes on an interval of a line: proved by rows, by covectors; a feasible point met; modes left to
  // marching, to exact numbers.
  std::uint64_t intervals_by_rows = 0, intervals_by_covectors = 0, witnesses = 0, modes_marched = 0, lines_exactly = 0;
  // Frictional stability: postures asked, of which clattering or a mode needed exact numbers.
  std::uint64_t frictional = 0, frictional_exactly = 0;
};

inline constinit thread_local Decisions decisions{};

}  // namespace surefoot::stability
