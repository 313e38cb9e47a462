#include "gaits/player_data.hpp"

#include <array>
#include <optional>

#include "gaits/plan_page.hpp"
#include "gaits/plan_tree.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/rules.hpp"
#include "gaits/terrain_picture.hpp"
#include "stability/region.hpp"

namespace surefoot::gaits {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Tree = nlohmann::ordered_json;

Tree interval(const std::optional<std::pair<double, double>>& ends) {
  return ends ? Tree::array({ends->first, ends->second}) : Tree();
}

const char* to_string(TerrainPicture::Grip grip) {
  return grip == TerrainPicture::Grip::usual ? "usual" : grip == TerrainPicture::Grip::less ? "less" : "more";
}

class PlayerData {
 public:
  PlayerData(const Scene& scene, const Plan& plan)
      : scene_(scene), plan_(plan), picture_(scene.terrain), decimals_(decimals_for(scene.robot.reach_max)) {}

  Tree tree(const std::vector<std::string>& faults) {
    Tree tree;
    tree["plan"] = tree_of(plan_);
    tree["plan"].erase("time_s");  // the same plan gives the same page
    tree["title"] = title_of(plan_, !faults.empty());
    if (is_told_in_decimals(scene_.robot.reach_max)) tree["decimals"] = decimals_;
    tree["scene"] = scene();
    tree["weakest"] = weakest();
    tree["stances"] = Tree::array();
    tree["transfers"] = Tree::array();
    Feet last = scene_.start.feet;  // where each leg stood last
    for (int k = 0; k < static_cast<int>(plan_.stances.size()); ++k) {
      for (int leg = 0; leg < leg_count; ++leg)
        if (const auto& foot = plan_.stances[k].feet[leg]) last[leg] = foot;
      tree["stances"].push_back(stance(plan_.stances[k], last));
      if (k >= plan_.steps()) continue;
      tree["transfers"].push_back(transfer(plan_.stances[k], plan_.transfers[k], last));
      last[plan_.transfers[k].leg] = plan_.transfers[k].foothold;
    }
    tree["terrain"] = terrain();
    tree["faults"] = faults;
    return tree;
  }

 private:
  /// For drawing: to a hundredth of what the table of steps tells.
  double drawn(double length) const {
    const double scale = std::pow(10.0, decimals_ + 2);
    return std::round(length * scale) / scale;
  }

  Tree drawn(const Polyline& points) const {
    Tree list = Tree::array();
    for (const Vector2d& p : points) list.push_back({drawn(p.x()), drawn(p.y())});
    return list;
  }

  Tree scene() const {
    Tree tree;
    tree["radius_of_gyration"] = scene_.robot.radius_of_gyration;
    tree["reach"] = {scene_.robot.reach_min, scene_.robot.reach_max};
    tree["clearance"] = scene_.robot.clearance;
    tree["kappa"] = scene_.disturbance.kappa;
    tree["nu"] = scene_.disturbance.nu;
    tree["region"] = scene_.criterion == Criterion::equilibrium ? "R_SS(W)" : "R(W)";
    tree["stance_region"] = scene_.criterion == Criterion::robust ? "R(W)" : "R_SS(W)";
    tree["start"] = Tree::object();
    for (int leg = 0; leg < leg_count; ++leg)
      if (const auto& foot = scene_.start.feet[leg]) tree["start"][std::to_string(leg + 1)] = tree_of(*foot);
    tree["goal"] = {{"com_x", interval(scene_.goal.com_x)}, {"com_y", interval(scene_.goal.com_y)}};
    return tree;
  }

  Tree weakest() const {
    const WeakestPlace place = weakest_place(plan_);
    if (!place.bounded()) return nullptr;
    return {{"index", place.index},
            {"in_transfer", place.in_transfer},
            {"factor", factor_in_words(place.sigma)},
            {"place", place_in_words(place, plan_.steps())}};
  }

  /// What a stance and a transfer have in common.
  Tree verdict(const Feet& feet, double sigma, const std::string& limit, bool all_modes) const {
    Tree tree;
    tree["factor"] = factor_in_words(sigma);
    tree["why"] = limit.empty() ? "" : limit_in_words(limit, planted_legs(feet));
    tree["region"] = region(feet, all_modes);
    return tree;
  }

  Tree stance(const Stance& stance, const Feet& last) const {
    Tree tree = verdict(stance.feet, stance.safety_factor, stance.limit, scene_.criterion == Criterion::robust);
    for (int leg = 0; leg < leg_count; ++leg)
      if (!stance.feet[leg]) tree["free"] = {{"leg", leg + 1}, {"from", last[leg] ? tree_of(*last[leg]) : Tree()}};
    return tree;
  }

  Tree transfer(const Stance& from, const Transfer& transfer, const Feet& last) const {
    Tree tree = verdict(feet_during(from, transfer), transfer.safety_factor, transfer.limit,
                        scene_.criterion != Criterion::equilibrium);
    if (const auto& old_foot = last[transfer.leg]) {
      const auto turn = swing_turn(scene_, from.com, old_foot->position, transfer.foothold.position);
      tree["turn"] = turn ? Tree(*turn) : Tree();
    }
    return tree;
  }

  /// Rings: of R(W) where all modes count, else of R_SS(W); within the box around what the feet can reach.
  Tree region(const Feet& feet, bool all_modes) const {
    Tree rings = Tree::array();
    const std::vector<stability::Contact> contacts = picture_.contacts_of(feet);
    if (contacts.empty() || contacts.size() > static_cast<std::size_t>(leg_count)) return rings;
    const Vector2d reach = Vector2d::Constant(scene_.robot.reach_max);
    AlignedBox2d window(contacts[0].position - reach, contacts[0].position + reach);
    for (const auto& contact : contacts)
      window = window.intersection(AlignedBox2d(contact.position - reach, contact.position + reach));
    if (!(window.sizes().array() > 0).all()) return rings;  // of feet two reaches apart a point is left
    if (!all_modes) {
      const stability::RobustOracle oracle(contacts, scene_.robot.radius_of_gyration, scene_.disturbance);
      const Polyline polygon =
          oracle.equilibrium_polygon({window.corner(AlignedBox2d::BottomLeft), window.corner(AlignedBox2d::BottomRight),
                                      window.corner(AlignedBox2d::TopRight), window.corner(AlignedBox2d::TopLeft)});
      if (polygon.size() > 2) rings.push_back(drawn(polygon));
      return rings;
    }
    stability::RegionOptions options;
    options.area_tolerance = 1e-2;  // areas are not told
    options.curve_tolerance = region_detail;
    options.window = window;
    const stability::WrenchBox box{{}, scene_.disturbance.kappa, scene_.disturbance.nu};
    for (const auto& cell : stability::region(contacts, scene_.robot.radius_of_gyration, box, options).cells)
      if (cell.modes.empty())
        for (const auto& ring : cell.rings) rings.push_back(drawn(ring));
    return rings;
  }

  /// As much as may be seen beside the journey.
  Tree terrain() const {
    AlignedBox2d window = contents(scene_, plan_);
    const Vector2d room = Vector2d::Constant(std::max(6 * scene_.robot.reach_max, window.sizes().maxCoeff()));
    window = {window.min() - room, window.max() + room};
    Tree tree{{"ground", Tree::array()}, {"surface", Tree::array()}, {"legend", Tree::array()}};
    for (const Polyline& polygon : picture_.ground_in(window)) tree["ground"].push_back(drawn(polygon));
    bool barred = false;
    for (const TerrainPicture::Run& run : picture_.surface_in(window)) {
      barred |= !run.foothold;
      tree["surface"].push_back({{"grip", to_string(run.grip)},
                                 {"foothold", run.foothold},
                                 {"hatched", run.hatched},
                                 {"points", drawn(run.points)}});
    }
    for (const auto grip : {TerrainPicture::Grip::usual, TerrainPicture::Grip::less, TerrainPicture::Grip::more})
      if (const std::string range = picture_.friction_range(grip); !range.empty())
        tree["legend"].push_back({{"grip", to_string(grip)}, {"words", range}});
    if (barred) tree["legend"].push_back({{"grip", "barred"}, {"words", "no foothold"}});
    return tree;
  }

  const Scene& scene_;
  const Plan& plan_;
  TerrainPicture picture_;
  int decimals_;
};

}  // namespace

std::string player_data(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults) {
  const std::string text = PlayerData(scene, plan).tree(faults).dump(-1, ' ', true, Tree::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {  // these occur inside strings only
    if (c == '<') safe += "\\u003c";
    else if (c == '>') safe += "\\u003e";
    else if (c == '&') safe += "\\u0026";
    else safe += c;
  }
  return safe;
}

}  // namespace surefoot::gaits
