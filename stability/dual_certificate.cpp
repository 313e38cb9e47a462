#include "stability/dual_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "stability/cover_conditions.hpp"
#include "stability/guard.hpp"

namespace surefoot::stability {
using Kind = ModeSpec::Kind;

namespace {

/// Twists (v tau, alpha) along tau = sigma t_i with v > 0 and v a_l + alpha b_l > 0 for every other contact, where a_l = sigma n_l x n_i and
/// b_l = (x_l - x_i) x n_l: alpha / v lies between -a_l / b_l over b_l > 0 and over b_l < 0.
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

/// The cone edges along which a mode has forces.
struct Edges {
  struct At {
    int contact, edge;
  };
  std::array<At, 2> at;
  int count = 0;
  explicit Edges(const ModeSpec& spec) {
    if (spec.kind == Kind::all_break) return;
    if (spec.kind == Kind::roll) {
      at = {At{spec.i, edge_u}, At{spec.i, edge_w}};
      count = 2;
      return;
    }
    at[count++] = {spec.i, loaded_edge(spec.sigma_i)};
    if (spec.kind == Kind::two_slides) at[count++] = {spec.j, loaded_edge(spec.sigma_j)};
  }
};

/// A convex cone in 3-space by its extreme rays in cyclic order.
struct RayPolygon {
  std::array<Row<double>, 16> at;
  int count = 0;

  void add(const Row<double>& ray) {
    const double size = std::max({std::abs(ray.p), std::abs(ray.one), std::abs(ray.q)});
    if (count < static_cast<int>(at.size()) && size > 0) at[count++] = {ray.p / size, ray.one / size, ray.q / size};
  }
  void clip(const Row<double>& row) {
    RayPolygon kept;
    for (int k = 0; k < count; ++k) {
      const Row<double>&a = at[k], &b = at[k + 1 == count ? 0 : k + 1];
      const double va = dot(row, a), vb = dot(row, b);
      if (va >= 0) kept.add(a);
      if ((va > 0 && vb < 0) || (va < 0 && vb > 0)) {
        const double wa = std::abs(vb), wb = std::abs(va);
        kept.add({a.p * wa + b.p * wb, a.one * wa + b.one * wb, a.q * wa + b.q * wb});
      }
    }
    *this = kept;
  }
  Row<double> sum() const {
    Row<double> total{0, 0, 0};
    for (int k = 0; k < count; ++k) total = {total.p + at[k].p, total.one + at[k].one, total.q + at[k].q};
    return total;
  }
};

/// {Z : Z . M^-1 v >= 0 on W}, moments in units of rho, is spanned by four rays if W has an extent along both axes. An axis
/// without one is widened (a proposal may ask for too much): otherwise opposite rays would not say which way round.
RayPolygon positive_on_box(double rho, const DisturbanceBox& box, double widening) {
  const double kappa = std::max(box.kappa, widening), nu = std::max(box.nu / rho, widening);
  RayPolygon polygon;
  polygon.add({1, kappa, 0});
  polygon.add({0, nu, 1});
  polygon.add({-1, kappa, 0});
  polygon.add({0, nu, -1});
  return polygon;
}

/// The rows Z . M^-1 v >= 0 at the corners, for moments in units of rho.
std::array<Row<double>, 4> corner_rows(double rho, const DisturbanceBox& box) {
  const double k = box.kappa, n = box.nu / rho;
  return {Row<double>{k, 1, n}, Row<double>{-k, 1, n}, Row<double>{-k, 1, -n}, Row<double>{k, 1, -n}};
}

Covector propose_breaks(const Frame<double>& frame, const DisturbanceBox& box) {
  const double rho = std::sqrt(frame.rho2);
  RayPolygon polygon;
  const std::array<Row<double>, 3> units{Row<double>{1, 0, 0}, Row<double>{0, 1, 0}, Row<double>{0, 0, 1}};
  for (int l = 0; l < frame.contacts; ++l) polygon.add(units[l]);
  for (const Row<double>& corner : corner_rows(rho, box)) {
    std::array<double, 3> value{};
    for (int l = 0; l < frame.contacts; ++l) {
      const ContactTerms<double>& t = frame.at[l];
      value[l] = corner.p * t.n.x + corner.one * t.n.y + corner.q * (t.nz / rho);
    }
    polygon.clip({value[0], value[1], value[2]});
  }
  return {polygon.sum(), polygon.count > 0};
}

/// Z without moment about x_i: (Z_x, Z_y) in the plane, its moment about the COM is r x Z.
Covector propose_force(const Frame<double>& frame, const ModeSpec& spec, const TwistCone<double>& cone,
                       const DisturbanceBox& box) {
  const double rho = std::sqrt(frame.rho2);
  const Vec2<double>& r = frame.at[spec.i].r;
  RayPolygon polygon;
  for (const Row<double>& ray : {Row<double>{1, 0, 0}, Row<double>{0, 1, 0}, Row<double>{-1, 0, 0}, Row<double>{0, -1, 0}})
    polygon.add(ray);
  const auto clip = [&](double x, double y, double moment) {  // moment in units of rho
    polygon.clip({x - moment * r.y / rho, y + moment * r.x / rho, 0});
  };
  for (const Row<double>& corner : corner_rows(rho, box)) clip(corner.p, corner.one, corner.q);
  for (int k = 0; k < cone.count; ++k) polygon.clip({cone.extreme[k].p, cone.extreme[k].one, 0});
  const Edges edges(spec);
  for (int k = 0; k < edges.count; ++k) {
    const auto& [contact, edge] = edges.at[k];
    const ContactTerms<double>& t = frame.at[contact];
    clip(-t.edge[edge].x, -t.edge[edge].y, -t.sz[edge] / rho);
  }
  return {polygon.sum(), polygon.count > 0};
}

}  // namespace

DualCertificate::DualCertificate(const Posture& posture, const ModeSpec& spec, const DisturbanceBox& box)
    : posture_(posture), spec_(spec), box_(box), cone_(twist_cone<double>(posture, spec)) {}

Covector DualCertificate::propose(const Frame<double>& frame) const {
  if (spec_.kind == Kind::all_break) return propose_breaks(frame, box_);
  if (cone_.free_rotation) return propose_force(frame, spec_, cone_, box_);
  if (box_.kappa > 0 && box_.nu > 0) return propose_widened(frame, 0);
  for (const double widening : {1e-3, 1e-6, 1e-9})
    if (const Covector covector = propose_widened(frame, widening); covector.found) return covector;
  return {};
}

Covector DualCertificate::propose_widened(const Frame<double>& frame, double widening) const {
  const double rho = std::sqrt(frame.rho2);
  const Vec2<double>& r = frame.at[spec_.i].r;
  RayPolygon polygon = positive_on_box(rho, box_, widening);
  // In the COM frame: Z . e = Z . (v + alpha (r_y, -r_x)) + Z_z alpha.
  for (int k = 0; k < cone_.count; ++k) {
    const Row<double>& e = cone_.extreme[k];
    polygon.clip({e.p + e.q * r.y, e.one - e.q * r.x, e.q * rho});
  }
  const Edges edges(spec_);
  for (int k = 0; k < edges.count; ++k) {
    const auto& [contact, edge] = edges.at[k];
    const ContactTerms<double>& t = frame.at[contact];
    polygon.clip({-t.edge[edge].x, -t.edge[edge].y, -t.sz[edge] / rho});
  }
  const Row<double> sum = polygon.sum();
  const double moment = sum.q * rho;  // about the COM; about x_i it is less r x Z
  return {{sum.p, sum.one, moment - (r.x * sum.one - r.y * sum.p)}, polygon.count >= 3};
}

namespace {

template <class K>
Row<K> covector_about_contact(const Posture& posture, const ModeSpec& spec, const Covector& covector) {
  const Row<K> given{K(covector.z.p), K(covector.z.one), K(covector.z.q)};
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
bool holds_between(const ModeSpec& spec, const DisturbanceBox& box, const Row<K>& za, const Frame<K>& fa, const Row<K>& zb,
                   const Frame<K>& fb, const K& corner_slack, const K& edge_slack) {
  const Vec2<K>&ra = fa.at[spec.i].r, &rb = fb.at[spec.i].r;
  const K half(0.5);
  const std::array<K, 3> moment{moment_about_com(za, ra),
                                half * (moment_about_com(za, rb) + moment_about_com(zb, ra)), moment_about_com(zb, rb)};
  if (!positive_on_corners(za, zb, moment, fa.rho2, box, corner_slack)) return false;
  const Edges edges(spec);
  for (int k = 0; k < edges.count; ++k) {
    const auto& [contact, edge] = edges.at[k];
    const ContactTerms<K>&ta = fa.at[contact], &tb = fb.at[contact];
    if (!negative_on_edge(za, zb, moment, ta.edge[edge], ta.sz[edge], tb.sz[edge], fa.rho2, edge_slack)) return false;
  }
  return true;
}

}  // namespace

/// Z not negative on K. `error` bounds the rounding error of Z . e for doubles.
template <class K>
bool DualCertificate::in_cone(const Covector& covector, const TwistCone<K>& cone, double error) const {
  const Row<double>& z = covector.z;
  if (spec_.kind == Kind::all_break) return z.p >= 0 && z.one >= 0 && z.q >= 0 && z.p + z.one + z.q > 0;
  if (cone.free_rotation && z.q != 0) return false;
  const Row<K> exact{K(z.p), K(z.one), K(z.q)};
  const K least(std::is_same_v<K, double> ? error : 0.0);
  for (int k = 0; k < cone.count; ++k)
    if (!(dot(exact, cone.extreme[k]) >= least)) return false;
  return true;
}

bool DualCertificate::proves(const Covector& a, const Frame<double>& frame_a, const Covector& b,
                             const Frame<double>& frame_b, double radius) const {
  if (GuardScale(posture_.edge_bound(), posture_.rho2(), box_).at(radius).nothing_certain()) return false;
  const Row<double> za = covector_about_contact<double>(posture_, spec_, a);
  const Row<double> zb = covector_about_contact<double>(posture_, spec_, b);
  // Errors as in guard.hpp, for |Z_x| + |Z_y| = force and a moment of at most |Z_0| + R force about any COM of the line.
  // A sum of normals (all_break) has the errors of its terms, however small it is itself: |n| <= 2 in the 1-norm.
  const auto size = [&](const Covector& c, const Row<double>& z) {
    return spec_.kind == Kind::all_break ? 2 * (c.z.p + c.z.one + c.z.q) : std::abs(z.p) + std::abs(z.one);
  };
  const double force = std::max(size(a, za), size(b, zb));
  const double about_contact = std::max(std::abs(za.q), std::abs(zb.q)) + 2 * posture_.spread() * force;
  const double moment = about_contact + radius * force;
  const double factor = row_error_factor * posture_.edge_bound();
  const double twist_error = row_error_factor * about_contact + underflow_slack;
  if (!in_cone<double>(a, cone_, twist_error) || (&a != &b && !in_cone<double>(b, cone_, twist_error))) return false;
  const double area = factor * posture_.rho2() * force;
  return holds_between<double>(spec_, box_, za, frame_a, zb, frame_b,
                               area * (1 + box_.kappa) + factor * box_.nu * moment + underflow_slack,
                               area + factor * radius * moment + underflow_slack);
}

bool DualCertificate::proves(const Covector& a, const Frame<Dyadic>& frame_a, const Covector& b,
                             const Frame<Dyadic>& frame_b) const {
  const TwistCone<Dyadic> cone = twist_cone<Dyadic>(posture_, spec_);
  if (!in_cone<Dyadic>(a, cone, 0) || !in_cone<Dyadic>(b, cone, 0)) return false;
  const Dyadic none(0);
  return holds_between<Dyadic>(spec_, box_, covector_about_contact<Dyadic>(posture_, spec_, a), frame_a,
                                 covector_about_contact<Dyadic>(posture_, spec_, b), frame_b, none, none);
}

}  // namespace surefoot::stability
