#include "tests/support/extreme_plain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::testing {
namespace {

using Vec = std::array<double, 3>;
using Eigen::Vector2d;

constexpr double structural = 1e-12;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double size(const Vec& a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec times(double f, const Vec& a) { return {f * a[0], f * a[1], f * a[2]}; }
Vec plus(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

struct Arm {
  Vector2d r, n, t;
  double mu;
  Vec normal, tangent;
  Vec wrench(const Vector2d& d) const { return {d.x(), d.y(), r.x() * d.y() - r.y() * d.x()}; }
  /// sigma = +1: the edge loaded by U.
  Vec edge(int sigma) const { return wrench(n - sigma * mu * t); }
};

class Plain {
 public:
  explicit Plain(const SamplePosture& sample) : box_(sample.box), rho2_(sample.rho * sample.rho) {
    for (const Contact& contact : sample.contacts) {
      Arm arm{contact.position - sample.com, contact.normal, {contact.normal.y(), -contact.normal.x()}, contact.friction, {}, {}};
      arm.normal = arm.wrench(arm.n);
      arm.tangent = arm.wrench(arm.t);
      arms_.push_back(arm);
    }
  }

  bool equilibrium() {
    std::vector<Vec> rays;
    for (const Arm& arm : arms_) rays.push_back(arm.edge(1)), rays.push_back(arm.edge(-1));
    bool full = false;
    for (std::size_t b = 1; b < rays.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const Vec z = cross(rays[a], rays[b]);
        note(z);
        if (size(z) <= structural * size(rays[a]) * size(rays[b])) continue;
        bool above = false, below = false;
        for (const Vec& ray : rays) {
          const double value = dot(z, ray), zero = structural * size(z) * size(ray);
          above |= value > zero;
          below |= value < -zero;
        }
        full |= above || below;
        for (const int sign : {1, -1})
          if (!(sign > 0 ? below : above) && !positive_on_box(times(sign, z))) return false;
      }
    }
    return full;
  }

  bool feasible(const ContactMode& mode) {
    std::vector<int> staying;
    for (int i = 0; i < mode.contacts; ++i)
      if (mode.at[i] != ContactState::breaks) staying.push_back(i);
    rows_.clear();
    d_ = 1;
    if (staying.empty()) {
      for (const Arm& arm : arms_) rows_.push_back(times(-1, by_mass(arm.normal)));
    } else if (staying.size() == 2) {
      if (!two_slides(mode, staying[0], staying[1])) return false;
    } else if (mode.at[staying[0]] == ContactState::rolls) {
      roll(mode, staying[0]);
    } else {
      slide(mode, staying[0]);
    }
    for (const Vec& row : rows_) note(row);
    return (d_ >= 0 && meets_box(1)) || (d_ <= 0 && meets_box(-1));
  }

  bool not_a_number() const { return not_a_number_; }

 private:
  void note(const Vec& v) { not_a_number_ |= !std::isfinite(size(v)); }
  static int sigma(ContactState state) { return state == ContactState::slides_along ? 1 : -1; }
  /// M^-1 v as a form in v.
  Vec by_mass(const Vec& a) const { return {a[0], a[1], a[2] / rho2_}; }
  bool positive_on_box(const Vec& z) const {
    return z[1] - std::abs(z[0]) * box_.kappa - std::abs(z[2]) * box_.nu > 0;
  }

  void roll(const ContactMode& mode, int i) {
    const Arm& at = arms_[i];
    const double inertia = rho2_ + at.r.squaredNorm();
    const Vec alpha{-at.r.y() / inertia, at.r.x() / inertia, -1 / inertia};
    const Vec ax = times(at.r.y(), alpha), ay = times(-at.r.x(), alpha);
    const Vec fx = plus(ax, {1, 0, 0}), fy = plus(ay, {0, 1, 0});
    for (const int side : {1, -1}) {
      const Vector2d d = at.mu * at.n - side * at.t;
      rows_.push_back(plus(times(d.x(), fx), times(d.y(), fy)));
    }
    for (int j = 0; j < mode.contacts; ++j) {
      if (j == i) continue;
      const double opening = arms_[j].normal[2] + arms_[j].n.x() * at.r.y() - arms_[j].n.y() * at.r.x();
      if (std::abs(opening) > structural * arms_[j].n.lpNorm<1>() * (at.r - arms_[j].r).lpNorm<1>())
        rows_.push_back(times(opening, alpha));
    }
  }

  void slide(const ContactMode& mode, int i) {
    const Arm& at = arms_[i];
    const int side = sigma(mode.at[i]);
    const Vec s = at.edge(side), n = by_mass(at.normal);
    d_ = dot(n, s);
    rows_.push_back(n);
    // D A . xi for a covector A
    const auto reading = [&](const Vec& a) { return plus(times(-d_, by_mass(a)), times(dot(by_mass(a), s), n)); };
    rows_.push_back(times(side, reading(at.tangent)));
    for (int j = 0; j < mode.contacts; ++j) {
      const Vec& other = arms_[j].normal;
      if (j != i && size(cross(at.normal, other)) > structural * size(at.normal) * size(other))
        rows_.push_back(reading(other));
    }
  }

  bool two_slides(const ContactMode& mode, int i, int j) {
    const Arm &a = arms_[i], &b = arms_[j];
    const Vec c = cross(a.normal, b.normal);
    if (size(c) <= structural * size(a.normal) * size(b.normal)) return false;
    const Vec mc{c[0], c[1], c[2] * rho2_}, si = a.edge(sigma(mode.at[i])), sj = b.edge(sigma(mode.at[j]));
    const Vec z = cross(si, sj);
    d_ = dot(z, mc);
    const auto add = [&](const Vec& covector, double factor) {
      const double rate = factor * dot(covector, c);
      if (std::abs(rate) <= structural * size(covector) * size(c)) return 0;
      rows_.push_back(times(-rate, z));
      return rate > 0 ? 1 : -1;
    };
    const int along_i = add(a.tangent, sigma(mode.at[i])), along_j = add(b.tangent, sigma(mode.at[j]));
    if (along_i * along_j < 0) return false;
    rows_.push_back(cross(sj, mc));
    rows_.push_back(cross(mc, si));
    for (int l = 0; l < mode.contacts; ++l)
      if (l != i && l != j) add(arms_[l].normal, 1);
    return true;
  }

  bool meets_box(int sign) const {
    std::vector<Vector2d> polygon{
        {-box_.kappa, -box_.nu}, {box_.kappa, -box_.nu}, {box_.kappa, box_.nu}, {-box_.kappa, box_.nu}};
    const auto value = [&](const Vec& row, const Vector2d& v) { return sign * (row[0] * v.x() + row[1] + row[2] * v.y()); };
    for (const Vec& row : rows_) {
      std::vector<Vector2d> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double va = value(row, a), vb = value(row, b);
        if (va >= 0) kept.push_back(a);
        if ((va >= 0) != (vb >= 0)) kept.push_back(a + (b - a) * (va / (va - vb)));
      }
      polygon.swap(kept);
      if (polygon.empty()) return false;
    }
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& v : polygon) middle += v / static_cast<double>(polygon.size());
    return std::all_of(rows_.begin(), rows_.end(), [&](const Vec& row) { return value(row, middle) > 0; });
  }

  DisturbanceBox box_;
  double rho2_;
  std::vector<Arm> arms_;
  std::vector<Vec> rows_;
  double d_ = 1;
  bool not_a_number_ = false;
};

}  // namespace

PlainVerdict plain_verdict(const SamplePosture& sample) {
  Plain plain(sample);
  PlainVerdict verdict;
  verdict.equilibrium = plain.equilibrium();
  for (const ContactMode& mode : non_static_modes(static_cast<int>(sample.contacts.size())))
    if (plain.feasible(mode)) verdict.modes.push_back(mode.name());
  std::sort(verdict.modes.begin(), verdict.modes.end());
  verdict.robust = verdict.equilibrium && verdict.modes.empty();
  verdict.not_a_number = plain.not_a_number();
  return verdict;
}

}  // namespace surefoot::testing
