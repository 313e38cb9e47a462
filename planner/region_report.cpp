// What `surefoot region` says in words and in JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "gaits/text_table.hpp"
#include "planner/region_command.hpp"

namespace surefoot::planner {
namespace {

using Tree = nlohmann::ordered_json;
using stability::FrictionalPart;
using stability::FrictionalRegion;
using stability::Region;
using stability::RegionCell;

Tree points(const stability::RegionPolygon& polygon) {
  Tree list = Tree::array();
  for (const Eigen::Vector2d& p : polygon) list.push_back({p.x(), p.y()});
  return list;
}

Tree mode_names(const RegionCell& cell) {
  Tree names = Tree::array();
  for (const auto& mode : cell.modes) names.push_back(mode.name());
  return names;
}

Tree cell_tree(const RegionCell& cell) {
  Tree tree;
  tree["modes"] = mode_names(cell);
  tree["area"] = cell.area;
  tree["inside"] = {cell.inside.x(), cell.inside.y()};
  if (!cell.confirmed) tree["confirmed"] = false;
  tree["polygon"] = cell.rings.empty() ? Tree::array() : points(cell.rings.front());
  for (std::size_t k = 1; k < cell.rings.size(); ++k) tree["holes"].push_back(points(cell.rings[k]));
  return tree;
}

std::string percent(double part, double whole) { return whole > 0 ? fmt::format("{:.2f} %", 100 * part / whole) : "-"; }

/// As many digits as the error leaves.
std::string area(double value, double error) {
  const double digits = value > 0 && error > 0 ? std::floor(std::log10(value / error)) : 9;
  return fmt::format("{:.{}g} m^2", value, static_cast<int>(std::clamp(digits, 2.0, 9.0)));
}

void describe_posture(std::string& out, const gaits::RegionFigure& figure) {
  auto put = std::back_inserter(out);
  fmt::format_to(put, "{}\n", figure.title);
  for (std::size_t k = 0; k < figure.contacts.size(); ++k) {
    const auto& contact = figure.contacts[k];
    const Eigen::Vector2d n = contact.normal.stableNormalized();
    fmt::format_to(put, "  contact {}  at ({:.6g}, {:.6g}) m, normal ({:.4f}, {:.4f}), friction {:.4g}\n",
                   figure.contact_names[k], contact.position.x(), contact.position.y(), n.x() + 0.0, n.y() + 0.0,
                   contact.friction);  // 0 rather than -0
  }
  const auto& box = figure.box;
  fmt::format_to(put, "  rho {:.6g} m, ", figure.radius_of_gyration);
  if (box.one_wrench()) fmt::format_to(put, "one wrench w: p = {:.6g}, q = {:.6g} m\n", box.centre.p, box.centre.q);
  else fmt::format_to(put, "disturbances W: |p| <= {:.6g}, |q| <= {:.6g} m\n", box.kappa, box.nu);
}

void describe_modes(std::string& out, const gaits::RegionFigure& figure, const Region& region) {
  using gaits::TextTable;
  const std::string whole = gaits::equilibrium_name(figure.box);
  if (region.modes.empty()) {
    out += fmt::format("\nNo mode but rest is possible anywhere in {}.\n", whole);
    return;
  }
  TextTable modes({{"", "mode", TextTable::Align::left},
                   {"", "possible on", TextTable::Align::right},
                   {"", "of " + whole, TextTable::Align::right},
                   {"", "forbids alone", TextTable::Align::right}});
  for (const auto& share : region.modes) {
    double alone = 0;
    for (const RegionCell& cell : region.cells)
      if (cell.modes.size() == 1 && cell.modes.front() == share.mode) alone += cell.area;
    modes.add({{share.mode.name()},
               {fmt::format("{:.6g} m^2", share.area)},
               {percent(share.area, region.equilibrium_area)},
               {percent(alone, region.equilibrium_area)}});
  }
  out += '\n' + modes.print(false);
  constexpr std::size_t most_cells = 24;
  TextTable cells({{"", "cell", TextTable::Align::right},
                   {"", "area", TextTable::Align::right},
                   {"", "share", TextTable::Align::right},
                   {"", "around", TextTable::Align::left},
                   {"", "modes", TextTable::Align::left}});
  for (std::size_t k = 0; k < std::min(region.cells.size(), most_cells); ++k) {
    const RegionCell& cell = region.cells[k];
    std::string names;
    for (const auto& mode : cell.modes) names.append(names.empty() ? "" : " ").append(mode.name());
    cells.add({{std::to_string(k + 1)},
               {fmt::format("{:.6g} m^2", cell.area)},
               {percent(cell.area, region.equilibrium_area)},
               {fmt::format("({:.3g}, {:.3g})", cell.inside.x(), cell.inside.y())},
               {names.empty() ? "rest only: " + gaits::robust_name(figure.box) : names}});
  }
  out += '\n' + cells.print(false);
  if (region.cells.size() > most_cells)
    out += fmt::format("and {} smaller cells (all of them in the JSON)\n", region.cells.size() - most_cells);
}

Tree part_tree(const stability::FrictionalPart& part) {
  Tree tree{{"area", part.area}, {"error", part.error}, {"polygons", Tree::array()}};
  for (const auto& polygon : part.polygons) tree["polygons"].push_back(points(polygon));
  return tree;
}

Tree box_tree(const Eigen::AlignedBox2d& box) {
  if (box.isEmpty()) return nullptr;
  return {box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}

Tree frictional_tree(const FrictionalRegion& region) {
  return {{"restitution", region.restitution},
          {"window", box_tree(region.window)},
          {"upward", region.upward},
          {"equilibrium", box_tree(region.strip)},
          {"equilibrium_area", region.equilibrium_area()},
          {"kinematic_strong", part_tree(region.kinematic_strong)},
          {"clattering", part_tree(region.clattering)},
          {"stable", part_tree(region.stable)}};
}

void describe_frictional(std::string& out, const FrictionalRegion& region) {
  auto put = std::back_inserter(out);
  fmt::format_to(
      put,
      "\nFrictional stability, restitution {:.6g} (gravity alone, within x {:.6g} .. {:.6g}, y {:.6g} .. {:.6g} m)\n",
      region.restitution, region.window.min().x(), region.window.max().x(), region.window.min().y(),
      region.window.max().y());
  if (region.strip.isEmpty()) {
    out += "         no COM there can be balanced\n";
    return;
  }
  const double whole = region.equilibrium_area();
  double error = 0;
  const auto line = [&](const char* name, const FrictionalPart& part) {
    fmt::format_to(put, "{:<37}{}, {} of R_EQ\n", name, area(part.area, part.error), percent(part.area, whole));
    error = std::max(error, part.error);
  };
  fmt::format_to(put, "{:<37}{:.9g} m^2\n", "R_EQ     balanced", whole);
  line("         kinematic-strong", region.kinematic_strong);
  line("         clattering converges (10)", region.clattering);
  line("         both: frictionally stable", region.stable);
  fmt::format_to(put, "         each to within {:.1g} m^2: an estimate\n", error);
  if (!region.upward) out += "         the ground does not face upward under both feet: Theorem 3 is silent\n";
}

}  // namespace

std::string region_to_json(const gaits::RegionFigure& figure, const Region& region,
                           const std::optional<FrictionalRegion>& frictional) {
  Tree tree;
  tree["surefoot"] = 1;
  tree["posture"] = figure.title;
  tree["equilibrium_area"] = region.equilibrium_area;
  tree["robust_area"] = region.robust_area;
  tree["area_error"] = region.area_error;
  tree["cells_error"] = region.cells_error;
  tree["window"] = nullptr;
  if (region.window)
    tree["window"] = {region.window->min().x(), region.window->min().y(), region.window->max().x(),
                      region.window->max().y()};
  tree["polyline_tolerance"] = region.curve_tolerance;
  if (!region.note.empty()) tree["note"] = region.note;
  tree["equilibrium"] = points(region.equilibrium);
  tree["modes"] = Tree::array();
  for (const auto& share : region.modes) tree["modes"].push_back({{"mode", share.mode.name()}, {"area", share.area}});
  tree["cells"] = Tree::array();
  for (const RegionCell& cell : region.cells) tree["cells"].push_back(cell_tree(cell));
  tree["boundaries"] = Tree::array();
  for (const auto& boundary : region.boundaries)
    tree["boundaries"].push_back({{"label", boundary.label}, {"polyline", points(boundary.polyline)}});
  if (frictional) tree["frictional"] = frictional_tree(*frictional);
  // Lists of maps one entry to a line.
  std::string out = "{";
  for (auto entry = tree.begin(); entry != tree.end(); ++entry) {
    out += fmt::format("{}\n\"{}\": ", entry == tree.begin() ? "" : ",", entry.key());
    if (!entry->is_array() || entry->empty() || !entry->front().is_object()) {
      out += entry->dump(-1, ' ', false, Tree::error_handler_t::replace);
      continue;
    }
    for (std::size_t k = 0; k < entry->size(); ++k)
      out += (k == 0 ? "[\n  " : ",\n  ") + (*entry)[k].dump(-1, ' ', false, Tree::error_handler_t::replace);
    out += "]";
  }
  return out + "\n}\n";
}

std::string region_to_text(const gaits::RegionFigure& figure, const Region& region,
                           const std::optional<FrictionalRegion>& frictional) {
  std::string out;
  describe_posture(out, figure);
  auto put = std::back_inserter(out);
  out += '\n';
  if (region.empty()) {
    fmt::format_to(put, "{}\n", region.note);
    if (frictional) describe_frictional(out, *frictional);
    return out;
  }
  fmt::format_to(put, "{:<8} balanced                 {}\n", gaits::equilibrium_name(figure.box),
                 area(region.equilibrium_area, region.area_error));
  fmt::format_to(put, "{:<8} and sure to stay at rest {}, {} of it\n", gaits::robust_name(figure.box),
                 area(region.robust_area, region.area_error), percent(region.robust_area, region.equilibrium_area));
  constexpr double coarse = 0.01;  // of the area that the cells share out
  fmt::format_to(put, "         both to within {:.1g} m^2, cells together {}to within {:.1g} m^2: proved\n",
                 region.area_error, region.cells_error > coarse * region.equilibrium_area ? "only " : "",
                 region.cells_error);
  if (region.window)
    fmt::format_to(put, "         clipped to x {:.6g} .. {:.6g}, y {:.6g} .. {:.6g} m\n", region.window->min().x(),
                   region.window->max().x(), region.window->min().y(), region.window->max().y());
  if (figure.terrain != nullptr) out += "         COMs below the ground or out of reach count too\n";
  if (!region.note.empty()) fmt::format_to(put, "         note: {}\n", region.note);
  describe_modes(out, figure, region);
  if (frictional) describe_frictional(out, *frictional);
  return out;
}

}  // namespace surefoot::planner
