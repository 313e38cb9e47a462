#include "stability/line_screen.hpp"

#include <cmath>

#include "stability/decisions.hpp"

namespace surefoot::stability {
namespace {

/// Collects rows with their errors and the denominator, as they are.
class StationSink {
 public:
  StationSink(const Guard& guard, StationRows& into) : guard_(guard), into_(into) {
    into_.list.count = 0;
    into_.denominator = 1;
  }
  void denominator(double d) { into_.denominator = d; }
  bool add(const Row<double>& row) { return push(row, guard_.area); }
  bool add_length(const Row<double>& row) { return push(row, guard_.length); }

 private:
  bool push(const Row<double>& row, double error) {
    into_.list.error[into_.list.count] = error;
    into_.list.row[into_.list.count++] = row;
    return false;
  }
  const Guard& guard_;
  StationRows& into_;
};

RowList<double> signed_rows(const RowList<double>& rows, double sign) {
  RowList<double> result = rows;
  if (sign < 0)
    for (int k = 0; k < rows.count; ++k) result.row[k] = -rows.row[k];
  return result;
}

bool has_denominator(const ModeSpec& spec) {
  return spec.kind == ModeSpec::Kind::slide || spec.kind == ModeSpec::Kind::two_slides;
}

/// The middle Bernstein coefficient of a quadratic from its values.
double middle_coefficient(double a, double middle, double b) { return 2 * middle - 0.5 * (a + b); }
constexpr double middle_error_factor = 3;

}  // namespace

const DualCertificate& LineCertificates::of_mode(int k) {
  std::optional<DualCertificate>& made = made_[k];
  if (!made) made.emplace(line_, line_.posture.modes()[k]);
  return *made;
}

const StationRows& Station::rows(const LineFrame& line, int k) {
  if (!(has_rows_ >> k & 1)) {
    has_rows_ |= 1u << k;
    StationSink sink(line.guard, rows_[k]);
    emit_rows(frame_, line.posture.modes()[k], sink);
  }
  return rows_[k];
}

const Covector& Station::covector(LineCertificates& certificates, int k) {
  if (!(has_covector_ >> k & 1)) {
    has_covector_ |= 1u << k;
    covector_[k] = certificates.of_mode(k).propose(frame_);
  }
  return covector_[k];
}

bool Station::has_witness(const LineFrame& line, int k) {
  const StationRows& here = rows(line, k);
  if (has_denominator(line.posture.modes()[k]) && !(std::abs(here.denominator) > line.guard.denominator)) return false;
  return has_plain_witness(signed_rows(here.list, here.denominator), line.box);
}

/// xi is a multiple of one twist; the sign of the multiple is that of -R . v for a roll about x_i (whatever the force,
/// which acts there), of -z . v / D for two slides. R and z are linear along the line, D is quadratic.
bool LineInterval::excludes_by_direction(const ModeSpec& spec) const {
  if (spec.sense == 0) return false;
  const Frame<double>&a = a_.frame(), &b = b_.frame();
  const auto wrong_way = [&](const Row<double>& row, double sign) {
    return negative_on(line_.box, row, -spec.sense * sign, line_.guard.length);
  };
  if (spec.kind == ModeSpec::Kind::roll)
    return wrong_way(rotation_row(a.at[spec.i]), 1) && wrong_way(rotation_row(b.at[spec.i]), 1);
  if (spec.kind != ModeSpec::Kind::two_slides) return false;
  const int i = spec.i, j = spec.j, edge_i = loaded_edge(spec.sigma_i), edge_j = loaded_edge(spec.sigma_j);
  const Row<double> za = force_pair(a.at[i], edge_i, a.at[j], edge_j),
                    zb = force_pair(b.at[i], edge_i, b.at[j], edge_j);
  const double sign = (za.one > 0) == (spec.sense > 0) ? 1 : -1;  // of D, if the direction is to be wrong at gravity
  if (!wrong_way(za, sign) || !wrong_way(zb, sign)) return false;
  const Row<double> ca = inertia_times_normal_cross(a, i, j), cb = inertia_times_normal_cross(b, i, j);
  const double least = line_.guard.denominator;
  return sign * dot(za, ca) > least && sign * dot(zb, cb) > least && sign * (dot(za, cb) + dot(zb, ca)) > 2 * least;
}

bool LineInterval::denominator_keeps_sign(const StationRows& a, const StationRows& b, int k, double sign) {
  if (!has_denominator(line_.posture.modes()[k])) return true;
  const double least = middle_error_factor * line_.guard.denominator;
  if (!(sign * a.denominator > least && sign * b.denominator > least)) return false;
  return sign * middle_coefficient(a.denominator, middle_.rows(line_, k).denominator, b.denominator) > least;
}

bool LineInterval::excludes_by_one_row(const StationRows& a, const StationRows& b, int k, double sign) {
  for (int r = 0; r < a.list.count; ++r) {
    const Row<double>&ra = a.list.row[r], &rb = b.list.row[r];
    const double error = middle_error_factor * a.list.error[r];
    if (!negative_on(line_.box, ra, sign, error) || !negative_on(line_.box, rb, sign, error)) continue;
    const Row<double>& rm = middle_.rows(line_, k).list.row[r];
    const Row<double> between{middle_coefficient(ra.p, rm.p, rb.p), middle_coefficient(ra.one, rm.one, rb.one),
                              middle_coefficient(ra.q, rm.q, rb.q)};
    if (negative_on(line_.box, between, sign, error)) return true;
  }
  return false;
}

bool LineInterval::excludes_by_rows(int k) {
  bool excluded = excludes_by_direction(line_.posture.modes()[k]);
  if (!excluded) {
    const StationRows &a = a_.rows(line_, k), &b = b_.rows(line_, k);
    const auto excluded_for = [&](double sign) {
      return excludes_by_one_row(a, b, k, sign) || excludes_by_two_rows(a, b, k, sign);
    };
    const double sign = a.denominator < 0 ? -1 : 1;
    excluded = excluded_for(sign) && (denominator_keeps_sign(a, b, k, sign) || excluded_for(-sign));
  }
  decisions.intervals_by_rows += excluded;
  return excluded;
}

bool LineInterval::excludes_by_two_rows(const StationRows& a, const StationRows& b, int k, double sign) {
  const StationRows& m = middle_.rows(line_, k);
  RowList<double> between;
  between.count = a.list.count;
  for (int r = 0; r < a.list.count; ++r) {
    const Row<double>&ra = a.list.row[r], &rm = m.list.row[r], &rb = b.list.row[r];
    between.row[r] = {middle_coefficient(ra.p, rm.p, rb.p), middle_coefficient(ra.one, rm.one, rb.one),
                      middle_coefficient(ra.q, rm.q, rb.q)};
  }
  return two_rows_miss_box({&a.list, &between, &b.list}, sign, line_.box, middle_error_factor);
}

bool LineInterval::excludes_by_covectors(int k) {
  const Covector& za = a_.covector(certificates_, k);
  if (!za.found) return false;
  const Covector& zb = b_.covector(certificates_, k);
  const bool excluded = zb.found && certificates_.of_mode(k).proves(za, a_.frame(), zb, b_.frame());
  decisions.intervals_by_covectors += excluded;
  return excluded;
}

}  // namespace surefoot::stability
