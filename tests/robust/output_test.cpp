// Whatever happens to the output: one clear line, the right status, no part of a file.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/planner/program.hpp"
#include "tests/planner/scene_text.hpp"

using nlohmann::json;
using namespace surefoot::tests;

namespace {

const std::string posture = R"({"contacts": [{"p": [-0.5, 0.15], "n": [0.4, 1], "mu": 0.5},
  {"p": [0.5, 0.15], "n": [-0.4, 1], "mu": 0.5}],
 "com": [0, 0.18], "rho": 0.15, "restitution": 0.1, "heights": [1e-3, 2e-3, 0]})";

/// Commands that write to standard output.
const std::vector<std::string> writers{"plan scene.yaml --effort 0",
                                       "plan scene.yaml --effort 0 --format json",
                                       "check scene.yaml plan.json",
                                       "validate scene.yaml",
                                       "region scene.yaml",
                                       "region scene.yaml --svg -",
                                       "simulate posture.json",
                                       "simulate posture.json --json -",
                                       "query query.json",
                                       "--help",
                                       "--version"};

/// All that the writers read.
void prepare(const Workplace& place) {
  place.write("scene.yaml", flat_scene);
  place.write("posture.json", posture);
  place.write("query.json", R"({"contacts": [{"p": [0,0], "n": [0,1], "mu": 0.5}], "com": [0,0.4], "rho": 0.2, )"
                            R"("kappa": 0, "nu": 0})"
                            "\n");
  REQUIRE(place.run("plan scene.yaml -q --effort 0 -o plan.json").status == 0);
}

}  // namespace

TEST_CASE("A full device or a closed standard output is one error, status 2", "[robust]") {
  const Workplace place;
  prepare(place);
  const std::ptrdiff_t files = place.count();
  for (const std::string& command : writers)
    for (const char* where : {" >/dev/full", " >&-"}) {
      const auto run = place.run(command + where);
      INFO(command << where << "\n" << run.err);
      CHECK(run.status == 2);
      CHECK(run.one_error());
      CHECK(place.count() == files);
    }
}

TEST_CASE("A reader that goes away ends the program without a word", "[robust]") {
  const Workplace place;
  prepare(place);
  const std::ptrdiff_t files = place.count() + 1;  // and the status
  for (const std::string& command : writers) {
    const auto run = place.shell("{ sleep 0.2; '" SUREFOOT_BINARY "' " + command + "; echo $? >status; } | true");
    INFO(command);
    CHECK(run.err.empty());
    CHECK(run.out.empty());
    CHECK(place.read("status") == "2\n");  // and not 128 + SIGPIPE
    CHECK(place.count() == files);
  }
}

TEST_CASE("Standard output named as a file is written to where it stands, be it a pipe or a file", "[robust]") {
  const Workplace place;
  prepare(place);
  const std::string run = "'" SUREFOOT_BINARY "' plan scene.yaml -q --effort 0 --format json";
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    INFO(name);
    REQUIRE(place.shell(run + " -o " + name + " | cat >piped.json").status == 0);
    CHECK(place.run("check scene.yaml piped.json").status == 0);
    REQUIRE(place.shell("{ echo '# begun'; " + run + " -o " + name + "; echo '# done'; } >file.json").status == 0);
    CHECK_THAT(place.read("file.json"), Catch::StartsWith("# begun\n{") && Catch::EndsWith("}\n# done\n"));
    CHECK(place.run("check scene.yaml file.json").status == 0);
    REQUIRE(place.shell(": >file.json; exec 3>file.json; rm file.json; " + run + " -o /dev/fd/3").status == 0);
    CHECK(place.shell("ls").out.find("deleted") == std::string::npos);
  }
}

TEST_CASE("Closed standard error changes nothing but what is said there", "[robust]") {
  const Workplace place;
  prepare(place);
  for (const std::string& command : writers) {
    INFO(command);
    CHECK(place.run(command + " 2>&-").status == 0);
    CHECK(place.run(command + " 2>/dev/full").status == 0);
  }
  CHECK(place.run("plan missing.yaml 2>&-").status == 2);
}

TEST_CASE("Where a file cannot be written the old one stays and none is left beside", "[robust]") {
  const Workplace place;
  prepare(place);
  std::filesystem::create_directory(place / "folder");
  const std::ptrdiff_t files = place.count();
  const std::string old = place.read("plan.json");
  for (const std::string command :
       {"plan scene.yaml --effort 0 -o ", "plan scene.yaml --effort 0 -o plan.json --svg ", "region scene.yaml --svg ",
        "region scene.yaml --json ", "simulate posture.json --svg ", "simulate posture.json --json "})
    for (const std::string target : {"folder", "missing/file", "''", "/dev/full", "scene.yaml/file", "folder/"}) {
      const auto run = place.run(command + target);
      INFO(command << target << "\n" << run.err);
      CHECK(run.status == 2);
      CHECK(run.one_error());
      CHECK(place.count() == files);
      CHECK(place.read("plan.json") == old);
    }
}

TEST_CASE("A disk that is full when the file is half written leaves the old file", "[robust]") {
  const Workplace place;
  prepare(place);
  const std::string old = place.read("plan.json");
  const std::ptrdiff_t files = place.count();
  REQUIRE(old.size() > 1024);
  // A limit of 512 bytes for each file has the same effect as the end of the disk.
  const auto run = place.shell("ulimit -f 1; '" SUREFOOT_BINARY "' plan scene.yaml --effort 0 --seed 2 -o plan.json");
  INFO(run.err);
  CHECK(run.status == 2);
  CHECK(run.out.empty());
  CHECK(run.one_error());
  CHECK(place.read("plan.json") == old);
  CHECK(place.count() == files);
}
