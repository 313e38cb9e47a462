// Areas, cells and discs against the oracle on grids, closed forms and the shares of theory section 9. A grid's error:
// the cells whose corners differ.
#include "stability/region.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "stability/region_tolerance.hpp"
#include "tests/support/region_reference.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sample_posture.hpp"

using namespace surefoot::stability;
using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using surefoot::testing::all_kinds;
using surefoot::testing::reference_area;
using surefoot::testing::ReferenceArea;
using surefoot::testing::SamplePosture;
using surefoot::testing::Sampler;

namespace {

constexpr double degree = std::numbers::pi / 180;
const WrenchBox published{{}, std::tan(10 * degree), 0.1};

Contact on_slope(double x, double y, double slope) {
  return {{x, y}, {-std::sin(slope * degree), std::cos(slope * degree)}, 0.5};
}
std::vector<Contact> uneven() { return {on_slope(0, 0, -35), on_slope(1, 0.1, 10)}; }
std::vector<Contact> vee() { return {on_slope(0, 0, -30), on_slope(1, 0, 30)}; }
std::vector<Contact> level() { return {on_slope(0, 0, 0), on_slope(1, 0, 0)}; }

double ring_area(const RegionPolygon& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector2d p = ring[k] - ring[0], q = ring[(k + 1) % ring.size()] - ring[0];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

/// Area of R(W) by a grid of oracle calls, with a bound of the grid's own error.
struct GridArea {
  double robust = 0, error = 0;
};
GridArea by_grid(const RobustOracle& oracle, const AlignedBox2d& box, int n) {
  const Vector2d step = box.sizes() / n;
  std::vector<char> inside(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k)
      inside[static_cast<std::size_t>(i * (n + 1) + k)] =
          oracle.robust(box.min() + Vector2d(step.x() * i, step.y() * k));
  GridArea area;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const auto at = [&](int a, int b) {
        return static_cast<int>(inside[static_cast<std::size_t>((i + a) * (n + 1) + k + b)]);
      };
      const int corners = at(0, 0) + at(0, 1) + at(1, 0) + at(1, 1);
      area.robust += corners / 4.0;
      area.error +=
          corners % 4 != 0 ? 0.5 : 0;  // of cells the boundary crosses half their area on average: 1/2 bounds their sum
    }
  area.robust *= step.prod();
  area.error = (area.error + 2) * step.prod();  // what slips between the points of a grid this fine
  return area;
}

AlignedBox2d bounds_of(const RegionPolygon& polygon) {
  AlignedBox2d box;
  for (const Vector2d& p : polygon) box.extend(p);
  return box;
}

double cells_total(const Region& r) {
  double sum = 0;
  for (const RegionCell& cell : r.cells) sum += cell.area;
  return sum;
}

}  // namespace

TEST_CASE("The shares of theory section 9 hold by area", "[region]") {
  RegionOptions options;
  options.window = AlignedBox2d(Vector2d(-0.2, -2), Vector2d(1.2, 5));
  // The published shares count a 57 x 141 grid; a grid of 400 x 2000 oracle calls gives these to 1e-3.
  const auto check = [&](const std::vector<Contact>& contacts, double rho) {
    const Region r = region(contacts, rho, published, options);
    const RobustOracle oracle(contacts, rho, {published.kappa, published.nu});
    int equilibria = 0, robust = 0;
    for (int i = 0; i < 200; ++i)
      for (int k = 0; k < 1000; ++k) {
        const Vector2d com(-0.2 + 1.4 * (i + 0.5) / 200, -2 + 7.0 * (k + 0.5) / 1000);
        if (!oracle.equilibrium(com)) continue;
        ++equilibria;
        robust += oracle.robust(com);
      }
    CHECK(r.robust_area / r.equilibrium_area == Approx(static_cast<double>(robust) / equilibria).margin(1e-3));
    return r.robust_area / r.equilibrium_area;
  };
  // Against the published values within what their grid can tell.
  CHECK(check(uneven(), 0.25) == Approx(1.000).margin(1e-9));
  CHECK(check(uneven(), 0.1) == Approx(0.634).margin(1e-3));
  CHECK(check(uneven(), 0.05) == Approx(0.602).margin(2e-3));
  CHECK(check(vee(), 0.25) == Approx(1.000).margin(1e-9));
  CHECK(check(vee(), 0.1) == Approx(0.921).margin(1e-3));
  CHECK(check(vee(), 0.05) == Approx(0.842).margin(2e-3));
}

TEST_CASE("R_SS(W) of a level stance is the rhombus of the tipping lines", "[region]") {
  // Half width 1/2 - nu at the ground, sides x = nu + kappa |y|: height (1/2 - nu) / kappa up and down.
  const WrenchBox box{{}, 0.1, 0.1};
  const Region r = region(level(), 0.2, box);
  CHECK(r.equilibrium_area == Approx(2 * 0.4 * 0.4 / 0.1).epsilon(1e-12));
  CHECK_FALSE(r.window);
}

TEST_CASE("A level stance cannot lift both feet within R_SS(W), however small rho", "[region]") {
  // N_i . xi > 0 is -(rho^2 + (x_i - x) q) > 0: for both feet x > 1 + rho^2 / nu or x < -rho^2 / nu, beyond a foot.
  const Region r = region(level(), 0.05, {{}, 0.1, 0.125});
  for (const ModeShare& share : r.modes) CHECK(share.mode.name() != "FF");
}

TEST_CASE("Mirrored postures have mirrored cells", "[region]") {
  const Region r = region(vee(), 0.05, published);
  std::map<std::string, double> area;
  for (const RegionCell& cell : r.cells) {
    std::set<std::string> names;
    for (const ContactMode& mode : cell.modes) names.insert(mode.name());
    std::string key;
    for (const std::string& name : names) key += name + " ";
    area[key] += cell.area;
  }
  // Mirroring swaps the contacts and U with W.
  CHECK(area.at("FF UF ") == Approx(area.at("FF FW ")).epsilon(1e-7));
  CHECK(area.at("FF FU ") == Approx(area.at("FF WF ")).epsilon(1e-7));
  CHECK(area.at("FF FU UU ") == Approx(area.at("FF WF WW ")).epsilon(1e-6));
}

TEST_CASE("Cells tile R_SS(W) and their rings enclose their areas", "[region]") {
  for (const double rho : {0.25, 0.1, 0.05})
    for (const auto& contacts : {uneven(), vee(), level()}) {
      const Region r = region(contacts, rho, published);
      CHECK(r.note.empty());
      CHECK(cells_total(r) == Approx(r.equilibrium_area).margin(r.area_error));
      CHECK(r.area_error <= 1.1e-6 * r.equilibrium_area);
      CHECK(r.cells_error < 1e-4 * r.equilibrium_area);
      for (const RegionCell& cell : r.cells) {
        double enclosed = 0, length = 0;
        for (const RegionPolygon& ring : cell.rings) {
          enclosed += ring_area(ring);
          for (std::size_t k = 0; k < ring.size(); ++k) length += (ring[(k + 1) % ring.size()] - ring[k]).norm();
        }
        CHECK(enclosed == Approx(cell.area).margin(2 * r.curve_tolerance * length));
      }
    }
}

TEST_CASE("Every boundary curve separates verdicts of the oracle on its mode", "[region]") {
  const Region r = region(uneven(), 0.1, published);
  const RobustOracle oracle(uneven(), 0.1, {published.kappa, published.nu});
  int curves = 0;
  for (const RegionBoundary& boundary : r.boundaries) {
    if (boundary.curve.kind == CurveId::edge) continue;
    ++curves;
    const std::string mode = boundary.label.substr(0, boundary.label.find(':'));
    const auto has = [&](const Vector2d& com) {
      const auto modes = oracle.feasible_modes(com);
      return std::any_of(modes.begin(), modes.end(), [&](const ContactMode& m) { return m.name() == mode; });
    };
    for (std::size_t k = 0; k + 1 < boundary.polyline.size(); ++k) {
      const Vector2d d = boundary.polyline[k + 1] - boundary.polyline[k];
      if (d.norm() < 20 * r.curve_tolerance) continue;
      const Vector2d side = 3 * r.curve_tolerance * Vector2d(-d.y(), d.x()).normalized(),
                     middle = boundary.polyline[k] + 0.5 * d;
      INFO(boundary.label << " at " << middle.transpose());
      CHECK(has(middle + side) != has(middle - side));
    }
  }
  CHECK(curves >= 4);
}

TEST_CASE("Areas of random postures agree with grids of oracle calls", "[region]") {
  const std::uint64_t seed = 41;
  Sampler sampler(seed);
  int compared = 0;
  for (int round = 0; round < surefoot::test::rounds(78); ++round) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(round) % all_kinds.size()]);
    INFO("seed " << seed << " round " << round << "\n" << s.json());
    RegionOptions options;
    options.curves = false;
    const Region r = region(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu}, options);
    CHECK(cells_total(r) == Approx(r.equilibrium_area).margin(r.cells_error + 1e-9 * r.equilibrium_area));
    if (r.empty()) continue;
    const GridArea grid = by_grid(RobustOracle(s.contacts, s.rho, s.box), bounds_of(r.equilibrium), 40);
    CHECK(std::abs(grid.robust - r.robust_area) <= grid.error + r.area_error);
    ++compared;
  }
  CHECK(compared > surefoot::test::enough(35));
}

TEST_CASE("The stated error of an area holds against integrals of the oracle's verdicts", "[region]") {
  for (const double rho : {0.1})
    for (const auto& contacts : {uneven(), vee()}) {
      const RegionAreas areas = region_areas(contacts, rho, published);
      const Region r = region(contacts, rho, published);
      CHECK(areas.error <= 1.1e-6 * areas.equilibrium);
      CHECK(areas.equilibrium == r.equilibrium_area);
      const ReferenceArea reference = reference_area(RobustOracle(contacts, rho, {published.kappa, published.nu}),
                                                     r.equilibrium, 1e-6 * areas.equilibrium);
      const double own = 2 * reference.error;
      CHECK(std::abs(areas.robust - reference.area) <= areas.error + own);
      CHECK(std::abs(r.robust_area - reference.area) <= r.area_error + own);
      // Far better than stated, since the sweep is within what the subdivision proves.
      CHECK(r.robust_area == Approx(reference.area).margin(own));
    }
}

TEST_CASE("Areas by subdivision and by sweep agree within the stated errors, on every kind of posture", "[region]") {
  Sampler sampler(45);
  int proved = 0, with_region = 0;
  for (int round = 0; round < surefoot::test::rounds(39); ++round) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(round) % all_kinds.size()]);
    INFO("round " << round << "\n" << s.json());
    RegionOptions options;
    options.curves = false;
    const RegionAreas areas = region_areas(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu});
    const Region r = region(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu}, options);
    CHECK(areas.note.empty() == !r.empty());
    if (r.empty()) continue;
    CHECK(std::abs(areas.robust - r.robust_area) <= areas.error + r.area_error);
    double robust_cells = 0;
    for (const RegionCell& cell : r.cells)
      if (cell.modes.empty()) robust_cells += cell.area;
    CHECK(std::abs(robust_cells - r.robust_area) <= r.area_error + r.cells_error);
    ++with_region;
    proved += areas.error <= 1.1e-6 * areas.equilibrium;
  }
  CHECK(with_region > surefoot::test::enough(20));
  CHECK(proved > 0.5 * with_region);
}

TEST_CASE("Stiff and extreme postures: a region within the grid's error, or a statement", "[region]") {
  // By rule, as in the catalogue of docs/extremes.md (all of it: bench_region --extremes).
  const std::vector<std::function<void(SamplePosture&)>> rules{
      [](SamplePosture& s) { s.box.kappa = 0; },
      [](SamplePosture& s) { s.box.nu = 0; },
      [](SamplePosture& s) {
        s.box = {0, 0};
      },
      [](SamplePosture& s) {
        s.box = {1e-12, 1e-12};
      },
      [](SamplePosture& s) {
        s.box = {10, 10};
      },
      [](SamplePosture& s) { s.rho *= 1e-4; },
      [](SamplePosture& s) { s.rho *= 1e6; },
      [](SamplePosture& s) { s.rho = 1e-308; },
      [](SamplePosture& s) {
        for (Contact& c : s.contacts) c.friction = 1e-12;
      },
      [](SamplePosture& s) {
        for (Contact& c : s.contacts) c.friction = 1e9;
      },
      [](SamplePosture& s) { s.contacts.back().position = s.contacts[0].position + Vector2d(1e-300, 0); },
      [](SamplePosture& s) { s.contacts.back().normal = s.contacts[0].normal * 3; },
      [](SamplePosture& s) { s.contacts.back().normal = -s.contacts[0].normal; },
      [](SamplePosture& s) {
        for (Contact& c : s.contacts) c.position *= 0x1p40;
      },
      [](SamplePosture& s) {
        for (Contact& c : s.contacts) c.position += Vector2d(1e9, -1e9);
      },
  };
  Sampler sampler(46);
  int regions = 0, statements = 0;
  for (std::size_t k = 0; k < 3 * rules.size(); ++k) {
    SamplePosture s = sampler.posture(all_kinds[k % all_kinds.size()]);
    rules[k % rules.size()](s);
    INFO("case " << k << "\n" << s.json());
    const RegionAreas areas = region_areas(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu});
    if (!(areas.equilibrium > 0)) {
      CHECK_FALSE(areas.note.empty());
      ++statements;
      continue;
    }
    ++regions;
    CHECK(areas.robust >= -areas.error);
    CHECK(areas.robust <= areas.equilibrium * (1 + 1e-12) + areas.error);
    const RobustOracle oracle(s.contacts, s.rho, s.box);
    RegionOptions options;
    options.curves = false;
    const Region r = region(s.contacts, s.rho, {{}, s.box.kappa, s.box.nu}, options);
    for (const RegionCell& cell : r.cells)
      if (cell.confirmed) CHECK(oracle.robust(cell.inside) == cell.modes.empty());
    CHECK(cells_total(r) ==
          Approx(r.equilibrium_area).margin(r.cells_error + r.area_error + 1e-9 * r.equilibrium_area));
    const GridArea grid = by_grid(oracle, bounds_of(r.equilibrium), 24);
    CHECK(std::abs(grid.robust - areas.robust) <= grid.error + areas.error);
  }
  CHECK(regions > 5);
  CHECK(statements > 0);
}

TEST_CASE("One wrench is a box without extent: R(w) under gravity, and under a slanted force by turning the posture",
          "[region]") {
  // Turning everything by phi turns gravity: the force (p, 1) with p = tan(phi) on the posture is plain gravity on the
  // turned one, and areas do not change. The window of the slanted one is large enough to hold the strip's part we
  // compare: three contacts in a bowl.
  const Region still = region(uneven(), 0.1, {{}, 0, 0});
  CHECK(still.window);
  const RobustOracle oracle(uneven(), 0.1, {0, 0});
  for (const RegionCell& cell : still.cells) CHECK(oracle.robust(cell.inside) == cell.modes.empty());
  const double phi = 0.2;
  const Eigen::Rotation2Dd turn(phi);
  std::vector<Contact> turned;
  for (const Contact& c : uneven()) turned.push_back({turn * c.position, turn * c.normal, c.friction});
  // f = -(p, 1) turned by phi is straight down for p = -tan(phi)... the sense is found by the cells themselves.
  const WrenchBox slanted{{std::tan(phi), 0}, 0, 0};
  const Region leaning = region(uneven(), 0.1, slanted);
  const RobustOracle upright(turned, 0.1, {0, 0});
  REQUIRE_FALSE(leaning.empty());
  for (const RegionCell& cell : leaning.cells) {
    const Vector2d there = turn * cell.inside;
    CHECK(upright.equilibrium(there));
    CHECK(upright.robust(there) == cell.modes.empty());
  }
}

TEST_CASE("Unbounded regions are clipped to the stated window, bounded ones are not", "[region]") {
  const Region strip = region(level(), 0.2, {{}, 0, 0.1});
  REQUIRE(strip.window);
  CHECK(strip.equilibrium_area == Approx(0.8 * strip.window->sizes().y()).epsilon(1e-12));
  RegionOptions options;
  options.window = AlignedBox2d(Vector2d(0, 0), Vector2d(0.5, 1));
  CHECK(region(level(), 0.2, {{}, 0, 0.1}, options).equilibrium_area == Approx(0.4).epsilon(1e-12));
  CHECK_FALSE(region(level(), 0.2, {{}, 0.1, 0.1}).window);
}

TEST_CASE("Degenerate and extreme postures give a region or a statement", "[region]") {
  const auto survives = [](const std::vector<Contact>& contacts, double rho, const WrenchBox& box) {
    const Region r = region(contacts, rho, box);
    CHECK((!r.empty() || !r.note.empty()));
    CHECK(std::isfinite(r.equilibrium_area));
    CHECK(r.robust_area <= r.equilibrium_area + r.area_error + 1e-9 * r.equilibrium_area);
    return r;
  };
  survives({{{0, 0}, {0, 1}, 0.5}, {{0, 0}, {0, 1}, 0.5}}, 0.1, published);           // one place twice
  survives({{{0, 0}, {0, 1}, 0.5}, {{1e-9, 0}, {0, 1}, 0.5}}, 0.1, published);        // almost
  survives({{{0, 0}, {0, 1}, 0}, {{1, 0}, {0, 1}, 0}}, 0.1, published);               // no friction
  survives({{{0, 0}, {0, 1}, 1e-6}, {{1, 0}, {0, 1}, 1e-6}}, 0.1, {{}, 1e-7, 1e-7});  // hardly any
  survives({{{0, 0}, {1, 0}, 1}, {{1, 0}, {-1, 0}, 1}}, 0.1, published);              // two walls
  survives({{{0, 0}, {0, 1}, 1}, {{0, 1}, {0, -1}, 1}}, 0.1, published);              // floor and ceiling
  survives({{{0, 0}, {0, 1}, 0.5}, {{0.5, 0}, {0, 1}, 0.5}, {{1, 0}, {0, 1}, 0.5}}, 0.01, published);  // three in a row
  survives({{{0, 0}, {0, 1}, 0.5}}, 0.1, published);                                                   // one contact
  const Region plain = survives(uneven(), 0.1, published);
  for (const double scale : {1e-6, 1e6}) {
    std::vector<Contact> scaled = uneven();
    for (Contact& c : scaled) c.position *= scale;
    const Region r = survives(scaled, 0.1 * scale, {{}, published.kappa, published.nu * scale});
    CHECK(r.robust_area / r.equilibrium_area == Approx(plain.robust_area / plain.equilibrium_area).epsilon(1e-7));
  }
  std::vector<Contact> far = uneven();
  for (Contact& c : far) c.position += Vector2d(1e6, -1e6);
  CHECK(survives(far, 0.1, published).robust_area == Approx(plain.robust_area).epsilon(1e-6));
}

TEST_CASE("Half-planes of R_SS(W) are those of the oracle", "[region]") {
  Sampler sampler(43);
  for (int round = 0; round < surefoot::test::rounds(200); ++round) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(round) % all_kinds.size()]);
    const auto ours = equilibrium_half_planes(Posture(s.contacts, s.rho), {{}, s.box.kappa, s.box.nu});
    const auto theirs = RobustOracle(s.contacts, s.rho, s.box).equilibrium_half_planes();
    REQUIRE(ours.size() == theirs.size());
    for (std::size_t k = 0; k < ours.size(); ++k) {
      CHECK(ours[k].plane.normal == theirs[k].normal);
      CHECK(ours[k].plane.offset == Approx(theirs[k].offset).epsilon(1e-12).margin(1e-14));
    }
  }
}

TEST_CASE("The disc around a COM is robust all over, and is the largest where only tipping limits it",
          "[region][tolerance]") {
  Sampler sampler(44);
  int discs = 0, sharp = 0;
  for (int round = 0; round < surefoot::test::rounds(400); ++round) {
    const SamplePosture s = sampler.posture(all_kinds[static_cast<std::size_t>(round) % all_kinds.size()]);
    INFO("round " << round << "\n" << s.json());
    const RobustOracle oracle(s.contacts, s.rho, s.box);
    const double radius = com_tolerance(s.contacts, s.rho, s.box, s.com);
    CHECK((radius > 0) <= oracle.robust(s.com));
    if (radius == 0) continue;
    ++discs;
    bool beyond = false;
    for (int k = 0; k < 3600 && !beyond; ++k) {
      const Vector2d along(std::cos(k * 0.1 * degree), std::sin(k * 0.1 * degree));
      beyond = !oracle.robust(s.com + 1.01 * radius * along) || !oracle.robust(s.com + 1.003 * radius * along);
    }
    sharp += beyond;
    for (int k = 0; k < 90; ++k)
      for (const double part : {0.5, 0.9999}) {
        const double angle = 4 * k * degree;
        CHECK(oracle.robust(s.com + part * radius * Vector2d(std::cos(angle), std::sin(angle))));
      }
  }
  CHECK(discs > surefoot::test::enough(40));
  // Discs end where the oracle's verdict does, but for few.
  CHECK(sharp > 0.9 * discs);
  // Level ground, large rho: tipping over a foot, 0.2 - nu - kappa y away, across a side of slope 1 / kappa.
  const double exact = (0.2 - 0.1 - 0.1 * 0.4) / std::hypot(1, 0.1);
  CHECK(com_tolerance(level(), 0.5, {0.1, 0.1}, {0.2, 0.4}) == Approx(exact).epsilon(2e-4));
  // Where a mode limits it: along rays from the COM the oracle first refuses at this distance.
  const RobustOracle oracle(uneven(), 0.1, {published.kappa, published.nu});
  const Vector2d com(0.55, 0.7);
  double first = HUGE_VAL;
  for (int k = 0; k < 720; ++k) {
    const Vector2d along(std::cos(k * 0.5 * degree), std::sin(k * 0.5 * degree));
    double low = 0, high = 2;
    if (!oracle.line(com, com + high * along).stable())
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (oracle.line(com, com + middle * along).stable() ? low : high) = middle;
      }
    first = std::min(first, high);
  }
  CHECK(com_tolerance(uneven(), 0.1, {published.kappa, published.nu}, com) == Approx(first).epsilon(1e-3));
}
