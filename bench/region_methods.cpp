#include "bench/region_methods.hpp"

#include <cmath>

#include "stability/region_cells.hpp"
#include "stability/region_rectangle.hpp"
#include "stability/region_setup.hpp"

namespace surefoot::bench {

using namespace stability;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;

AlignedBox2d bounds_of(const RegionPolygon& polygon) {
  AlignedBox2d box;
  for (const Vector2d& p : polygon) box.extend(p);
  return box;
}

Area by_grid(const RobustOracle& oracle, const AlignedBox2d& box, int n) {
  const Vector2d step = box.sizes() / n;
  std::vector<char> before(static_cast<std::size_t>(n + 1)), now(before.size());
  Area area;
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n; ++k)
      now[static_cast<std::size_t>(k)] = oracle.robust(box.min() + Vector2d(step.x() * i, step.y() * k));
    for (std::size_t k = 0; i > 0 && k < static_cast<std::size_t>(n); ++k) {
      const int inside = before[k] + before[k + 1] + now[k] + now[k + 1];
      area.value += inside / 4.0;
      area.error += inside % 4 != 0 ? 0.5 : 0;
    }
    before.swap(now);
  }
  return {area.value * step.prod(), (area.error + 2) * step.prod()};
}

namespace {

class Quadtree {
 public:
  Quadtree(const Stance& stance, const AlignedBox2d& box)
      : posture_(stance.contacts, stance.rho), wrenches_{{}, stance.box.kappa, stance.box.nu},
        modes_(posture_, wrenches_, box.center(), Vector2d::UnitX()),
        planes_(equilibrium_half_planes(posture_, wrenches_)), half_(0.5 * box.sizes()) {}
  Area area(int depth) {
    visit(0, 0, half_.y(), half_.x(), depth);  // modes_ has e_t = x, e_s = -y
    return found_;
  }

 private:
  void visit(double s, double t, double ds, double dt, int depth) {
    const double size = 4 * ds * dt;
    bool inside = true;
    const Vector2d x = modes_.position(s, t);
    for (const LabelledHalfPlane& half : planes_) {
      const Vector2d& n = half.plane.normal;
      const double value = n.dot(x) + half.plane.offset, spread = std::abs(n.x()) * dt + std::abs(n.y()) * ds;
      if (value <= -spread) return;
      inside &= value >= spread;
    }
    bool refused = false;
    for (int mode = 0; mode < static_cast<int>(modes_.modes().size()); ++mode) {
      const ModeThere there = mode_there(modes_, mode, {s - ds, s + ds, t - dt, t + dt});
      if (there.kind == ModePart::nowhere) continue;
      inside = false;
      refused |= there.kind == ModePart::everywhere;
    }
    if (refused) return;
    if (inside) {
      found_.value += size;
      return;
    }
    if (depth == 0) {
      found_.value += 0.5 * size;
      found_.error += 0.5 * size;
      return;
    }
    for (const double a : {-0.5, 0.5})
      for (const double b : {-0.5, 0.5}) visit(s + a * ds, t + b * dt, 0.5 * ds, 0.5 * dt, depth - 1);
  }

  Posture posture_;
  WrenchBox wrenches_;
  RegionModes modes_;
  std::vector<LabelledHalfPlane> planes_;
  Vector2d half_;
  Area found_;
};

}  // namespace

Area by_quadtree(const Stance& stance, const AlignedBox2d& box, int depth) { return Quadtree(stance, box).area(depth); }

Area by_sweep(const Stance& stance, double tolerance) {
  RegionOptions options;
  const RegionSetup setup(stance.contacts, stance.rho, {{}, stance.box.kappa, stance.box.nu}, options);
  Sweep sweep(*setup.modes, setup.local, tolerance, setup.core);
  sweep.run();
  Area area;
  for (const SweepCell& cell : collect_cells(sweep, 0).cells)
    if (cell.modes == 0) area.value += cell.area;
  area.error = sweep.error();
  return area;
}

}  // namespace surefoot::bench
