// What is read, what is refused, and where and how a refusal says so.
#include "terrain/document.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "document_text.hpp"

namespace surefoot::terrain {
namespace {

using namespace std::string_literals;

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

}  // namespace
}  // namespace surefoot::terrain
