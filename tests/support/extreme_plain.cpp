#include "tests/support/extreme_plain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace surefoot::testing {
namespace {

template <class S>
using Vec = std::array<S, 3>;

/// 1e-12 in doubles, the same multiple of their rounding in other types.
template <class S>
constexpr S structural = S(1e-12L / std::numeric_limits<double>::epsilon() * std::numeric_limits<S>::epsilon());

template <class S>
S dot(const Vec<S>& a, const Vec<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class S>
S size(const Vec<S>& a) {
  return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
}
template <class S>
Vec<S> cross(const Vec<S>& a, const Vec<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class S>
Vec<S> times(const std::type_identity_t<S>& f, const Vec<S>& a) {
  return {f * a[0], f * a[1], f * a[2]};
}
template <class S>
Vec<S> plus(const Vec<S>& a, const std::type_identity_t<Vec<S>>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class S>
struct Arm {
  using Vector2 = Eigen::Matrix<S, 2, 1>;
  Vector2 r, n, t;
  S mu;
  Vec<S> normal, tangent;
  Vec<S> wrench(const Vector2& d) const { return {d.x(), d.y(), r.x() * d.y() - r.y() * d.x()}; }
  /// sigma = +1: the edge loaded by U.
  Vec<S> edge(int sigma) const { return wrench(n - S(sigma) * mu * t); }
};

template <class S>
class Plain {
  using Vector2 = Eigen::Matrix<S, 2, 1>;

 public:
  explicit Plain(const SamplePosture& sample)
      : kappa_(S(sample.box.kappa)), nu_(S(sample.box.nu)), rho2_(S(sample.rho) * S(sample.rho)) {
    for (const Contact& contact : sample.contacts) {
      Arm<S> arm{contact.position.template cast<S>() - sample.com.template cast<S>(),
                 contact.normal.template cast<S>(),
                 {},
                 S(contact.friction),
                 {},
                 {}};
      arm.t = {arm.n.y(), -arm.n.x()};
      arm.normal = arm.wrench(arm.n);
      arm.tangent = arm.wrench(arm.t);
      arms_.push_back(arm);
    }
  }

  bool equilibrium() {
    std::vector<Vec<S>> rays;
    for (const Arm<S>& arm : arms_) rays.push_back(arm.edge(1)), rays.push_back(arm.edge(-1));
    bool full = false;
    for (std::size_t b = 1; b < rays.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const Vec<S> z = cross(rays[a], rays[b]);
        note(z);
        if (size(z) <= structural<S> * size(rays[a]) * size(rays[b])) continue;
        bool above = false, below = false;
        for (const Vec<S>& ray : rays) {
          const S value = dot(z, ray), zero = structural<S> * size(z) * size(ray);
          above |= value > zero;
          below |= value < -zero;
        }
        full |= above || below;
        for (const int sign : {1, -1})
          if (!(sign > 0 ? below : above) && !positive_on_box(times(S(sign), z))) return false;
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
      for (const Arm<S>& arm : arms_) rows_.push_back(times(-1, by_mass(arm.normal)));
    } else if (staying.size() == 2) {
      if (!two_slides(mode, staying[0], staying[1])) return false;
    } else if (mode.at[staying[0]] == ContactState::rolls) {
      roll(mode, staying[0]);
    } else {
      slide(mode, staying[0]);
    }
    for (const Vec<S>& row : rows_) note(row);
    return (d_ >= 0 && meets_box(1)) || (d_ <= 0 && meets_box(-1));
  }

  bool not_a_number() const { return not_a_number_; }

 private:
  void note(const Vec<S>& v) { not_a_number_ |= !std::isfinite(size(v)); }
  static int sigma(ContactState state) { return state == ContactState::slides_along ? 1 : -1; }
  /// M^-1 v as a form in v.
  Vec<S> by_mass(const Vec<S>& a) const { return {a[0], a[1], a[2] / rho2_}; }
  bool positive_on_box(const Vec<S>& z) const { return z[1] - std::abs(z[0]) * kappa_ - std::abs(z[2]) * nu_ > 0; }

  void roll(const ContactMode& mode, int i) {
    const Arm<S>& at = arms_[i];
    const S inertia = rho2_ + at.r.squaredNorm();
    const Vec<S> alpha{-at.r.y() / inertia, at.r.x() / inertia, -1 / inertia};
    const Vec<S> ax = times(at.r.y(), alpha), ay = times(-at.r.x(), alpha);
    const Vec<S> fx = plus(ax, {1, 0, 0}), fy = plus(ay, {0, 1, 0});
    for (const int side : {1, -1}) {
      const Vector2 d = at.mu * at.n - S(side) * at.t;
      rows_.push_back(plus(times(d.x(), fx), times(d.y(), fy)));
    }
    for (int j = 0; j < mode.contacts; ++j) {
      if (j == i) continue;
      const S opening = arms_[j].normal[2] + arms_[j].n.x() * at.r.y() - arms_[j].n.y() * at.r.x();
      if (std::abs(opening) >
          structural<S> * arms_[j].n.template lpNorm<1>() * (at.r - arms_[j].r).template lpNorm<1>())
        rows_.push_back(times(opening, alpha));
    }
  }

  void slide(const ContactMode& mode, int i) {
    const Arm<S>& at = arms_[i];
    const int side = sigma(mode.at[i]);
    const Vec<S> s = at.edge(side), n = by_mass(at.normal);
    d_ = dot(n, s);
    rows_.push_back(n);
    // D A . xi for a covector A
    const auto reading = [&](const Vec<S>& a) { return plus(times(-d_, by_mass(a)), times(dot(by_mass(a), s), n)); };
    rows_.push_back(times(S(side), reading(at.tangent)));
    for (int j = 0; j < mode.contacts; ++j) {
      const Vec<S>& other = arms_[j].normal;
      if (j != i && size(cross(at.normal, other)) > structural<S> * size(at.normal) * size(other))
        rows_.push_back(reading(other));
    }
  }

  bool two_slides(const ContactMode& mode, int i, int j) {
    const Arm<S>&a = arms_[i], &b = arms_[j];
    const Vec<S> c = cross(a.normal, b.normal);
    if (size(c) <= structural<S> * size(a.normal) * size(b.normal)) return false;
    const Vec<S> mc{c[0], c[1], c[2] * rho2_}, si = a.edge(sigma(mode.at[i])), sj = b.edge(sigma(mode.at[j]));
    const Vec<S> z = cross(si, sj);
    d_ = dot(z, mc);
    const auto add = [&](const Vec<S>& covector, S factor) {
      const S rate = factor * dot(covector, c);
      if (std::abs(rate) <= structural<S> * size(covector) * size(c)) return 0;
      rows_.push_back(times(-rate, z));
      return rate > 0 ? 1 : -1;
    };
    const int along_i = add(a.tangent, S(sigma(mode.at[i]))), along_j = add(b.tangent, S(sigma(mode.at[j])));
    if (along_i * along_j < 0) return false;
    rows_.push_back(cross(sj, mc));
    rows_.push_back(cross(mc, si));
    for (int l = 0; l < mode.contacts; ++l)
      if (l != i && l != j) add(arms_[l].normal, 1);
    return true;
  }

  bool meets_box(int sign) const {
    std::vector<Vector2> polygon{{-kappa_, -nu_}, {kappa_, -nu_}, {kappa_, nu_}, {-kappa_, nu_}};
    const auto value = [&](const Vec<S>& row, const Vector2& v) {
      return S(sign) * (row[0] * v.x() + row[1] + row[2] * v.y());
    };
    for (const Vec<S>& row : rows_) {
      std::vector<Vector2> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const S va = value(row, a), vb = value(row, b);
        if (va >= 0) kept.push_back(a);
        if ((va >= 0) != (vb >= 0)) kept.push_back(a + (b - a) * (va / (va - vb)));
      }
      polygon.swap(kept);
      if (polygon.empty()) return false;
    }
    Vector2 middle = Vector2::Zero();
    for (const Vector2& v : polygon) middle += v / static_cast<S>(polygon.size());
    return std::all_of(rows_.begin(), rows_.end(), [&](const Vec<S>& row) { return value(row, middle) > 0; });
  }

  S kappa_, nu_, rho2_;
  std::vector<Arm<S>> arms_;
  std::vector<Vec<S>> rows_;
  S d_ = 1;
  bool not_a_number_ = false;
};

}  // namespace

template <class S>
PlainVerdict plain_verdict_in(const SamplePosture& sample) {
  Plain<S> plain(sample);
  PlainVerdict verdict;
  verdict.equilibrium = plain.equilibrium();
  for (const ContactMode& mode : non_static_modes(static_cast<int>(sample.contacts.size())))
    if (plain.feasible(mode)) verdict.modes.push_back(mode.name());
  std::sort(verdict.modes.begin(), verdict.modes.end());
  verdict.robust = verdict.equilibrium && verdict.modes.empty();
  verdict.not_a_number = plain.not_a_number();
  return verdict;
}

template PlainVerdict plain_verdict_in<float>(const SamplePosture&);
template PlainVerdict plain_verdict_in<double>(const SamplePosture&);
template PlainVerdict plain_verdict_in<long double>(const SamplePosture&);

}  // namespace surefoot::testing
