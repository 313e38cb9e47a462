#include "stability/dual_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stability/cover_conditions.hpp"
#include "stability/guard.hpp"

namespace surefoot::stability {
using Kind = ModeSpec::Kind;

namespace {

/// Twists (v tau, alpha) along tau = sigma t_i with v > 0 and v a_l + alpha b_l > 0 for every other contact, where a_l
/// = sigma n_l x n_i and b_l = (x_l - x_i) x n_l: alpha / v lies between -a_l / b_l over b_l > 0 and over b_l < 0.
template <class K>
TwistCone<K> slide_cone(const Posture& posture, const ModeSpec& spec) {
  const int i = spec.i;
  const Vec2<K> ni = posture.normal<K>(i), tau{spec.sigma_i * ni.y, -spec.sigma_i * ni.x};
  struct Bound {
    K a{0}, b{0};
    bool given = false;
  } low, high;
  for (int l = 0; l < posture.contacts(); ++l) {
    const int turn = l == i ? 0 : posture.turn_sign(i, l);
    if (turn == 0) continue;  // opens by v alone, which the list of modes has checked
    const Vec2<K> nl = posture.normal<K>(l);
    const K a = spec.sigma_i * cross(nl, ni);
    K b = cross(posture.offset<K>(i, l), nl);
    if (b < 0) b = -b;  // its sign is `turn`, which is known exactly
    if (turn > 0 && (!low.given || -(a * low.b) > -(low.a * b))) low = {a, b, true};
    if (turn < 0 && (!high.given || a * high.b < high.a * b)) high = {a, b, true};
  }
  const auto ray = [&](const K& v, const K& alpha) { return Row<K>{v * tau.x, v * tau.y, alpha}; };
  TwistCone<K> cone;
  cone.free_rotation = !low.given && !high.given;
  if (cone.free_rotation) {
    cone.add(ray(K(1), K(0)));
    return cone;
  }
  cone.add(low.given ? ray(low.b, -low.a) : ray(K(0), K(-1)));
  cone.add(high.given ? ray(high.b, high.a) : ray(K(0), K(1)));
  return cone;
}

template <class K>
TwistCone<K> twist_cone(const Posture& posture, const ModeSpec& spec) {
  if (spec.kind == Kind::slide) return slide_cone<K>(posture, spec);
  TwistCone<K> cone{};
  cone.free_rotation = spec.sense == 0;  // a roll that opens nothing; two slides at one point
  if (spec.kind == Kind::roll && spec.sense != 0) cone.add({K(0), K(0), K(spec.sense)});
  if (spec.kind == Kind::two_slides && spec.sense != 0) {
    const Vec2<K> ni = posture.normal<K>(spec.i), nj = posture.normal<K>(spec.j);
    const K moment = cross(posture.offset<K>(spec.i, spec.j), nj);
    const Row<K> c{ni.y * moment, -(ni.x * moment), cross(ni, nj)};  // N_i x N_j about x_i
    cone.add(spec.sense > 0 ? c : -c);
  }
  return cone;
}

constexpr Covector nothing{{0, 0, 0}, false};

/// The covectors (x, 1, m), m their moment about the COM, that are left by half-planes: a convex polygon.
class Slice {
 public:
  /// Those that press on all of W: nu |m| <= rho^2 (1 - kappa |x|).
  Slice(double rho2, double kappa, double nu) {
    const double x = 1 / kappa, m = rho2 / nu;
    at_[0] = {x, 0}, at_[1] = {0, m}, at_[2] = {-x, 0}, at_[3] = {0, -m};
  }
  /// Keeps the part where half_plane . (x, 1, m) >= 0; whether there is any.
  bool clip(const Row<double>& half_plane) {
    std::array<double, most> value;
    bool all = true;
    for (int k = 0; k < count_; ++k) {
      value[k] = value_at(half_plane, at_[k].x, at_[k].y);
      all &= value[k] >= 0;
    }
    if (all) return true;
    std::array<Vec2<double>, most> kept;
    int n = 0;
    for (int k = 0; k < count_; ++k) {
      const int next = k + 1 == count_ ? 0 : k + 1;
      if (value[k] >= 0) kept[n++] = at_[k];
      if ((value[k] >= 0) == (value[next] >= 0)) continue;
      const double part = value[k] / (value[k] - value[next]);
      kept[n++] = {at_[k].x + part * (at_[next].x - at_[k].x), at_[k].y + part * (at_[next].y - at_[k].y)};
    }
    count_ = n;
    at_ = kept;
    return n > 0;
  }
  /// The mean of the vertices as directions: far ones count less.
  Vec2<double> centre(double inverse_rho) const {
    Vec2<double> sum{0, 0};
    double weights = 0;
    for (int k = 0; k < count_; ++k) {
      const double weight = 1 / (1 + std::abs(at_[k].x) + std::abs(at_[k].y) * inverse_rho);
      sum = {sum.x + weight * at_[k].x, sum.y + weight * at_[k].y};
      weights += weight;
    }
    return {sum.x / weights, sum.y / weights};
  }

 private:
  static constexpr int most = 4 + 4;  // every half-plane adds one vertex at most
  std::array<Vec2<double>, most> at_;
  int count_ = 4;
};

/// Moves a twist about x_i to the COM at offset r from it: what Z = (x, 1, m) reads there.
template <class K>
Row<K> about_com(const Row<K>& twist, const Vec2<K>& r) {
  return {twist.p + twist.q * r.y, twist.one - twist.q * r.x, twist.q};
}

}  // namespace

LoadedEdges::LoadedEdges(const ModeSpec& spec) {
  const auto add = [&](std::int8_t contact, int edge) { at[count++] = {contact, static_cast<std::int8_t>(edge)}; };
  if (spec.kind == Kind::all_break) return;
  if (spec.kind == Kind::roll) {
    add(spec.i, edge_u), add(spec.i, edge_w);
    return;
  }
  add(spec.i, loaded_edge(spec.sigma_i));
  if (spec.kind == Kind::two_slides) add(spec.j, loaded_edge(spec.sigma_j));
}

DualCertificate::DualCertificate(const LineFrame& line, const ModeSpec& spec)
    : line_(line), spec_(spec), edges_(spec), cone_(twist_cone<double>(line.posture, spec)) {}

Covector DualCertificate::propose(const Frame<double>& frame) const {
  if (spec_.kind == Kind::all_break) return propose_breaks(frame);
  if (cone_.free_rotation) return propose_force(frame);
  if (cone_.count == 0) return nothing;
  if (line_.box.kappa > 0 && line_.box.nu > 0) return propose_widened(frame, 0);
  // Where W has no extent along an axis, the slice is not bounded; a proposal may ask for too much.
  for (const double widening : {1e-3, 1e-6, 1e-9})
    if (const Covector covector = propose_widened(frame, widening); covector.found) return covector;
  return nothing;
}

Covector DualCertificate::propose_widened(const Frame<double>& frame, double widening) const {
  const double rho = line_.posture.rho();
  const Vec2<double>& r = frame.at[spec_.i].r;
  Slice slice(frame.rho2, std::max(line_.box.kappa, widening), std::max(line_.box.nu, widening * rho));
  for (int k = 0; k < cone_.count; ++k)
    if (!slice.clip(about_com(cone_.extreme[k], r))) return nothing;
  for (int k = 0; k < edges_.count; ++k) {
    const ContactTerms<double>& t = frame.at[edges_.at[k].contact];
    const int edge = edges_.at[k].edge;
    if (!slice.clip({-frame.rho2 * t.edge[edge].x, -frame.rho2 * t.edge[edge].y, -t.sz[edge]})) return nothing;
  }
  const Vec2<double> centre = slice.centre(1 / rho);
  const Row<double> z{centre.x, 1, centre.y - (r.x - r.y * centre.x)};  // about x_i: less r x Z
  return {z, surely_in_cone(z)};
}

/// Z without moment about x_i: (x, 1) in the plane, its moment about the COM is r x Z = r_x - r_y x.
Covector DualCertificate::propose_force(const Frame<double>& frame) const {
  const Vec2<double>& r = frame.at[spec_.i].r;
  const double rho2 = frame.rho2;
  double low = -HUGE_VAL, high = HUGE_VAL;
  const auto clip = [&](const Row<double>& half_plane) {
    const double slope = half_plane.p - half_plane.q * r.y, value = half_plane.one + half_plane.q * r.x;
    const double end = -value / slope;
    if (slope > 0) low = std::max(low, end);
    if (slope < 0) high = std::min(high, end);
    if (slope == 0 && !(value > 0)) high = -HUGE_VAL;
  };
  for (const double kappa : {-line_.box.kappa, line_.box.kappa})
    for (const double nu : {-line_.box.nu, line_.box.nu}) clip({rho2 * kappa, rho2, nu});
  for (int k = 0; k < cone_.count; ++k) clip({cone_.extreme[k].p, cone_.extreme[k].one, 0});
  for (int k = 0; k < edges_.count; ++k) {
    const ContactTerms<double>& t = frame.at[edges_.at[k].contact];
    const int edge = edges_.at[k].edge;
    clip({-rho2 * t.edge[edge].x, -rho2 * t.edge[edge].y, -t.sz[edge]});
  }
  if (!(low < high)) return nothing;
  const double bound = 2 + 2 * std::min(std::abs(low), std::abs(high));  // stands for an end at infinity
  const Row<double> z{0.5 * (std::max(low, -bound) + std::min(high, bound)), 1, 0};
  return {z, surely_in_cone(z)};
}

/// Multipliers of the normals for which Z presses most: a concave function, linear but where Z has no x or no moment.
Covector DualCertificate::propose_breaks(const Frame<double>& frame) const {
  const int n = frame.contacts;
  double most = 0;
  Covector best = nothing;
  const auto consider = [&](double y0, double y1, double y2) {
    const std::array<double, 3> y{y0, y1, y2};
    Vec2<double> d{0, 0};
    double moment = 0;
    for (int l = 0; l < n; ++l) {
      const ContactTerms<double>& t = frame.at[l];
      d = {d.x + y[l] * t.n.x, d.y + y[l] * t.n.y};
      moment += y[l] * t.nz;
    }
    const double press = frame.rho2 * (d.y - line_.box.kappa * std::abs(d.x)) - line_.box.nu * std::abs(moment);
    if (!(press > most)) return;
    most = press;
    best = {{y0, y1, y2}, true};
  };
  const auto single = [&](int l, double y) {
    return std::array<double, 3>{l == 0 ? y : 0, l == 1 ? y : 0, l == 2 ? y : 0};
  };
  const auto balanced = [&](int i, int j, double value_i, double value_j) {
    if (!(value_i * value_j < 0)) return;
    const double share = value_j / (value_j - value_i);
    const auto yi = single(i, share), yj = single(j, 1 - share);
    consider(yi[0] + yj[0], yi[1] + yj[1], yi[2] + yj[2]);
  };
  for (int i = 0; i < n; ++i) {
    const auto y = single(i, 1);
    consider(y[0], y[1], y[2]);
    for (int j = 0; j < i; ++j) {
      balanced(i, j, frame.at[i].n.x, frame.at[j].n.x);
      balanced(i, j, frame.at[i].nz, frame.at[j].nz);
    }
  }
  if (n == 3) {
    const auto& t = frame.at;
    const Row<double> y = cross(Row<double>{t[0].n.x, t[1].n.x, t[2].n.x}, Row<double>{t[0].nz, t[1].nz, t[2].nz});
    const double sum = y.p + y.one + y.q;
    if (y.p * sum > 0 && y.one * sum > 0 && y.q * sum > 0) consider(y.p / sum, y.one / sum, y.q / sum);
  }
  return best;
}

/// Z not negative on K beyond the rounding error of Z . e: e has components of at most 2 (twice the spread for
/// lengths).
bool DualCertificate::surely_in_cone(const Row<double>& z) const {
  const double force = std::abs(z.p) + std::abs(z.one);
  const double error = row_error_factor * (std::abs(z.q) + 2 * line_.posture.spread() * force) + underflow_slack;
  if (!std::isfinite(error)) return false;  // so is Z where rho^2 overflows
  for (int k = 0; k < cone_.count; ++k)
    if (!(dot(z, cone_.extreme[k]) >= error)) return false;
  return true;
}

namespace {

template <class K>
Row<K> covector_about_contact(const Posture& posture, const ModeSpec& spec, const Covector& covector) {
  Row<K> given{K(covector.z.p), K(covector.z.one), K(covector.z.q)};
  if (spec.kind != Kind::all_break) return given;
  Row<K> sum{K(0), K(0), K(0)};
  const std::array<K, 3> y{given.p, given.one, given.q};
  for (int l = 0; l < posture.contacts(); ++l) {
    const Vec2<K> n = posture.normal<K>(l);
    sum = {sum.p + n.x * y[l], sum.one + n.y * y[l], sum.q + cross(posture.offset<K>(spec.i, l), n) * y[l]};
  }
  return sum;
}

/// Conditions (*) between the COMs of two frames.
template <class K>
bool holds_between(const ModeSpec& spec, const LoadedEdges& edges, const DisturbanceBox& box, const Row<K>& za,
                   const Frame<K>& fa, const Row<K>& zb, const Frame<K>& fb, const K& corner_slack,
                   const K& edge_slack) {
  const Vec2<K>&ra = fa.at[spec.i].r, &rb = fb.at[spec.i].r;
  const K half(0.5);
  const std::array<K, 3> moment{moment_about_com(za, ra), half * (moment_about_com(za, rb) + moment_about_com(zb, ra)),
                                moment_about_com(zb, rb)};
  if (!positive_on_corners(za, zb, moment, fa.rho2, box, corner_slack)) return false;
  for (int k = 0; k < edges.count; ++k) {
    const ContactTerms<K>&ta = fa.at[edges.at[k].contact], &tb = fb.at[edges.at[k].contact];
    const int e = edges.at[k].edge;
    if (!negative_on_edge(za, zb, moment, ta.edge[e], ta.sz[e], tb.sz[e], fa.rho2, edge_slack)) return false;
  }
  return true;
}

/// Z not negative on K, exactly.
bool in_cone(const ModeSpec& spec, const Covector& covector, const TwistCone<Dyadic>& cone) {
  const Row<double>& z = covector.z;
  if (spec.kind == Kind::all_break) return z.p >= 0 && z.one >= 0 && z.q >= 0 && z.p + z.one + z.q > 0;
  if (cone.free_rotation && z.q != 0) return false;
  const Row<Dyadic> exact{z.p, z.one, z.q};
  for (int k = 0; k < cone.count; ++k)
    if (dot(exact, cone.extreme[k]).sign() < 0) return false;
  return true;
}

}  // namespace

bool DualCertificate::proves(const Covector& a, const Frame<double>& frame_a, const Covector& b,
                             const Frame<double>& frame_b) const {
  const Posture& posture = line_.posture;
  const Row<double> za = covector_about_contact<double>(posture, spec_, a);
  const Row<double> zb = covector_about_contact<double>(posture, spec_, b);
  // Errors as in guard.hpp, for |Z_x| + |Z_y| = force and a moment of at most |Z_0| + R force about any COM of the
  // line. A sum of normals (all_break) has the errors of its terms, however small it is itself: |n| <= 2 in the 1-norm.
  const auto size = [&](const Covector& c, const Row<double>& z) {
    return spec_.kind == Kind::all_break ? 2 * (c.z.p + c.z.one + c.z.q) : std::abs(z.p) + std::abs(z.one);
  };
  const double force = std::max(size(a, za), size(b, zb));
  const double about_contact = std::max(std::abs(za.q), std::abs(zb.q)) + 2 * posture.spread() * force;
  const double moment = about_contact + line_.radius * force;
  const double factor = row_error_factor * posture.edge_bound(), area = factor * posture.rho2() * force;
  return holds_between<double>(spec_, edges_, line_.box, za, frame_a, zb, frame_b,
                               area * (1 + line_.box.kappa) + factor * line_.box.nu * moment + underflow_slack,
                               area + factor * line_.radius * moment + underflow_slack);
}

bool DualCertificate::proves(const Covector& a, const Frame<Dyadic>& frame_a, const Covector& b,
                             const Frame<Dyadic>& frame_b) const {
  const TwistCone<Dyadic> cone = twist_cone<Dyadic>(line_.posture, spec_);
  if (!in_cone(spec_, a, cone) || !in_cone(spec_, b, cone)) return false;
  const Dyadic none(0);
  return holds_between<Dyadic>(spec_, edges_, line_.box, covector_about_contact<Dyadic>(line_.posture, spec_, a),
                               frame_a, covector_about_contact<Dyadic>(line_.posture, spec_, b), frame_b, none, none);
}

namespace {

/// Sums that may be positive, may be at most zero: exactly, or in doubles with what rounding may do to short sums.
bool may_be_positive(const Row<Dyadic>& terms) { return (terms.p + terms.one + terms.q).sign() > 0; }
bool may_be_at_most_zero(const Row<Dyadic>& terms) { return (terms.p + terms.one + terms.q).sign() <= 0; }
double slack_of(const Row<double>& terms) {
  constexpr double ample = 1e-9;
  return ample * (std::abs(terms.p) + std::abs(terms.one) + std::abs(terms.q));
}
bool may_be_positive(const Row<double>& terms) { return !(terms.p + terms.one + terms.q < -slack_of(terms)); }
bool may_be_at_most_zero(const Row<double>& terms) { return !(terms.p + terms.one + terms.q > slack_of(terms)); }

/// Whether one of the covectors of proves_on_border proves the mode or, in doubles, may.
template <class K>
bool borders_prove(const ModeSpec& spec, const LoadedEdges& edges, const TwistCone<K>& cone, const DisturbanceBox& box,
                   const Frame<K>& frame_a, const Frame<K>& frame_b) {
  if (spec.kind == Kind::all_break || cone.free_rotation) return false;  // no Z is positive on all of K
  const K rho2 = frame_a.rho2;
  // Z = (x, y, rho^2 m) about every COM: Z . M^-1 v = x p + y + m q.
  const auto proves = [&](const K& x, const K& y, const K& m) {
    for (const Frame<K>* frame : {&frame_a, &frame_b}) {  // linear along the line
      for (int k = 0; k < cone.count; ++k) {
        const Row<K> twist = about_com(cone.extreme[k], frame->at[spec.i].r);
        if (!may_be_positive(Row<K>{x * twist.p, y * twist.one, rho2 * m * twist.q})) return false;
      }
      for (int k = 0; k < edges.count; ++k) {
        const ContactTerms<K>& t = frame->at[edges.at[k].contact];
        const int edge = edges.at[k].edge;
        if (!may_be_at_most_zero(Row<K>{x * t.edge[edge].x, y * t.edge[edge].y, m * t.sz[edge]})) return false;
      }
    }
    return true;
  };
  const K none(0), kappa(box.kappa), nu(box.nu);
  for (const int sign : {1, -1})
    if (proves(K(sign), kappa, none) || proves(none, nu, K(sign))) return true;
  return false;
}

}  // namespace

bool DualCertificate::may_prove_on_border(const Frame<double>& a, const Frame<double>& b) const {
  return borders_prove(spec_, edges_, cone_, line_.box, a, b);
}

bool DualCertificate::proves_on_border(const Frame<Dyadic>& a, const Frame<Dyadic>& b) const {
  return borders_prove(spec_, edges_, twist_cone<Dyadic>(line_.posture, spec_), line_.box, a, b);
}

}  // namespace surefoot::stability
