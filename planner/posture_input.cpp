#include "planner/posture_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"

namespace surefoot::planner {

using terrain::Document;
using terrain::InputError;
using terrain::Node;

Document read_posture_document(const std::string& path, const char* for_scenes) {
  std::error_code ignored;
  const std::vector<CannedScene> canned =
      path == "-" || std::filesystem::exists(path, ignored) ? std::vector<CannedScene>() : canned_scenes();
  if (std::any_of(canned.begin(), canned.end(), [&](const CannedScene& scene) { return scene.name == path; }))
    throw InputError(fmt::format("{}: this is a canned scene; expected a posture ({})", path, for_scenes));
  Document document = path == "-" ? Document::parse(read_stdin(), "<stdin>") : Document::read_file(path);
  if (const Node& root = document.root(); gaits::looks_like_scene(root))
    root.fail(fmt::format("posture: this is a scene; expected a posture ({})", for_scenes));
  if (const Node& root = document.root(); root.find("stances"))
    root.fail("posture: this is a plan; expected a posture");
  return document;
}

Eigen::Vector2d read_point(const Node& node, const char* what) {
  const auto& items = node.items(what, 2);
  return {items[0].number(what), items[1].number(what)};
}

double checked_restitution(double e, const std::string& place) {
  if (!(e > 0 && e < 1))
    throw InputError(fmt::format("{}: found {}, expected a number between 0 and 1, ends excluded", place, e));
  return e;
}

double read_restitution(const Node& node) {
  const double e = node.positive("restitution");
  if (e >= 1) node.fail(fmt::format("restitution: found {}, expected a number between 0 and 1, ends excluded", e));
  return e;
}

std::vector<stability::Contact> read_contacts(const Node& root, std::size_t least, std::size_t most) {
  const Node& contacts = root.require("contacts", "posture");
  const auto& list = contacts.items("contacts");
  if (list.size() < least || list.size() > most)
    contacts.fail(fmt::format("contacts: found {}, expected {} to {}", list.size(), least, most));
  std::vector<stability::Contact> result;
  for (const Node& item : list) {
    item.allow_only({"p", "n", "mu"}, "contact");
    stability::Contact contact;
    contact.position = read_point(item.require("p", "contact"), "p");
    contact.normal = read_point(item.require("n", "contact"), "n");
    contact.friction = item.require("mu", "contact").not_negative("mu");
    if (contact.normal.isZero(0)) item.require("n", "contact").fail("n: a normal may not be zero");
    result.push_back(contact);
  }
  return result;
}

DisturbedPosture read_disturbed_posture(const Node& root) {
  root.allow_only({"contacts", "com", "rho", "kappa", "nu", "restitution"}, "posture");
  DisturbedPosture posture;
  posture.contacts = read_contacts(root, 1, 3);
  posture.rho = root.require("rho", "posture").positive("rho");
  posture.box.kappa = root.require("kappa", "posture").not_negative("kappa");
  posture.box.nu = root.require("nu", "posture").not_negative("nu");
  if (const Node* e = root.find("restitution")) posture.restitution = read_restitution(*e);
  if (const Node* com = root.find("com")) posture.com = read_point(*com, "com");
  return posture;
}

std::vector<double> read_numbers(const std::string& option, const std::string& text, std::size_t count,
                                 const char* form) {
  std::vector<double> values;
  std::size_t begin = 0;
  try {
    for (;;) {
      const std::size_t end = text.find(',', begin);
      const std::string part = text.substr(begin, end == std::string::npos ? end : end - begin);
      const Document parsed = Document::parse(part, option);
      values.push_back(parsed.root().number("number"));
      if (end == std::string::npos) break;
      begin = end + 1;
    }
  } catch (const InputError&) {
    values.clear();
  }
  if (values.size() != count) throw InputError(fmt::format("{}: found {}, expected {}", option, one_line(text), form));
  return values;
}

}  // namespace surefoot::planner
