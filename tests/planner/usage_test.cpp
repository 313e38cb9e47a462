// Command lines that are wrong, and the words that tell what was meant.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "program.hpp"
#include "scene_text.hpp"

using surefoot::tests::check_untouched;
using surefoot::tests::Workplace;

namespace {

const std::string& scene = surefoot::tests::flat_scene;

}  // namespace

TEST_CASE("Names that promise another kind of file are refused before anything is planned", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  for (const char* names :
       {"-o plan.svg", "-o plan.png", "-o plan.JPG", "--svg plan.png", "--svg page.HTML", "--html plan.svg"}) {
    const auto run = place.run(std::string("plan scene.yaml ") + names);
    INFO(names << ": " << run.err);
    CHECK(run.status == 2);
    CHECK(run.one_error());
  }
  CHECK(place.count() == 1);
  REQUIRE(place.run("plan scene.yaml -q --effort 0 -o plan.YML").status == 0);
  CHECK(place.run("check scene.yaml plan.YML").status == 0);
  REQUIRE(place.run("plan scene.yaml -q --effort 0 -o plan.json --svg picture.svg").status == 0);
  CHECK_THAT(place.run("plan picture.svg").err, Catch::Contains("picture.svg:1:1: this is a picture or a page"));
}

TEST_CASE("Bad usage is one error and status 2", "[command]") {
  const Workplace place;
  place.write("scene.yaml", scene);
  place.write("plan.json", "precious");
  place.write("plan.svg", "precious");
  for (const char* arguments : {"",
                                "paln scene.yaml",
                                "plan",
                                "plan missing.yaml",
                                "plan .",
                                "plan ''",
                                "plan scene.yaml extra",
                                "plan scene.yaml --sede 3",
                                "plan scene.yaml --seed x",
                                "plan scene.yaml --seed 0",
                                "plan scene.yaml --seed -1",
                                "plan scene.yaml --seed 1e3",
                                "plan scene.yaml --seed 99999999999999999999",
                                "plan scene.yaml --time-limit nan",
                                "plan scene.yaml --time-limit -1",
                                "plan scene.yaml --time-limit 0",
                                "plan scene.yaml --format jsno",
                                "plan scene.yaml --planner RTT",
                                "plan scene.yaml --objective speed",
                                "plan scene.yaml -o nowhere/plan.json",
                                "plan scene.yaml -o .",
                                "plan scene.yaml -o ''",
                                "plan scene.yaml -o scene.yaml",
                                "plan scene.yaml -o ./scene.yaml",
                                "plan scene.yaml -o plan.json --svg ./plan.json",
                                "plan scene.yaml -o plan.json --svg nowhere/plan.svg",
                                "plan scene.yaml -o plan.json --html nowhere/plan.html",
                                "plan scene.yaml --html .",
                                "plan scene.yaml --html scene.yaml",
                                "plan scene.yaml --svg plan.svg --html ./plan.svg",
                                "plan scene.yaml --svg -",
                                "plan scene.yaml --html -",
                                "plan scene.yaml -q -v",
                                "check scene.yaml",
                                "check scene.yaml missing.json",
                                "check scene.yaml scene.yaml",
                                "check scene.yaml plan.json",
                                "check - -",
                                "query a b",
                                "simulate",
                                "simulate scene.yaml"}) {
    const auto run = place.run(arguments);
    INFO("surefoot " << arguments << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(run.one_error());
    check_untouched(place, 3);
    CHECK(place.read("scene.yaml") == scene);
  }
}

TEST_CASE("Misspelt words are answered with what was probably meant", "[command]") {
  const Workplace place;
  std::filesystem::create_directory(place / "maps");
  place.write("maps/stairs_up.yaml", scene);
  CHECK_THAT(place.run("paln x").err, Catch::Contains("did you mean plan?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --sede 3").err, Catch::Contains("did you mean --seed?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --time 3").err, Catch::Contains("did you mean --time-limit?"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml -svg a.svg").err, Catch::Contains("did you mean --svg?"));
  for (const char* words : {"help", "help plan"}) CHECK_THAT(place.run(words).err, Catch::Contains("surefoot --help"));
  CHECK_THAT(place.run("-version").err, Catch::Contains("did you mean --version?"));
  CHECK_THAT(place.run("--plan a.yaml").err, Catch::Contains("did you mean surefoot plan?"));
  CHECK_THAT(place.run("--svg a.svg").err, Catch::Contains("expected a command before --svg: plan, check,"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --format xml").err,
             Catch::Contains("expected one of: text, json, yaml"));
  const std::vector<std::pair<std::string, std::string>> early{{"--seed 3 plan x", "--seed"},
                                                               {"-q plan x", "-q"},
                                                               {"--svg=a.svg plan x", "--svg"},
                                                               {"-o p.json plan x", "-o"}};
  for (const auto& [words, option] : early)
    CHECK_THAT(place.run(words).err, Catch::Contains(option + " belongs behind the command: surefoot plan ... "));
  const std::vector<std::pair<std::string, std::string>> empty{{"plan ''", "SCENE"},
                                                               {"check maps/stairs_up.yaml ''", "PLAN"},
                                                               {"plan maps/stairs_up.yaml -o ''", "--output"},
                                                               {"plan maps/stairs_up.yaml --svg ''", "--svg"},
                                                               {"query ''", "FILE"}};
  for (const auto& [words, name] : empty) {
    const auto run = place.run(words);
    CHECK(run.status == 2);
    CHECK(run.err == "surefoot: error: " + name + " is an empty text\n");
  }
  const std::string nines(20, '9'), number = "a number such as 0.25 or 1e-3",
                                    whole = "a whole number between -2^63 and 2^63";
  const std::vector<std::pair<std::string, std::string>> beyond{{"--seed " + nines, whole},
                                                                {"--seed -" + nines, whole},
                                                                {"--seed 0x" + nines, whole},
                                                                {"--effort 1e400", number},
                                                                {"--time-limit 1e-400", number}};
  for (const auto& [option, expected] : beyond) {
    const std::size_t blank = option.find(' ');
    const auto run = place.run("plan maps/stairs_up.yaml " + option);
    CHECK(run.status == 2);
    CHECK(run.err == "surefoot: error: " + option.substr(0, blank) + ": found " + option.substr(blank + 1) +
                         ", expected " + expected + "\n");
  }
  CHECK(place.run("plan maps/stairs_up.yaml -q --effort 1e-310 -o plan.yaml").status == 0);
  CHECK_THAT(place.run("plan 1e400").err, Catch::Contains("1e400: "));  // the name of a file
  for (const std::string word : {"-o=x.json", "-o="})
    CHECK_THAT(place.run("plan x " + word).err, Catch::EndsWith("error: " + word + ": behind " + word.substr(0, 2) +
                                                                " stands a space, no equals sign\n"));
  CHECK_THAT(place.run("plan x -q=1").err, Catch::EndsWith("error: -q=1: -q takes no value\n"));
  CHECK_THAT(place.run("plan x -x=1").err, Catch::Contains("not expected here"));
  CHECK_THAT(place.run("validate -- -a=b.yaml").out, Catch::StartsWith("-a=b.yaml: no such file"));
  CHECK_THAT(place.run("simulate vee").err, Catch::Contains("vee: this is a canned scene; expected a posture"));
  CHECK_THAT(place.run("region --posture p.json --wrench 0.1 -0.05").err,
             Catch::Contains("a scene, -0.05, and --posture are given; expected one of them"));
  CHECK_THAT(place.run("version").err, Catch::EndsWith("expected surefoot --version\n"));
  CHECK_THAT(place.run("plan").err, Catch::EndsWith("SCENE is missing (surefoot plan --help tells more)\n"));
  CHECK_THAT(place.run("plan x --svg").err, Catch::EndsWith("error: --svg: expected FILE behind it\n"));
  CHECK_THAT(place.run("plan x --svg a --svg b").err, Catch::EndsWith("error: --svg is given more than once\n"));
  const auto many = place.run("plan a.yaml b.yaml c.yaml d.yaml e.yaml");
  CHECK(many.status == 2);
  CHECK_THAT(many.err,
             Catch::Contains("not expected here: b.yaml, c.yaml, d.yaml and 1 more word (surefoot plan --help"));
  CHECK_THAT(place.run("plan maps/stairs_up.yaml --planner RTT").err, Catch::Contains("did you mean \"RRT\"?"));
  for (const char* name : {"stairs_up.yaml", "maps/stairs_pu.yaml", "stairsup"})
    CHECK_THAT(place.run(std::string("plan ") + name).err, Catch::Contains("did you mean maps/stairs_up.yaml?"));
}

TEST_CASE("The command bench hands its words to surefoot-bench beside the program, or says what to do", "[command]") {
  const Workplace place;
  place.shell("cp '" SUREFOOT_BINARY "' surefoot");
  const auto alone = place.shell("./surefoot bench verdict");
  INFO(alone.err);
  CHECK(alone.status == 2);
  CHECK(alone.out.empty());
  CHECK(alone.one_error());
  CHECK_THAT(alone.err, Catch::Contains("./surefoot bench builds it"));
  place.write("surefoot-bench", "#!/bin/sh\nprintf '%s|' \"$@\"\nexit 5\n");
  const auto handed = place.shell("chmod +x surefoot-bench && ./surefoot bench verdict --out 'a b'");
  CHECK(handed.status == 5);
  CHECK(handed.out == "verdict|--out|a b|");
}

TEST_CASE("Help and version go to stdout", "[command]") {
  const Workplace place;
  for (const char* arguments : {"--help", "-h", "plan --help", "check --help", "query --help"}) {
    const auto run = place.run(arguments);
    INFO(arguments);
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK_THAT(run.out, Catch::Contains("surefoot"));
  }
  for (const char* command : {"plan", "check", "query"})
    CHECK_THAT(place.run(std::string(command) + " --help").out, Catch::Contains("Example: "));
  const auto version = place.run("--version");
  CHECK(version.status == 0);
  for (const char* word : {"surefoot ", "OMPL ", "NLopt ", "Eigen ", "yaml-cpp 0."})
    CHECK_THAT(version.out, Catch::Contains(word));
}
