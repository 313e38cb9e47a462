#include "stability/posture.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "stability/given.hpp"
#include "stability/guard.hpp"

namespace surefoot::stability {
namespace {

/// 2^-e for 2^(e - 1) <= size < 2^e.
double power_of_two_below_inverse(double size) {
  const auto biased = static_cast<unsigned>(std::bit_cast<std::uint64_t>(size) >> 52);
  constexpr unsigned greatest = 2044;  // of which the result is a normal number, as of any but subnormals
  if (biased == 0 || biased > greatest) return std::ldexp(1.0, -std::ilogb(size) - 1);
  return std::bit_cast<double>(static_cast<std::uint64_t>(2045 - biased) << 52);
}

/// Components of at most 1, one of them at least 1/2. Scaling by a power of two is exact but for components that become
/// subnormal, which underflow_slack covers.
Vec2<double> scaled_normal(const Eigen::Vector2d& n) {
  const double size = std::max(std::abs(n.x()), std::abs(n.y()));
  if (size >= 0.5 && size <= 1) return {n.x(), n.y()};
  constexpr double least = 0x1p-1021;  // the scale of smaller ones is not a double
  if (size < least) return scaled_normal({n.x() * 0x1p200, n.y() * 0x1p200});
  const double scale = power_of_two_below_inverse(size);
  return {n.x() * scale, n.y() * scale};
}

}  // namespace

Posture::Posture(std::span<const Contact> contacts, double radius_of_gyration, Modes modes)
    : count_(static_cast<int>(contacts.size())), rho_(radius_of_gyration), rho2_(rho_ * rho_) {
  require(!contacts.empty() && contacts.size() <= 3, "contacts: expected 1 to 3");
  assert(std::isfinite(rho_) && rho_ > 0 && "radius of gyration must be positive");
  for (int i = 0; i < count_; ++i) {
    const Contact& c = contacts[i];
    assert(c.position.allFinite() && c.normal.allFinite() && std::isfinite(c.friction) && c.friction >= 0);
    assert((c.normal.x() != 0 || c.normal.y() != 0) && "the normal must not be zero");
    position_[i] = c.position;
    given_normal_[i] = {c.normal.x(), c.normal.y()};
    normal_[i] = scaled_normal(c.normal);
    friction_[i] = c.friction;
    edge_bound_ = std::max(edge_bound_, 1 + c.friction);
    spread_ = std::max(spread_, (c.position - position_[0]).lpNorm<1>());
  }
  // Row a x row b: at most 9 u of 2 a^2 (times the spread in the slots that are lengths), as z in guard.hpp.
  facet_error_ = 32 * unit_roundoff * edge_bound_ * edge_bound_;
  find_facets();
  if (modes == Modes::listed) list_modes();
}

// ---- frames -----------------------------------------------------------------------------------------------------

namespace {

/// Fills everything that follows from n, mu and r.
template <class V>
void complete(ContactTerms<V>& t) {
  const auto& n = t.n;
  t.edge[edge_u] = {n.x + t.mu * n.y, n.y - t.mu * n.x};
  t.edge[edge_w] = {n.x - t.mu * n.y, n.y + t.mu * n.x};
  t.nz = t.r.x * n.y - t.r.y * n.x;
  for (int e : {edge_u, edge_w}) t.sz[e] = t.r.x * t.edge[e].y - t.r.y * t.edge[e].x;
}

/// MakeR(i) gives r_i.
template <class V, class MakeR>
Frame<V> make_frame(int count, const std::array<Vec2<double>, 3>& normal, const std::array<double, 3>& friction,
                    Constant<V> rho2, MakeR&& make_r) {
  using K = Constant<V>;
  Frame<V> frame;
  frame.rho2 = rho2;
  frame.contacts = count;
  for (int i = 0; i < count; ++i) {
    ContactTerms<V>& t = frame.at[i];
    t.n = {K(normal[i].x), K(normal[i].y)};
    t.mu = K(friction[i]);
    t.r = make_r(i);
    complete(t);
  }
  return frame;
}

Dyadic squared(double value) { return Dyadic(value) * Dyadic(value); }

}  // namespace

Frame<double> Posture::frame(const Eigen::Vector2d& com) const {
  assert(com.allFinite());
  return make_frame<double>(count_, normal_, friction_, rho2_, [&](int i) {
    return Vec2<double>{position_[i].x() - com.x(), position_[i].y() - com.y()};
  });
}

Frame<Dual> Posture::dual_frame(const Eigen::Vector2d& com) const {
  assert(com.allFinite());
  return make_frame<Dual>(count_, normal_, friction_, rho2_, [&](int i) {
    return Vec2<Dual>{{position_[i].x() - com.x(), -1, 0}, {position_[i].y() - com.y(), 0, -1}};
  });
}

Frame<Dyadic> Posture::exact_frame(const Eigen::Vector2d& com) const {
  return make_frame<Dyadic>(count_, given_normal_, friction_, squared(rho_),
                            [&](int i) { return exactly(position_[i]) - exactly(com); });
}

Frame<double> Posture::frame(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) const {
  const Eigen::Vector2d back = lambda * (from - to);
  return make_frame<double>(count_, normal_, friction_, rho2_, [&](int i) {
    return Vec2<double>{position_[i].x() - from.x() + back.x(), position_[i].y() - from.y() + back.y()};
  });
}

Frame<Dyadic> Posture::exact_frame(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) const {
  const Dyadic part(lambda);
  const Vec2<Dyadic> start = exactly(from), back = start - exactly(to);
  return make_frame<Dyadic>(count_, given_normal_, friction_, squared(rho_), [&](int i) {
    const Vec2<Dyadic> r = exactly(position_[i]) - start;
    return Vec2<Dyadic>{r.x + part * back.x, r.y + part * back.y};
  });
}

}  // namespace surefoot::stability
