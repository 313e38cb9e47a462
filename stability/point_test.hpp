// Is a non-static mode feasible at one COM for some wrench of W? Doubles with certificates first, exact numbers where
// these cannot tell.
#pragma once

#include <cassert>
#include <cmath>
#include <optional>

#include "stability/box_test.hpp"
#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

/// A COM; the frames in doubles and in exact numbers are made when first needed.
class PointQuery {
 public:
  PointQuery(const Posture& posture, const Eigen::Vector2d& com, const DisturbanceBox& box)
      : posture_(posture), com_(com), box_(box) {
    assert(com.allFinite());
  }

  /// z . g > 0 at every corner of W for every facet (theory section 3).
  bool equilibrium() const;
  bool feasible(const ModeSpec& spec);
  /// The first mode of the posture that is feasible, or null: shared certificates first (screen.hpp).
  const ModeSpec* any_feasible();

 private:
  bool feasible_exactly(const ModeSpec& spec);
  bool inside_exactly(const Facet& facet) const;
  void make_frame();
  const Frame<Dyadic>& exact_frame();

  const Posture& posture_;
  const Eigen::Vector2d& com_;
  const DisturbanceBox& box_;
  bool framed_ = false;
  Frame<double> frame_;
  Guard guard_;
  std::optional<Frame<Dyadic>> exact_;
};

/// Collects a mode's rows in doubles with their error bounds, the sign of D applied. Stops early when a row alone
/// excludes the mode for the whole box.
class PointSink {
 public:
  PointSink(const Guard& guard, const DisturbanceBox& box) : guard_(guard), box_(box) {}
  void denominator(double d) {
    sign_certain_ = d > guard_.denominator || d < -guard_.denominator;
    negative_ = d < 0;
  }
  bool add(const Row<double>& row) { return push(row, guard_.area); }
  bool add_length(const Row<double>& row) { return push(row, guard_.length); }

  RowList<double> rows;
  bool excluded() const { return excluded_; }
  bool sign_certain() const { return sign_certain_; }

 private:
  bool push(Row<double> row, double error) {
    if (negative_) row = -row;
    excluded_ = sign_certain_ && negative_on(box_, row, 1, error);
    rows.error[rows.count] = error;
    rows.row[rows.count++] = row;
    return excluded_ || !sign_certain_;
  }
  const Guard guard_;
  const DisturbanceBox& box_;
  bool excluded_ = false, sign_certain_ = true, negative_ = false;
};

/// Collects rows as they are, with D beside them, for number types other than double.
template <class V>
struct RowSink {
  RowList<V> rows;
  std::optional<V> d;
  int direction = -1;  // the row that is the direction of the twist left, if there is one
  void denominator(const V& value) { d = value; }
  bool add(const Row<V>& row) {
    rows.row[rows.count++] = row;
    return false;
  }
  bool add_length(const Row<V>& row) {
    direction = rows.count;
    return add(row);
  }
};

/// The rows of a mode in exact arithmetic meet the box: with the sign of D, both signs where D = 0.
bool meets_box_exactly(const RowSink<Dyadic>& sink, const DisturbanceBox& box);

}  // namespace surefoot::stability
