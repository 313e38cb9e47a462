#include "stability/region_rows.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

// Rows equal to within this, relative to their size, count as equal: rounding of a row in doubles is below 1e-14.
constexpr double equal_rows = 1e-12;

/// Takes rows of rows.hpp as polynomials, with the centre of the box moved to (0, 0) and its sides scaled to 1.
class PolySink {
 public:
  PolySink(RegionMode& mode, const WrenchBox& box) : mode_(mode), box_(box) {}
  void denominator(const Poly2& d) {
    mode_.has_denominator = true;
    mode_.denominator = d;
  }
  bool add(const Row<Poly2>& row) {
    const Poly2 one = row.one + row.p * box_.centre.p + row.q * box_.centre.q;
    const double given = std::max({row.p.size(), row.one.size(), row.q.size()});
    if (!(given > 0)) {  // theory section 4: a row that vanishes is dropped
      mode_.row[mode_.count++] = {};
      return false;
    }
    mode_.row[mode_.count++].form = {row.p * box_.kappa, one, row.q * box_.nu};
    const Form<Poly2>& scaled = mode_.row[mode_.count - 1].form;
    if (!(std::max({scaled.u.size(), scaled.one.size(), scaled.w.size()}) > 0)) mode_.impossible = true;  // 0 > 0 on all of W
    return false;
  }
  bool add_length(const Row<Poly2>& row) { return add(row); }

 private:
  RegionMode& mode_;
  const WrenchBox& box_;
};

/// Meanings in the order in which emit_rows hands out rows.
void name_rows(RegionMode& mode, int contacts) {
  int k = 0;
  const auto name = [&](RowMeaning meaning, int contact) {
    mode.row[k].meaning = meaning;
    mode.row[k++].contact = static_cast<signed char>(contact);
  };
  const ModeSpec& spec = mode.spec;
  switch (spec.kind) {
    case ModeSpec::Kind::all_break:
      for (int l = 0; l < contacts; ++l) name(RowMeaning::lifts, l);
      return;
    case ModeSpec::Kind::roll:
      if (spec.sense != 0) name(RowMeaning::turns, spec.i);
      name(RowMeaning::cone_w, spec.i);
      name(RowMeaning::cone_u, spec.i);
      return;
    case ModeSpec::Kind::slide:
      name(RowMeaning::slides, spec.i);
      for (int l = 0; l < contacts; ++l)
        if (l != spec.i && !spec.row_vanishes[l]) name(RowMeaning::lifts, l);
      name(RowMeaning::pushes, spec.i);
      return;
    case ModeSpec::Kind::two_slides:
      if (spec.sense != 0) name(RowMeaning::moves, spec.i);
      name(RowMeaning::pushes, spec.i);
      name(RowMeaning::pushes, spec.j);
      return;
  }
}

double size_of(const Form<Poly2>& f) { return std::max({f.u.size(), f.one.size(), f.w.size()}); }

bool nearly_equal(const Poly2& a, const Poly2& b) { return (a - b).size() <= equal_rows; }

/// The covectors sigma T_i, N_l and N_i of a slide.
void add_covectors(RegionMode& mode, const Frame<Poly2>& frame, const WrenchBox& box) {
  const ModeSpec& spec = mode.spec;
  const ContactTerms<Poly2>& at = frame.at[spec.i];
  const int edge = loaded_edge(spec.sigma_i);
  const auto add = [&](const ContactTerms<Poly2>& where, const Vec2<double>& a) {
    const Poly2 moment = cross(where.r, a);
    const double p = frame.rho2 * a.x, one = frame.rho2 * a.y;
    mode.covector[mode.covectors++] = {
        {Poly2(p * box.kappa), moment * box.centre.q + Poly2(one + p * box.centre.p), moment * box.nu},
        moment * at.sz[edge] + Poly2(frame.rho2 * dot(a, at.edge[edge]))};
  };
  const double sigma = spec.sigma_i;
  add(at, {sigma * at.n.y, -sigma * at.n.x});
  for (int l = 0; l < frame.contacts; ++l)
    if (l != spec.i && !spec.row_vanishes[l]) add(frame.at[l], frame.at[l].n);
  add(at, at.n);
}

/// Rows scaled to size 1; those that vanish identically or repeat an earlier one are left out. Two rows that are
/// opposite everywhere exclude the mode for every COM.
void tidy(RegionMode& mode) {
  int kept = 0;
  for (int k = 0; k < mode.count; ++k) {
    RegionRow row = mode.row[k];
    const double size = size_of(row.form);
    if (!(size > 0)) continue;
    row.form = {row.form.u * (1 / size), row.form.one * (1 / size), row.form.w * (1 / size)};
    const auto same = [&](const RegionRow& other) {
      return nearly_equal(row.form.u, other.form.u) && nearly_equal(row.form.one, other.form.one) &&
             nearly_equal(row.form.w, other.form.w);
    };
    if (std::any_of(mode.row.begin(), mode.row.begin() + kept, same)) continue;
    const auto opposite = [&](const RegionRow& other) {
      return nearly_equal(row.form.u, -other.form.u) && nearly_equal(row.form.one, -other.form.one) &&
             nearly_equal(row.form.w, -other.form.w);
    };
    if (std::any_of(mode.row.begin(), mode.row.begin() + kept, opposite)) mode.impossible = true;
    mode.row[kept++] = row;
  }
  mode.count = kept;
}

// ---- the margin program -----------------------------------------------------------------------------------------

double value_at(const Form<double>& f, double u, double w) { return f.one + f.u * u + f.w * w; }

/// A slot that is nothing but rounding of a row of size 1 counts as positive, so that labels do not flicker.
double sign_of(double slot) { return slot < -equal_rows ? -1 : 1; }

Margin single(const Form<double>* g, int k) {
  Margin m;
  m.u = sign_of(g[k].u), m.w = sign_of(g[k].w);
  m.value = value_at(g[k], m.u, m.w);
  m.basis = {CurveId::corner, -1, static_cast<signed char>(k), -1, -1,
             static_cast<signed char>((m.u > 0 ? 1 : 0) + (m.w > 0 ? 2 : 0))};
  m.count = 1;
  m.y = {1, 0, 0};
  return m;
}

/// The best point of the box on which rows i and j are equal; false if they are not equal anywhere.
bool pair(const Form<double>* g, int i, int j, Margin& m) {
  const Form<double> h{g[i].u - g[j].u, g[i].one - g[j].one, g[i].w - g[j].w};
  bool found = false;
  const auto offer = [&](double u, double w, int side) {
    const double value = value_at(g[i], u, w);
    if (found && value <= m.value) return;
    found = true;
    m.u = u, m.w = w, m.value = value;
    m.basis.place = static_cast<signed char>(side);
  };
  for (int end : {-1, 1}) {
    const double w = -(h.one + end * h.u) / h.w;
    if (std::abs(w) <= 1 + equal_rows) offer(end, w, end < 0 ? 0 : 1);
    const double u = -(h.one + end * h.w) / h.u;
    if (std::abs(u) <= 1 + equal_rows) offer(u, end, end < 0 ? 2 : 3);
  }
  if (!found) return false;
  m.basis = {CurveId::side, -1, static_cast<signed char>(std::min(i, j)), static_cast<signed char>(std::max(i, j)), -1,
             m.basis.place};
  m.count = 2;
  const bool free_w = m.basis.place < 2;
  const double yi = std::abs(free_w ? g[m.basis.b].w : g[m.basis.b].u);
  const double yj = std::abs(free_w ? g[m.basis.a].w : g[m.basis.a].u);
  if (!(yi + yj > 0)) return false;
  m.y = {yi / (yi + yj), yj / (yi + yj), 0};
  return true;
}

bool triple(const Form<double>* g, int i, int j, int k, Margin& m) {
  int row[3] = {i, j, k};
  std::sort(row, row + 3);
  const Form<double>&f = g[row[0]], &e = g[row[1]], &h = g[row[2]];
  double y[3] = {e.u * h.w - e.w * h.u, h.u * f.w - h.w * f.u, f.u * e.w - f.w * e.u};
  const double sum = y[0] + y[1] + y[2];
  if (!(std::abs(sum) > 0)) return false;
  for (double& part : y) part /= sum;
  if (y[0] < 0 || y[1] < 0 || y[2] < 0) return false;
  // f = e and f = h:
  const double a1 = f.u - e.u, b1 = f.w - e.w, c1 = e.one - f.one, a2 = f.u - h.u, b2 = f.w - h.w, c2 = h.one - f.one;
  const double det = a1 * b2 - a2 * b1;
  m.u = (c1 * b2 - c2 * b1) / det, m.w = (a1 * c2 - a2 * c1) / det;
  if (!(std::abs(m.u) <= 1 + equal_rows && std::abs(m.w) <= 1 + equal_rows)) return false;
  m.value = y[0] * f.one + y[1] * e.one + y[2] * h.one;
  m.basis = {CurveId::inside, -1, static_cast<signed char>(row[0]), static_cast<signed char>(row[1]),
             static_cast<signed char>(row[2]), 0};
  m.count = 3;
  m.y = {y[0], y[1], y[2]};
  return true;
}

/// The optimum of the rows of a basis and one more row that is violated at it: the new row is tight.
Margin enter(const Form<double>* g, const Margin& old, int j) {
  const signed char rows[3] = {old.basis.a, old.basis.b, old.basis.c};
  Margin best = old;
  double best_excess = -HUGE_VAL;
  const auto offer = [&](const Margin& m) {  // the candidate at which no other row is lower
    double least = value_at(g[j], m.u, m.w);
    for (int k = 0; k < old.count; ++k) least = std::min(least, value_at(g[rows[k]], m.u, m.w));
    const double excess = least - m.value;
    if (excess > best_excess + equal_rows || (excess > best_excess - equal_rows && m.value > best.value)) {
      best_excess = excess;
      best = m;
    }
  };
  offer(single(g, j));
  if (best_excess >= -equal_rows) return best;
  Margin m;
  for (int k = 0; k < old.count; ++k)
    if (pair(g, j, rows[k], m)) offer(m);
  for (int k = 0; k < old.count; ++k)
    for (int l = k + 1; l < old.count; ++l)
      if (triple(g, j, rows[k], rows[l], m)) offer(m);
  return best;
}

}  // namespace

Margin margin(const Form<double>* rows, int count) {
  std::array<Form<double>, 6> g;
  std::array<double, 6> size;
  if (count == 0) return {1, {}, 0, 0, 0, {}};
  Margin m;
  m.value = HUGE_VAL;
  for (int k = 0; k < count; ++k) {
    size[k] = std::abs(rows[k].u) + std::abs(rows[k].one) + std::abs(rows[k].w);
    const double scale = size[k] > 0 ? 1 / size[k] : 0;
    g[k] = {rows[k].u * scale, rows[k].one * scale, rows[k].w * scale};
    const double own = g[k].one + std::abs(g[k].u) + std::abs(g[k].w);
    if (own < m.value - equal_rows) {
      m = single(g.data(), k);
      m.value = own;
    }
  }
  constexpr int most_pivots = 24;  // the value falls with each; ties end it
  for (int pivot = 0; pivot < most_pivots; ++pivot) {
    int worst = -1;
    double least = m.value - equal_rows;
    for (int k = 0; k < count; ++k) {
      const double value = value_at(g[k], m.u, m.w);
      if (value < least) least = value, worst = k;
    }
    if (worst < 0) break;
    m = enter(g.data(), m, worst);
  }
  // Rows that depend on each other have margin 0; rounding must not make that feasible.
  constexpr double no_margin = 1e-14;  // of rows of size 1
  if (m.value < no_margin) m.value = std::min(m.value, 0.0);
  const signed char basis[3] = {m.basis.a, m.basis.b, m.basis.c};
  for (int k = 0; k < m.count; ++k) m.y[k] = size[basis[k]] > 0 ? m.y[k] / size[basis[k]] : 0;
  return m;
}

// ---- modes ------------------------------------------------------------------------------------------------------

RegionModes::RegionModes(const Posture& posture, const WrenchBox& box, const Vector2d& origin, const Vector2d& e_t)
    : box_(box), origin_(origin), e_s_(e_t.y(), -e_t.x()), e_t_(e_t) {
  const Frame<double> base = posture.frame(origin);
  Frame<Poly2> frame;
  frame.rho2 = base.rho2;
  frame.contacts = base.contacts;
  for (int i = 0; i < base.contacts; ++i) {
    const ContactTerms<double>& from = base.at[i];
    ContactTerms<Poly2>& to = frame.at[i];
    to.n = from.n, to.edge = from.edge, to.mu = from.mu;
    to.r = {Poly2(from.r.x, -e_s_.x(), -e_t_.x()), Poly2(from.r.y, -e_s_.y(), -e_t_.y())};
    to.nz = cross(to.r, to.n);
    for (int e : {edge_u, edge_w}) to.sz[e] = cross(to.r, to.edge[e]);
  }
  modes_.reserve(posture.modes().size());
  for (const ModeSpec& spec : posture.modes()) add(frame, spec, posture.contacts());
}

void RegionModes::add(const Frame<Poly2>& frame, const ModeSpec& spec, int contacts) {
  RegionMode& mode = modes_.emplace_back();
  mode.spec = spec;
  mode.mode = contact_mode(spec, contacts);
  PolySink sink(mode, box_);
  emit_rows(frame, spec, sink);
  name_rows(mode, contacts);
  tidy(mode);
  if (spec.kind == ModeSpec::Kind::slide) add_covectors(mode, frame, box_);
}

Poly2 RegionModes::curve(const CurveId& id, double s, double t) const {
  if (id.kind == CurveId::edge) return edges_[id.a].about(s, t);
  const RegionMode& mode = modes_[id.mode];
  if (id.kind == CurveId::denominator) return mode.denominator.about(s, t);
  return curve_value<Poly2>(id, [&](int k) {
    const Form<Poly2>& f = mode.row[k].form;
    return Form<Poly2>{f.u.about(s, t), f.one.about(s, t), f.w.about(s, t)};
  });
}

namespace {

/// Greatest value in |S| <= ds, |T| <= dt.
double bound(const Poly2& f, double ds, double dt) {
  return f.c + std::abs(f.s) * ds + std::abs(f.t) * dt + std::max(f.ss, 0.0) * ds * ds + std::abs(f.st) * ds * dt +
         std::max(f.tt, 0.0) * dt * dt;
}

double magnitude(const Poly2& f, double ds, double dt) {
  return std::abs(f.c) + std::abs(f.s) * ds + std::abs(f.t) * dt + std::abs(f.ss) * ds * ds +
         std::abs(f.st) * ds * dt + std::abs(f.tt) * dt * dt;
}

}  // namespace

namespace {

/// With the sign of D given: the multipliers that are best in the middle bound the mode's rows in the whole rectangle.
bool excluded_with_sign(const RegionMode& mode, double sign, double s0, double ds, double t0, double dt, bool& feasible) {
  std::array<Form<double>, 6> rows;
  for (int k = 0; k < mode.count; ++k) {
    const Form<Poly2>& f = mode.row[k].form;
    rows[k] = {sign * f.u.at(s0, t0), sign * f.one.at(s0, t0), sign * f.w.at(s0, t0)};
  }
  const Margin m = margin(rows.data(), mode.count);
  feasible = m.value > 0;
  if (feasible || m.count == 0) return false;
  Form<Poly2> sum;
  const signed char basis[3] = {m.basis.a, m.basis.b, m.basis.c};
  for (int k = 0; k < m.count; ++k) {
    const Form<Poly2>& f = mode.row[basis[k]].form;
    const double y = sign * m.y[k];
    sum = {sum.u + f.u * y, sum.one + f.one * y, sum.w + f.w * y};
  }
  sum = {sum.u.about(s0, t0), sum.one.about(s0, t0), sum.w.about(s0, t0)};
  constexpr double rounding = 1e-13;  // of the sum of magnitudes: some ten operations of 1e-16 each, with room
  const double error = rounding * (magnitude(sum.u, ds, dt) + magnitude(sum.one, ds, dt) + magnitude(sum.w, ds, dt));
  for (const double u : {-1, 1})
    for (const double w : {-1, 1})
      if (!(bound(sum.one + sum.u * u + sum.w * w, ds, dt) < -error)) return false;
  return true;
}

/// A slide moves as xi = -M^-1 v + phi M^-1 s with phi > 0 and N . xi = 0, whatever the sign of D: it is excluded where
/// some Z = A + z N has Z . M^-1 v > 0 on the box and Z . M^-1 s < 0. (Near D = 0 the rows, multiplied by D, nearly
/// depend on each other.)
bool excluded_by_covector(const SlideCovector& a, const SlideCovector& n, double s0, double ds, double t0, double dt) {
  double low = -HUGE_VAL, high = HUGE_VAL;  // of z, in the middle
  const auto require = [&](double constant, double slope) {  // constant + z slope > 0
    if (slope > 0)
      low = std::max(low, -constant / slope);
    else if (slope < 0)
      high = std::min(high, -constant / slope);
    else if (constant <= 0)
      low = HUGE_VAL;
  };
  const auto corner = [](const Form<Poly2>& f, double u, double w) { return f.one + f.u * u + f.w * w; };
  for (const double u : {-1, 1})
    for (const double w : {-1, 1}) require(corner(a.load, u, w).at(s0, t0), corner(n.load, u, w).at(s0, t0));
  require(-a.push.at(s0, t0), -n.push.at(s0, t0));
  if (!(low < high)) return false;
  const double z = low == -HUGE_VAL ? (high == HUGE_VAL ? 0 : high - 1) : high == HUGE_VAL ? low + 1 : 0.5 * (low + high);
  constexpr double rounding = 1e-13;
  const auto negative = [&](const Poly2& f) {
    const Poly2 here = f.about(s0, t0);
    return bound(here, ds, dt) < -rounding * magnitude(here, ds, dt);
  };
  if (!negative(a.push + n.push * z)) return false;
  for (const double u : {-1, 1})
    for (const double w : {-1, 1})
      if (!negative(-(corner(a.load, u, w) + corner(n.load, u, w) * z))) return false;
  return true;
}

/// One covector, or two of which the force pushes one up and one down, mixed so that it barely pushes down.
bool excluded_by_covectors(const RegionMode& mode, double s0, double ds, double t0, double dt) {
  const int last = mode.covectors - 1;
  const SlideCovector& n = mode.covector[std::max(last, 0)];
  for (int k = 0; k < last; ++k)
    if (excluded_by_covector(mode.covector[k], n, s0, ds, t0, dt)) return true;
  for (int k = 0; k < last; ++k)
    for (int l = 0; l < last; ++l) {
      const SlideCovector &down = mode.covector[k], &up = mode.covector[l];
      const double a = down.push.at(s0, t0), b = up.push.at(s0, t0);
      if (!(a < 0 && b > 0)) continue;
      for (const double part : {0.95, 0.6}) {  // of the most that leaves the sum below 0
        const double y = part * -a / b;
        const SlideCovector sum{{down.load.u + up.load.u * y, down.load.one + up.load.one * y, down.load.w + up.load.w * y},
                                down.push + up.push * y};
        if (excluded_by_covector(sum, n, s0, ds, t0, dt)) return true;
      }
    }
  return false;
}

}  // namespace

bool RegionModes::excluded(const RegionMode& mode, double s0, double ds, double t0, double dt, bool& feasible,
                           bool closely) const {
  feasible = false;
  if (mode.impossible) return true;
  if (!mode.has_denominator) return excluded_with_sign(mode, 1, s0, ds, t0, dt, feasible);
  const Poly2 d = mode.denominator.about(s0, t0);
  const bool can_be_positive = bound(d, ds, dt) >= 0, can_be_negative = bound(-d, ds, dt) >= 0;
  bool ignored = false, all = true;
  if (can_be_positive) all = excluded_with_sign(mode, 1, s0, ds, t0, dt, d.c > 0 ? feasible : ignored);
  if (can_be_negative && (all || d.c < 0))
    all = excluded_with_sign(mode, -1, s0, ds, t0, dt, d.c < 0 ? feasible : ignored) && all;
  return all || (closely && !feasible && excluded_by_covectors(mode, s0, ds, t0, dt));
}

// ---- words ------------------------------------------------------------------------------------------------------

namespace {

std::string row_in_words(const RegionRow& row) {
  const std::string foot = std::to_string(row.contact + 1);
  switch (row.meaning) {
    case RowMeaning::lifts: return "contact " + foot + " lifts off";
    case RowMeaning::turns: return "turning about contact " + foot + " reverses";
    case RowMeaning::cone_u: return "force at " + foot + " on cone edge u";
    case RowMeaning::cone_w: return "force at " + foot + " on cone edge w";
    case RowMeaning::slides: return "sliding at " + foot + " reverses";
    case RowMeaning::pushes: return "force at " + foot + " vanishes";
    case RowMeaning::moves: return "the motion reverses";
  }
  return {};
}

std::string coordinate(const char* name, const char* half_side, double centre, int end) {
  std::string text = std::string(name) + " = ";
  if (centre != 0) text += std::string(name) + "0 ";
  return text + (end > 0 ? "+" : "-") + half_side;
}

}  // namespace

std::string curve_in_words(const RegionMode& mode, const CurveId& id, const WrenchBox& box) {
  std::string text = mode.mode.name() + ": ";
  if (id.kind == CurveId::denominator) return text + "D = 0";
  const signed char rows[3] = {id.a, id.b, id.c};
  for (int k = 0; k < 3 && rows[k] >= 0; ++k) text += (k == 0 ? "" : " and ") + row_in_words(mode.row[rows[k]]);
  const bool at_u = id.kind == CurveId::corner || (id.kind == CurveId::side && id.place < 2);
  const bool at_w = id.kind == CurveId::corner || (id.kind == CurveId::side && id.place >= 2);
  const int end_w = id.kind == CurveId::corner ? (id.place & 2) : (id.place & 1);
  if (at_u && box.kappa > 0) text += ", " + coordinate("p", "kappa", box.centre.p, (id.place & 1) ? 1 : -1);
  if (at_w && box.nu > 0) text += ", " + coordinate("q", "nu", box.centre.q, end_w ? 1 : -1);
  return text;
}

}  // namespace surefoot::stability
