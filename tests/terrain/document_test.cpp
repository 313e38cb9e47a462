// What is read, what is refused, and where and how a refusal says so.
#include "terrain/document.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace surefoot::terrain {
namespace {

using namespace std::string_literals;

Document parse(std::string_view text) { return Document::parse(text, "f.yaml"); }

template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string parse_error(std::string_view text) {
  return error_of([&] { parse(text); });
}

struct Refusal {
  std::string text, message;
};

TEST_CASE("escapes stand for characters, always as UTF-8", "[document]") {
  // YAML 1.2, 5.7: \_ is U+00A0, \N is U+0085, \L is U+2028, \P is U+2029.
  const Document document = parse(R"(["a\_b", "\N", "\L\P", "\xe4\u20ac\U0001f600", "\_\_\N"])");
  const std::vector<std::string> expected{"a\u00a0b", "\xC2\x85", "\u2028\u2029", "\u00e4\u20ac\U0001f600",
                                          "\u00a0\u00a0\xC2\x85"};
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(document.root().items("list")[i].text("text") == expected[i]);
}

TEST_CASE("JSON's pairs of escapes beyond U+FFFF are one character, and escapes of backslashes none", "[document]") {
  const Document document =
      parse(R"( {"a": "\ud83e\udd16 \u00e9", "b": ["\\\ud83d\ude00", "\\ud83e\\udd16", "\uDBFF\uDFFF"], "c": "\ud)" +
            std::string(R"(7ff"})"));
  const Node& root = document.root();
  CHECK(root.require("a", "x").text("a") == "\U0001f916 \u00e9");
  const auto& b = root.require("b", "x").items("b");
  CHECK(b[0].text("b") == "\\\U0001f600");
  CHECK(b[1].text("b") == "\\ud83e\\udd16");
  CHECK(b[2].text("b") == "\U0010ffff");
  CHECK(root.require("c", "x").text("c") == "\ud7ff");
  // Places are those of the text as given.
  CHECK_THAT(parse_error("{\"a\": \"\\ud83e\\udd16\\ud83e\\udd16\", \"b\": ]}"), Catch::StartsWith("f.yaml:1:40:"));
  CHECK_THAT(parse_error("{\"a\": \"\\ud83e\\udd16\",\n \"b\": ]}"), Catch::StartsWith("f.yaml:2:7:"));
  // Half a pair is no character, and what is not JSON has escapes of its own.
  for (const std::string alone : {R"({"a": "\ud83e"})", R"({"a": "\udd16\ud83e"})", R"({"a": "\ud83e\u0041"})"})
    CHECK_THAT(parse_error(alone), Catch::Contains("invalid unicode"));
  CHECK(parse(R"(a: '\ud83e\udd16')").root().require("a", "x").text("a") == R"(\ud83e\udd16)");
  for (const std::string cut : {"{\"a\": \"\\", "{\"a\": \"\\u", "{\"a\": \"\\ud83e\\udd1", "{"})
    CHECK_FALSE(parse_error(cut).empty());
}

TEST_CASE("traps of the parser are refused with their place", "[document]") {
  const std::vector<Refusal> refusals{
      {"- {x: 0}\nfriction: 0.5\n",
       "f.yaml:2:1: content after the end of the value; expected one value (is the indentation right?)"},
      {"[1, 2] 3\n", "f.yaml:1:8: content after the end of the value; expected one value (is the indentation right?)"},
      {"a: 1\n---\nb: 2\n",
       "f.yaml:2:1: content after the end of the value; expected one value (is the indentation right?)"},
      {"a: 1\n...\nb: 2\n",
       "f.yaml:3:1: content after the end of the value; expected one value (is the indentation right?)"},
      {"[1, 2]\n}\n", "f.yaml:2:1: not valid JSON or YAML: illegal flow end; a closing bracket without an opening one"},
      {"a: 1\nb: 2\n\"a\": 3\n", "f.yaml:3:1: key \"a\" is given twice; first at line 1"},
      {"{b: {c: 1, d: 2, c: 3}}", "f.yaml:1:18: key \"c\" is given twice; first at line 1"},
      {"z: 1\na: 1\nz: 2\na: 2\n", "f.yaml:3:1: key \"z\" is given twice; first at line 1"},
      {"a: &x 1\nb: *x\n", "f.yaml:1:4: anchors (&x) are not accepted"},
      {"a: *x\n", "f.yaml:1:4: not valid YAML: the referenced anchor is not defined"},
      {"a: !!str 1\n", "f.yaml:1:4: tags (tag:yaml.org,2002:str) are not accepted"},
      {"a: ! 1\n", "f.yaml:1:4: tags (!) are not accepted"},
      {"!thing {a: 1}\n", "f.yaml:1:1: tags (!thing) are not accepted"},
      {"? [1, 2]\n: 3\n", "f.yaml:1:3: a list or map as a key; expected a word"},
      {"{a: 1,, b: 2}", "f.yaml:1:7: nothing before the comma; expected a key"},
      {"~: 1\n", "f.yaml:1:1: nothing before the colon; expected a key"},
      {"a: 'x\nb: 3\n", "f.yaml:1:4: this quote is never closed; expected another '"},
      {"a: \"x\\\"\nb: 3\n", "f.yaml:1:4: this quote is never closed; expected another \""},
      {"{\"a\": 1,, \"b\": 2}", "f.yaml:1:9: nothing before the comma; expected a key"},
      {"{, a: 1}", "f.yaml:1:2: nothing before the comma; expected a key"},
      {"{\"a\"\n: 1}", "f.yaml:1:2: this key ends its line; expected its colon on the same line"},
      {"{\"a\" # c\n # d\n : 1}", "f.yaml:1:2: this key ends its line; expected its colon on the same line"},
      {"[\"a\": 1, {\"a\"\n, : 3}]", "f.yaml:1:11: nothing before the colon; expected a key"},
      {"{: 1}", "f.yaml:1:2: nothing before the colon; expected a key"},
      {"a: 'it''s\n", "f.yaml:1:4: this quote is never closed; expected another '"},
      {"a: [1, 2\nb: 3\n",
       "f.yaml:2:2: not valid YAML: end of sequence flow not found; is a ']' or a comma missing in the list that "
       "begins at f.yaml:1:4?"},
      {"\"\\", "f.yaml:1:4: not valid YAML: unknown escape character"},
      {"\"\\\u00e4\"", "f.yaml:1:4: not valid YAML: unknown escape character"},
      {"a: b: c\n",
       "f.yaml:1:5: not valid YAML: illegal map value; a text that holds a colon stands in quotes, a map on one line "
       "in braces {}"},
      {"a: 1\n\tb: 2\n", "f.yaml:2:1: not valid YAML: illegal tab when looking for indentation; indent by spaces"},
      {"", "f.yaml:1:1: nothing but white space or comments"},
      {"# only this\n\n", "f.yaml:1:1: nothing but white space or comments"},
      {"a: 1\nb: \xff\n", "f.yaml:2:4: byte 0xff is not UTF-8 text"},
      {"\xFF\xFE"
       "a\0"s,
       "f.yaml:1:1: this is UTF-16, not UTF-8 text; expected the file to be saved as UTF-8"},
      {"\xFE\xFF\0a"s, "f.yaml:1:1: this is UTF-16, not UTF-8 text; expected the file to be saved as UTF-8"},
      {"\xFF", "f.yaml:1:1: byte 0xff is not UTF-8 text"},
      {"a: \xC0\x80", "f.yaml:1:4: byte 0xc0 is not UTF-8 text"},
      {"a: \xED\xA0\x80", "f.yaml:1:4: byte 0xed is not UTF-8 text"},
      {"a: \xE2\x82", "f.yaml:1:4: byte 0xe2 is not UTF-8 text"},
      {"a: 1\nb\0: 2\n"s, "f.yaml:2:2: control character 0x00; expected text"},
      {"a: 1\n\x04"
       "b: 2\n",
       "f.yaml:2:1: control character 0x04; expected text"},  // ends yaml-cpp's input
      {"a: 1\rb: 2\r", "f.yaml:1:5: control character 0x0d; lines must end in LF or CR LF, not in CR alone"},
  };
  for (const auto& [text, message] : refusals) {
    CAPTURE(text);
    CHECK(parse_error(text) == message);
  }
}

TEST_CASE("what the parser only calls invalid is explained by its usual cause", "[document]") {
  const std::vector<Refusal> refusals{
      // Brackets and commas of lists and maps.
      {"v: [[0, 0], [1, 0]\nw: 1\n", "]' or a comma missing in the list that begins at f.yaml:1:4?"},
      {"v: [[0, 0] [1, 0]]\n", "]' or a comma missing in the list that begins at f.yaml:1:4?"},
      {"# a\nd: {k: 0.1, n: 1\nw: 1\n", "}' or a comma missing in the map that begins at f.yaml:2:4?"},
      {"d: {k: 0.1; n: 1}\n", "}' or a comma missing in the map that begins at f.yaml:1:4?"},
      {"d: {k: 1}}\n", "a closing bracket without an opening one"},
      // JSON that was cut, or whose brackets do not match; brackets and quotes in texts and comments do not count.
      {"{\"a\": 1, \"b\": [1, 2]\n",
       "f.yaml:1:21: not valid JSON or YAML: the text ends, but a '}' is missing in the map that begins at f.yaml:1:1"},
      {"{\"a\": \"]}\\\"\", # {\n \"b\": {\"c\": 1}\n",
       "f.yaml:2:15: not valid JSON or YAML: the text ends, but a '}' is missing in the map that begins at f.yaml:1:1"},
      {"{\"x\": [{\"y\": -0.5]}",
       "f.yaml:1:18: not valid JSON or YAML: ']' is found where '}' must end the map that begins at f.yaml:1:8"},
      {"# c\n--- {n: it's, x: [1, 2}\n",
       "f.yaml:2:23: not valid JSON or YAML: '}' is found where ']' must end the list that begins at f.yaml:2:18"},
      {"{n: it's, v: [[0, 0] [1, 0]]}\n", "]' or a comma missing in the list that begins at f.yaml:1:14?"},
      {"{\"x\": [1, 2}}",
       "f.yaml:1:12: not valid JSON or YAML: '}' is found where ']' must end the list that begins at f.yaml:1:7"},
      {"r:\n  a: 1\n    b: 2\n", "keys of one map, or dashes of one list, begin in the same column"},
      {"goal:{com_x: [1.5, 1.9]}   # there\n", "a space must follow a colon"},
      {"r:\n  a: 1\n  clearance:0.1   # [m]\ns: 2\n", "a space must follow a colon"},
      {"r:\n  a: 1\n  support:[1, 2]   # as is com: [x, y]\ns: 2\n", "a space must follow a colon"},
      // Colons and dashes.
      {"t:\n  f:0.6  # mu: Coulomb\n\n  # more\n  c: 1\n", "on line 2 a space must follow the colon"},
      {"t:\n  f = 0.6  # mu: Coulomb\n  c: 1\n", "on line 2 a colon is missing (key: value)"},
      {"r\n  g: 1\n", "on line 1 a colon is missing (key: value)"},
      {"name: my: scene\n", "a text that holds a colon stands in quotes, a map on one line in braces {}"},
      {"goal: com_x: [1, 2]\n", "a text that holds a colon stands in quotes, a map on one line in braces {}"},
      {"d:{k: 0.1, n: 1}\n", "a space must follow a colon"},
      {"f: {x: 1}, {x: 2}\n", "a list of several on one line stands in square brackets"},
      {"t:\n  // mu\n  f: 1\n", "on line 2 a comment must begin with #"},
      {"c:\n  -v: 1\n    s: 1\n", "on line 2 a space must follow the dash"},
      // Indentation.
      {"t:\n  f: 0.6\n c: 1\n", "keys of one map, or dashes of one list, begin in the same column"},
      {"t:\n  f: 0.6\n \u00a0c: 1\n", "a no-break space (U+00A0) stands on line 3: write ordinary spaces"},
      {"t:\n\u00a0 f: 0.6\n  c: 1\n", "a no-break space (U+00A0) stands on line 2: write ordinary spaces"},
      {"t:\n  f:\u00a00.6\n  c: 1\n", "a no-break space (U+00A0) stands on line 2: write ordinary spaces"},
      {"n: a\u00a0b\nt:\n\tf: 0.6\n", "a tab stands in the indentation: indent by spaces"},  // one that is meant
      {"n: a\t# :\u00a0b\nt:\n\tf: 0.6\n", "a tab stands in the indentation: indent by spaces"},
      {"t:\n\tf: 0.6\n", "a tab stands in the indentation: indent by spaces"},
      {"a: - b\n", "a dash of a list stands at the beginning of its line"},
  };
  for (const auto& [text, advice] : refusals) {
    CAPTURE(text);
    const std::string error = parse_error(text);
    const bool flow = text.find_first_of("{[") == 0 || text.starts_with("# c\n--- {");
    CHECK_THAT(error, Catch::StartsWith("f.yaml:") &&
                          Catch::Contains(flow ? ": not valid JSON or YAML: " : ": not valid YAML: ") &&
                          Catch::EndsWith(advice));
    CHECK(error.find('\n') == std::string::npos);
  }
  CHECK(parse_error("surefoot:1\nname: x\n") ==
        "f.yaml:2:5: not valid YAML: illegal map value; on line 1 a space must follow the colon");
  CHECK(parse_error("surefoot:1  # version\nname: x\n") ==
        "f.yaml:2:1: content after the end of the value; expected one value; on line 1 a space must follow the colon");
}

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

TEST_CASE("nesting is limited, in every style, without exhausting the stack", "[document]") {
  const auto nested = [](std::size_t depth, const std::string& open, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += open;
    text += "1";
    for (std::size_t i = 0; i < depth; ++i) text += close;
    return text;
  };
  CHECK(parse_error(nested(max_depth, "[", "]")) == "no error");
  CHECK(parse_error(nested(max_depth + 1, "[", "]")) == "f.yaml:1:65: nested deeper than 64 levels");
  for (const std::string open : {"[", "{a: ", "- ", "[\n", "? "}) {
    CAPTURE(open);
    const std::string error = parse_error(nested(200000, open, ""));
    CHECK_THAT(error, Catch::Contains("nested deeper than 64 levels") || Catch::Contains("a list or map as a key") ||
                          Catch::Contains("the text ends, but a"));
  }
}

TEST_CASE("files that are none are refused by name", "[document]") {
  const auto folder = std::filesystem::temp_directory_path() / "surefoot_document_test";
  std::filesystem::create_directories(folder);
  const auto path = [&](const char* name) { return (folder / name).string(); };
  CHECK(error_of([&] { Document::read_file(folder.string()); }) ==
        folder.string() + ": is a directory; expected a file");
  CHECK(error_of([&] { Document::read_file(path("none.yaml")); }) ==
        path("none.yaml") + ": cannot be opened: No such file or directory");
  CHECK(error_of([&] { Document::read_file(""); }) == "the name of an input file is empty");
  std::ofstream(path("empty.yaml")).close();
  CHECK(error_of([&] { Document::read_file(path("empty.yaml")); }) ==
        path("empty.yaml") + ":1:1: nothing but white space or comments");
  std::ofstream(path("good.yaml"), std::ios::binary) << "\xEF\xBB\xBF"
                                                        "a: 1\r\nb: [2,\r\n 3]\r\n";
  const Document document = Document::read_file(path("good.yaml"));
  CHECK(document.root().require("a", "file").where() == path("good.yaml") + ":1:4");
  CHECK(document.root().require("b", "file").items("b", 2)[1].where() == path("good.yaml") + ":3:2");
  CHECK(document.root().require("b", "file").items("b", 2)[1].integer("b") == 3);
  std::filesystem::remove_all(folder);
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

TEST_CASE("JSON reads as the same tree", "[document]") {
  const Document document = parse(
      "{\n\t\"a\": \"caf\\u00e9 \\\"x\\\" \\/ \\\\\", \"b\":[1.25,-3e-2,null,true,\"inf\"],\"c\":{\"1\":{}, \"2\": []},"
      "\"long\":\"" +
      std::string(3000, 'x') + "\", \"d\": \"\"}\n");
  const Node& root = document.root();
  CHECK(root.require("a", "x").text("a") == "caf\u00e9 \"x\" / \\");
  const auto& b = root.require("b", "x").items("b", 5);
  CHECK(b[0].number("b") == 1.25);
  CHECK(b[1].number("b") == -3e-2);
  CHECK(b[2].is_null());
  CHECK(b[3].boolean("b"));
  CHECK(b[4].text("b") == "inf");
  const auto& c = root.require("c", "x").entries("c");
  REQUIRE(c.size() == 2);
  CHECK(c[0].first.text("key") == "1");
  CHECK(c[0].second.entries("c.1").empty());
  CHECK(c[1].second.items("c.2").empty());
  CHECK(root.require("long", "x").text("long").size() == 3000);
  CHECK(root.require("d", "x").text("d").empty());
}

TEST_CASE("nodes stay valid when their document is moved", "[document]") {
  Document first = parse("{a: short, b: \"with\\tescape\"}");
  const Node& b = *first.root().find("b");
  const Document second = std::move(first);
  CHECK(b.text("b") == "with\tescape");
  CHECK(b.where() == "f.yaml:1:15");
  CHECK(second.root().require("a", "x").text("a") == "short");
}

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
