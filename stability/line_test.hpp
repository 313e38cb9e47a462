// Straight lines of COMs on fixed contacts [OR-P, section VII; theory section 6]: is a mode infeasible at every lambda
// in [0, 1]? Intervals of lambda are proved one after the other with dual certificates (dual_certificate.hpp), found at
// their ends.
#pragma once

#include <array>
#include <cstdint>

#include "stability/dual_certificate.hpp"
#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

enum class LineOutcome {
  excluded,   ///< proved infeasible on the whole line
  feasible,   ///< at `lambda`, for some wrench of W
  uncertain,  ///< proved up to `lambda`, beyond it neither: tangential
};

struct LineMode {
  LineOutcome outcome = LineOutcome::uncertain;
  double lambda = 0;
};

/// What a scan of the whole line with fast certificates found.
struct LineScan {
  std::uint32_t excluded = 0;                         // bit k: mode k is infeasible on the whole line
  std::array<double, Posture::most_modes> reached{};  // for the others: infeasible up to this lambda at least
  int feasible_mode = -1;                             // feasible at `feasible_at`, if not -1
  double feasible_at = 0;
};

class LineQuery {
 public:
  LineQuery(const Posture& posture, const Eigen::Vector2d& from, const Eigen::Vector2d& to, const DisturbanceBox& box);

  /// Shared and closed-form certificates (line_screen.hpp) for the box scaled by s; stops at a feasible mode if it
  /// seeks and meets one.
  LineScan scan(double s = 1, bool seeks_feasible = true) const;
  /// Decided for the doubles given: doubles with error bounds first, exact numbers where these cannot tell. The mode is
  /// known to be infeasible up to `from`.
  LineMode feasible(const ModeSpec& spec, double from = 0) const;
  /// Up to which lambda, from `lambda` on, the mode is proved infeasible for the box scaled by s. Doubles only.
  double excluded_up_to(const ModeSpec& spec, double s, double lambda) const;

 private:
  bool has_witness(const ModeSpec& spec, double lambda) const;
  bool has_witness_exactly(const ModeSpec& spec, double lambda) const;
  LineMode feasible_exactly(const ModeSpec& spec) const;

  const Posture& posture_;
  Eigen::Vector2d from_, to_;
  DisturbanceBox box_;
  double radius_ = 0;  // bounds |r_x| + |r_y| on the line, and the terms it is computed from
};

}  // namespace surefoot::stability
