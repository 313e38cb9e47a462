// The modes of a posture as functions of the COM: rows as polynomials (rows.hpp on Poly2), the margin by which a mode
// is feasible in a box of wrenches, and the curves on which that margin vanishes.
//
// Wrenches. The box is scaled to |u| <= 1, |w| <= 1: p = p0 + kappa u, q = q0 + nu w. A row is then the form
// one + u U + w W with three polynomials; a side without extent has U = 0 or W = 0. Any centre (p0, q0) is allowed, so
// that one wrench and a box are one case.
//
// Margin. m(x) = max over the box of the least row (each row scaled to size 1 at x). A mode is feasible iff m > 0.
// The maximum is a vertex of a linear program in (u, w, m): one row at a corner of W, two rows on a side, or three rows
// inside. Its dual gives multipliers y >= 0 with sum y_k row_k <= m on the whole box: with y fixed, that sum is of
// degree 2 in x, which bounds the mode on lines and in rectangles.
//
// Curves. m = 0 is there
//   one row at a corner      one + u U + w W = 0                         degree 2
//   two rows on a side       e_i f_j - e_j f_i = 0 (e: on the side, f: slot of the free coordinate)   degree <= 4
//   three rows inside        det (one, U, W)_{ijk} = 0                   degree <= 6
// and the denominator D = 0 of a sliding mode (degree 2), where the sign of all its rows changes.
//
// Doubles throughout; relative rounding only. What is decided here is confirmed by the oracle (region.hpp).
#pragma once

#include <Eigen/Core>
#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stability/dual_certificate.hpp"
#include "stability/posture.hpp"
#include "stability/region_bivariate.hpp"

namespace surefoot::stability {

/// Rows equal to within this, relative to their size, count as equal: rounding of a row in doubles is below 1e-14.
constexpr double equal_rows = 1e-12;

/// Wrenches (p, q) with |p - centre.p| <= kappa, |q - centre.q| <= nu.
struct WrenchBox {
  Wrench centre;
  double kappa = 0;  ///< >= 0
  double nu = 0;     ///< [m], >= 0
  bool one_wrench() const { return kappa == 0 && nu == 0; }
  bool centred() const { return centre.p == 0 && centre.q == 0; }
};

/// What a row of a mode demands; vanishing on the curves that the row gives.
enum class RowMeaning : unsigned char {
  lifts,   ///< contact `i` lifts off
  turns,   ///< the sense of the rotation about contact `i`
  cone_u,  ///< the force at `i` stays on the near side of edge u of its cone
  cone_w,  ///< likewise edge w
  slides,  ///< contact `i` slides in the sense of the mode
  pushes,  ///< the force at `i` is positive
  moves,   ///< the sense of the motion of two slides
};

/// A row over the scaled box.
template <class V>
struct Form {
  V u, one, w;
};

struct RegionRow {
  Form<Poly2> form;
  RowMeaning meaning{};
  std::int8_t contact = 0;
};

struct RegionMode {
  ModeSpec spec{};
  ContactMode mode;
  int count = 0;
  std::array<RegionRow, 6> row;
  bool impossible = false;  ///< the rows exclude each other for every COM
  bool has_denominator = false;
  Poly2 denominator;
};

/// Which curve bounds: of a mode (kind corner, side, inside, denominator) or of R_SS(W) (kind edge, number in a).
struct CurveId {
  enum Kind : std::int8_t { corner, side, inside, denominator, edge } kind = corner;
  std::int8_t mode = -1;
  std::int8_t a = -1, b = -1, c = -1;  ///< rows, ascending; edge: its number
  int row(int k) const { return k == 0 ? a : k == 1 ? b : c; }
  /// corner: bit 0 set for u = +1, bit 1 for w = +1; side: 0..3 for u = -1, u = +1, w = -1, w = +1
  std::int8_t place = 0;
  friend auto operator<=>(const CurveId&, const CurveId&) = default;  // NOLINT(modernize-use-nullptr): there is none
};

/// The curve of a basis from rows in any number type.
template <class V, class RowAt>
V curve_value(const CurveId& id, RowAt&& row) {
  switch (id.kind) {
    case CurveId::corner: {
      const Form<V> f = row(id.a);
      return f.one + f.u * (id.place & 1 ? 1.0 : -1.0) + f.w * (id.place & 2 ? 1.0 : -1.0);
    }
    case CurveId::side: {
      const Form<V> f = row(id.a), g = row(id.b);
      const double end = id.place & 1 ? 1.0 : -1.0;
      if (id.place < 2) return (f.one + f.u * end) * g.w - (g.one + g.u * end) * f.w;
      return (f.one + f.w * end) * g.u - (g.one + g.w * end) * f.u;
    }
    default: {
      const Form<V> f = row(id.a), g = row(id.b), h = row(id.c);
      return f.one * (g.u * h.w - g.w * h.u) - f.u * (g.one * h.w - g.w * h.one) + f.w * (g.one * h.u - g.u * h.one);
    }
  }
}

/// All modes of a posture in coordinates x = origin + s e_s + t e_t.
class RegionModes {
 public:
  /// e_t a unit vector; e_s is perpendicular to it.
  RegionModes(const Posture& posture, const WrenchBox& box, const Eigen::Vector2d& origin, const Eigen::Vector2d& e_t);
  RegionModes(const RegionModes&) = delete;
  RegionModes& operator=(const RegionModes&) = delete;

  std::span<const RegionMode> modes() const { return modes_; }
  /// The polynomial of a curve about (s, t): value, gradient, second derivatives.
  Poly2 curve(const CurveId& id, double s, double t) const;
  Eigen::Vector2d position(double s, double t) const { return origin_ + s * e_s_ + t * e_t_; }
  Eigen::Vector2d local(const Eigen::Vector2d& x) const { return {(x - origin_).dot(e_s_), (x - origin_).dot(e_t_)}; }
  /// Numbers the lines a + b s + c t >= 0 that CurveId::edge names.
  void set_edges(std::vector<Poly2> edges) { edges_ = std::move(edges); }
  const std::vector<Poly2>& edges() const { return edges_; }

  const Posture& posture() const { return posture_; }
  const WrenchBox& box() const { return box_; }
  const DualCertificate& certificate(int index) const { return certificates_[index]; }
  /// Unit vectors along which s and t grow.
  const Eigen::Vector2d& e_s() const { return e_s_; }
  const Eigen::Vector2d& e_t() const { return e_t_; }

 private:
  void add(const Frame<Poly2>& frame, const ModeSpec& spec, int contacts);

  Posture posture_;
  WrenchBox box_;
  LineFrame line_;
  std::vector<DualCertificate> certificates_;  // of each mode, with line_
  Eigen::Vector2d origin_, e_s_, e_t_;
  std::vector<RegionMode> modes_;
  std::vector<Poly2> edges_;
};

/// The curve in words: "UF: foot 2 lifts off, p = +kappa, q = -nu".
std::string curve_in_words(const RegionMode& mode, const CurveId& id, const WrenchBox& box);

}  // namespace surefoot::stability
