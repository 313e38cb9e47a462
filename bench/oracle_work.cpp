#include "bench/oracle_work.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "gaits/plan_io.hpp"
#include "gaits/rules.hpp"
#include "gaits/scene.hpp"

namespace surefoot::bench {

using stability::RobustOracle;

const Work& work(int contacts) {
  static std::map<int, Work> cache;
  Work& made = cache[contacts];
  if (!made.postures.empty()) return made;
  testing::Sampler sampler(2024 + static_cast<std::uint64_t>(contacts));
  using testing::Kind;
  constexpr Kind kinds[]{Kind::gentle, Kind::any, Kind::flat, Kind::vee, Kind::stairs};
  for (std::size_t k = 0; k < batch; ++k) {
    made.postures.push_back(sampler.posture(kinds[k % 5], contacts));
    made.to.push_back(sampler.com_near(made.postures.back().contacts));
  }
  return made;
}

std::vector<RobustOracle> oracles(const Work& given) {
  std::vector<RobustOracle> made;
  for (const testing::SamplePosture& p : given.postures) made.emplace_back(p.contacts, p.rho, p.box);
  return made;
}

std::vector<Line> lines_between_robust(int contacts) {
  const Work& given = work(contacts);
  const std::vector<RobustOracle> made = oracles(given);
  testing::Sampler sampler(7);
  std::vector<Line> lines;
  for (std::size_t k = 0; k < batch; ++k) {
    const testing::SamplePosture& p = given.postures[k];
    if (!made[k].robust(p.com)) continue;
    for (int attempt = 0; attempt < 10; ++attempt) {
      const Eigen::Vector2d to = sampler.com_near(p.contacts);
      if (!made[k].robust(to)) continue;
      lines.push_back({made[k], p.com, to});
      break;
    }
  }
  return lines;
}

const std::vector<Line>& planned_transfers() {
  static const std::vector<Line> transfers = [] {
    std::vector<Line> made;
    for (const auto& entry : std::filesystem::directory_iterator(SUREFOOT_PLANS)) {
      const gaits::Scene scene = gaits::load_scene(SUREFOOT_MAPS "/" + entry.path().stem().string() + ".yaml");
      if (scene.criterion != gaits::Criterion::robust) continue;
      const gaits::Plan plan = gaits::read_plan(entry.path().string());
      for (std::size_t k = 0; k < plan.transfers.size(); ++k)
        made.push_back({gaits::oracle_of(scene, gaits::feet_during(plan.stances[k], plan.transfers[k])),
                        plan.stances[k].com, plan.stances[k + 1].com});
    }
    return made;
  }();
  return transfers;
}

}  // namespace surefoot::bench
