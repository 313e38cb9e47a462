// Keys that are not known, and which ones they stand for.
#include "terrain/document.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "document_text.hpp"

namespace surefoot::terrain {
namespace {

TEST_CASE("unknown keys are refused with the nearest known one", "[document]") {
  const auto refuse = [](const std::string& text) {
    return error_of([&] { parse(text).root().allow_only({"friction", "chains"}, "terrain"); });
  };
  CHECK(error_of([&] {
          parse("com: 1").root().allow_only({"com_x", "com_y"}, "goal");
        }) == "f.yaml:1:1: goal: unknown key \"com\"; did you mean \"com_x\"?");
  CHECK(error_of([&] {
          parse("co: 1").root().allow_only({"co_x", "co_y"}, "goal");
        }) == "f.yaml:1:1: goal: unknown key \"co\"; expected one of: co_x, co_y");  // too short to tell
  CHECK(refuse("{friction: 1, chains: 2}") == "no error");
  CHECK(refuse("{}") == "no error");
  CHECK(refuse("friction: 1\nfricton: 2\n") ==
        "f.yaml:2:1: terrain: unknown key \"fricton\"; did you mean \"friction\", which is given already?");
  CHECK(refuse("mu: 1\n") == "f.yaml:1:1: terrain: unknown key \"mu\"; did you mean \"friction\"?");
  CHECK(error_of([&] {
          parse("{com_x: 1, com_xx: 2}").root().allow_only({"com_x", "com_y"}, "goal");
        }) == "f.yaml:1:12: goal: unknown key \"com_xx\"; did you mean \"com_x\", which is given already?");
  CHECK(error_of([&] {
          parse("{n: 1, nu: 2}").root().allow_only({"n", "mu"}, "contact");
        }) == "f.yaml:1:8: contact: unknown key \"nu\"; did you mean \"mu\"?");
  CHECK(refuse("{\u00a0chains: 1}") ==
        "f.yaml:1:2: terrain: unknown key \"\u00a0chains\"; a no-break space (U+00A0) stands in it: write ordinary "
        "spaces");
  CHECK(refuse("{speed: 1}") == "f.yaml:1:2: terrain: unknown key \"speed\"; expected one of: friction, chains");
  CHECK(refuse("{friction:1}") == "f.yaml:1:2: terrain: unknown key \"friction:1\"; a space must follow the colon");
  CHECK(refuse("{reach: 1}") == "f.yaml:1:2: terrain: unknown key \"reach\"; expected one of: friction, chains");
  static const KeyHomes homes{{"inside \"robot\"", {"reach", "chain", "radius_of_gyration"}}};
  const auto at_home = [](const std::string& text) {
    return error_of([&] {
      Document document = parse(text);
      document.know_homes(homes);
      document.root().allow_only({"friction", "chains"}, "terrain");
    });
  };
  CHECK(at_home("{reach: 1}") == "f.yaml:1:2: terrain: unknown key \"reach\"; it belongs inside \"robot\"");
  CHECK(at_home("{chain: 1}") ==
        "f.yaml:1:2: terrain: unknown key \"chain\"; it belongs inside \"robot\" (or did you mean \"chains\"?)");
  CHECK(at_home("{rho: 1}") ==
        "f.yaml:1:2: terrain: unknown key \"rho\"; did you mean \"radius_of_gyration\", which belongs inside "
        "\"robot\"?");
  CHECK(at_home("{speed: 1}") == "f.yaml:1:2: terrain: unknown key \"speed\"; expected one of: friction, chains");
  CHECK(refuse("[1]") == "f.yaml:1:1: terrain: a list of 1 item is given; expected a map (key: value)");
}

TEST_CASE("near misses are near", "[document]") {
  const std::vector<std::string> keys{"friction", "chains", "radius_of_gyration", "x", "nu"};
  CHECK(near_miss("fricton", keys) == "friction");
  CHECK(near_miss("FRICTION", keys) == "friction");
  CHECK(near_miss("firction", keys) == "friction");
  CHECK(near_miss("chain", keys) == "chains");
  CHECK(near_miss("radius-of-gyraton", keys) == "radius_of_gyration");
  CHECK(near_miss("radius", keys).empty());
  CHECK(near_miss("y", keys).empty());
  CHECK(near_miss("nuo", keys) == "nu");
  CHECK(near_miss("foo", {"com"}).empty());  // of three letters one may differ
  CHECK(near_miss("xml", {"text", "yaml"}).empty());
  CHECK(near_miss("nope", {"slope"}).empty());
  CHECK(near_miss("un", keys) == "nu");
  CHECK(near_miss("", keys).empty());
  CHECK(near_miss("friction", {}).empty());
  CHECK(near_miss(std::string(100000, 'a'), keys).empty());
  CHECK(key_meant("Rho", keys) == "radius_of_gyration");
  CHECK(key_meant("mu", {"kappa", "friction"}) == "friction");
  CHECK(key_meant("mu", keys) == "friction");
  CHECK(key_meant("mu", {"kappa", "nu"}).empty());  // no misspelt torque
  CHECK(key_meant("radius_of_gyration", {"com", "rho"}) == "rho");
  CHECK(key_meant("legs", {"com", "feet"}) == "feet");
  CHECK(key_meant("legs", {"leg", "foothold"}) == "leg");
  CHECK(key_meant("foothold", {"feet", "support", "com"}) == "feet");
  CHECK(key_meant("feet", {"friction", "foothold"}).empty());
  CHECK(key_meant("footholds", {"friction", "foothold"}) == "foothold");
  CHECK(key_meant("rho", {"com", "feet"}).empty());
}

}  // namespace
}  // namespace surefoot::terrain
