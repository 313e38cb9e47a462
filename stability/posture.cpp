#include "stability/posture.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "stability/decisions.hpp"
#include "stability/guard.hpp"

namespace surefoot::stability {
namespace {

int sign_of(const Dyadic& value) { return value.sign(); }

/// The sign of `value` if its error is below `bound`, else that of `exact()`.
template <class Exact>
int certain_sign(double value, double bound, Exact&& exact) {
  if (value > bound) return 1;
  if (value < -bound) return -1;
  if (bound == 0 && value == 0) return 0;
  if constexpr (!guarded) return value > 0 ? 1 : value < 0 ? -1 : 0;
  ++decisions.signs_exactly;
  return sign_of(exact());
}

Vec2<Dyadic> exactly(const Vec2<double>& v) { return {Dyadic(v.x), Dyadic(v.y)}; }
Vec2<Dyadic> exactly(const Eigen::Vector2d& v) { return {Dyadic(v.x()), Dyadic(v.y())}; }

bool same(const Vec2<double>& a, const Vec2<double>& b) { return a.x == b.x && a.y == b.y; }

/// Equal, or both along one axis: decided without arithmetic.
bool surely_parallel(const Vec2<double>& a, const Vec2<double>& b) {
  return same(a, b) || (a.x == 0 && b.x == 0) || (a.y == 0 && b.y == 0);
}

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

/// (x_l - x_i) x n_l: the rate at which contact l opens when the body turns about contact i. Independent of the COM.
/// `nl` is scaled for the first look, `given` is the normal itself.
int opening_sign(const Eigen::Vector2d& xi, const Eigen::Vector2d& xl, const Vec2<double>& nl,
                 const Vec2<double>& given) {
  const double dx = xl.x() - xi.x(), dy = xl.y() - xi.y();
  const double left = dx * nl.y, right = dy * nl.x;
  // dx, dy: 1 u each, two products and a difference: 3 u of the magnitude.
  const double bound = guarded ? 4 * unit_roundoff * (std::abs(left) + std::abs(right)) : 0;
  const bool underflow = guarded && bound < underflow_slack && ((dx != 0 && given.y != 0) || (dy != 0 && given.x != 0));
  return certain_sign(left - right, underflow ? HUGE_VAL : bound, [&] {
    const Vec2<Dyadic> d = exactly(xl) - exactly(xi);
    return cross(d, exactly(given));
  });
}

/// N_l . (N_i x N_j): the rate at which contact l opens when i and j slide. Independent of the COM (evaluated about
/// x_i).
template <class K>
K opening_of_slide(const Vec2<K>& dj, const Vec2<K>& dl, const Vec2<K>& ni, const Vec2<K>& nj, const Vec2<K>& nl) {
  return cross(dj, nj) * cross(nl, ni) + cross(dl, nl) * cross(ni, nj);
}

}  // namespace

Posture::Posture(std::span<const Contact> contacts, double radius_of_gyration, Modes modes)
    : count_(static_cast<int>(contacts.size())), rho_(radius_of_gyration), rho2_(rho_ * rho_) {
  assert(count_ >= 1 && count_ <= 3 && "1 to 3 contacts");
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
  if (count_ == 2) find_facets<4>();
  if (count_ == 3) find_facets<6>();  // one contact: a plane cone, without facets
  constexpr std::array<std::uint64_t, 3> sides_of_rays{0, 4, 20};
  decisions.signs += sides_of_rays[count_ - 1];
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
  return make_frame<double>(count_, normal_, friction_, rho2_, [&](int i) {
    return Vec2<double>{position_[i].x() - com.x(), position_[i].y() - com.y()};
  });
}

Frame<Dual> Posture::dual_frame(const Eigen::Vector2d& com) const {
  return make_frame<Dual>(count_, normal_, friction_, rho2_, [&](int i) {
    return Vec2<Dual>{{position_[i].x() - com.x(), -1, 0}, {position_[i].y() - com.y(), 0, -1}};
  });
}

Frame<Dyadic> Posture::exact_frame(const Eigen::Vector2d& com) const {
  return make_frame<Dyadic>(count_, given_normal_, friction_, squared(rho_), [&](int i) {
    return exactly(position_[i]) - exactly(com);
  });
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

// ---- equilibrium cone -------------------------------------------------------------------------------------------

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
  const Row<Dyadic> exact = exact_facet({{}, static_cast<signed char>(a), static_cast<signed char>(b), 1});
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
  const Row<Dyadic> exact = exact_facet({{}, static_cast<signed char>(a), static_cast<signed char>(b), 1});
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
  signed char a, b;
};
constexpr auto ray_pairs = [] {
  std::array<RayPair, 15> pairs{};
  int count = 0;
  for (signed char b = 1; b < 6; ++b)
    for (signed char a = 0; a < b; ++a) pairs[count++] = {a, b};
  return pairs;
}();

}  // namespace

/// A pair of rays spans a facet if no two others lie on different sides of its plane. The sides of all pairs follow
/// from the signs of the triple products of a < b < c: c's side of (a, b) and a's of (b, c) have that sign, b's of (a,
/// c) the opposite one.
template <int rays>
void Posture::find_facets() {
  for (int i = 0; i < rays / 2; ++i)
    for (int e : {edge_u, edge_w})
      rays_[2 * i + e] = ray_about<double>(offset<double>(0, i), normal_[i], friction_[i], e);
  // z: 9 u of 2 a^2 (spread); the product with the third ray: at most 3 terms, 8 u more, of 6 a^3 spread.
  const double bound = guarded ? 4 * facet_error_ * edge_bound_ * spread_ + underflow_slack : 0;
  unsigned positive = 0, negative = 0;  // pairs that have a ray on that side
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

// ---- modes ------------------------------------------------------------------------------------------------------

ModeSpec& Posture::add_mode(ModeSpec::Kind kind) {
  ModeSpec& spec = modes_[mode_count_++];
  spec = {kind, 0, 0, 0, 0, 0, {}};
  return spec;
}

void Posture::list_modes() {
  constexpr std::array<std::uint64_t, 3> turns_and_triple_product{0, 2, 6 + 1};
  decisions.signs += turns_and_triple_product[count_ - 1];
  for (int i = 0; i < count_; ++i)
    for (int l = 0; l < count_; ++l)
      if (l != i)
        turn_sign_[i][l] =
            static_cast<signed char>(opening_sign(position_[i], position_[l], normal_[l], given_normal_[l]));
  if (count_ == 3) find_triple_sign();
  add_mode(ModeSpec::Kind::all_break);
  for (int i = 0; i < count_; ++i) add_roll(i);
  for (int i = 0; i < count_; ++i) list_slides(i);
  for (int i = 0; i < count_; ++i)
    for (int j = i + 1; j < count_; ++j) list_two_slides(i, j);
}

/// Contacts that turning about i would open in opposite senses exclude the roll for every COM.
void Posture::add_roll(int i) {
  int sense = 0;
  for (int l = 0; l < count_; ++l) {
    if (l == i) continue;
    const int opening = turn_sign_[i][l];
    if (opening * sense < 0) return;
    if (opening != 0) sense = opening;
  }
  ModeSpec& spec = add_mode(ModeSpec::Kind::roll);
  spec.i = static_cast<signed char>(i);
  spec.sense = static_cast<signed char>(sense);
}

/// The sign of n_i x n_j.
int Posture::normal_cross_sign(int i, int j) const {
  if (surely_parallel(given_normal_[i], given_normal_[j])) return 0;
  const double bound = 4 * unit_roundoff + underflow_slack;  // components of at most 1: 2 u of 2
  return certain_sign(cross(normal_[i], normal_[j]), bound, [&] { return cross(normal<Dyadic>(i), normal<Dyadic>(j)); });
}

/// Sliding at i leaves two freedoms: the speed v along t_i and a rotation alpha about x_i, in which contact l opens at
/// the rate v (n_l x n_i) + alpha (x_l - x_i) x n_l. Whether some (v, alpha) with sigma v > 0 opens every other contact
/// does not depend on the COM. With two others that the rotation opens in opposite senses, elimination of alpha leaves
/// the sign of N_l . (N_i x N_j). (Left to the rows, an impossible mode would have linearly dependent rows, a
/// tangential case.)
void Posture::list_slides(int i) {
  int positive = -1, negative = -1;
  bool along = true, against = true;  // sigma = 1, sigma = -1
  std::array<bool, 3> vanishes{};
  for (int l = 0; l < count_; ++l) {
    if (l == i) continue;
    const int turn = turn_sign_[i][l];
    if (turn > 0) positive = l;
    if (turn < 0) negative = l;
    if (turn != 0) continue;
    const int opening = normal_cross_sign(l, i);
    if (opening < 0) along = false;
    if (opening > 0) against = false;
    vanishes[l] = opening == 0;  // both normals on one line
  }
  if (positive >= 0 && negative >= 0) {
    const int opening = opening_of_third(i, positive, negative);
    along &= opening > 0;
    against &= opening < 0;
  }
  for (const int sigma : {1, -1}) {
    if (!(sigma > 0 ? along : against)) continue;
    ModeSpec& spec = add_mode(ModeSpec::Kind::slide);
    spec.i = static_cast<signed char>(i);
    spec.sigma_i = static_cast<signed char>(sigma);
    spec.row_vanishes = vanishes;
  }
}

/// The sign of N_3 . (N_1 x N_2).
void Posture::find_triple_sign() {
  if (surely_parallel(given_normal_[0], given_normal_[1]) && surely_parallel(given_normal_[0], given_normal_[2])) return;
  const double value = opening_of_slide(offset<double>(0, 1), offset<double>(0, 2), normal_[0], normal_[1], normal_[2]);
  // Two products of cross products (3 u of the spread from contact 1 and 2 u of 2): 8 u of 4 spread.
  const double bound = 128 * unit_roundoff * spread_ + underflow_slack;
  triple_sign_ = static_cast<signed char>(certain_sign(value, bound, [&] {
    return opening_of_slide(offset<Dyadic>(0, 1), offset<Dyadic>(0, 2), normal<Dyadic>(0), normal<Dyadic>(1),
                            normal<Dyadic>(2));
  }));
}

/// The sign of N_l . (N_i x N_j), for three different contacts.
int Posture::opening_of_third(int i, int j, int l) const {
  const bool even = (j - i + 3) % 3 == 1 && (l - j + 3) % 3 == 1;
  return even ? triple_sign_ : -triple_sign_;
}

/// Along c = N_i x N_j contact i slides as T_i . c = |n_i|^2 (x_j - x_i) x n_j says, contact j as T_j . c = -|n_j|^2
/// (x_i - x_j) x n_i, and the third opens as N_l . c. The mode needs all of them (where they are not zero) to agree
/// with one sign of xi along c.
void Posture::list_two_slides(int i, int j) {
  const int slide_i = turn_sign_[i][j];
  const int slide_j = -turn_sign_[j][i];
  const bool same_line = slide_i == 0 && slide_j == 0 && normal_cross_sign(i, j) == 0;
  if (same_line) return;  // c = 0
  const int third = count_ == 3 ? opening_of_third(i, j, 3 - i - j) : 0;
  for (int sigma_i : {1, -1})
    for (int sigma_j : {1, -1}) {
      if (slide_i * slide_j * sigma_i * sigma_j < 0) continue;  // the twist slides them the other way round
      const int needs[3] = {sigma_i * slide_i, sigma_j * slide_j, third};
      int sense = 0;
      bool possible = true;
      for (int need : needs) {
        possible &= need * sense >= 0;
        if (need != 0) sense = need;
      }
      if (!possible) continue;
      ModeSpec& spec = add_mode(ModeSpec::Kind::two_slides);
      spec.i = static_cast<signed char>(i);
      spec.j = static_cast<signed char>(j);
      spec.sigma_i = static_cast<signed char>(sigma_i);
      spec.sigma_j = static_cast<signed char>(sigma_j);
      spec.sense = static_cast<signed char>(sense);
    }
}

}  // namespace surefoot::stability
