// `surefoot validate` as a user runs it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "program.hpp"
#include "scene_text.hpp"

using surefoot::tests::flat_scene;
using surefoot::tests::with;
using surefoot::tests::Workplace;

TEST_CASE("A ceiling given the wrong way round is remarked on, canned scenes are not", "[validate]") {
  const Workplace place;
  place.write("pipe.yaml", with("[[-1, 0], [4, 0]]", "[[-1, 0], [4, 0]]\n    - vertices: [[-1, 1.5], [4, 1.5]]"));
  const auto run = place.run("validate pipe.yaml");
  CHECK(run.status == 0);
  CHECK(run.out.find("\npipe.yaml: remark: chain 1 turns its back to chain 0 at (1.5, 1.5)") != std::string::npos);
  CHECK(place.run("plan pipe.yaml --effort 0").err.find("chain 1 turns its back") != std::string::npos);
  CHECK(place.run("plan pipe.yaml --effort 0 -q").err.empty());
  const auto canned = place.shell("'" SUREFOOT_BINARY "' validate " SUREFOOT_MAPS "/*.yaml");
  CHECK(canned.out.find("flat.yaml: valid") != std::string::npos);
  CHECK(canned.out.find("remark") == std::string::npos);
}

TEST_CASE("A scene in order is summed up on one line, status 0", "[validate]") {
  const Workplace place;
  place.write("scene.yaml", flat_scene);
  const auto run = place.run("validate scene.yaml");
  CHECK(run.status == 0);
  CHECK(run.err.empty());
  CHECK(run.out == "scene.yaml: valid: scene, 1 chain, 1 segment, 5 m, friction 0.6, start stands\n");
  const auto from_stdin = place.run("validate -", flat_scene);
  CHECK(from_stdin.status == 0);
  CHECK(from_stdin.out.starts_with("<stdin>: valid: "));
}

TEST_CASE("All faults of all scenes are listed by place, status 2", "[validate]") {
  const Workplace place;
  place.write("good.yaml", flat_scene);
  place.write("bad.yaml", with("0.6", "-1", with("com_x", "com_z")));
  const auto run = place.run("validate bad.yaml good.yaml missing.yaml");
  CHECK(run.status == 2);
  CHECK(run.err.empty());
  CHECK(run.out ==
        "bad.yaml:3:13: friction: -1 is negative; expected a number >= 0\n"
        "bad.yaml:11:8: goal: unknown key \"com_z\"; did you mean \"com_x\"?\n"
        "good.yaml: valid: good, 1 chain, 1 segment, 5 m, friction 0.6, start stands\n"
        "missing.yaml: no such file or canned scene (surefoot maps lists those)\n");
}

TEST_CASE("What plan refuses before it searches, validate refuses too", "[validate]") {
  const Workplace place;
  // Both feet left of the COM: no rule of the file is broken, but gravity's.
  place.write("scene.yaml", with("  support", "  com: [0.4, 0.4]\n  support"));
  const auto plan = place.run("plan scene.yaml"), validate = place.run("validate scene.yaml");
  CHECK(plan.status == 2);
  CHECK(validate.status == 2);
  CHECK(plan.err == "surefoot: error: " + validate.out);
  CHECK_THAT(validate.out, Catch::Contains("not stable"));
}

TEST_CASE("A report of many faults ends with the number of the others", "[validate]") {
  const Workplace place;
  std::string vertices = "[[-1, 0]";
  for (int i = 0; i < 250; ++i) vertices += ", [0, b]";
  place.write("scene.yaml", with("[[-1, 0], [4, 0]]", vertices + "]"));
  const auto run = place.run("validate scene.yaml");
  CHECK(run.status == 2);
  CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 101);
  CHECK(run.out.ends_with("scene.yaml: and at least 150 more\n"));
}
