// Whatever comes in: one clear line, status 2, nothing on standard output, no file made. And what only looks strange is
// read as it is meant.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/planner/program.hpp"
#include "tests/robust/spoilt.hpp"

using nlohmann::json;
using namespace surefoot::tests;

namespace {

void check_refused(const Workplace& place, const std::string& arguments, const std::string& input = "") {
  const std::ptrdiff_t files = place.count();
  const auto run = place.run(arguments, input);
  INFO("surefoot " << arguments << "\n" << run.err.substr(0, 2000));
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK(run.one_error());
  CHECK(run.err.size() < 500);
  CHECK(place.count() == files);
}

std::string without_time(const std::string& plan) {
  json tree = json::parse(plan);
  tree.erase("time_s");
  return tree.dump();
}

}  // namespace

TEST_CASE("A text that is no scene, plan or posture is refused by every command that reads one", "[robust]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  for (const Spoilt& spoilt : spoilt_texts()) {
    INFO(spoilt.what);
    place.write("bad", spoilt.text);
    check_refused(place, "plan bad -o plan.json --svg plan.svg");
    check_refused(place, "check scene.yaml bad");
    check_refused(place, "region --posture bad --svg region.svg");
    check_refused(place, "simulate bad --json motion.json");
    check_refused(place, "plan - --format json", spoilt.text);
    const auto validate = place.run("validate bad");
    CHECK(validate.status == 2);
    CHECK(validate.err.empty());
    CHECK_THAT(validate.out, Catch::StartsWith("bad:"));
    CHECK(place.count() == 2);
  }
}

TEST_CASE("Line ends of any system, a byte-order mark and UTF-8 change no plan", "[robust]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  const auto plain = place.run("plan scene.yaml --format json --effort 0");
  REQUIRE(plain.status == 0);
  std::string crlf;
  for (const char c : flat_scene) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text : {crlf, "\xEF\xBB\xBF" + flat_scene, "\xEF\xBB\xBF# \xE2\x82\xAC \xC3\xA4\r\n" + crlf,
                                  flat_scene + "\n\n# end"}) {
    place.write("scene.yaml", text);
    const auto run = place.run("plan scene.yaml --format json --effort 0");
    CHECK(run.status == 0);
    CHECK(without_time(run.out) == without_time(plain.out));
  }
}

TEST_CASE("Where the decimal point is a comma, the same bytes are read and written", "[robust]") {
  const Workplace place;
  // A locale of our own making: the machine need not have it.
  const auto made = place.shell(
      "localedef -i de_DE -f UTF-8 ./de_DE.UTF-8 2>/dev/null && "
      "LOCPATH=$PWD LC_ALL=de_DE.UTF-8 locale decimal_point");
  if (made.status != 0 || made.out != ",\n") {
    WARN("skipped: localedef cannot make the locale de_DE.UTF-8 here");
    return;
  }
  place.write("scene.yaml", flat_scene);
  const std::string query = R"({"contacts": [{"p": [0.5,0], "n": [0,1], "mu": 0.5}], "com": [0.5,0.4], "rho": 0.2, )"
                            R"("kappa": 0.17, "nu": 0.1})"
                            "\n";
  const auto run = [&](const std::string& locale, const std::string& arguments, const std::string& input) {
    return place.shell("LOCPATH=$PWD LC_ALL=" + locale + " '" SUREFOOT_BINARY "' " + arguments, input);
  };
  const auto plan = run("C", "plan scene.yaml --format json --effort 0 --svg c.svg", "");
  const auto plan_de = run("de_DE.UTF-8", "plan scene.yaml --format json --effort 0 --svg de.svg", "");
  REQUIRE(plan.status == 0);
  CHECK(without_time(plan_de.out) == without_time(plan.out));
  CHECK(place.read("de.svg") == place.read("c.svg"));
  place.write("plan.json", plan_de.out);
  for (const std::string arguments : {"check scene.yaml plan.json", "validate scene.yaml", "query -",
                                      "region scene.yaml --json -", "plan scene.yaml --seed 1,5"}) {
    const auto c = run("C", arguments, query), de = run("de_DE.UTF-8", arguments, query);
    INFO(arguments);
    CHECK(c.status == de.status);
    CHECK(c.out == de.out);
    CHECK(c.err == de.err);
  }
}

TEST_CASE("Every line of a query is answered by one line, however bad", "[robust]") {
  const std::string good =
      R"({"contacts": [{"p": [0,0], "n": [0,1], "mu": 0.5}, {"p": [1,0], "n": [0,1], "mu": 0.5}], )"
      R"("com": [0.5,0.4], "rho": 0.2, "kappa": 0.17, "nu": 0.1})";
  const auto with_number = [&good](const std::string& number) { return with("0.17", number, good); };
  std::vector<std::string> bad{repeated("[", 100'000),
                               repeated("{\"a\":", 100'000),
                               R"({"contacts": )" + repeated("[", 1000) + repeated("]", 1000) + "}",
                               repeated("x", 3 << 20),
                               good + repeated(" ", 2 << 20),
                               with_number("1e999"),
                               with_number("-1e999"),
                               with_number("NaN"),
                               with_number("Infinity"),
                               with_number("0x1"),
                               with_number("0,17"),
                               with_number("\"0.17\""),
                               with("\"nu\"", "\"nu\": 1, \"nu\"", good),
                               with("\"mu\"", "\"mu\": 1, \"mu\"", good),
                               "",
                               " ",
                               "null",
                               "\xEF\xBB\xBF",
                               "\xFF\xFE",
                               rubbish(1000, 3),
                               std::string("\0", 1)};
  for (std::string& line : bad) std::replace(line.begin(), line.end(), '\n', ' ');
  std::string input;
  for (const std::string& line : bad) input += line + '\n' + good + '\n';
  const Workplace place;
  const auto run = place.run("query -", input + good);  // the last one without its line feed
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  std::istringstream answers(run.out);
  std::string answer;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    INFO(bad[i].substr(0, 200));
    REQUIRE(std::getline(answers, answer));
    const json refusal = json::parse(answer);
    CHECK(refusal.contains("error"));
    CHECK(refusal["line"] == 2 * i + 1);
    CHECK(answer.size() < 500);
    REQUIRE(std::getline(answers, answer));
    CHECK(json::parse(answer)["robust"] == true);
  }
  REQUIRE(std::getline(answers, answer));
  CHECK(json::parse(answer)["robust"] == true);
  CHECK_FALSE(std::getline(answers, answer));
}

TEST_CASE("Directories, devices and closed streams as input", "[robust]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  std::filesystem::create_directory(place / "folder");
  for (const char* input : {"folder", "/dev/null", "missing", "''", "folder/missing", "scene.yaml/x"})
    for (const char* command : {"plan ", "check scene.yaml ", "region --posture ", "simulate "})
      check_refused(place, command + std::string(input));
  for (const char* input : {"folder", "missing", "scene.yaml/x"}) check_refused(place, std::string("query ") + input);
  for (const char* command : {"plan - <&-", "check scene.yaml - <&-", "query <&-", "simulate - <&-", "plan - <folder"})
    check_refused(place, command);
  check_refused(place, "validate - -");
}

TEST_CASE("A pipe with a name is read like a file", "[robust]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  const auto run = place.shell("mkfifo pipe && { cat scene.yaml >pipe & '" SUREFOOT_BINARY "' validate pipe; }");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Catch::StartsWith("pipe: valid: "));
}
