#include "bench/region_stances.hpp"

#include <algorithm>
#include <filesystem>

#include "gaits/plan_io.hpp"
#include "gaits/scene.hpp"
#include "terrain/document.hpp"

namespace surefoot::bench {
namespace {

namespace fs = std::filesystem;
using terrain::Node;

std::vector<fs::path> files_in(const char* directory, const char* extension) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.path().extension() == extension) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

Eigen::Vector2d point(const Node& node) {
  const auto& items = node.items("point", 2);
  return {items[0].number("x"), items[1].number("y")};
}

Stance on(const gaits::Scene& scene, const gaits::Feet& feet) {
  Stance stance{{}, {}, scene.robot.radius_of_gyration, scene.disturbance};
  for (const auto& foot : feet)
    if (foot) stance.contacts.push_back(gaits::contact_at(*foot));
  return stance;
}

}  // namespace

std::vector<StanceGroup> drawn_postures() {
  std::vector<StanceGroup> groups;
  for (const fs::path& path : files_in(SUREFOOT_POSTURES, ".json")) {
    const terrain::Document document = terrain::Document::read_file(path);
    const Node& root = document.root();
    Stance stance;
    for (const Node& item : root.require("contacts", "posture").items("contacts"))
      stance.contacts.push_back({point(item.require("p", "contact")), point(item.require("n", "contact")),
                                 item.require("mu", "contact").number("mu")});
    stance.rho = root.require("rho", "posture").number("rho");
    stance.box = {root.require("kappa", "posture").number("kappa"), root.require("nu", "posture").number("nu")};
    groups.push_back({path.stem(), {stance}});
  }
  return groups;
}

std::vector<StanceGroup> canned_stances() {
  std::vector<StanceGroup> groups;
  for (const fs::path& path : files_in(SUREFOOT_MAPS, ".yaml")) {
    const gaits::Scene scene = gaits::load_scene(path);
    const fs::path stored = fs::path(SUREFOOT_PLANS) / path.stem().concat(".json");
    if (!fs::exists(stored)) {
      groups.push_back({path.stem(), {on(scene, scene.start.feet)}});
      continue;
    }
    const gaits::Plan plan = gaits::read_plan(stored);
    StanceGroup two{path.stem(), {}}, three{path.stem().string() + ", 3 contacts", {}};
    for (const gaits::Stance& stance : plan.stances) two.stances.push_back(on(scene, stance.feet));
    for (std::size_t k = 0; k < plan.transfers.size(); ++k)
      three.stances.push_back(on(scene, gaits::feet_during(plan.stances[k], plan.transfers[k])));
    groups.push_back(std::move(two));
    groups.push_back(std::move(three));
  }
  return groups;
}

}  // namespace surefoot::bench
