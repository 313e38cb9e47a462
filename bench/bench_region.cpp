// Area of R(W): error against time for three methods (grid of oracle calls, certified quadtree, sweep), as CSV on
// stdout.
//   bench_region                  the postures of theory section 9
//   bench_region --random N       instead: areas of N random postures against grids of oracle calls, within the grids'
//   error
// Errors are against the sweep at its finest, whose own bound is in the last column.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "stability/region.hpp"
#include "stability/region_rectangle.hpp"
#include "tests/support/sample_posture.hpp"

namespace {

using namespace surefoot::stability;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;

struct Stance {
  std::string name;
  std::vector<Contact> contacts;
  double rho = 0;
  DisturbanceBox box;
};

AlignedBox2d bounds_of(const RegionPolygon& polygon) {
  AlignedBox2d box;
  for (const Vector2d& p : polygon) box.extend(p);
  return box;
}

struct Area {
  double value = 0, error = 0;  // error: the method's own
};

/// Oracle calls at the corners of an n x n grid; cells whose corners differ are in doubt.
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

/// Squares excluded for all modes by certificates, or refused for one; what is left at the last depth counts half.
class Quadtree {
 public:
  Quadtree(const Stance& stance, const AlignedBox2d& box)
      : posture_(stance.contacts, stance.rho), wrenches_{{}, stance.box.kappa, stance.box.nu},
        modes_(posture_, wrenches_, box.center(), Vector2d::UnitX()), planes_(equilibrium_half_planes(posture_, wrenches_)),
        centre_(box.center()), half_(0.5 * box.sizes()) {}
  Area area(int depth) {
    found_ = {};
    // modes_ has e_t = x, e_s = -y.
    visit(0, 0, half_.y(), half_.x(), depth);
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
      if (there.kind == ModeThere::nowhere) continue;
      inside = false;
      refused |= there.kind == ModeThere::everywhere;
    }
    if (inside) {
      found_.value += size;
      return;
    }
    if (depth == 0) {
      if (!refused) found_.value += 0.5 * size;
      found_.error += refused ? size : 0.5 * size;
      return;
    }
    for (const double a : {-0.5, 0.5})
      for (const double b : {-0.5, 0.5}) visit(s + a * ds, t + b * dt, 0.5 * ds, 0.5 * dt, depth - 1);
  }

  Posture posture_;
  WrenchBox wrenches_;
  RegionModes modes_;
  std::vector<LabelledHalfPlane> planes_;
  Vector2d centre_, half_;
  Area found_;
};

/// Least time of a few runs [ms].
template <class Work>
double least_time(Work&& work) {
  double least = HUGE_VAL, spent = 0;
  for (int run = 0; run < 20 && spent < 200; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    least = std::min(least, ms);
    spent += ms;
  }
  return least;
}

Region sweep(const Stance& s, double tolerance) {
  RegionOptions options;
  options.curves = false;
  options.area_tolerance = tolerance;
  return region(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu}, options);
}

void compare(const Stance& stance) {
  const Region finest = sweep(stance, 1e-12);
  const AlignedBox2d box = bounds_of(finest.equilibrium);
  const RobustOracle oracle(stance.contacts, stance.rho, stance.box);
  const double whole = finest.equilibrium_area;
  const auto row = [&](const char* method, double resolution, double ms, const Area& area) {
    std::printf("%s,%s,%g,%.4f,%.10g,%.2e,%.2e,%.1e\n", stance.name.c_str(), method, resolution, ms, area.value,
                std::abs(area.value - finest.robust_area) / whole, area.error / whole, finest.area_error / whole);
  };
  Area area;
  for (const int n : {30, 100, 300, 1000}) {
    const double ms = least_time([&] { area = by_grid(oracle, box, n); });
    row("grid", n, ms, area);
  }
  for (const int depth : {4, 6, 8, 10}) {
    const double ms = least_time([&] { area = Quadtree(stance, box).area(depth); });
    row("quadtree", depth, ms, area);
  }
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const double ms = least_time([&] {
      const Region r = sweep(stance, tolerance);
      area = {r.robust_area, r.area_error};
    });
    row("sweep", tolerance, ms, area);
  }
}

int random_postures(int count) {
  using namespace surefoot::testing;
  Sampler sampler(2025);
  int outside = 0, nonempty = 0, noted = 0;
  double slowest = 0, total = 0;
  for (int k = 0; k < count; ++k) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(k) % all_kinds.size()]);
    const Stance stance{name(s.kind), s.contacts, s.rho, s.box};
    const auto begin = std::chrono::steady_clock::now();
    const Region r = sweep(stance, 1e-6);
    const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    slowest = std::max(slowest, ms);
    total += ms;
    if (r.empty()) continue;
    ++nonempty;
    noted += !r.note.empty();
    const Area grid = by_grid(RobustOracle(s.contacts, s.rho, s.box), bounds_of(r.equilibrium), 60);
    if (std::abs(grid.value - r.robust_area) <= grid.error + r.area_error) continue;
    ++outside;
    std::printf("outside the grid's error: %.6g, grid %.6g +- %.2g: %s\n", r.robust_area, grid.value, grid.error, s.json().c_str());
  }
  std::printf("%d postures, %d with a region, %d outside the grid's error, %d with a note; sweep: mean %.3f ms, slowest %.1f ms\n",
              count, nonempty, outside, noted, total / count, slowest);
  return outside == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  if (count == 3 && std::strcmp(words[1], "--random") == 0) return random_postures(std::atoi(words[2]));
  constexpr double degree = std::numbers::pi / 180;
  const auto contact = [](double x, double y, double slope) {
    return Contact{{x, y}, {-std::sin(slope * degree), std::cos(slope * degree)}, 0.5};
  };
  const DisturbanceBox box{std::tan(10 * degree), 0.1};
  std::printf("posture,method,resolution,ms,robust_area,relative_error,own_relative_error,reference_relative_error\n");
  for (const double rho : {0.25, 0.1, 0.05}) {
    compare({"uneven rho " + std::to_string(rho).substr(0, 4), {contact(0, 0, -35), contact(1, 0.1, 10)}, rho, box});
    compare({"vee rho " + std::to_string(rho).substr(0, 4), {contact(0, 0, -30), contact(1, 0, 30)}, rho, box});
  }
}
