// The tree of a plan, and its two spellings. Both put each entry of a list of maps on a line of its own and everything
// inside it in flow style, so they differ only in how strings and list items are spelled.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gaits/plan_io.hpp"
#include "gaits/plan_tree.hpp"

namespace surefoot::gaits {
namespace {

using Tree = nlohmann::ordered_json;

double finite(double value, const char* what) {
  if (!std::isfinite(value)) throw std::invalid_argument(std::string("plan: ") + what + " is not finite");
  return value;
}

Tree point(const Eigen::Vector2d& p, const char* what) {
  return Tree::array({finite(p.x(), what), finite(p.y(), what)});
}

Tree factor(double sigma) {
  if (sigma == HUGE_VAL) return "inf";
  return finite(sigma, "safety factor");
}

}  // namespace

Tree tree_of(const terrain::Foothold& foot) {
  Tree tree;
  tree["chain"] = foot.chain;
  tree["segment"] = foot.segment;
  tree["s"] = finite(foot.s, "arc length of a foothold");
  tree["x"] = finite(foot.position.x(), "position of a foothold");
  tree["y"] = finite(foot.position.y(), "position of a foothold");
  tree["normal"] = point(foot.normal, "normal of a foothold");
  tree["friction"] = finite(foot.friction, "friction of a foothold");
  return tree;
}

namespace {

using gaits::tree_of;

Tree tree_of(const Stance& stance) {
  Tree tree;
  tree["feet"] = Tree::object();
  for (int leg = 0; leg < leg_count; ++leg)
    if (stance.feet[leg]) tree["feet"][std::to_string(leg + 1)] = tree_of(*stance.feet[leg]);
  tree["com"] = point(stance.com, "COM");
  tree["safety_factor"] = factor(stance.safety_factor);
  if (!stance.limit.empty()) tree["limit"] = stance.limit;
  return tree;
}

Tree tree_of(const Transfer& transfer) {
  Tree tree;
  tree["place"]["leg"] = transfer.leg + 1;
  tree["place"]["foothold"] = tree_of(transfer.foothold);
  tree["lift"] = transfer.lift + 1;
  tree["safety_factor"] = factor(transfer.safety_factor);
  if (!transfer.limit.empty()) tree["limit"] = transfer.limit;
  return tree;
}

Tree tree_of(const LeftOut& left_out) {
  Tree tree;
  tree["what"] = left_out.what;
  tree["why"] = left_out.why;
  return tree;
}

template <class Item>
Tree list_of(const std::vector<Item>& items) {
  Tree list = Tree::array();
  for (const Item& item : items) list.push_back(tree_of(item));
  return list;
}

Tree tree_of(const Resolution& resolution) {
  Tree tree;
  tree["foothold_spacing"] = finite(resolution.foothold_spacing, "foothold_spacing");
  tree["com_columns"] = resolution.com_columns;
  tree["fewest_on_lattice"] = resolution.fewest_on_lattice;
  tree["least_steps"] = resolution.least_steps;
  return tree;
}

}  // namespace

Tree tree_of(const Plan& plan) {
  Tree tree;
  tree["surefoot"] = 1;
  tree["scene"] = plan.scene;
  tree["status"] = to_string(plan.status);
  if (!plan.reason.empty()) tree["reason"] = plan.reason;
  tree["planner"] = plan.planner;
  tree["seed"] = plan.seed;
  tree["stances"] = list_of(plan.stances);
  tree["transfers"] = list_of(plan.transfers);
  tree["safety_factor"] = factor(plan.safety_factor);
  if (plan.safety_factor_before_refinement)
    tree["safety_factor_before_refinement"] = factor(*plan.safety_factor_before_refinement);
  tree["steps"] = plan.steps();
  tree["time_s"] = finite(plan.time_s, "time_s");
  if (plan.resolution) tree["resolution"] = tree_of(*plan.resolution);
  tree["left_out"] = list_of(plan.left_out);
  return tree;
}

namespace {

/// Shortest form that reads back to the same double and is seen as a floating-point number by every reader: with a
/// decimal point (YAML 1.1 takes 1e-07 for a string, some JSON readers take -0 for the integer 0).
std::string number(double value) {
  std::array<char, 32> buffer;
  const char* end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(static_cast<const char*>(buffer.data()), end);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// A JSON string that is also a double-quoted scalar of YAML, which wants more characters escaped than JSON does:
/// DEL, C1 controls, Unicode line breaks, byte-order mark, non-characters.
std::string quoted(const std::string& value) {
  std::string text = Tree(value).dump(-1, ' ', false, Tree::error_handler_t::replace);
  replace_all(text, "\x7f", "\\u007f");
  for (int c = 0x80; c < 0xa0; ++c) {
    constexpr std::string_view hex = "0123456789abcdef";
    const std::array<char, 2> raw{'\xc2', static_cast<char>(c)};
    replace_all(text, std::string_view(raw.data(), raw.size()), std::string("\\u00") + hex[c / 16] + hex[c % 16]);
  }
  replace_all(text, "\u2028", "\\u2028");
  replace_all(text, "\u2029", "\\u2029");
  replace_all(text, "\ufeff", "\\ufeff");
  replace_all(text, "\xef\xbf\xbe", "\\ufffe");
  replace_all(text, "\xef\xbf\xbf", "\\uffff");
  return text;
}

std::string json_string(const std::string& value) { return quoted(value); }

/// Plain where no reader can mistake it: a lower-case word that is none of YAML's words for truth, nothing or numbers.
std::string yaml_string(const std::string& value) {
  static constexpr std::array<std::string_view, 12> taken{"",    "y",    "n",     "yes",  "no",  "on",
                                                          "off", "true", "false", "null", "nan", "inf"};
  const bool word = value.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos && value[0] != '_';
  return word && std::find(taken.begin(), taken.end(), value) == taken.end() ? value : quoted(value);
}

using StringSpelling = std::string (*)(const std::string&);

std::string inline_form(const Tree& tree, StringSpelling spell) {
  if (tree.is_string()) return spell(tree.get_ref<const std::string&>());
  if (tree.is_number_float()) return number(tree.get<double>());
  if (!tree.is_structured()) return tree.dump();
  std::string text(1, tree.is_object() ? '{' : '[');
  for (const auto& item : tree.items()) {
    if (text.size() > 1) text += ", ";
    if (tree.is_object()) text += spell(item.key()) + ": ";
    text += inline_form(item.value(), spell);
  }
  return text + (tree.is_object() ? '}' : ']');
}

}  // namespace

std::string to_json(const Plan& plan) {
  const Tree tree = tree_of(plan);
  std::string text = "{";
  std::string separator = "\n";
  for (const auto& entry : tree.items()) {
    text += separator + "  " + json_string(entry.key()) + ": ";
    separator = ",\n";
    if (!entry.value().is_array() || entry.value().empty()) {
      text += inline_form(entry.value(), json_string);
      continue;
    }
    text += "[";
    std::string item_separator = "\n";
    for (const Tree& item : entry.value()) {
      text += item_separator + "    " + inline_form(item, json_string);
      item_separator = ",\n";
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

std::string to_yaml(const Plan& plan) {
  const Tree tree = tree_of(plan);
  std::string text;
  for (const auto& entry : tree.items()) {
    text += yaml_string(entry.key()) + ":";
    if (!entry.value().is_array() || entry.value().empty()) {
      text += " " + inline_form(entry.value(), yaml_string) + "\n";
      continue;
    }
    text += "\n";
    for (const Tree& item : entry.value()) text += "  - " + inline_form(item, yaml_string) + "\n";
  }
  return text;
}

}  // namespace surefoot::gaits
