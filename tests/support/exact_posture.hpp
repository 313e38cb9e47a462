// Verdicts in integers, for tests and the exact comparison only: no rounding, no tolerance, no filter in doubles.
//
// Doubles are dyadic: lengths are multiples of one power of two, normals, friction and kappa each of their own, and
// verdicts do not change with the unit of length nor with positive factors of a row. So all rows are polynomials in
// integers. The rows of a mode come from one general solution of the equations of motion instead of closed forms. With
// M* = rho^2 M^-1 = diag(rho^2, rho^2, 1), v = (p, 1, q) = -w, forces phi along the wrenches g_a and equations h_a . xi
// = 0,
//     rho^2 xi = M*(-v + sum phi_a g_a),   A phi = (h_a . M* v)_a,   A_ab = h_a . M* g_b,   a, b <= 2,
// solved by Cramer's rule; the common denominator is D = det A. (By Cauchy-Binet all numerators have degree <= 2 in the
// COM.) Whether rows meet the closed box is decided by Helly's theorem: every two of them and the box, every three of
// them.
//
// Conventions: equilibrium strict; D = 0 tests both signs; a kinematic row that vanishes for every COM is dropped, one
// that happens to vanish at this COM is not positive; two slides whose normals are on one line, or whose directions no
// twist has, do not exist.
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <string>
#include <vector>

#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

/// mantissa * 2^exponent; the mantissa is odd or 0.
struct Dyadic {
  long mantissa = 0;
  int exponent = 0;
  Dyadic() = default;
  explicit Dyadic(double value);
};

/// The linear form G . (p, 1, q), or a spatial vector.
struct Form {
  Integer p, one, q;
};

/// A mode with what the contacts alone say about it.
struct ExactMode {
  ContactMode mode;
  int staying[2] = {-1, -1};  ///< contacts that do not break
  bool possible = true;
  unsigned dropped = 0;  ///< bit l: the kinematic row of contact l vanishes for every COM
};

/// Numerators over the common denominator d (1 where there is none). A mode asks for all of them to have the sign of d.
struct ModeForms {
  Integer d = 1;
  std::vector<Form> rows;
};

/// Everything about one COM.
struct ExactFrame {
  struct At {
    Form n, t;            // the covectors (n, r x n), (t, r x t)
    Form mass_n, mass_t;  // M* n, M* t
    Integer mu, one;      // friction mu / one
  };
  int count = 0;
  std::array<At, 3> at;
  std::array<std::array<Integer, 3>, 3> nn, nt, tt;  // N_i . M* N_j, N_i . M* T_j, T_i . M* T_j
  std::array<Form, 4> corners;                       // of the box, in order around it, times a positive number
};

/// A point of the plane: (x, y) * 2^exponent.
struct ExactCom {
  Integer x, y;
  int exponent = 0;
  explicit ExactCom(const Eigen::Vector2d& com);
  /// from + lambda (to - from)
  ExactCom(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda);
  /// The same point; `unit` is at most `exponent`.
  ExactCom in_unit(int unit) const;
};

class ExactPosture {
 public:
  /// Contacts, radius of gyration and box of `sample`; its COM is not looked at.
  explicit ExactPosture(const SamplePosture& sample);

  const std::vector<ExactMode>& modes() const { return modes_; }
  ExactFrame frame(const ExactCom& com) const;

  bool equilibrium(const ExactFrame& frame) const;
  bool feasible(const ExactFrame& frame, const ExactMode& mode) const;
  std::vector<std::string> feasible_modes(const ExactFrame& frame) const;
  bool robust(const ExactFrame& frame) const;
  /// The sign of the denominator D of a mode.
  static int denominator_sign(const ExactFrame& frame, const ExactMode& mode);
  /// Facets z (kept as two rays) and their least value over the box: negative, zero, positive.
  int facet_count() const { return static_cast<int>(facets_.size()); }
  int facet_sign(const ExactFrame& frame, int facet, int corner) const;

  static ModeForms mode_forms(const ExactFrame& frame, const ExactMode& mode);

 private:
  struct Facet {
    int a, b, sign;
  };
  void find_facets(const ExactFrame& frame);
  void list_modes(const ExactFrame& frame);
  ExactMode analysed(const ContactMode& mode, const ExactFrame& frame) const;

  int count_;
  std::array<std::array<Dyadic, 2>, 3> position_, normal_;
  std::array<Dyadic, 3> friction_;
  Dyadic rho_, kappa_, nu_;
  bool full_rank_ = false;
  std::vector<Facet> facets_;
  std::vector<ExactMode> modes_;
};

/// Does some point of the closed box (given by its corners) make sign * row positive for every row?
bool meets_box(const std::vector<Form>& rows, int sign, const std::array<Form, 4>& corners);

Integer dot(const Form& a, const Form& b);
Form cross(const Form& a, const Form& b);

}  // namespace surefoot::testing
