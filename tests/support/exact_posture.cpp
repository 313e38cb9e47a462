#include "tests/support/exact_posture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace surefoot::testing {
namespace {

Integer shifted(Integer value, int bits) { return bits >= 0 ? Integer(value << bits) : Integer(value >> -bits); }
Integer in_units(const Dyadic& value, int exponent) {
  return value.mantissa == 0 ? Integer(0) : shifted(Integer(value.mantissa), value.exponent - exponent);
}
/// The greatest unit of which both are multiples: the exponent to give to in_units.
int finest(const Dyadic& value, int exponent) {
  return value.mantissa == 0 ? exponent : std::min(exponent, value.exponent);
}
constexpr int no_unit = 1 << 20;

Form scaled(const Form& a, const Integer& factor) { return {a.p * factor, a.one * factor, a.q * factor}; }
Form sum(const Form& a, const Form& b) { return {a.p + b.p, a.one + b.one, a.q + b.q}; }
Form difference(const Form& a, const Form& b) { return {a.p - b.p, a.one - b.one, a.q - b.q}; }
bool vanishes(const Form& a) { return a.p.is_zero() && a.one.is_zero() && a.q.is_zero(); }

bool slides(ContactState state) { return state == ContactState::slides_along || state == ContactState::slides_against; }
/// Sliding along +t loads n - mu t, along -t the other edge: n - sigma mu t.
int sigma(ContactState state) { return state == ContactState::slides_along ? 1 : -1; }

/// one (n -+ mu t), from the two products with n and t.
Integer edge(const ExactFrame::At& at, int side, const Integer& with_n, const Integer& with_t) {
  return side > 0 ? Integer(at.one * with_n - at.mu * with_t) : Integer(at.one * with_n + at.mu * with_t);
}
Form edge_wrench(const ExactFrame::At& at, int side) {
  const Form n = scaled(at.n, at.one), t = scaled(at.t, at.mu);
  return side > 0 ? difference(n, t) : sum(n, t);
}

}  // namespace

Integer dot(const Form& a, const Form& b) { return a.p * b.p + a.one * b.one + a.q * b.q; }
Form cross(const Form& a, const Form& b) {
  return {a.one * b.q - a.q * b.one, a.q * b.p - a.p * b.q, a.p * b.one - a.one * b.p};
}

Dyadic::Dyadic(double value) {
  if (value == 0) return;
  const double fraction = std::frexp(value, &exponent);
  mantissa = static_cast<long>(std::ldexp(fraction, 53));
  const int zeros = std::countr_zero(static_cast<unsigned long>(mantissa));
  mantissa >>= zeros;  // exact: the bits shifted out are zeros
  exponent += zeros - 53;
}

ExactCom::ExactCom(const Eigen::Vector2d& com) {
  const Dyadic dx(com.x()), dy(com.y());
  exponent = finest(dx, finest(dy, no_unit));
  if (exponent == no_unit) exponent = 0;
  x = in_units(dx, exponent);
  y = in_units(dy, exponent);
}

ExactCom::ExactCom(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) {
  ExactCom a(from), b(to);
  const int unit = std::min(a.exponent, b.exponent);
  a = a.in_unit(unit);
  b = b.in_unit(unit);
  const Dyadic part(lambda);
  const int fine = std::min(part.exponent, 0);
  const Integer share = in_units(part, fine);
  x = shifted(a.x, -fine) + share * (b.x - a.x);
  y = shifted(a.y, -fine) + share * (b.y - a.y);
  exponent = unit + fine;
}

ExactCom ExactCom::in_unit(int unit) const {
  ExactCom com = *this;
  com.x = shifted(x, exponent - unit);
  com.y = shifted(y, exponent - unit);
  com.exponent = unit;
  return com;
}

ExactPosture::ExactPosture(const SamplePosture& sample)
    : count_(static_cast<int>(sample.contacts.size())), rho_(sample.rho), kappa_(sample.box.kappa), nu_(sample.box.nu) {
  for (int i = 0; i < count_; ++i) {
    const Contact& contact = sample.contacts[i];
    for (int k = 0; k < 2; ++k)
      position_[i][k] = Dyadic(contact.position[k]), normal_[i][k] = Dyadic(contact.normal[k]);
    friction_[i] = Dyadic(contact.friction);
  }
  // What is asked of this frame does not depend on the COM: ranks, and signs of products of wrenches with twists.
  const ExactFrame anywhere = frame(ExactCom(sample.contacts[0].position));
  find_facets(anywhere);
  list_modes(anywhere);
}

ExactFrame ExactPosture::frame(const ExactCom& com) const {
  int unit = finest(rho_, finest(nu_, com.exponent));
  for (int i = 0; i < count_; ++i) unit = finest(position_[i][0], finest(position_[i][1], unit));
  const Integer com_x = shifted(com.x, com.exponent - unit), com_y = shifted(com.y, com.exponent - unit);
  const Integer rho = in_units(rho_, unit), rho2 = rho * rho;
  ExactFrame frame;
  frame.count = count_;
  for (int i = 0; i < count_; ++i) {
    ExactFrame::At& at = frame.at[i];
    const Integer x = in_units(position_[i][0], unit) - com_x, y = in_units(position_[i][1], unit) - com_y;
    const int normal_unit = finest(normal_[i][0], finest(normal_[i][1], no_unit));
    const Integer nx = in_units(normal_[i][0], normal_unit), ny = in_units(normal_[i][1], normal_unit);
    at.n = {nx, ny, x * ny - y * nx};
    at.t = {ny, -nx, -(x * nx) - y * ny};
    at.mass_n = {rho2 * at.n.p, rho2 * at.n.one, at.n.q};
    at.mass_t = {rho2 * at.t.p, rho2 * at.t.one, at.t.q};
    const int friction_unit = finest(friction_[i], 0);
    at.mu = in_units(friction_[i], friction_unit);
    at.one = shifted(1, -friction_unit);
  }
  for (int i = 0; i < count_; ++i) {
    for (int j = 0; j < count_; ++j) {
      frame.nt[i][j] = dot(frame.at[i].n, frame.at[j].mass_t);
      frame.nn[i][j] = j < i ? frame.nn[j][i] : dot(frame.at[i].n, frame.at[j].mass_n);
      frame.tt[i][j] = j < i ? frame.tt[j][i] : dot(frame.at[i].t, frame.at[j].mass_t);
    }
  }
  const int kappa_unit = finest(kappa_, 0);
  const Integer kappa = in_units(kappa_, kappa_unit), one = shifted(1, -kappa_unit), nu = in_units(nu_, unit) * one;
  frame.corners = {Form{-kappa, one, -nu}, Form{kappa, one, -nu}, Form{kappa, one, nu}, Form{-kappa, one, nu}};
  return frame;
}

// ---- equilibrium ------------------------------------------------------------------------------------------------

namespace {
Form ray(const ExactFrame& frame, int k) { return edge_wrench(frame.at[k / 2], k % 2 == 0 ? 1 : -1); }
}  // namespace

/// Facets by definition: the plane of two rays with every ray on one side [theory section 3].
void ExactPosture::find_facets(const ExactFrame& frame) {
  std::vector<Form> rays;
  for (int k = 0; k < 2 * count_; ++k) rays.push_back(ray(frame, k));
  for (int a = 0; a < 2 * count_; ++a) {
    for (int b = a + 1; b < 2 * count_; ++b) {
      const Form z = cross(rays[a], rays[b]);
      if (vanishes(z)) continue;
      bool above = false, below = false;
      for (const Form& other : rays) {
        const int side = dot(z, other).sign();
        above |= side > 0;
        below |= side < 0;
      }
      full_rank_ |= above || below;
      if (!below) facets_.push_back({a, b, 1});
      if (!above) facets_.push_back({a, b, -1});
    }
  }
}

int ExactPosture::facet_sign(const ExactFrame& frame, int facet, int corner) const {
  const Facet& f = facets_[facet];
  return f.sign * dot(cross(ray(frame, f.a), ray(frame, f.b)), frame.corners[corner]).sign();
}

bool ExactPosture::equilibrium(const ExactFrame& frame) const {
  if (!full_rank_) return false;
  for (const Facet& f : facets_) {
    const Form z = cross(ray(frame, f.a), ray(frame, f.b));
    for (const Form& corner : frame.corners)
      if (f.sign * dot(z, corner).sign() <= 0) return false;
  }
  return true;
}

// ---- contact modes ----------------------------------------------------------------------------------------------

/// Which kinematic rows vanish for every COM, and whether two slides can go together at all. Covectors that read 0 on
/// all twists the equations allow lie in the span of the equations.
ExactMode ExactPosture::analysed(const ContactMode& mode, const ExactFrame& frame) const {
  ExactMode result{mode, {-1, -1}, true, 0};
  int staying = 0;
  for (int i = 0; i < count_; ++i)
    if (mode.at[i] != ContactState::breaks) result.staying[staying++] = i;
  if (staying == 0) return result;
  const int i = result.staying[0], j = result.staying[1];
  const Form& first = frame.at[i].n;
  if (staying == 1 && slides(mode.at[i])) {
    for (int l = 0; l < count_; ++l)
      if (l != i && vanishes(cross(first, frame.at[l].n))) result.dropped |= 1u << l;
    return result;
  }
  const Form twist = cross(first, staying == 2 ? frame.at[j].n : frame.at[i].t);  // the only one, up to a factor
  result.possible = !vanishes(twist);
  bool along = false, against = false;
  for (int l = 0; l < count_; ++l) {
    const bool breaks = mode.at[l] == ContactState::breaks;
    if (!breaks && staying == 1) continue;  // a roll has no kinematic row of its own
    const int rate = breaks ? dot(frame.at[l].n, twist).sign() : sigma(mode.at[l]) * dot(frame.at[l].t, twist).sign();
    along |= rate > 0;
    against |= rate < 0;
    if (rate == 0) result.dropped |= 1u << l;
  }
  result.possible &= !(along && against);
  if (staying == 2 &&
      vanishes(cross(edge_wrench(frame.at[i], sigma(mode.at[i])), edge_wrench(frame.at[j], sigma(mode.at[j])))))
    result.dropped = 7;  // both forces on one line of action: D xi = 0 for every COM
  return result;
}

void ExactPosture::list_modes(const ExactFrame& frame) {
  for (const ContactMode& mode : non_static_modes(count_)) {
    const ExactMode entry = analysed(mode, frame);
    if (entry.possible) modes_.push_back(entry);
  }
}

namespace {

/// Forces over the denominator d as forms in v, and the row that a covector reads.
struct Solution {
  Integer d = 1;
  std::array<Form, 2> force;
};

// Sides of the loaded edges; for a roll the two forces are along n and t.
Solution solve(const ExactFrame& frame, const ExactMode& mode) {
  const auto& [i, j] = mode.staying;
  const ExactFrame::At& a = frame.at[i];
  if (j < 0 && slides(mode.mode.at[i]))
    return {edge(a, sigma(mode.mode.at[i]), frame.nn[i][i], frame.nt[i][i]), {a.mass_n, {}}};
  const bool roll = j < 0;
  const auto entry = [&](int equation, int force) {  // N_equation . M* (edge of force)
    return edge(frame.at[force], sigma(mode.mode.at[force]), frame.nn[equation][force], frame.nt[equation][force]);
  };
  const Integer a11 = roll ? frame.nn[i][i] : entry(i, i), a12 = roll ? frame.nt[i][i] : entry(i, j);
  const Integer a21 = roll ? frame.nt[i][i] : entry(j, i), a22 = roll ? frame.tt[i][i] : entry(j, j);
  const Form &first = a.mass_n, &second = roll ? a.mass_t : frame.at[j].mass_n;
  return {a11 * a22 - a12 * a21,
          {difference(scaled(first, a22), scaled(second, a12)), difference(scaled(second, a11), scaled(first, a21))}};
}

/// -d M* c + sum (c . M* g_a) force_a for the covector c = N_l, or c = T_l where `tangent`.
Form reading(const ExactFrame& frame, const ExactMode& mode, const Solution& solution, int l, bool tangent) {
  Form row = scaled(tangent ? frame.at[l].mass_t : frame.at[l].mass_n, -solution.d);
  for (int a = 0; a < 2 && mode.staying[a] >= 0; ++a) {
    const int m = mode.staying[a];
    const Integer with_n = tangent ? frame.nt[m][l] : frame.nn[l][m],
                  with_t = tangent ? frame.tt[l][m] : frame.nt[l][m];
    if (mode.mode.at[m] == ContactState::rolls)
      return sum(row, sum(scaled(solution.force[0], with_n), scaled(solution.force[1], with_t)));
    row = sum(row, scaled(solution.force[a], edge(frame.at[m], sigma(mode.mode.at[m]), with_n, with_t)));
  }
  return row;
}

void add_forces(const ExactFrame& frame, const ExactMode& mode, const Solution& solution, std::vector<Form>& rows) {
  const auto& [i, j] = mode.staying;
  if (i < 0) return;
  if (mode.mode.at[i] == ContactState::rolls) {
    const Form normal = scaled(solution.force[0], frame.at[i].mu),
               tangential = scaled(solution.force[1], frame.at[i].one);
    rows.push_back(sum(normal, tangential));
    rows.push_back(difference(normal, tangential));
    return;
  }
  for (int a = 0; a < (j < 0 ? 1 : 2); ++a) rows.push_back(solution.force[a]);
}

void add_readings(const ExactFrame& frame, const ExactMode& mode, const Solution& solution, std::vector<Form>& rows) {
  for (int l = 0; l < frame.count; ++l) {
    const ContactState state = mode.mode.at[l];
    if (state == ContactState::rolls || (mode.dropped >> l & 1u)) continue;
    Form row = reading(frame, mode, solution, l, slides(state));
    if (state == ContactState::slides_against) row = {-row.p, -row.one, -row.q};
    rows.push_back(row);
  }
}

bool meets_with_denominator(const std::vector<Form>& rows, int d, const std::array<Form, 4>& corners) {
  return (d >= 0 && meets_box(rows, 1, corners)) || (d <= 0 && meets_box(rows, -1, corners));
}

}  // namespace

ModeForms ExactPosture::mode_forms(const ExactFrame& frame, const ExactMode& mode) {
  const Solution solution = mode.staying[0] < 0 ? Solution{} : solve(frame, mode);
  ModeForms forms;
  forms.d = solution.d;
  add_forces(frame, mode, solution, forms.rows);
  add_readings(frame, mode, solution, forms.rows);
  return forms;
}

int ExactPosture::denominator_sign(const ExactFrame& frame, const ExactMode& mode) {
  return mode.staying[0] < 0 ? 1 : solve(frame, mode).d.sign();
}

bool ExactPosture::feasible(const ExactFrame& frame, const ExactMode& mode) const {
  const Solution solution = mode.staying[0] < 0 ? Solution{} : solve(frame, mode);
  std::vector<Form> rows;
  add_forces(frame, mode, solution, rows);
  // Not needed for the answer: forces alone exclude most modes.
  if (!rows.empty() && !meets_with_denominator(rows, solution.d.sign(), frame.corners)) return false;
  add_readings(frame, mode, solution, rows);
  return meets_with_denominator(rows, solution.d.sign(), frame.corners);
}

std::vector<std::string> ExactPosture::feasible_modes(const ExactFrame& frame) const {
  std::vector<std::string> names;
  for (const ExactMode& mode : modes_)
    if (feasible(frame, mode)) names.push_back(mode.mode.name());
  std::sort(names.begin(), names.end());
  return names;
}

bool ExactPosture::robust(const ExactFrame& frame) const {
  return equilibrium(frame) &&
         std::none_of(modes_.begin(), modes_.end(), [&](const ExactMode& mode) { return feasible(frame, mode); });
}

// ---- rows and the box -------------------------------------------------------------------------------------------

namespace {

using Corners = std::array<Integer, 4>;

/// Two rows and the box. Their values map the box to a parallelogram; if it meets the open positive quadrant, it does
/// so at a corner or on a side: follow the direction (1, 1) to its boundary.
bool pair_meets_box(const Corners& a, const Corners& b) {
  for (int c = 0; c < 4; ++c)
    if (a[c].sign() > 0 && b[c].sign() > 0) return true;
  for (int c = 0; c < 4; ++c) {
    int i = c, j = (c + 1) % 4;
    if (a[i].sign() <= 0) std::swap(i, j);
    // On the side, a > 0 next to i and b > 0 next to j; they overlap iff a_i b_j > a_j b_i.
    if (a[i].sign() > 0 && b[j].sign() > 0 && a[i] * b[j] > a[j] * b[i]) return true;
  }
  return false;
}

Integer minor(const Form& a, const Form& b) { return a.p * b.q - a.q * b.p; }

/// Three open half-planes have no common point, though every two have: positive multipliers cancel the gradients and
/// leave a constant that is not positive. (With a pair of opposite gradients that pair fails alone.)
bool triple_is_empty(const Form& a, const Form& b, const Form& c, int sign) {
  const Integer ya = minor(b, c), yb = minor(c, a), yc = minor(a, b);
  const int side = ya.sign();
  if (side == 0 || yb.sign() != side || yc.sign() != side) return false;
  return side * sign * Integer(ya * a.one + yb * b.one + yc * c.one).sign() <= 0;
}

}  // namespace

bool meets_box(const std::vector<Form>& rows, int sign, const std::array<Form, 4>& corners) {
  const std::size_t count = rows.size();
  std::vector<Corners> at(count);
  std::array<bool, 4> all_positive{true, true, true, true};
  for (std::size_t k = 0; k < count; ++k) {
    bool somewhere = false;
    const Integer p = corners[1].p * rows[k].p, one = corners[0].one * rows[k].one, q = corners[2].q * rows[k].q;
    const Integer low = one - q, high = one + q;
    at[k] = {low - p, low + p, high + p, high - p};
    for (int c = 0; c < 4; ++c) {
      if (sign < 0) at[k][c] = -at[k][c];
      const bool positive = at[k][c].sign() > 0;
      somewhere |= positive;
      all_positive[c] &= positive;
    }
    if (!somewhere) return false;
  }
  if (std::find(all_positive.begin(), all_positive.end(), true) != all_positive.end()) return true;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      if (!pair_meets_box(at[a], at[b])) return false;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      for (std::size_t c = b + 1; c < count; ++c)
        if (triple_is_empty(rows[a], rows[b], rows[c], sign)) return false;
  return true;
}

}  // namespace surefoot::testing
