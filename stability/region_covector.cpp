#include "stability/region_covector.hpp"

#include <cmath>
#include <optional>

namespace surefoot::stability {
namespace {

using Conic = Bivariate<2>;
using Eigen::Vector2d;

struct Affine {
  double c = 0, s = 0, t = 0;
  double greatest() const { return std::abs(c) + std::abs(s) + std::abs(t); }
};
Conic operator*(const Affine& f, const Affine& g) {
  return {{f.c * g.c, f.c * g.s + f.s * g.c, f.c * g.t + f.t * g.c, f.s * g.s, f.s * g.t + f.t * g.s, f.t * g.t}};
}
Affine operator*(const Affine& f, double k) { return {f.c * k, f.s * k, f.t * k}; }
Affine operator+(const Affine& f, const Affine& g) { return {f.c + g.c, f.s + g.s, f.t + g.t}; }
Conic conic(const Affine& f) { return {{f.c, f.s, f.t, 0, 0, 0}}; }

class Excluder {
 public:
  Excluder(const RegionModes& modes, int index, const Rectangle& rectangle)
      : modes_(modes), rectangle_(rectangle), certificate_(modes.certificate(index)), spec_(modes.modes()[index].spec),
        frame_(modes.posture().frame(modes.position(rectangle.s(), rectangle.t()))) {
    for (int k = 0; k < frame_.contacts; ++k)
      radius_ = std::max(radius_, offset(k).x.greatest() + offset(k).y.greatest());
  }

  bool excludes() {
    const std::optional<Vector2d> middle = proposal(0, 0);
    if (!middle) return false;
    if (certificate_.cone().free_rotation) {  // no moment about the contact
      const Vec2<Affine> r = offset(spec_.i);
      x_ = {middle->x(), 0, 0}, m_ = r.x + r.y * -middle->x();
      return holds();
    }
    x_ = {middle->x(), 0, 0}, m_ = {middle->y(), 0, 0};
    if (holds()) return true;
    scale_ = promising;
    if (!holds()) return false;
    scale_ = 1;
    const auto right = proposal(1, 0), left = proposal(-1, 0), top = proposal(0, 1), bottom = proposal(0, -1);
    if (!right || !left || !top || !bottom) return false;
    const Vector2d along_s = 0.5 * (*right - *left), along_t = 0.5 * (*top - *bottom);
    x_ = {middle->x(), along_s.x(), along_t.x()}, m_ = {middle->y(), along_s.y(), along_t.y()};
    return holds();
  }

 private:
  /// (X, M) at a point of the rectangle.
  std::optional<Vector2d> proposal(double sigma, double tau) const {
    const Vector2d com =
        modes_.position(rectangle_.s() + sigma * rectangle_.ds(), rectangle_.t() + tau * rectangle_.dt());
    const Frame<double> frame = modes_.posture().frame(com);
    const Covector covector = certificate_.propose(frame);
    if (!covector.found) return std::nullopt;
    const Vec2<double>& r = frame.at[spec_.i].r;
    return Vector2d(covector.z.p, covector.z.q + r.x - r.y * covector.z.p);
  }

  /// The contact seen from the COM.
  Vec2<Affine> offset(int contact) const {
    const Vec2<double>& r = frame_.at[contact].r;
    const Vector2d s = modes_.e_s() * (scale_ * rectangle_.ds()), t = modes_.e_t() * (scale_ * rectangle_.dt());
    return {{r.x, -s.x(), -t.x()}, {r.y, -s.y(), -t.y()}};
  }

  bool holds() const {
    const double rho2 = frame_.rho2, kappa = modes_.box().kappa, nu = modes_.box().nu;
    const double x = x_.greatest(), m = m_.greatest();
    constexpr double rounding = 1e-13;  // of the sum of magnitudes: some twenty operations of 1e-16 each, with room
    const double press_error = rounding * (rho2 * (1 + kappa * x) + nu * m);
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        const double at_x = x_.c + s * x_.s + t * x_.t, at_m = m_.c + s * m_.s + t * m_.t;
        if (!(rho2 * (1 - kappa * std::abs(at_x)) - nu * std::abs(at_m) > press_error)) return false;
      }
    const LoadedEdges edges(spec_);
    const double a = modes_.posture().edge_bound(), edge_error = rounding * a * (rho2 * (1 + x) + m * radius_);
    for (int k = 0; k < edges.count; ++k) {
      const Vec2<double>& c = frame_.at[edges.at[k].contact].edge[edges.at[k].edge];
      const Vec2<Affine> r = offset(edges.at[k].contact);
      const Conic read = m_ * (r.x * c.y + r.y * -c.x) + conic(x_ * (rho2 * c.x) + Affine{rho2 * c.y, 0, 0});
      if (!(upper(read) < -edge_error)) return false;
    }
    const TwistCone<double>& cone = certificate_.cone();
    const Vec2<Affine> r = offset(spec_.i);
    for (int k = 0; k < cone.count; ++k) {
      const Row<double>& twist = cone.extreme[k];
      const Conic read =
          x_ * (r.y * twist.q + Affine{twist.p, 0, 0}) + conic(r.x * -twist.q + m_ * twist.q + Affine{twist.one, 0, 0});
      const double v = std::abs(twist.p) + std::abs(twist.one), turn = std::abs(twist.q);
      if (!(lower(read) >= rounding * (v * (1 + x) + turn * (m + radius_ * (1 + x))))) return false;
    }
    return true;
  }

  const RegionModes& modes_;
  const Rectangle& rectangle_;
  const DualCertificate& certificate_;
  const ModeSpec& spec_;
  Frame<double> frame_;
  /// A covector that does not even hold in a part of the rectangle as it is need not be made affine.
  static constexpr double promising = 0.5;
  double radius_ = 0, scale_ = 1;
  Affine x_, m_;
};

}  // namespace

bool excluded_by_covector(const RegionModes& modes, int index, const Rectangle& rectangle) {
  if (!modes.box().centred() || modes.modes()[index].spec.kind == ModeSpec::Kind::all_break) return false;
  return Excluder(modes, index, rectangle).excludes();
}

}  // namespace surefoot::stability
