// A set of 1 to 3 contacts with all that does not depend on the COM: scaled normals, cone edges, the facets of the
// equilibrium cone, and the list of non-static modes that the geometry of these contacts allows for any COM.
// Every decision made here is exact for the doubles given.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "stability/contact.hpp"
#include "stability/rows.hpp"

namespace surefoot::stability {

/// A facet of the contact wrench cone [theory section 3]: the plane through rays `a` and `b` (ray 2 i + edge), with the
/// inner normal z about contact 1's position. z = sign * (ray a x ray b).
struct Facet {
  Row<double> z;
  std::int8_t a, b, sign;
};

inline Vec2<Dyadic> exactly(const Vec2<double>& v) { return {v.x, v.y}; }
inline Vec2<Dyadic> exactly(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

/// The same direction and size.
inline bool same(const Vec2<double>& a, const Vec2<double>& b) { return a.x == b.x && a.y == b.y; }

class Posture {
 public:
  static constexpr int most_modes = 22;  // of three contacts: all break, 3 rolls, 6 slides, 12 pairs of slides
  enum class Modes { listed, deferred };
  /// Throws std::invalid_argument for a count outside 1..3. Asserts on non-finite numbers, negative friction, zero
  /// normals, rho <= 0 (RobustOracle throws).
  explicit Posture(std::span<const Contact> contacts, double radius_of_gyration, Modes modes = Modes::listed);
  /// To be called once before modes() and turn_sign() if the modes were deferred.
  void list_modes();

  int contacts() const { return count_; }
  /// True if the cone has no interior (all rays in one plane or on one line): nothing robust, never an equilibrium.
  bool flat_cone() const { return flat_cone_; }
  std::span<const Facet> facets() const { return {facets_.data(), static_cast<std::size_t>(facet_count_)}; }
  std::span<const ModeSpec> modes() const { return {modes_.data(), static_cast<std::size_t>(mode_count_)}; }
  /// Error bound of facet normals: z.q of facet_error, z.p and z.one of facet_error * spread() [m].
  double facet_error() const { return facet_error_; }
  double spread() const { return spread_; }          ///< greatest |d_x| + |d_y| of contacts from contact 1 [m]
  double edge_bound() const { return edge_bound_; }  ///< a = 1 + max mu
  double rho() const { return rho_; }
  double rho2() const { return rho2_; }
  const Eigen::Vector2d& position(int i) const { return position_[i]; }

  /// sign of (x_l - x_i) x n_l: does contact l open (+1) when the body turns about contact i?
  int turn_sign(int i, int l) const { return turn_sign_[i][l]; }
  /// Normals (scaled for doubles, as given for exact numbers) and x_l - x_i.
  template <class K>
  Vec2<K> normal(int i) const;
  template <class K>
  Vec2<K> offset(int i, int l) const;

  Frame<double> frame(const Eigen::Vector2d& com) const;
  Frame<Dual> dual_frame(const Eigen::Vector2d& com) const;
  Frame<Dyadic> exact_frame(const Eigen::Vector2d& com) const;
  /// At from + lambda (to - from), which need not be a point of doubles: r = (x_i - from) + lambda (from - to).
  Frame<double> frame(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) const;
  Frame<Dyadic> exact_frame(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) const;
  /// The inner normal of a facet, exactly.
  Row<Dyadic> exact_facet(const Facet& facet) const;

 private:
  void find_facets();
  template <int rays>
  void find_facets_of();
  int exact_side(int a, int b, int c) const;
  bool parallel(int a, int b) const;
  bool is_new_plane(int a, int b, unsigned coplanar) const;
  void find_triple_sign();
  void list_slides(int i);
  int opening_of_third(int i, int j, int l) const;
  int normal_cross_sign(int i, int j) const;
  void list_two_slides(int i, int j);
  void add_roll(int i);
  ModeSpec& add_mode(ModeSpec::Kind kind);

  int count_;
  int facet_count_ = 0, mode_count_ = 0;
  bool flat_cone_ = true;
  double rho_, rho2_;
  double edge_bound_ = 1, facet_error_ = 0, spread_ = 0;
  std::array<Eigen::Vector2d, 3> position_;
  std::array<Vec2<double>, 3> normal_;        // scaled by a power of two to components of at most 1
  std::array<Vec2<double>, 3> given_normal_;  // as given: what exact decisions use
  std::array<double, 3> friction_;
  std::array<Row<double>, 6> rays_;  // about contact 1: (C, d x C)
  std::array<Facet, 15> facets_;
  std::array<ModeSpec, most_modes>
      modes_;  // the first mode_count_ of them; likewise facets_: the rest is left uninitialised
  std::array<std::array<std::int8_t, 3>, 3> turn_sign_{};
  std::int8_t triple_sign_ = 0;  // of N_3 . (N_1 x N_2)
};

template <>
inline Vec2<double> Posture::normal<double>(int i) const {
  return normal_[i];
}
template <>
inline Vec2<Dyadic> Posture::normal<Dyadic>(int i) const {
  return {Dyadic(given_normal_[i].x), Dyadic(given_normal_[i].y)};
}
template <>
inline Vec2<double> Posture::offset<double>(int i, int l) const {
  return {position_[l].x() - position_[i].x(), position_[l].y() - position_[i].y()};
}
template <>
inline Vec2<Dyadic> Posture::offset<Dyadic>(int i, int l) const {
  return {Dyadic(position_[l].x()) - Dyadic(position_[i].x()), Dyadic(position_[l].y()) - Dyadic(position_[i].y())};
}

}  // namespace surefoot::stability
