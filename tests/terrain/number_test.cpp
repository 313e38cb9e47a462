// Numbers and other values of a document: how they are read, and what is said of those that are none.
#include "terrain/document.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "document_text.hpp"

namespace surefoot::terrain {
namespace {

TEST_CASE("a number in the dress of another convention is told how to be written", "[document]") {
  const std::string unit =
      "is not a finite decimal number; expected the number alone, without a unit (metres, kilograms, seconds)";
  const std::string share = "is not a finite decimal number; expected the number alone (a share of 10 % is 0.1)";
  const std::string point = "is not a finite decimal number; expected a point, no comma: ";
  const std::string minus = "is not a finite decimal number; expected a plain minus sign, as in -0.25";
  const std::vector<Refusal> refusals{{"0,5", point + "0.5"}, {"-12,25", point + "-12.25"},
                                      {"30 deg", unit},       {"1m", unit},
                                      {"60%", share},         {"1e-3 m", unit},
                                      {"0.5f", unit},         {"30\u00b0", unit},
                                      {"\u22120.5", minus},   {"\u20130.5", minus}};
  for (const auto& [text, message] : refusals) {
    CAPTURE(text);
    CHECK(error_of([&] { parse("a: " + text).root().require("a", "file").number("mu"); }) ==
          "f.yaml:1:4: mu: " + text + " " + message);
  }
  // Long digits are cut, and a long text costs no more than a look at its beginning.
  const std::string digits(200, '3');
  CHECK(error_of([&] { parse("a: 0," + digits).root().require("a", "file").number("mu"); }).size() < 200);
  CHECK(error_of([&] { parse("a: 1" + std::string(1 << 22, 'x')).root().require("a", "file").number("mu"); }).size() <
        200);
}

TEST_CASE("a comma for a point is found where it parts a list or a map", "[document]") {
  const auto items = [](const std::string& text) { return error_of([&] { parse(text).root().items("x", 2); }); };
  CHECK(items("[-0,25, 0,9]") ==
        "f.yaml:1:1: x: a list of 4 items is given; expected a list of 2 items; if [-0.25, 0.9] is meant, the decimal "
        "point is a point, no comma");
  for (const std::string text : {"[0.25, 1, 0, 9]", "[1, -2, 3, 4]", "[1, 2, 3]"}) {
    CAPTURE(text);
    CHECK_THAT(items(text), Catch::EndsWith("expected a list of 2 items"));
  }
  CHECK(items("0.1, 0.9") == "f.yaml:1:1: x: 0.1, 0.9 is given; expected a list of 2 items in square brackets, [a, b]");
  CHECK_THAT(error_of([&] { parse("1, 2, 3").root().items("x", 3); }),
             Catch::EndsWith("expected a list of 3 items in square brackets, [a, b, c]"));
  for (const std::string word : {"[a b]", "['1, 2']", "[1 b]", "[1;]"})
    CHECK_THAT(items(word), Catch::EndsWith("a list of 1 item is given; expected a list of 2 items"));
  for (const std::string apart : {"[-2; 0]", "[-2 0]"})
    CHECK_THAT(items(apart),
               Catch::EndsWith("a list of 1 item is given; expected a list of 2 items; a comma must part them"));
  CHECK(items("0.1 - 0.9") ==
        "f.yaml:1:1: x: 0.1 - 0.9 is given; expected a list of 2 items in square brackets, [a, b]");
  CHECK(items("(1, 2)") == "f.yaml:1:1: x: (1, 2) is given; expected a list of 2 items in square brackets, [a, b]");
  const auto keys = [](const std::string& text) {
    return error_of([&] { parse(text).root().allow_only({"x"}, "foot"); });
  };
  CHECK(keys("{x: -0,5}") ==
        "f.yaml:1:8: foot: unknown key \"5\"; the decimal point is a point, no comma: expected -0.5");
  CHECK(keys("{x: 0.1, 5}") == "f.yaml:1:10: foot: unknown key \"5\"; expected one of: x");
}

TEST_CASE("numbers are read as the nearest double", "[document]") {
  const std::vector<std::pair<std::string, double>> numbers{
      {"0", 0.0},
      {"-0.3", -0.3},
      {"+1.5", 1.5},
      {".5", 0.5},
      {"5.", 5.0},
      {"1e-3", 1e-3},
      {"1E+3", 1e3},
      {"-2.5e2", -250},
      {"0.1000000000000000055511151231257827021181583404541015625", 0.1},
      {"1.7976931348623157e308", std::numeric_limits<double>::max()},
      {"4.9406564584124654e-324", std::numeric_limits<double>::denorm_min()},
      {"9007199254740993", 9007199254740992.0},
      {"0.30000000000000004", 0.1 + 0.2},
      {"0e5", 0.0},
      {"123456789012345678901234567890", 123456789012345678901234567890.0}};
  for (const auto& [text, value] : numbers) {
    CAPTURE(text);
    CHECK(parse("a: " + text).root().require("a", "file").number("a") == value);
    CHECK(parse("{\"a\":" + text + "}").root().require("a", "file").number("a") == value);
  }
}

TEST_CASE("what is no plain decimal number is refused with the value and what is expected", "[document]") {
  const std::string form = " is not a finite decimal number; expected a number such as 0.25 or 1e-3";
  const std::string zero = " has a leading zero; expected a decimal number without";
  const std::string range = " is too large or too small for a double; expected a number such as 0.25 or 1e-3";
  const std::vector<Refusal> refusals{{".nan", ".nan" + form},
                                      {".inf", ".inf" + form},
                                      {"-.inf", "-.inf" + form},
                                      {"nan", "nan" + form},
                                      {"inf", "inf" + form},
                                      {"infinity", "infinity" + form},
                                      {"0x10", "0x10" + form},
                                      {"0o10", "0o10" + form},
                                      {"1_000", "1_000" + form},
                                      {"1.2.3", "1.2.3" + form},
                                      {"1e", "1e" + form},
                                      {"--1", "--1" + form},
                                      {"+-1", "+-1" + form},
                                      {".", "." + form},
                                      {"1 2", "1 2" + form},
                                      {"12:30", "12:30" + form},
                                      {"abc", "abc" + form},
                                      {"010", "010" + zero},
                                      {"-007.5", "-007.5" + zero},
                                      {"1e999", "1e999" + range},
                                      {"-1e999", "-1e999" + range},
                                      {"1e-999", "1e-999" + range},
                                      {"'1'", "\"1\" is a text; expected a number, without quotes"},
                                      {"\"\"", "\"\" is a text; expected a number"},
                                      {"[1]", "a list of 1 item is given; expected a number"},
                                      {"{b: 1}", "a map is given; expected a number"},
                                      {"~", "nothing is given; expected a number"},
                                      {"null", "nothing is given; expected a number"},
                                      {"", "nothing is given; expected a number"},
                                      {"aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeee",
                                       "aaaaaaaaaabbbbbbbbbbccccccccccdddddddddd..." + form}};
  for (const auto& [text, message] : refusals) {
    CAPTURE(text);
    const std::string place = text.empty() ? "f.yaml:1:1: " : "f.yaml:1:4: ";
    CHECK(error_of([&] { parse("a: " + text + "\n").root().require("a", "file").number("mu"); }) ==
          place + "mu: " + message);
  }
}

TEST_CASE("bounds, integers, booleans and texts say what they expect", "[document]") {
  const Document document = parse(
      "{neg: -0.3, zero: 0, minus: -0.0, big: 9223372036854775808, least: -9223372036854775808, half: 0.5, "
      "octal: 010, yes: yes, True: True, t: true, f: false, quoted: \"true\", e: 1e3, name: caf\u00e9, n: 12}");
  const Node& root = document.root();
  const auto at = [&](const char* key) -> const Node& { return root.require(key, "file"); };
  CHECK(error_of([&] { at("neg").not_negative("friction"); }) ==
        "f.yaml:1:7: friction: -0.3 is negative; expected a number >= 0");
  CHECK(error_of([&] { at("zero").positive("robot.mass"); }) ==
        "f.yaml:1:19: robot.mass: 0 is not positive; expected a number > 0");
  CHECK_FALSE(std::signbit(at("minus").not_negative("x")));
  CHECK_THAT(error_of([] { parse("'1'").root().boolean("x"); }), Catch::EndsWith("expected true or false"));
  CHECK(at("least").integer("x") == std::numeric_limits<std::int64_t>::min());
  CHECK(error_of([&] { at("big").integer("seed"); }) ==
        "f.yaml:1:40: seed: 9223372036854775808 is out of range; expected an integer of at most 63 bits");
  const auto tail = [](const std::string& message) { return message.substr(message.find("x: ")); };
  CHECK(tail(error_of([&] { at("half").integer("x"); })) ==
        "x: 0.5 is not an integer; expected a whole number such as 7");
  CHECK(tail(error_of([&] { at("e").integer("x"); })) == "x: 1e3 is not an integer; expected a whole number such as 7");
  CHECK(tail(error_of([&] { at("octal").integer("x"); })) == "x: 010 has a leading zero; expected an integer without");
  CHECK(at("t").boolean("x"));
  CHECK_FALSE(at("f").boolean("x"));
  CHECK(tail(error_of([&] { at("yes").boolean("x"); })) == "x: yes is given; expected true or false");
  CHECK(tail(error_of([&] { at("True").boolean("x"); })) == "x: True is given; expected true or false");
  CHECK(tail(error_of([&] { at("quoted").boolean("x"); })) ==
        "x: \"true\" is a text; expected true or false, without quotes");
  CHECK(at("name").text("x") == "caf\u00e9");
  CHECK(at("n").text("x") == "12");
  CHECK(at("n").where() == "f.yaml:1:193");  // columns count characters, not bytes
  CHECK(tail(error_of([&] { root.text("x"); })) == "x: a map is given; expected a text");
  CHECK(tail(error_of([&] { at("n").items("x"); })) == "x: 12 is given; expected a list");
  CHECK(tail(error_of([&] { parse("[1, 2]").root().items("x", 3); })) ==
        "x: a list of 2 items is given; expected a list of 3 items");
  CHECK(tail(error_of([&] { at("n").entries("x"); })) == "x: 12 is given; expected a map (key: value)");
  CHECK(tail(error_of([&] { parse("a:\nb: 1").root().require("a", "x").entries("x"); })) ==
        "x: nothing is given; expected a map (key: value), indented below it");
  CHECK(error_of([] { parse("x:\ny: 1").root().find("x")->entries("x"); }) ==
        "f.yaml:1:1: x: nothing is given; expected a map (key: value), indented below it");
  CHECK(error_of([] { parse("a:1\nb:2").root().entries("x"); }) ==
        "f.yaml:1:1: x: a:1 b:2 is given; expected a map (key: value), with a space behind each colon");
  CHECK(error_of([] { parse("\"a: b\"").root().entries("x"); }) ==
        "f.yaml:1:1: x: \"a: b\" is a text; expected a map (key: value)");
  CHECK(error_of([] { parse("{\"x\": null}").root().find("x")->entries("x"); }) ==
        "f.yaml:1:7: x: nothing is given; expected a map (key: value)");
  CHECK(tail(error_of([&] { root.require("absent", "x"); })) == "x: \"absent\" is missing");
  CHECK(error_of([] { parse("y: 1").root().require("x", "y", "; add it"); }) ==
        "f.yaml:1:1: y: \"x\" is missing; add it");
  CHECK(root.find("absent") == nullptr);
  CHECK(at("n").find("absent") == nullptr);
}

}  // namespace
}  // namespace surefoot::terrain
