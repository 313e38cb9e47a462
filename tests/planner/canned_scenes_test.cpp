// Canned scenes by name, `surefoot maps`, and what a terminal shows; on the built program.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/planner/program.hpp"

using namespace surefoot::tests;

namespace {

/// Without the run's time.
std::string timeless(const std::string& plan) {
  return std::regex_replace(plan, std::regex("\"time_s\": [^,]*"), "\"time_s\": 0");
}

/// A command in a terminal of 30 columns; what it showed, stdout and stderr together.
std::string on_terminal(const Workplace& place, const std::string& environment, const std::string& arguments) {
  place.write("command", "stty cols 30; " + environment + " '" SUREFOOT_BINARY "' " + arguments);
  return place.shell("script -qec 'sh ./command' shown >/dev/null && cat shown").out;
}

}  // namespace

TEST_CASE("maps lists every canned scene with its first line", "[command][canned]") {
  const Workplace place;
  const auto run = place.run("maps");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  std::set<std::string> expected, listed;
  for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_MAPS)) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream file(entry.path());
    std::string line;
    std::getline(file, line);
    CHECK(std::regex_match(line, std::regex("# (Exercises|Impossible): .*")));
    expected.insert(entry.path().stem().string() + " " + line.substr(2));
  }
  std::istringstream lines(run.out);
  for (std::string name, rest; lines >> name >> std::ws && std::getline(lines, rest);) listed.insert(name + " " + rest);
  CHECK(listed == expected);
  CHECK(place.run("maps flat").status == 2);
}

TEST_CASE("A canned scene is known by its name where no file is", "[command][canned]") {
  const Workplace place;
  const std::string flat = SUREFOOT_MAPS "/flat.yaml";
  REQUIRE(place.run("plan flat --effort 0 -q -o by_name.json").status == 0);
  REQUIRE(place.run("plan '" + flat + "' --effort 0 -q -o by_path.json").status == 0);
  CHECK(timeless(place.read("by_name.json")) == timeless(place.read("by_path.json")));
  CHECK(place.run("check flat by_name.json").status == 0);
  CHECK(place.run("check slope by_name.json").status == 1);
  CHECK(place.run("region flat").out == place.run("region '" + flat + "'").out);
  std::filesystem::create_directory(place / "flat");
  CHECK(place.run("check flat by_name.json").status == 0);
  std::filesystem::remove(place / "flat");
  place.write("flat", "surefoot: 1\nnonsense: 1\n");
  CHECK_THAT(place.run("check flat by_name.json").err,
             Catch::Contains("flat:1:1: scene: \"terrain\" is missing; add such as \"terrain: {friction: 0.6, chains: "
                             "[{vertices: [[-1, 0], [3, 0]]}]}\" (and 5 more: surefoot validate flat)"));
}

TEST_CASE("What is neither file nor canned scene is answered with the nearest", "[command][canned]") {
  const Workplace place;
  place.write("plan.json", "{}");
  for (const char* command :
       {"plan stairs_upp", "plan maps/stairs_up.yaml", "check Stairs_up plan.json", "region stairsup"}) {
    const auto run = place.run(command);
    INFO(command << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
    CHECK_THAT(run.err, Catch::EndsWith(": no such file or canned scene, did you mean stairs_up?\n"));
  }
  CHECK_THAT(place.run("plan nothing_like_any").err,
             Catch::EndsWith("no such file or canned scene (surefoot maps lists those)\n"));
  std::filesystem::create_symlink(place / "nowhere.yaml", place / "link.yaml");
  CHECK_THAT(place.run("plan link.yaml").err, Catch::EndsWith("link.yaml: is a symbolic link that leads nowhere\n"));
  CHECK(place.run("validate nothing_like_any").out ==
        "nothing_like_any: no such file or canned scene (surefoot maps lists those)\n");
  CHECK_THAT(place.run("plan stairs").err, Catch::Contains("did you mean stairs_down or stairs_up?"));
  CHECK_THAT(place.run("mpas").err, Catch::Contains("did you mean maps?"));
}

TEST_CASE("A canned scene is not overwritten by its own plan", "[command][canned]") {
  const Workplace place;
  std::filesystem::create_directories(place / "bin");
  std::filesystem::create_directories(place / "share/surefoot/maps");
  std::filesystem::copy(SUREFOOT_BINARY, place / "bin");
  std::filesystem::copy(SUREFOOT_MAPS "/flat.yaml", place / "share/surefoot/maps");
  const std::string scene = place.read("share/surefoot/maps/flat.yaml");
  CHECK(place.shell("bin/surefoot maps").out.find("flat") == 0);
  for (const char* arguments : {"plan flat --effort 0 -o", "plan flat --effort 0 --svg", "region flat --json"}) {
    const auto run = place.shell(std::string("bin/surefoot ") + arguments + " share/surefoot/maps/flat.yaml");
    INFO(arguments << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
    CHECK(place.read("share/surefoot/maps/flat.yaml") == scene);
  }
}

TEST_CASE("A program without its maps says so and still plans files", "[command][canned]") {
  const Workplace place;
  std::filesystem::create_directory(place / "bin");
  std::filesystem::copy(SUREFOOT_BINARY, place / "bin");
  const auto maps = place.shell("bin/surefoot maps");
  CHECK(maps.status == 2);
  CHECK(maps.one_error());
  CHECK(place.shell("bin/surefoot plan flat").status == 2);
  CHECK(place.shell("bin/surefoot plan '" SUREFOOT_MAPS "/flat.yaml' --effort 0").status == 0);
}

TEST_CASE("A missing command is answered with all there are", "[command]") {
  const Workplace place;
  const std::string help = place.run("--help").out, missing = place.run("").err;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  int commands = 0;
  for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");) {
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    if (name.empty()) continue;  // a description goes on
    CHECK_THAT(missing, Catch::Contains(name));
    ++commands;
  }
  CHECK(commands >= 6);
}

TEST_CASE("Colour and progress go to able terminals only, and progress keeps to one line", "[command]") {
  const Workplace place;
  if (place.shell("command -v script && command -v stty").status != 0) {
    WARN("skipped: no script(1) to give a terminal");
    return;
  }
  if (on_terminal(place, "TERM=xterm", "maps").find("stairs_up") == std::string::npos) {
    WARN("skipped: no terminal to be had (is /dev/pts mounted?)");
    return;
  }
  const std::regex colour("\x1b\\[[0-9;]*m"), wipe("\r\x1b\\[K([^\r\n]*)");
  const std::string coloured = on_terminal(place, "TERM=xterm", "plan rubble --effort 0.5");
  CHECK(std::regex_search(coloured, colour));
  std::ptrdiff_t lines = 0;
  for (std::sregex_iterator at(coloured.begin(), coloured.end(), wipe), end; at != end; ++at, ++lines)
    if (at->str(1).find("solved") == std::string::npos) CHECK(at->str(1).size() <= 29);
  CHECK(lines >= 2);  // shown at least once, and wiped
  CHECK_FALSE(std::regex_search(on_terminal(place, "TERM=xterm NO_COLOR=1", "plan flat --effort 0"), colour));
  for (const char* words : {"plan rubble --effort 0.5 -q", "plan rubble --effort 0.5 -q 2>/dev/null"})
    CHECK_FALSE(std::regex_search(on_terminal(place, "TERM=xterm", words), wipe));
  CHECK(on_terminal(place, "TERM=dumb", "plan rubble --effort 0.5").find('\x1b') == std::string::npos);
  CHECK(place.run("plan flat --effort 0").out.find('\x1b') == std::string::npos);
}
