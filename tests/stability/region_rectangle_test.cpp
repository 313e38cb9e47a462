// Certificates on rectangles of COMs against exact verdicts of the oracle at points inside.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "stability/region_pieces.hpp"
#include "stability/robust_oracle.hpp"
#include "tests/support/rounds.hpp"
#include "tests/support/sample_posture.hpp"

using namespace surefoot::stability;
using namespace surefoot::testing;
using Eigen::Vector2d;

namespace {

double magnitude_of(const CurvePolynomial& curve) {
  double sum = 0;
  for (int k = 0; k < (curve.degree + 1) * (curve.degree + 2) / 2; ++k)
    sum += std::abs(curve.f.c[static_cast<std::size_t>(k)]);
  return sum;
}

/// What the certificates say of a mode at a point; unknown where they do not tell, or a curve passes too near.
ModePart::Kind said_at(const RegionModes& modes, const LeafMode& mode, const Rectangle& box, double s, double t) {
  if (mode.there.kind == ModePart::nowhere || mode.there.kind == ModePart::everywhere) return mode.there.kind;
  constexpr double near = 1e-9;  // of the curve's size on the rectangle
  std::uint64_t holds = 0;
  int index = 0;
  bool clear = true;
  mode.list([&](const CurveCondition& condition) {
    const double value = modes.curve(condition.curve, s, t).c;
    clear = clear && std::abs(value) > near * magnitude_of(curve_there(modes, condition.curve, box));
    if (condition.sign * value > 0) holds |= std::uint64_t{1} << index;
    ++index;
  });
  return clear ? mode.state(holds) : ModePart::unknown;
}

struct Counts {
  int checked = 0, by_curves = 0, several_curves = 0, beside_denominator = 0, narrowed = 0;
};

void check_rectangle(const SamplePosture& sample, const RegionModes& modes, const RobustOracle& oracle,
                     const Rectangle& box, std::mt19937& random, Counts& counts) {
  std::vector<LeafMode> there;
  for (int k = 0; k < static_cast<int>(modes.modes().size()); ++k) {
    there.push_back({k, mode_there(modes, k, box)});
    const ModeThere& found = there.back().there;
    counts.by_curves += found.kind == ModePart::by_curves;
    counts.several_curves += found.part[0].count > 1;
    counts.beside_denominator += found.denominator && found.kind == ModePart::by_curves;
  }
  std::uniform_real_distribution<double> share(0, 1);
  for (int point = 0; point < 4; ++point) {
    const double s = box.a + (box.b - box.a) * share(random), t = box.lo + (box.hi - box.lo) * share(random);
    const std::vector<ContactMode> feasible = oracle.feasible_modes(modes.position(s, t));
    const Rectangle part{box.a, s, box.lo, t};   // the point is its corner
    std::map<std::string, ModePart::Kind> said;  // a mode may stand several times, for each sense of its motion
    for (const LeafMode& mode : there) {
      ModePart::Kind kind = said_at(modes, mode, box, s, t);
      const LeafMode in_part{mode.mode, narrowed(modes, mode.mode, mode.there, part)};
      const ModePart::Kind narrow = said_at(modes, in_part, part, s, t);
      if (kind != ModePart::unknown && narrow != ModePart::unknown) {
        INFO(sample.json());
        CHECK(kind == narrow);
        ++counts.narrowed;
      }
      const auto [at, first] = said.try_emplace(modes.modes()[static_cast<std::size_t>(mode.mode)].mode.name(), kind);
      if (first) continue;
      if (kind == ModePart::everywhere || at->second == ModePart::everywhere) at->second = ModePart::everywhere;
      else if (kind != at->second) at->second = ModePart::unknown;
    }
    for (const auto& [name, kind] : said) {
      if (kind == ModePart::unknown) continue;
      const bool possible =
          std::any_of(feasible.begin(), feasible.end(), [&](const ContactMode& m) { return m.name() == name; });
      INFO(sample.json() << " at " << modes.position(s, t).transpose() << ": " << name);
      CHECK(possible == (kind == ModePart::everywhere));
      ++counts.checked;
    }
  }
}

}  // namespace

TEST_CASE("What certificates say of a rectangle, the oracle says at its points", "[region]") {
  Sampler sampler(77);
  std::mt19937 random(78);
  std::uniform_real_distribution<double> unit(-1, 1);
  Counts counts;
  const int postures = surefoot::test::rounds(1500);
  for (int round = 0; round < postures; ++round) {
    const SamplePosture sample = sampler.posture(all_kinds[static_cast<std::size_t>(round) % all_kinds.size()]);
    // Without friction and sideways force rows of sliding vanish by cancellation; in doubles their sign is open.
    const bool no_friction =
        std::any_of(sample.contacts.begin(), sample.contacts.end(), [](const Contact& c) { return c.friction == 0; });
    if (no_friction && sample.box.kappa == 0) continue;
    const RobustOracle oracle(sample.contacts, sample.rho, sample.box);
    const Posture posture(sample.contacts, sample.rho);
    const RegionModes modes(posture, {{}, sample.box.kappa, sample.box.nu}, sample.com,
                            Vector2d(std::cos(0.3), std::sin(0.3)));
    for (int k = 0; k < 4; ++k) {
      const double size = sample.rho * std::pow(10, -1.5 + 1.5 * unit(random)), s = sample.rho * unit(random),
                   t = sample.rho * unit(random);
      check_rectangle(sample, modes, oracle, {s - size, s + size, t - 0.7 * size, t + 0.7 * size}, random, counts);
    }
  }
  CAPTURE(counts.checked, counts.by_curves, counts.several_curves, counts.beside_denominator, counts.narrowed);
  CHECK(counts.checked > 20 * postures);
  CHECK(counts.by_curves > postures / 10);
  CHECK(counts.several_curves > postures / 100);
  CHECK(counts.beside_denominator > postures / 200);
}
