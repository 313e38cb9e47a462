// The contact wrench cone of a posture: its facets, decided exactly (theory section 3).
#include <bit>
#include <cmath>
#include <cstdint>

#include "stability/decisions.hpp"
#include "stability/guard.hpp"
#include "stability/posture.hpp"

namespace surefoot::stability {

namespace {

template <class K>
Row<K> ray_about(const Vec2<K>& d, const Vec2<K>& n, const K& mu, int edge) {
  const Vec2<K> c = edge == edge_u ? Vec2<K>{n.x + mu * n.y, n.y - mu * n.x} : Vec2<K>{n.x - mu * n.y, n.y + mu * n.x};
  return {c.x, c.y, cross(d, c)};
}

}  // namespace

Row<Dyadic> Posture::exact_facet(const Facet& facet) const {
  const auto ray = [&](int k) {
    const int i = k / 2;
    return ray_about<Dyadic>(offset<Dyadic>(0, i), normal<Dyadic>(i), Dyadic(friction_[i]), k % 2);
  };
  const Row<Dyadic> z = cross(ray(facet.a), ray(facet.b));
  return facet.sign > 0 ? z : -z;
}

/// The sign of z . ray c for z = ray a x ray b, where doubles cannot tell.
int Posture::exact_side(int a, int b, int c) const {
  if constexpr (!guarded) return 0;
  const auto same_direction = [&](int k, int l) {
    return k % 2 == l % 2 && friction_[k / 2] == friction_[l / 2] && same(given_normal_[k / 2], given_normal_[l / 2]);
  };
  // One ray given twice: frictionless contacts.
  const auto frictionless_pair = [&](int k, int l) { return k / 2 == l / 2 && friction_[k / 2] == 0; };
  if (frictionless_pair(a, b) || frictionless_pair(a, c) || frictionless_pair(b, c)) return 0;
  // Parallel forces span a plane whatever their lines of action: flat ground, parallel treads.
  if (same_direction(a, b) && same_direction(b, c)) return 0;
  ++decisions.signs_exactly;
  const Row<Dyadic> exact = exact_facet({{}, static_cast<std::int8_t>(a), static_cast<std::int8_t>(b), 1});
  const int i = c / 2;
  return dot(exact, ray_about<Dyadic>(offset<Dyadic>(0, i), normal<Dyadic>(i), Dyadic(friction_[i]), c % 2)).sign();
}

bool Posture::parallel(int a, int b) const {
  if (a / 2 == b / 2) return friction_[a / 2] == 0;  // C^u x C^w = 2 mu |n|^2
  const Row<double> z = cross(rays_[a], rays_[b]);
  if (std::abs(z.q) > facet_error_ || std::abs(z.p) > facet_error_ * spread_ + underflow_slack ||
      std::abs(z.one) > facet_error_ * spread_ + underflow_slack)
    return false;
  if constexpr (!guarded) return true;
  ++decisions.signs_exactly;
  const Row<Dyadic> exact = exact_facet({{}, static_cast<std::int8_t>(a), static_cast<std::int8_t>(b), 1});
  return exact.p.is_zero() && exact.one.is_zero() && exact.q.is_zero();
}

/// Rays a < b span a plane that an earlier pair has spanned already if a third ray lies in it (`coplanar`, bit c) and
/// pairs with one of them earlier in the order.
bool Posture::is_new_plane(int a, int b, unsigned coplanar) const {
  for (int c = 0; c < b; ++c) {
    if (c == a || !(coplanar >> c & 1)) continue;
    if (!parallel(std::min(a, c), std::max(a, c))) return false;
    if (c < a && !parallel(c, b)) return false;
  }
  return true;
}

namespace {

/// Pairs of rays a < b are numbered in the order (0, 1), (0, 2), (1, 2), (0, 3), ...; sets of pairs are bits.
constexpr unsigned pair_bit(int a, int b) { return 1u << (b * (b - 1) / 2 + a); }

struct RayPair {
  std::int8_t a, b;
};
constexpr auto ray_pairs = [] {
  std::array<RayPair, 15> pairs{};
  int count = 0;
  for (std::int8_t b = 1; b < 6; ++b)
    for (std::int8_t a = 0; a < b; ++a) pairs[count++] = {a, b};
  return pairs;
}();

}  // namespace

/// A pair of rays spans a facet if no two others lie on different sides of its plane. The sides of all pairs follow
/// from the signs of the triple products of a < b < c: c's side of (a, b) and a's of (b, c) have that sign, b's of (a,
/// c) the opposite one.
template <int rays>
void Posture::find_facets_of() {
  for (int i = 0; i < rays / 2; ++i)
    for (int e : {edge_u, edge_w})
      rays_[2 * i + e] = ray_about<double>(offset<double>(0, i), normal_[i], friction_[i], e);
  // z: 9 u of 2 a^2 (spread); the product with the third ray: at most 3 terms, 8 u more, of 6 a^3 spread.
  const double bound = guarded ? 4 * facet_error_ * edge_bound_ * spread_ + underflow_slack : 0;
  unsigned positive = 0, negative = 0;          // pairs that have a ray on that side
  std::array<unsigned char, 6 * 6> coplanar{};  // of rays a < b: which third rays lie in their plane
  bool any_coplanar = false;
  const auto coplanar_with = [&](int a, int b) -> unsigned char& { return coplanar[6 * a + b]; };
#pragma GCC unroll 6
  for (int b = 1; b < rays - 1; ++b)
#pragma GCC unroll 6
    for (int a = 0; a < b; ++a) {
      const Row<double> z = cross(rays_[a], rays_[b]);
      unsigned above = 0, below = 0;
#pragma GCC unroll 6
      for (int c = b + 1; c < rays; ++c) {
        const double value = dot(z, rays_[c]);
        const int side = value > bound ? 1 : value < -bound ? -1 : exact_side(a, b, c);
        const unsigned same = pair_bit(a, b) | pair_bit(b, c), opposite = pair_bit(a, c);
        if (side > 0) {
          above |= same, below |= opposite;
        } else if (side < 0) {
          above |= opposite, below |= same;
        } else {
          any_coplanar = true;
          coplanar_with(a, b) |= 1u << c, coplanar_with(b, c) |= 1u << a, coplanar_with(a, c) |= 1u << b;
        }
      }
      positive |= above, negative |= below;
    }
  flat_cone_ = positive == 0 && negative == 0;
  if (flat_cone_) return;
  const unsigned all = (1u << (rays * (rays - 1) / 2)) - 1;
  for (unsigned left = all & ~(positive & negative); left != 0; left &= left - 1) {
    const auto [a, b] = ray_pairs[std::countr_zero(left)];
    if (any_coplanar && (parallel(a, b) || !is_new_plane(a, b, coplanar_with(a, b)))) continue;
    const Row<double> z = cross(rays_[a], rays_[b]);
    facets_[facet_count_++] = negative & pair_bit(a, b) ? Facet{-z, a, b, -1} : Facet{z, a, b, 1};
  }
}

void Posture::find_facets() {
  if (count_ == 2) find_facets_of<4>();
  if (count_ == 3) find_facets_of<6>();  // one contact: a plane cone, without facets
  constexpr std::array<std::uint64_t, 3> sides_of_rays{0, 4, 20};
  decisions.signs += sides_of_rays[count_ - 1];
}

}  // namespace surefoot::stability
