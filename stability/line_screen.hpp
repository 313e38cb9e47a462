// Fast proofs that modes are infeasible for every wrench of W on an interval of a straight line of COMs:
//   1. one or two of the mode's rows with fixed multipliers are negative on all of W along the interval, by the
//      Bernstein coefficients of the rows, which are quadratic in lambda; for both signs of the denominator, if it does
//      not keep its sign; Along the one twist that a roll or two slides leave, the direction is such a row that is
//      cheap to have;
//   2. a covector interpolated between the ends (dual_certificate.hpp), also where the denominator vanishes.
// Rows and covectors are found once per station and serve all intervals it belongs to.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "stability/box_test.hpp"
#include "stability/dual_certificate.hpp"

namespace surefoot::stability {

/// Certificates that were needed so far on one line, by mode.
class LineCertificates {
 public:
  explicit LineCertificates(const LineFrame& line) : line_(line) {}
  const DualCertificate& of_mode(int k);
  const LineFrame& line() const { return line_; }

 private:
  const LineFrame& line_;
  std::array<std::optional<DualCertificate>, Posture::most_modes> made_;
};

/// Rows of a mode at one COM as emit_rows gives them, with the denominator (1 where there is none).
struct StationRows {
  RowList<double> list;
  double denominator;
};

/// A COM of the line with what was needed there so far, by mode.
class Station {
 public:
  Station(double lambda, const Frame<double>& frame) : lambda_(lambda), frame_(frame) {}
  double lambda() const { return lambda_; }
  const Frame<double>& frame() const { return frame_; }
  const StationRows& rows(const LineFrame& line, int k);
  const Covector& covector(LineCertificates& certificates, int k);
  /// A wrench for which the mode is feasible here, beyond the error bounds.
  bool has_witness(const LineFrame& line, int k);

 private:
  double lambda_;
  Frame<double> frame_;
  std::uint32_t has_rows_ = 0, has_covector_ = 0;
  std::array<StationRows, Posture::most_modes> rows_;
  std::array<Covector, Posture::most_modes> covector_;
};

/// The interval between two stations of one line, with the one in the middle.
class LineInterval {
 public:
  LineInterval(LineCertificates& certificates, Station& a, Station& middle, Station& b)
      : certificates_(certificates), line_(certificates.line()), a_(a), middle_(middle), b_(b) {}
  /// Whether mode k is shown to be infeasible for every wrench of W at every COM of the interval.
  bool excludes_by_rows(int k);
  bool excludes_by_covectors(int k);

 private:
  bool excludes_by_direction(const ModeSpec& spec) const;
  bool excludes_by_one_row(const StationRows& a, const StationRows& b, int k, double sign);
  bool excludes_by_two_rows(const StationRows& a, const StationRows& b, int k, double sign);
  bool denominator_keeps_sign(const StationRows& a, const StationRows& b, int k, double sign);

  LineCertificates& certificates_;
  const LineFrame& line_;
  Station &a_, &middle_, &b_;
};

}  // namespace surefoot::stability
