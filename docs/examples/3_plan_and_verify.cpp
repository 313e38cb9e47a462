// Plans a scene, verifies the plan, sees that the verifier refuses it once it is tampered with, writes it as JSON.
// Usage: 3_plan_and_verify SCENE PLAN, for example maps/flat.yaml plan.json
// Prints:
//   maps/flat.yaml: solved
//   verified: holds
//   the same with one COM 1 m higher: refused
#include <cstdio>
#include <fstream>
#include <surefoot/gaits/plan_io.hpp>
#include <surefoot/gaits/verifier.hpp>
#include <surefoot/planner/refine.hpp>
#include <surefoot/planner/search.hpp>

using namespace surefoot;

int main(int count, char** words) try {
  if (count != 3) {
    std::fprintf(stderr, "usage: 3_plan_and_verify SCENE PLAN, for example maps/flat.yaml plan.json\n");
    return 2;
  }
  const gaits::Scene scene = gaits::load_scene(words[1]);
  gaits::Plan plan = planner::search(scene, {.effort = 0});  // the first plan will do
  std::printf("%s: %s\n", words[1], gaits::to_string(plan.status));
  if (plan.status != gaits::Status::solved) return 1;  // plan.reason says why

  plan = planner::refine(scene, plan);
  const gaits::Verification verification = gaits::verify(scene, plan);
  std::printf("verified: %s\n", verification.holds() ? "holds" : gaits::to_string(verification.faults[0]).c_str());

  gaits::Plan tampered = plan;
  tampered.stances[1].com.y() += 1;
  std::printf("the same with one COM 1 m higher: %s\n", gaits::verify(scene, tampered).holds() ? "holds" : "refused");

  std::ofstream file(words[2]);
  file << gaits::to_json(plan);
  if (file.flush()) return 0;
  std::fprintf(stderr, "cannot write %s\n", words[2]);
  return 1;
} catch (const terrain::InputError& fault) {
  std::fprintf(stderr, "%s\n", fault.what());  // file:line:column: what is wrong with the scene
  return 2;
}
