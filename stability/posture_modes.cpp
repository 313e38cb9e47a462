// The non-static modes that the geometry of a posture's contacts allows for any COM, decided exactly.
#include <cmath>
#include <cstdint>

#include "stability/decisions.hpp"
#include "stability/guard.hpp"
#include "stability/posture.hpp"

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

/// Equal, or both along one axis: decided without arithmetic.
bool surely_parallel(const Vec2<double>& a, const Vec2<double>& b) {
  return same(a, b) || (a.x == 0 && b.x == 0) || (a.y == 0 && b.y == 0);
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
            static_cast<std::int8_t>(opening_sign(position_[i], position_[l], normal_[l], given_normal_[l]));
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
  spec.i = static_cast<std::int8_t>(i);
  spec.sense = static_cast<std::int8_t>(sense);
}

/// The sign of n_i x n_j.
int Posture::normal_cross_sign(int i, int j) const {
  if (surely_parallel(given_normal_[i], given_normal_[j])) return 0;
  const double bound = 4 * unit_roundoff + underflow_slack;  // components of at most 1: 2 u of 2
  return certain_sign(cross(normal_[i], normal_[j]), bound,
                      [&] { return cross(normal<Dyadic>(i), normal<Dyadic>(j)); });
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
    spec.i = static_cast<std::int8_t>(i);
    spec.sigma_i = static_cast<std::int8_t>(sigma);
    spec.row_vanishes = vanishes;
  }
}

/// The sign of N_3 . (N_1 x N_2).
void Posture::find_triple_sign() {
  if (surely_parallel(given_normal_[0], given_normal_[1]) && surely_parallel(given_normal_[0], given_normal_[2]))
    return;
  const double value = opening_of_slide(offset<double>(0, 1), offset<double>(0, 2), normal_[0], normal_[1], normal_[2]);
  // Two products of cross products (3 u of the spread from contact 1 and 2 u of 2): 8 u of 4 spread.
  const double bound = 128 * unit_roundoff * spread_ + underflow_slack;
  triple_sign_ = static_cast<std::int8_t>(certain_sign(value, bound, [&] {
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
      spec.i = static_cast<std::int8_t>(i);
      spec.j = static_cast<std::int8_t>(j);
      spec.sigma_i = static_cast<std::int8_t>(sigma_i);
      spec.sigma_j = static_cast<std::int8_t>(sigma_j);
      spec.sense = static_cast<std::int8_t>(sense);
    }
}

}  // namespace surefoot::stability
