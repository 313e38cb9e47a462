// `surefoot region` as a user runs it: text, JSON, picture, and one clear line for everything improper.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

using nlohmann::json;
using surefoot::tests::Workplace;

namespace {

const std::string level =
    R"({"contacts": [{"p": [0, 0], "n": [0, 1], "mu": 0.5}, {"p": [1, 0], "n": [0, 2], "mu": 0.5}], )"
    R"("rho": 0.2, "kappa": 0.1, "nu": 0.1})";
const std::string uneven =
    R"({"contacts": [{"p": [0, 0], "n": [0.573576436351046, 0.819152044288992], "mu": 0.5}, )"
    R"({"p": [1, 0.1], "n": [-0.17364817766693, 0.984807753012208], "mu": 0.5}], "rho": 0.1, "kappa": 0.176326980708465, "nu": 0.1})";

std::string replaced(std::string text, const std::string& piece, const std::string& other) {
  const auto at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), other);
}

double polygon_area(const json& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const json &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    twice += p[0].get<double>() * q[1].get<double>() - p[1].get<double>() * q[0].get<double>();
  }
  return twice / 2;
}

}  // namespace

TEST_CASE("A level posture's region is the rhombus of its tipping lines, in the JSON as promised", "[region]") {
  const Workplace place;
  place.write("level.json", level);
  const auto outcome = place.run("region --posture level.json --json -");
  REQUIRE(outcome.status == 0);
  const json tree = json::parse(outcome.out);
  CHECK(tree["equilibrium_area"].get<double>() == Approx(2 * 0.4 * 0.4 / 0.1));
  CHECK(tree["robust_area"].get<double>() == Approx(3.2));
  CHECK(tree["area_error"].get<double>() < 4e-6);
  CHECK(tree["window"].is_null());
  REQUIRE(tree["cells"].size() == 1);
  CHECK(tree["cells"][0]["modes"] == json::array());
  CHECK(polygon_area(tree["cells"][0]["polygon"]) == Approx(3.2));
  CHECK(tree["boundaries"].size() == 4);
}

TEST_CASE("Cells carry their modes, polygons enclose their areas, boundaries are labelled", "[region]") {
  const Workplace place;
  place.write("uneven.json", uneven);
  const auto outcome = place.run("region --posture uneven.json --json out.json --svg out.svg");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out.find("63.46 %") != std::string::npos);
  CHECK(outcome.out.find("FF UF FU UU") != std::string::npos);
  const json tree = json::parse(place.read("out.json"));
  double sum = 0;
  for (const json& cell : tree["cells"]) {
    sum += cell["area"].get<double>();
    CHECK(polygon_area(cell["polygon"]) == Approx(cell["area"].get<double>()).epsilon(0.01));
  }
  CHECK(sum == Approx(tree["equilibrium_area"].get<double>()));
  CHECK(tree["robust_area"].get<double>() / tree["equilibrium_area"].get<double>() == Approx(0.634).margin(1e-3));
  for (const json& boundary : tree["boundaries"]) CHECK_FALSE(boundary["label"].get<std::string>().empty());
  const std::string picture = place.read("out.svg");
  CHECK(picture.find("</svg>") != std::string::npos);
  CHECK(picture.find("rho = 0.1 m") != std::string::npos);
}

TEST_CASE("Scenes show their first stance or the one asked for, unbounded regions say where they are clipped",
          "[region]") {
  const Workplace place;
  const std::string scene = SUREFOOT_MAPS "/vee.yaml";
  CHECK(place.run("region " + scene).out.find("legs 1, 2") != std::string::npos);
  CHECK(place.run("region " + scene + " --stance 3,1").out.find("legs 1, 3") != std::string::npos);
  CHECK(place.run("region " + scene + " --stance 1,2,3").status == 0);
  place.write("strip.json", replaced(level, R"("kappa": 0.1)", R"("kappa": 0)"));
  const json clipped = json::parse(place.run("region --posture strip.json --window 0,0,0.5,1 --json -").out);
  CHECK(clipped["window"] == json::array({0.0, 0.0, 0.5, 1.0}));
  CHECK(clipped["equilibrium_area"].get<double>() == Approx(0.4));
  CHECK(json::parse(place.run("region --posture strip.json --json -").out)["window"].size() == 4);
  CHECK(place.run("region --posture - --wrench 0.1,-0.05", uneven).out.find("one wrench w") != std::string::npos);
}

TEST_CASE("A posture that cannot be balanced is a result, not an error", "[region]") {
  const Workplace place;
  const auto outcome =
      place.run("region --posture - --json out.json --svg out.svg", replaced(level, R"("nu": 0.1)", R"("nu": 0.6)"));
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("no COM can be balanced") != std::string::npos);
  CHECK(json::parse(place.read("out.json"))["equilibrium_area"] == 0.0);
}

TEST_CASE("Improper input is refused on one line with its place", "[region]") {
  const Workplace place;
  place.write("level.json", level);
  place.write("typo.json", replaced(level, "\"rho\"", "\"roh\""));
  place.write("zero.json", replaced(level, "[0, 2]", "[0, 0]"));
  const std::string scene = SUREFOOT_MAPS "/vee.yaml";
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const auto outcome = place.run("region " + arguments);
    INFO(arguments << ": " << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.one_error());
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find(words) != std::string::npos);
  };
  refused("", "expected a scene file or --posture");
  refused("--posture " SUREFOOT_MAPS "/vee.yaml", "takes a scene without --posture");
  refused(scene + " --posture level.json", "one of them");
  refused("level.json", "takes one with --posture");
  refused("--posture missing.json", "missing.json");
  refused("--posture typo.json", "typo.json:1:");
  refused("--posture zero.json", "may not be zero");
  refused("--posture level.json --stance 1,2", "--stance");
  refused(scene + " --stance 1,1", "found 1,1");
  refused(scene + " --stance 1,4", "expected two or three of the legs 1, 2, 3");
  refused("--posture level.json --window 1,1,0,0", "xmin < xmax");
  refused("--posture level.json --window 1,1", "--window");
  refused("--posture level.json --wrench a,b", "found a,b");
  refused("--posture level.json --svg level.json", "would be overwritten");
  refused("--posture level.json --svg region.png", "expected a name that ends in .svg");
  refused("--posture level.json --svg a --json a", "both --svg and --json");
  refused("--posture level.json --svg - --json -", "one of them");
}

TEST_CASE("With a restitution the regions of frictional stability are told, written and drawn",
          "[region][frictional]") {
  const Workplace place;
  // Level ground: clattering converges on a strip of known width (tests/stability/frictional_region_test.cpp).
  place.write("level.json", level);
  const auto told =
      place.run("region --posture level.json --restitution 0.01 --window=-1,-1,2,1 --json out.json --svg out.svg");
  REQUIRE(told.status == 0);
  const double theta = (std::cbrt(0.01) + std::cbrt(0.0001)) / 1.01;
  const double width = 2 * std::sqrt(0.25 - 0.04 - 0.2 * theta / std::sqrt(1 - theta * theta));
  CHECK(told.out.find("restitution 0.01") != std::string::npos);
  const json tree = json::parse(place.read("out.json"))["frictional"];
  CHECK(tree["equilibrium"] == json::array({0, -1, 1, 1}));
  CHECK(tree["clattering"]["area"].get<double>() == Approx(2 * width).epsilon(1e-5));
  CHECK(polygon_area(tree["clattering"]["polygons"][0]) == Approx(2 * width).epsilon(1e-2));
  CHECK(tree["stable"]["area"].get<double>() <= tree["kinematic_strong"]["area"].get<double>());
  const std::string picture = place.read("out.svg");
  for (const char* piece :
       {"class=\"kinematic-strong\"", "class=\"clattering\"", "restitution e = 0.01", "url(#hatch)"})
    CHECK(picture.find(piece) != std::string::npos);
  // Without one nothing of it is there.
  const auto without = place.run("region --posture level.json --json -");
  CHECK_FALSE(json::parse(without.out).contains("frictional"));
  // From the posture, and from the scene.
  place.write("with.json", replaced(level, "\"rho\"", "\"restitution\": 0.02, \"rho\""));
  CHECK(place.run("region --posture with.json").out.find("restitution 0.02") != std::string::npos);
  const auto bad = place.run("region --posture level.json --restitution 1");
  CHECK(bad.status == 2);
  CHECK(bad.err.find("--restitution: found 1, expected a number between 0 and 1") != std::string::npos);
  const auto three = place.run("region " SUREFOOT_MAPS "/vee.yaml --stance 1,2,3 --restitution 0.1");
  CHECK(three.status == 2);
  CHECK(three.err.find("about two contacts, there are 3; expected two legs, for example --stance 1,2") !=
        std::string::npos);
}

TEST_CASE("Where there is no region it is said within what and of which wrenches", "[region]") {
  const Workplace place;
  const std::string scene = " " SUREFOOT_MAPS "/vee.yaml";
  CHECK_THAT(place.run("region" + scene + " --window 90,90,91,91").out,
             Catch::Contains("\nno COM in the window can be balanced under every wrench of W\n"));
  CHECK_THAT(place.run("region" + scene + " --window 90,90,91,91 --wrench 0,0").out,
             Catch::Contains("\nno COM in the window can be balanced under this wrench\n"));
}

TEST_CASE("Frictional stability of a scene whose stance is not chosen is asked for by --stance", "[region]") {
  const Workplace place;
  std::string text = place.shell("cat '" SUREFOOT_MAPS "/flat.yaml'").out;
  text += "\nstability: {criterion: frictional, restitution: 0.1}\n";
  if (const auto at = text.find("  support:"); at != std::string::npos) text.erase(at, text.find('\n', at) - at);
  place.write("s.yaml", text);
  CHECK_THAT(place.run("region s.yaml").err, Catch::Contains("--stance LEG,LEG shows where it holds"));
  const auto chosen = place.run("region s.yaml --stance 1,2");
  CHECK(chosen.err.empty());
  CHECK_THAT(chosen.out, Catch::Contains("both: frictionally stable"));
}
