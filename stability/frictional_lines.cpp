#include "stability/frictional_lines.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "stability/frictional.hpp"

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {

/// Coefficients from the constant upwards.
using Polynomial = std::array<double, 5>;

double value_at(const Polynomial& f, double t) {
  double sum = 0;
  for (std::size_t k = f.size(); k-- > 0;) sum = sum * t + f[k];
  return sum;
}

Polynomial derivative(const Polynomial& f) {
  Polynomial g{};
  for (std::size_t k = 1; k < f.size(); ++k) g[k - 1] = static_cast<double>(k) * f[k];
  return g;
}

/// Appends where f changes sign in (low, high), ascending. Between places where the derivative does, f is monotone.
void sign_changes(const Polynomial& f, double low, double high, std::vector<double>& found) {
  if (std::all_of(f.begin() + 1, f.end(), [](double c) { return c == 0; })) return;
  std::vector<double> ends{low};
  sign_changes(derivative(f), low, high, ends);
  ends.push_back(high);
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double a = ends[k - 1], b = ends[k], at_a = value_at(f, a), at_b = value_at(f, b);
    if (!((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))) {
      if (at_b == 0 && b < high) found.push_back(b);
      continue;
    }
    boost::uintmax_t most = 100;
    const auto root = boost::math::tools::toms748_solve([&](double t) { return value_at(f, t); }, a, b, at_a, at_b,
                                                        boost::math::tools::eps_tolerance<double>(52), most);
    found.push_back(0.5 * (root.first + root.second));
  }
}

Polynomial on_vertical(const Poly2& f, double s) {
  const Quadratic q = on_line(f, s);
  return {q.c0, q.c1, q.c2, 0, 0};
}

Polynomial product(const Polynomial& f, const Polynomial& g) {  // of two quadratics
  Polynomial h{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) h[i + k] += f[i] * g[k];
  return h;
}

}  // namespace

FrictionalLengths FrictionalLine::lengths() const {
  FrictionalLengths sum{};
  for (int k = 0; k < frictional_part_count; ++k)
    for (const Interval& interval : part[k]) sum[k] += interval.high - interval.low;
  return sum;
}

FrictionalLines::FrictionalLines(std::span<const Contact> contacts, double rho, double restitution,
                                 const Eigen::AlignedBox2d& strip)
    : posture_(contacts, rho), restitution_(restitution), strip_(strip), origin_(strip.center()),
      frame_(frame_around(posture_, origin_, Vector2d::UnitX(), Vector2d::UnitY())), upward_(faces_upward(posture_)) {
  for (const ModeSpec& spec : posture_.modes()) {
    GravityRows<Poly2> rows;
    emit_rows(frame_, spec, rows);
    if (rows.d) add(*rows.d);
    for (int k = 0; k < rows.count; ++k) add(rows.value[k]);
  }
}

/// Modes share many rows.
void FrictionalLines::add(const Poly2& f) {
  const auto same = [&f](const Poly2& g) {
    return f.c == g.c && f.s == g.s && f.t == g.t && f.ss == g.ss && f.st == g.st && f.tt == g.tt;
  };
  if (std::none_of(curves_.begin(), curves_.end(), [&](const Poly2& g) { return same(g) || same(-g); }))
    curves_.push_back(f);
}

FrictionalLine FrictionalLines::at(double x) {
  ++asked_;
  const double s = x - origin_.x(), low = strip_.min().y() - origin_.y(), high = strip_.max().y() - origin_.y();
  cuts_.assign({low});
  for (const Poly2& curve : curves_) sign_changes(on_vertical(curve, s), low, high, cuts_);
  // (10) is an equality where X^2 = threshold^2 D_1 D_2 and X < 0.
  const Polynomial of_x = on_vertical(normal_product(frame_, 0, 1), s);
  const Polynomial squared = product(of_x, of_x);
  const Polynomial of_d =
      product(on_vertical(normal_product(frame_, 0, 0), s), on_vertical(normal_product(frame_, 1, 1), s));
  const double threshold = clattering_threshold(restitution_);
  Polynomial excess;
  for (std::size_t k = 0; k < excess.size(); ++k) excess[k] = squared[k] - threshold * threshold * of_d[k];
  sign_changes(excess, low, high, cuts_);
  sign_changes(of_x, low, high, cuts_);
  cuts_.push_back(high);
  std::sort(cuts_.begin(), cuts_.end());
  FrictionalLine line{x, {}};
  for (std::size_t k = 1; k < cuts_.size(); ++k)
    if (cuts_[k] > cuts_[k - 1]) decide(line, cuts_[k - 1] + origin_.y(), cuts_[k] + origin_.y());
  return line;
}

void FrictionalLines::decide(FrictionalLine& line, double low, double high) const {
  const Vector2d com(line.x, 0.5 * (low + high));
  const bool strong = kinematic_strong(posture_, com), clatters = clattering_converges(posture_, com, restitution_);
  const std::array<bool, frictional_part_count> holds{strong, clatters, strong && clatters && upward_};
  for (int k = 0; k < frictional_part_count; ++k) {
    if (!holds[k]) continue;
    if (Intervals& known = line.part[k]; !known.empty() && known.back().high == low) known.back().high = high;
    else known.push_back({low, high});
  }
}

}  // namespace surefoot::stability
