// The straight-line test and the least safety factor on a line against dense sampling of the point reference.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/agreement.hpp"
#include "tests/support/direct_reference.hpp"
#include "tests/support/exact_cases.hpp"
#include "tests/support/rounds.hpp"

using namespace surefoot::testing;
using surefoot::stability::LineSafetyFactor;
using surefoot::stability::LineVerdict;
using surefoot::stability::RobustOracle;
using surefoot::test::rounds;
using Outcome = LineVerdict::Outcome;

namespace {

Eigen::Vector2d on_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double lambda) {
  return from + lambda * (to - from);
}

// sigma is only upper semicontinuous: at a jump its value at lambda is a limit of values beside it.
double least_beside(const DirectReference<double>& reference, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                    double lambda) {
  double least = std::numeric_limits<double>::infinity();
  for (const double offset : {0.0, 1e-9, -1e-9}) {
    const double at = std::clamp(lambda + offset, 0.0, 1.0);
    least = std::min(least, reference.safety_factor(on_line(from, to, at)).value);
  }
  return least;
}

struct Counts {
  int stable = 0, unstable = 0, uncertain = 0, inside = 0;
};

// The verdict against the sampled least safety factor; the least safety factor from both sides: sampling can only find
// an upper bound, and the claimed place must attain the claimed value.
void compare_line(const SamplePosture& sample, const Eigen::Vector2d& to, int samples, Counts& counts) {
  INFO(name(sample.kind) << " com_to [" << to.x() << ", " << to.y() << "]\n" << sample.json());
  const RobustOracle oracle = oracle_of(sample);
  const DirectReference<double> reference(sample);
  const LineReference sampled = least_on_line(reference, sample.com, to, samples);
  const LineSafetyFactor found = oracle.line_safety_factor(sample.com, to);
  const LineVerdict verdict = oracle.line(sample.com, to);
  INFO("sampled least " << sampled.least << " at " << sampled.lambda << ", found " << found.least.value << " at "
                        << found.lambda << " (" << found.least.critical.name() << "), outcome "
                        << static_cast<int>(verdict.outcome) << " at " << verdict.lambda);
  if (found.least.value < practically_infinite || sampled.least < practically_infinite) {
    CHECK(found.least.value <= sampled.least * (1 + 1e-6) + 1e-9);
    CHECK(least_beside(reference, sample.com, to, found.lambda) ==
          Approx(found.least.value).epsilon(1e-5).margin(1e-7));
  }
  CHECK((found.lambda >= 0 && found.lambda <= 1));
  const bool zero_box = sample.box.kappa == 0 && sample.box.nu == 0;
  if (sampled.least < 1 - 1e-7) CHECK(verdict.outcome == Outcome::unstable);
  if (found.least.value > 1 + 1e-6 && !zero_box) CHECK(verdict.outcome == Outcome::stable);
  if (verdict.outcome == Outcome::unstable) {
    CHECK((verdict.lambda >= 0 && verdict.lambda <= 1));
    CHECK_FALSE(DirectReference<Rational>(sample).robust(on_line(sample.com, to, verdict.lambda), 1 + 1e-12));
  }
  counts.stable += verdict.outcome == Outcome::stable;
  counts.unstable += verdict.outcome == Outcome::unstable;
  counts.uncertain += verdict.outcome == Outcome::uncertain;
  counts.inside += sampled.least < 1 - 1e-7 && reference.robust(sample.com) && reference.robust(to);
}

struct LineCase {
  std::vector<Contact> contacts;
  double rho;
  DisturbanceBox box;
  Eigen::Vector2d from, to;
};

// Both ends robustly stable, the inside not: found by random search, confirmed in rationals. The comment says the kind
// of posture, the mode, and the least safety factor among 63 samples.
const std::vector<LineCase> unstable_inside{
    // opposed, FRF, least 0.0000 at 0.438
    {{{{-0.5107421875, -0.0810546875}, {12, 4}, 1.2003755918579686},
      {{0.6142578125, 0.2939453125}, {-3, -1}, 0.98901316260121264},
      {{0.630859375, 0.02722590110067602}, {0.027361868829363804, 3.9999064149219996}, 1.0058831937298787}},
     0.023261939996852374,
     {0.1006780006328117, 0.025438881534241214},
     {0.119459655063057, 0.6673103025323549},
     {0.39855556295427619, 0.22050672636167024}},
    // stacked, UFU, least 0.1468 at 0.250
    {{{{-0.48828125, 0.271484375}, {0, 4}, 1.008157559587207},
      {{-0.48828125, -0.279296875}, {0, -0.25}, 1.3815813078021377},
      {{0.77734375, 0.0048828125}, {0.17844339477696913, 0.46707382163901107}, 0.42501824290150608}},
     0.056993753339220805,
     {0.28898609740869613, 0},
     {0.99227817806284602, 0.65681757884714387},
     {0.00066968384171378625, 0.62846071957113581}},
    // walls, FFF, least 0.2107 at 0.719
    {{{{-0.9033203125, 0.020425031198818167}, {0.99931687434308947, 0.03695652382405528}, 0.98355917389747494},
      {{0.55078125, 0.22028247600414247}, {-0.96988068390099436, 0.24358049797908593}, 0.86797751145660174},
      {{0.7109375, -0.083104028405112856}, {-1.9813214574986446, 0.27269998543352802}, 1.0054925053609007}},
     0.03555445146181492,
     {0, 0.018391387699664828},
     {0.68963189261388513, -0.65685392611760984},
     {-1.1657058369049098, 0.33837597296377953}},
    // ridge, WFF, least 0.4953 at 0.125
    {{{{-0.5615234375, 0.13065596873042051}, {-0.41050667008638381, 0.28545450393116734}, 0.69707613712317418},
      {{0.833984375, -0.25684202578440379}, {2.2283168846346175, 7.6833979372184196}, 1.4980354189422682},
      {{0.85546875, 0.18807848952824974}, {0.15886890834425127, 0.47408930589236653}, 0.54902834292754854}},
     0.075372340357436701,
     {0.17089218056411873, 0.075527901628142199},
     {0.45496843483655769, -0.84818613658793374},
     {0.1769231192676991, 0.64926381851724346}},
    // vee, FFF, least 0.8104 at 0.156
    {{{{-0.5322265625, -0.1215531959840829}, {0.99163451699125982, 1.7368537603124539}, 0.40807403871169412},
      {{-0.4169921875, -0.23875953485050108}, {0.23586302739144938, 0.71194707128391244}, 0.46257142581902189},
      {{-0.001953125, 0.22143588484180282}, {-0.87725415712191779, 1.7973383498418749}, 1.3032772509043797}},
     0.033442826245620588,
     {0.026002624409167886, 0.043932247389146542},
     {-0.12112056154821566, 0.59465731743713568},
     {-0.13900626825678009, 0.240048507201998}},
    // vee, FFF, least 0.1190 at 0.391
    {{{{-0.5615234375, 0.042500220961542157}, {3.6397009634406654, 1.659089176846468}, 0.30461227093016147},
      {{0.103515625, 0.025911472625059773}, {-1.158390670813578, 3.8285938742274648}, 0.90424838659779416},
      {{0.6357421875, -0.06677065765943202}, {-0.22028596378051535, 0.11821207282375806}, 0.76022834362314962}},
     0.039524231497662925,
     {0.197125469563634, 0.050935613710178303},
     {-0.16734206412219349, 0.09571426255893356},
     {-0.46651460521260502, 0.60496266793006914}},
    // walls, FF, least 0.2225 at 0.422
    {{{{-0.7314453125, 0.26013078915645044}, {3.9522576830644183, 0.61616491839301901}, 0.8125680276868823},
      {{0.23828125, 0.1959386026589609}, {-3.971104176295146, 0.47992876660109812}, 1.4773140476597595}},
     0.059464653741474326,
     {0.029620364020517695, 0.11905054042219966},
     {-0.58810191429898195, 0.9991826122093328},
     {0.065573144770246561, -0.71091005622758552}},
    // vee, FF, least 0.0132 at 0.094
    {{{{0.1162109375, 0.067255570716067026}, {3.2372073006539588, 2.3495720658436312}, 0.62926649865697104},
      {{0.8828125, -0.089246168362719897}, {-1.5955090504974512, 1.2059647050310893}, 1.4553581655037027}},
     0.023697929573632679,
     {0.0086730863853896056, 0.24818656697234259},
     {0.61946567148480847, 0.089591613872197828},
     {0.30098982735996588, 1.9259671148216198}},
    // walls, UF, least 0.4369 at 0.969
    {{{{-0.38671875, 0.26296836783542715}, {0.24670335320675685, 0.040465485497423348}, 0.97435229849039229},
      {{0.576171875, 0.21864814278471129}, {-3.9383095662365384, 0.69979837131117262}, 0.96836996438292444}},
     0.045837666958715453,
     {0.059206841504155172, 0.10088471492770187},
     {-0.012450392558587764, 1.3234034563699923},
     {-0.072243023824774322, 0.28905831682431349}},
    // ridge, FF, least 0.2957 at 0.062
    {{{{0.6357421875, 0.11356780010586204}, {-0.17549488367860874, 0.98448034302500509}, 1.3398609368322836},
      {{0.90625, -0.15658998025683138}, {0.66594130102154292, 3.4360620168433713}, 0.42572818713670202}},
     0.012624140208887826,
     {0, 0.054171645341842212},
     {0.77736739839213553, -0.8574263427319635},
     {0.8030760632920233, 0.92970753417668417}},
    // opposed, UFU, least 0.0789 at 0.641
    {{{{-0.748046875, 0.0830078125}, {20, 12}, 0.73731833607089181},
      {{1.126953125, 1.2080078125}, {-10, -6}, 1.1278863096719083},
      {{-0.0654296875, -0.2045933359254965}, {0.31262619853003726, 1.4670599374233686}, 0.9996373235967031}},
     0.068987492522361568,
     {0, 0.24459036907798176},
     {-0.24841575366231478, -0.11822655401219728},
     {-0.082836444757159455, 0.99479385611599391}},
    // ridge, FWF, least 0.4621 at 0.797
    {{{{-0.740234375, -0.10706433251330291}, {-0.86136243803327384, 0.50799089592764801}, 1.4546704612654007},
      {{0.5166015625, -0.083704212571113712}, {1.4206466071718542, 1.4077511205930895}, 0.98119132609288129},
      {{0.6142578125, 0.15912720000140307}, {0.57566371207298994, 1.915361921570528}, 1.2014127614539245}},
     0.078783978121637468,
     {0.12901097192226949, 0.12939513210264228},
     {-0.45591060708186054, 0.58281932290964855},
     {0.027219031194068988, -0.85358800279218094}},
};

}  // namespace

TEST_CASE("Lines between stable ends are refused where the inside is unstable", "[line]") {
  for (const LineCase& line : unstable_inside) {
    SamplePosture sample;
    sample.contacts = line.contacts;
    sample.rho = line.rho;
    sample.box = line.box;
    sample.com = line.from;
    INFO(sample.json());
    const RobustOracle oracle = oracle_of(sample);
    const DirectReference<Rational> exact(sample);
    REQUIRE(exact.robust(line.from));
    REQUIRE(exact.robust(line.to));
    CHECK(oracle.robust(line.from));
    CHECK(oracle.robust(line.to));
    const LineVerdict verdict = oracle.line(line.from, line.to);
    CHECK(verdict.outcome == Outcome::unstable);
    CHECK_FALSE(exact.robust(on_line(line.from, line.to, verdict.lambda)));
    CHECK(oracle.line(line.to, line.from).outcome == Outcome::unstable);
    CHECK(oracle.line_equilibrium(line.from, line.to));
    Counts counts;
    compare_line(sample, line.to, 300, counts);
    CHECK(counts.inside == 1);
  }
}

TEST_CASE("Verdict and least safety factor on a line agree with dense sampling", "[line]") {
  const std::uint64_t seed = 1234;
  Sampler sampler(seed);
  Counts counts;
  INFO("seed " << seed);
  for (int round = 0; round < rounds(30); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      compare_line(sample, sampler.com_near(sample.contacts), 60, counts);
    }
  }
  CHECK(counts.unstable > surefoot::test::enough(200));
}

TEST_CASE("Lines with stable ends agree with dense sampling", "[line]") {
  const std::uint64_t seed = 4321;
  Sampler sampler(seed);
  Counts counts;
  INFO("seed " << seed);
  for (int drawn = 0; drawn < 250;) {
    SamplePosture sample = sampler.posture(all_kinds[sampler.integer(0, 12)], sampler.integer(2, 3));
    if (sampler.chance(0.6)) sample.rho = sampler.uniform(0.01, 0.1);
    const DirectReference<double> reference(sample);
    if (!reference.robust(sample.com)) continue;
    const Eigen::Vector2d to = sampler.com_near(sample.contacts);
    if (!reference.robust(to)) continue;
    compare_line(sample, to, 80, counts);
    ++drawn;
  }
  CHECK(counts.stable > surefoot::test::enough(150));
  CHECK(counts.uncertain == 0);
}

namespace {

SamplePosture scaled(SamplePosture sample, double s) {
  sample.box.kappa *= s, sample.box.nu *= s;
  return sample;
}

/// The least factor on a line, decided exactly: a little below it no COM looked at fails, a little above it one does,
/// where it is said to be or beside.
void check_least_factor(const SamplePosture& sample, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  INFO(sample.json() << " com_to " << to.transpose());
  const RobustOracle oracle(sample.contacts, sample.rho, sample.box);
  const LineSafetyFactor found = oracle.line_safety_factor(from, to);
  const double value = found.least.value;
  INFO("factor " << value << " at lambda " << found.lambda);
  constexpr double greatest = 1e5, slack = 1e-6;
  const auto robust = [&](const ExactPosture& exact, double lambda) {
    return exact.robust(exact.frame(ExactCom(from, to, lambda)));
  };
  const ExactPosture below(scaled(sample, std::min(value, greatest) * (1 - slack)));
  for (int k = 0; k <= 32 && value > 0; ++k) CHECK(robust(below, k / 32.0));
  if (value > greatest) return;
  const ExactPosture above(scaled(sample, std::max(value * (1 + slack), 1e-9)));
  bool fails = false;
  for (const double aside : {0.0, 0x1p-40, -0x1p-40, 0x1p-30, -0x1p-30})
    fails = fails || !robust(above, std::clamp(found.lambda + aside, 0.0, 1.0));
  CHECK(fails);
}

}  // namespace

TEST_CASE("The least safety factor on a line is no greater than that of any COM of it, also where rows vanish",
          "[line][exact]") {
  Sampler sampler(77);
  int lines = 0;
  for (int round = 0; round < rounds(300); ++round) {
    const LineFamily family = line_family(round % 3 == 0 ? LineKind::grid : LineKind::tied, sampler);
    for (const auto& [from, to] : family.lines) {
      if (family.sample.box.kappa == 0 && family.sample.box.nu == 0) continue;
      check_least_factor(family.sample, from, to);
      ++lines;
    }
  }
  CHECK(lines > rounds(300));
  // Torques are not disturbed, and the line passes straight above a foot: beside it W touches the edge of that foot's
  // cone at mu / kappa; at that very place rows vanish and nothing happens.
  SamplePosture sample;
  sample.contacts = {{{-0.5, 0}, {0, 1}, 1}, {{0.25, 0}, {0, 1}, 0.125}, {{0.5, -0.35431687108220733}, {0, 1}, 0.6}};
  sample.rho = 0.2;
  for (const double kappa : {0.1, 0.13}) {
    sample.box = {kappa, 0};
    const RobustOracle oracle(sample.contacts, sample.rho, sample.box);
    const LineSafetyFactor found = oracle.line_safety_factor({0.25, 0.578125}, {0.25, -0.125});
    CHECK(found.least.value == Approx(0.125 / kappa).epsilon(1e-9));
  }
}

TEST_CASE("Equilibrium on a line follows from its ends, factor included", "[line]") {
  const std::uint64_t seed = 55;
  Sampler sampler(seed);
  int finite = 0;
  for (int round = 0; round < rounds(40); ++round) {
    for (const Kind kind : all_kinds) {
      const SamplePosture sample = sampler.posture(kind);
      const Eigen::Vector2d to = sampler.com_near(sample.contacts);
      INFO("seed " << seed << " com_to " << to.transpose() << "\n" << sample.json());
      const RobustOracle oracle = oracle_of(sample);
      const DirectReference<double> reference(sample);
      const double expected =
          std::min(reference.equilibrium_factor(sample.com).value, reference.equilibrium_factor(to).value);
      const LineSafetyFactor found = oracle.line_equilibrium_factor(sample.com, to);
      if (expected < practically_infinite) CHECK(found.least.value == Approx(expected).epsilon(1e-9).margin(1e-12));
      else CHECK(found.least.value > 0.1 * practically_infinite);
      CHECK(least_on_line(reference, sample.com, to, 20, true).least >= expected * (1 - 1e-9));
      if (std::abs(expected - 1) > 1e-9) CHECK(oracle.line_equilibrium(sample.com, to) == (expected > 1));
      finite += expected > 0 && expected < practically_infinite;
    }
  }
  CHECK(finite > surefoot::test::enough(80));
}
