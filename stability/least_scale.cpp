#include "stability/least_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stability/point_test.hpp"

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The multipliers y of the gradient are this good, relative to their size.
constexpr double gradient_accuracy = 1e-7;

template <class K>
K absolute(const K& value) {
  return value < 0 ? K(-value) : value;
}
template <class K>
K norm(const Vec2<K>& a) {
  return absolute(a.x) + absolute(a.y);
}
template <class K>
K reach_of(const Vec2<K>& v) {
  return std::max<K>(absolute(v.x), absolute(v.y));
}

/// v(t) = base + t d on the line of a row: which rows bound t, and where.
template <class K>
struct Interval {
  K low{}, high{};
  int low_row = -1, high_row = -1;
};

/// Whether the rows i, j, k exclude one another: y >= 0 with sum y a = 0. (Any such y proves what its sums say.)
template <class K>
void exclude_by_three(LeastScale<K>& result, const ScaledRows<K>& rows, int i, int j, int k) {
  const auto &a = rows.row[i].a, &b = rows.row[j].a, &c = rows.row[k].a;
  result.empty = true;
  result.active = 3;
  result.row = {i, j, k};
  result.y = {absolute(cross(b, c)), absolute(cross(c, a)), absolute(cross(a, b))};
}

template <class K>
void exclude_by_two(LeastScale<K>& result, const ScaledRows<K>& rows, int i, int j) {
  result.empty = true;
  result.active = 2;
  result.row = {i, j, 0};
  result.y = {norm(rows.row[j].a), norm(rows.row[i].a), K(0)};
}

template <class K>
void exclude_by_one(LeastScale<K>& result, int k) {
  result.empty = true;
  result.active = 1;
  result.row = {k, 0, 0};
  result.y = {K(1), K(0), K(0)};
}

/// Multipliers of two rows whose lines cross on the side `face` of s W. False where they are not both >= 0.
template <class K>
bool set_dual(LeastScale<K>& result, const ScaledRows<K>& rows, const Vec2<K>& face) {
  const auto &a = rows.row[result.row[0]].a, &b = rows.row[result.row[1]].a;
  const K det = cross(a, b);
  if (det == 0) return false;
  result.y = {cross(face, b) / det, cross(a, face) / det, K(0)};
  return result.y[0] >= 0 && result.y[1] >= 0;
}

/// The point of least |.|_inf on the line of row k, within rows 0..k-1.
template <class K>
void move_to_line(LeastScale<K>& result, const ScaledRows<K>& rows, int k) {
  const ScaledRow<K>& row = rows.row[k];
  const K size = norm(row.a);
  if (!(size > 0)) return exclude_by_one(result, k);
  // The nearest point of the line to the origin in |.|_inf is -b/|a|_1 (sign a); a zero component may take any value.
  const K nearest = -row.b / size;
  const Vec2<K> base{row.a.x < 0 ? K(-nearest) : nearest, row.a.y < 0 ? K(-nearest) : nearest};
  const Vec2<K> d{-row.a.y / size, row.a.x / size};
  Interval<K> within;
  for (int j = 0; j < k; ++j) {
    const ScaledRow<K>& other = rows.row[j];
    const K slope = other.a.x * d.x + other.a.y * d.y, value = other.at(base);
    if (slope == 0) {
      if (value < 0 || (value == 0 && dot(other.a, row.a) <= 0)) return exclude_by_two(result, rows, j, k);
      continue;
    }
    const K t = -value / slope;
    if (slope > 0 && (within.low_row < 0 || t > within.low)) within.low = t, within.low_row = j;
    if (slope < 0 && (within.high_row < 0 || t < within.high)) within.high = t, within.high_row = j;
  }
  if (within.low_row >= 0 && within.high_row >= 0 && !(within.low < within.high))
    return exclude_by_three(result, rows, within.low_row, within.high_row, k);
  // |.|_inf is convex along the line with its minimum at t = 0 (or on a stretch around it): the nearest end of the
  // interval.
  K t(0);
  int partner = -1;
  if (within.low_row >= 0 && within.low > 0) t = within.low, partner = within.low_row;
  if (within.high_row >= 0 && within.high < 0) t = within.high, partner = within.high_row;
  result.v = {base.x + t * d.x, base.y + t * d.y};
  result.s = reach_of(result.v);
  result.active = partner < 0 ? 1 : 2;
  result.row = {k, std::max(partner, 0), 0};
}

template <class K>
void set_dual(LeastScale<K>& result, const ScaledRows<K>& rows) {
  if (result.empty || result.active == 0) return;
  if (result.active == 2) {
    const K one(1), zero(0);
    const Vec2<K>&v = result.v, x{v.x < 0 ? K(-one) : one, zero}, y{zero, v.y < 0 ? K(-one) : one};
    const bool x_side = absolute(v.x) >= absolute(v.y);
    if (set_dual(result, rows, x_side ? x : y)) return;
    if (absolute(v.x) == absolute(v.y) && set_dual(result, rows, x_side ? y : x)) return;
    result.active = 1;  // the side is reached along the first row alone
  }
  result.y = {K(1) / norm(rows.row[result.row[0]].a), K(0), K(0)};
}

}  // namespace

template <class K>
LeastScale<K> least_scale(const ScaledRows<K>& rows, const std::optional<K>& give_up) {
  LeastScale<K> result;
  for (int k = 0; k < rows.count && !result.empty; ++k) {
    if (rows.row[k].at(result.v) >= 0) continue;
    move_to_line(result, rows, k);
    if (give_up && !(result.s < *give_up)) break;
  }
  set_dual(result, rows);
  return result;
}

template LeastScale<double> least_scale(const ScaledRows<double>&, const std::optional<double>&);
template LeastScale<Fraction> least_scale(const ScaledRows<Fraction>&, const std::optional<Fraction>&);

// ---- proofs in doubles ------------------------------------------------------------------------------------------

namespace {

/// Collects a mode's rows with their error bounds, the sign of D applied. Stops early when a row alone excludes the
/// mode up to `level`, or when D is too small for its sign.
class ScaleSink {
 public:
  ScaleSink(const ScaleErrors& errors, const ModeSpec& spec, const DisturbanceBox& box, double level)
      : errors_(errors), normals_only_(spec.kind == ModeSpec::Kind::all_break),
        ends_with_normal_(spec.kind == ModeSpec::Kind::slide), box_(box), level_(level) {}
  void denominator(double d) {
    certain_ = d > errors_.denominator || d < -errors_.denominator;
    sign_ = d < 0 ? -1 : 1;
  }
  [[gnu::always_inline]] bool add(const Row<double>& row) {
    return push(row, normals_only_ ? errors_.normal : errors_.area);
  }
  [[gnu::always_inline]] bool add_length(const Row<double>& row) { return push(row, errors_.length); }

  ScaledRows<double> rows;
  bool excluded() const { return excluded_; }
  bool certain() const { return certain_; }
  double error(int k, double s) const { return error_[k]->constant + s * error_[k]->linear; }
  const RowErrors& errors(int k) const { return *error_[k]; }
  /// The last row of a slide is one of the normal alone.
  void finish() {
    if (ends_with_normal_) error_[rows.count - 1] = &errors_.normal;
  }

 private:
  [[gnu::always_inline]] bool push(const Row<double>& row, const RowErrors& errors) {
    const int k = rows.count++;
    ScaledRow<double>& scaled = rows.row[k];
    scaled = {{row.p * (sign_ * box_.kappa), row.q * (sign_ * box_.nu)}, row.one * sign_};
    error_[k] = &errors;
    excluded_ = certain_ && -scaled.b > level_ * (norm(scaled.a) + errors.linear) + errors.constant;
    return excluded_ || !certain_;
  }
  const ScaleErrors& errors_;
  bool normals_only_, ends_with_normal_;
  const DisturbanceBox& box_;
  double level_;
  std::array<const RowErrors*, max_rows> error_;
  bool excluded_ = false, certain_ = true;
  double sign_ = 1;
};

/// The level up to which the dual solution proves the mode infeasible. (The rounding of these sums is within the
/// errors.)
double proved_from_below(const LeastScale<double>& least, const ScaleSink& sink) {
  Vec2<double> a{0, 0};
  double rest = 0, growth = 0;
  for (int k = 0; k < least.active; ++k) {
    const double y = least.y[k];
    const ScaledRow<double>& row = sink.rows.row[least.row[k]];
    a = {a.x + y * row.a.x, a.y + y * row.a.y};
    rest -= y * (row.b + sink.errors(least.row[k]).constant);
    growth += y * sink.errors(least.row[k]).linear;
  }
  return rest > 0 ? rest / (norm(a) + growth) : 0;
}

/// Whether the rows exclude one another for disturbances of any size: three rows whose gradients surely span the plane
/// positively and whose determinant is surely negative, or two opposite ones where an axis is pinned. The true
/// multipliers are near y.
bool proved_at_any_level(const LeastScale<double>& least, const ScaleSink& sink, bool pinned) {
  if (!least.empty) return false;
  const auto row = [&](int k) -> const ScaledRow<double>& { return sink.rows.row[least.row[k]]; };
  const auto error = [&](int k) { return sink.errors(least.row[k]); };
  if (least.active == 1) return norm(row(0).a) + error(0).linear == 0 && row(0).b < -error(0).constant;
  double sum = 0;
  if (least.active == 2) {
    if (!pinned || !(dot(row(0).a, row(1).a) < 0)) return false;
    for (int k = 0; k < 2; ++k) {
      const double y = norm(row(1 - k).a), doubt = 2 * error(1 - k).linear;
      if (!(y > doubt)) return false;
      sum += y * (row(k).b + error(k).constant) + doubt * std::abs(row(k).b);
    }
    return sum < 0;
  }
  double orientation = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double y = cross(row(i).a, row(j).a);
    const double doubt = 2 * (error(i).linear * norm(row(j).a) + error(j).linear * norm(row(i).a));
    if (!(std::abs(y) > doubt) || y * orientation < 0) return false;
    orientation = y;
    sum += (std::abs(y) + doubt) * error(k).constant + doubt * std::abs(row(k).b) + std::abs(y) * row(k).b;
  }
  return sum < 0;
}

bool positive_at(const ScaleSink& sink, const Vec2<double>& v, double level) {
  for (int k = 0; k < sink.rows.count; ++k)
    if (!(sink.rows.row[k].at(v) > sink.error(k, level))) return false;
  return true;
}

/// The multipliers of two active rows, hence the gradient, are well defined.
bool well_conditioned(const LeastScale<double>& least, const ScaleSink& sink) {
  const int i = least.row[0], j = least.row[1];
  const auto &a = sink.rows.row[i].a, &b = sink.rows.row[j].a;
  const double error = sink.error(i, least.s) * norm(b) + sink.error(j, least.s) * norm(a);
  return std::abs(cross(a, b)) * gradient_accuracy > error;
}

/// Whether the mode is surely feasible somewhere in (1 + eps) s W: a step from the optimum, of size eps s, along the
/// bisector of two rows that vanish there. These are the active ones, unless more than two lines meet there (as they do
/// where the twist vanishes).
bool proved_from_above(const LeastScale<double>& least, const ScaleSink& sink) {
  const double step = safety_factor_accuracy * least.s, level = least.s + step;
  const Vec2<double>& v = least.v;
  if (least.active < 2)
    return positive_at(sink, {v.x * (1 + safety_factor_accuracy), v.y * (1 + safety_factor_accuracy)}, level);
  if (!well_conditioned(least, sink)) return false;
  const auto steps_in_between = [&](const Vec2<double>& a, const Vec2<double>& b) {
    const double det = cross(a, b), size_a = norm(a), size_b = norm(b);
    const Vec2<double> d{(b.y * size_a - a.y * size_b) / det, (a.x * size_b - b.x * size_a) / det};
    const double length = step / reach_of(d);
    return positive_at(sink, {v.x + length * d.x, v.y + length * d.y}, level);
  };
  if (steps_in_between(sink.rows.row[least.row[0]].a, sink.rows.row[least.row[1]].a)) return true;
  for (int j = 1; j < sink.rows.count; ++j)
    for (int i = 0; i < j; ++i)
      if (steps_in_between(sink.rows.row[i].a, sink.rows.row[j].a)) return true;
  return false;
}

double greatest_offset(const Frame<double>& frame) {
  double radius = 0;
  for (int i = 0; i < frame.contacts; ++i)
    radius = std::max(radius, std::abs(frame.at[i].r.x) + std::abs(frame.at[i].r.y));
  return radius;
}

}  // namespace

ScaleQuery::ScaleQuery(const Posture& posture, const Vector2d& com, const DisturbanceBox& box)
    : posture_(posture), com_(com), box_(box), frame_(posture.frame(com)) {
  const double radius = greatest_offset(frame_), a = posture.edge_bound(), rho2 = posture.rho2();
  const Guard guard = GuardScale(a, rho2, box).at(radius);
  nothing_certain_ = guard.nothing_certain();
  const auto errors = [&](double factor, double moment_free, double moment) {
    const double f = factor * unit_roundoff;
    return RowErrors{f * moment_free + underflow_slack, f * (moment_free * box.kappa + moment * box.nu)};
  };
  errors_ = {errors(64 * a, rho2 + radius * radius, radius), errors(64 * a * a, radius, 1), errors(16, rho2, radius),
             guard.denominator};
}

ScaleQuery::Outcome ScaleQuery::in_doubles(const ModeSpec& spec, double bound, ModeScale& scale) const {
  if (nothing_certain_) return Outcome::undecided;
  const bool bounded = bound <= greatest_proved_scale;
  const double level = bounded ? bound : greatest_proved_scale;
  ScaleSink sink(errors_, spec, box_, bounded ? bound : infinity);
  emit_rows(frame_, spec, sink);
  if (sink.excluded()) return Outcome::not_below;
  if (!sink.certain()) return Outcome::undecided;
  sink.finish();
  const LeastScale<double> least = least_scale<double>(sink.rows, level);
  const double low = proved_from_below(least, sink);
  if (low >= level * (1 - safety_factor_accuracy)) {
    const bool pinned = box_.kappa == 0 || box_.nu == 0;
    return bounded || proved_at_any_level(least, sink, pinned) ? Outcome::not_below : Outcome::undecided;
  }
  if (least.empty || !(least.s < level) || !(low >= least.s * (1 - safety_factor_accuracy)) ||
      !proved_from_above(least, sink))
    return Outcome::undecided;
  scale = {least.s, {least.v.x * box_.kappa, least.v.y * box_.nu}, least, false};
  return Outcome::found;
}

Vector2d ScaleQuery::gradient(const ModeSpec& spec, const ModeScale& scale) {
  if (scale.s == 0) return Vector2d::Zero();
  if (scale.exact) return exact_gradient(spec);
  RowSink<Dual> sink;
  emit_rows(posture_.dual_frame(com_), spec, sink);
  const double sign = sink.d && sink.d->value < 0 ? -1 : 1;
  Vector2d sum = Vector2d::Zero();
  for (int k = 0; k < scale.dual.active; ++k) {
    const Dual value = value_at(sink.rows.row[scale.dual.row[k]], scale.at.p, scale.at.q);
    sum -= sign * scale.dual.y[k] * Vector2d(value.dx, value.dy);
  }
  ModeScale again;
  if (sum.allFinite() || in_fractions(spec, infinity, again) != Outcome::found) return sum;
  return exact_gradient(spec);
}

double unproved_scale(const Frame<double>& frame, const ModeSpec& spec, const DisturbanceBox& box) {
  RowSink<double> sink;
  emit_rows(frame, spec, sink);
  const double sign = sink.d && *sink.d < 0 ? -1 : 1;
  ScaledRows<double> rows;
  for (; rows.count < sink.rows.count; ++rows.count) {
    const Row<double>& row = sink.rows.row[rows.count];
    rows.row[rows.count] = {{sign * row.p * box.kappa, sign * row.q * box.nu}, sign * row.one};
  }
  const LeastScale<double> least = least_scale<double>(rows, std::nullopt);
  return least.empty ? infinity : least.s;
}

// ---- fractions --------------------------------------------------------------------------------------------------

Fraction fraction(const Dyadic& value) {
  using Whole = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
  const long e = value.exponent();
  const Whole mantissa(value.mantissa()), power = Whole(1) << std::abs(e);
  return e < 0 ? Fraction(mantissa, power) : Fraction(mantissa * power);
}

namespace {

/// Rows of a mode in fractions, with the sign given.
struct ExactRows {
  ScaledRows<Fraction> scaled;
  std::array<int, max_rows> index;  // among the rows emitted
};

ExactRows exact_rows(const RowSink<Dyadic>& sink, bool negative, const DisturbanceBox& box) {
  ExactRows rows;
  const Fraction kappa(negative ? -box.kappa : box.kappa), nu(negative ? -box.nu : box.nu);
  for (int k = 0; k < sink.rows.count; ++k) {
    const Row<Dyadic>& row = sink.rows.row[k];
    if (row.p.is_zero() && row.one.is_zero() && row.q.is_zero()) continue;  // theory section 4: drop it
    rows.index[rows.scaled.count] = k;
    rows.scaled.row[rows.scaled.count++] = {{fraction(row.p) * kappa, fraction(row.q) * nu},
                                            negative ? Fraction(-fraction(row.one)) : fraction(row.one)};
  }
  return rows;
}

/// Whether {rows > 0} has points next to v: the rows that vanish at v must have gradients within an open half-plane,
/// that is between two of them that turn by less than half a circle.
bool opens_at(const ScaledRows<Fraction>& rows, const Vec2<Fraction>& v) {
  std::array<Vec2<Fraction>, max_rows> a;
  int count = 0;
  for (int k = 0; k < rows.count; ++k)
    if (rows.row[k].at(v) == 0) a[count++] = rows.row[k].a;
  if (count == 0) return true;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const Fraction turn = cross(a[i], a[j]);
      bool between = turn > 0 || (turn == 0 && dot(a[i], a[j]) > 0);
      for (int k = 0; k < count && between; ++k)
        between = cross(a[i], a[k]) >= 0 && cross(a[k], a[j]) >= 0 && (turn > 0 ? norm(a[k]) > 0 : dot(a[i], a[k]) > 0);
      if (between) return true;
    }
  return false;
}

/// The frame seen from a COM moved by (dx, dy).
Frame<Dyadic> moved(Frame<Dyadic> frame, int dx, int dy) {
  const Dyadic x(dx), y(dy);
  for (int i = 0; i < frame.contacts; ++i) {
    ContactTerms<Dyadic>& at = frame.at[i];
    at.r = {at.r.x - x, at.r.y - y};
    at.nz = at.nz - (x * at.n.y - y * at.n.x);
    for (int e : {edge_u, edge_w}) at.sz[e] = at.sz[e] - (x * at.edge[e].y - y * at.edge[e].x);
  }
  return frame;
}

}  // namespace

const Frame<Dyadic>& ScaleQuery::exact_frame() {
  if (!exact_) exact_ = posture_.exact_frame(com_);
  return *exact_;
}

ScaleQuery::Outcome ScaleQuery::in_fractions(const ModeSpec& spec, double bound, ModeScale& scale) {
  RowSink<Dyadic> sink;
  emit_rows(exact_frame(), spec, sink);
  const int sign = sink.d ? sink.d->sign() : 1;
  std::optional<Fraction> below;
  if (std::isfinite(bound)) below = Fraction(bound);
  bool any = false;
  for (const bool negative : {false, true}) {
    if (negative ? sign > 0 : sign < 0) continue;  // D = 0: both signs
    const ExactRows rows = exact_rows(sink, negative, box_);
    LeastScale<Fraction> least = least_scale<Fraction>(rows.scaled, below);
    if (least.empty || (below && least.s >= *below) || !opens_at(rows.scaled, least.v)) continue;
    for (int k = 0; k < least.active; ++k) least.row[k] = rows.index[least.row[k]];
    below = least.s;
    found_ = least;
    negative_ = negative;
    any = true;
  }
  if (!any) return Outcome::not_below;
  const auto number = [](const Fraction& value) { return value.convert_to<double>(); };
  scale = {number(found_->s),
           {number(found_->v.x * Fraction(box_.kappa)), number(found_->v.y * Fraction(box_.nu))},
           {},
           true};
  return Outcome::found;
}

/// Rows are of degree 2 in the COM: differences of values at distance 1 on either side are twice the derivative.
Vector2d ScaleQuery::exact_gradient(const ModeSpec& spec) {
  const Fraction p = found_->v.x * Fraction(box_.kappa), q = found_->v.y * Fraction(box_.nu);
  Vector2d gradient;
  for (int axis = 0; axis < 2; ++axis) {
    Fraction slope(0);
    for (const int side : {1, -1}) {
      RowSink<Dyadic> sink;
      emit_rows(moved(exact_frame(), axis == 0 ? side : 0, axis == 1 ? side : 0), spec, sink);
      for (int k = 0; k < found_->active; ++k) {
        const Row<Dyadic>& row = sink.rows.row[found_->row[k]];
        const Fraction value = fraction(row.p) * p + fraction(row.one) + fraction(row.q) * q;
        slope += Fraction(negative_ != (side < 0) ? 1 : -1) * found_->y[k] * value;
      }
    }
    gradient[axis] = Fraction(slope / 2).convert_to<double>();
  }
  return gradient;
}

}  // namespace surefoot::stability
