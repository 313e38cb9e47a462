#include "planner/query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "stability/frictional.hpp"
#include "stability/region_tolerance.hpp"
#include "stability/robust_oracle.hpp"
#include "terrain/document.hpp"

namespace surefoot::planner {

namespace {

using nlohmann::json;
using stability::Contact;
using stability::RobustOracle;

/// What is wrong with one line.
class BadLine : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Question {
  std::vector<Contact> contacts;
  Eigen::Vector2d com = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> com_to;
  double rho = 0;
  stability::DisturbanceBox box;
  bool com_tolerance = false;
  std::optional<double> restitution;
};

std::string shown(const json& value) {
  return terrain::shown(value.dump(-1, ' ', true, json::error_handler_t::replace));
}

[[noreturn]] void refuse(const std::string& place, const json& value, const char* expected) {
  throw BadLine(fmt::format("{}: found {}, expected {}", place, shown(value), expected));
}

/// Parses one object, refusing what the parser would let pass: duplicate keys and needless depth.
json parse(std::string_view line) {
  constexpr int deepest = 4;  // object, contacts, contact, point
  std::vector<std::vector<std::string>> keys;
  const auto watch = [&keys](int depth, json::parse_event_t event, json& parsed) {
    using Event = json::parse_event_t;
    if ((event == Event::object_start || event == Event::array_start) && depth >= deepest)
      throw BadLine("nested too deeply");
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (std::find(keys.back().begin(), keys.back().end(), key) != keys.back().end())
        throw BadLine(fmt::format("key \"{}\" is given twice", terrain::shown(key)));
      keys.back().push_back(key);
    }
    return true;
  };
  try {
    return json::parse(line.begin(), line.end(), watch);
  } catch (const json::exception& fault) {
    // "[json.exception.parse_error.101] parse error at line 1, column 9: syntax error ...": from the column on.
    std::string message = fault.what();
    if (const auto end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
    if (const auto column = message.find("column "); column != std::string::npos) message.erase(0, column);
    constexpr std::size_t most = 120;  // characters: the parser quotes what it read
    const auto* where = dynamic_cast<const json::parse_error*>(&fault);
    const bool cut = where != nullptr && where->byte > line.size();
    throw BadLine("not JSON: " + terrain::shown(message, most) + (cut ? " (a question stands on one line)" : ""));
  }
}

void allow_only(const json& object, const std::string& place, const std::vector<std::string>& keys) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const std::string question =
        terrain::did_you_mean(key, keys, [&object](const std::string& one) { return object.contains(one); });
    throw BadLine(fmt::format("{}unknown key \"{}\", {}", place.empty() ? "" : place + ": ", terrain::shown(key),
                              question.empty() ? fmt::format("expected one of: {}", fmt::join(keys, ", ")) : question));
  }
}

const json& required(const json& object, const std::string& place, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw BadLine(fmt::format("{}{} is missing", place.empty() ? "" : place + ".", key));
  return *found;
}

double number(const json& value, const std::string& place, bool zero_allowed, bool negative_allowed = false) {
  if (!value.is_number()) refuse(place, value, "a number");
  const double x = value.get<double>();
  if (!std::isfinite(x)) refuse(place, value, "a finite number");
  if (!negative_allowed && (x < 0 || (x == 0 && !zero_allowed)))
    refuse(place, value, zero_allowed ? "a number >= 0" : "a number > 0");
  return x;
}

Eigen::Vector2d pair(const json& value, const std::string& place) {
  if (!value.is_array() || value.size() != 2) refuse(place, value, "two numbers [x, y]");
  return {number(value[0], place + "[0]", true, true), number(value[1], place + "[1]", true, true)};
}

Contact read_contact(const json& value, const std::string& place) {
  static const std::vector<std::string> keys{"p", "n", "mu"};
  if (!value.is_object()) refuse(place, value, "an object {p, n, mu}");
  allow_only(value, place, keys);
  Contact contact;
  contact.position = pair(required(value, place, "p"), place + ".p");
  contact.normal = pair(required(value, place, "n"), place + ".n");
  contact.friction = number(required(value, place, "mu"), place + ".mu", true);
  if (contact.normal.isZero(0)) throw BadLine(place + ".n: a normal may not be zero");
  return contact;
}

Question read_question(std::string_view line) {
  static const std::vector<std::string> keys{"contacts", "com", "com_to",      "rho",
                                             "kappa",    "nu",  "restitution", "com_tolerance"};
  if (line.find_first_not_of(" \t\r") == std::string_view::npos) throw BadLine("empty line, a JSON object is expected");
  const json object = parse(line);
  if (!object.is_object()) throw BadLine(fmt::format("found {}, expected a JSON object", shown(object)));
  allow_only(object, "", keys);
  Question question;
  const json& contacts = required(object, "", "contacts");
  if (!contacts.is_array() || contacts.empty() || contacts.size() > 3) refuse("contacts", contacts, "1 to 3 contacts");
  for (std::size_t i = 0; i < contacts.size(); ++i)
    question.contacts.push_back(read_contact(contacts[i], fmt::format("contacts[{}]", i)));
  question.com = pair(required(object, "", "com"), "com");
  if (object.contains("com_to")) question.com_to = pair(object["com_to"], "com_to");
  question.rho = number(required(object, "", "rho"), "rho", false);
  question.box.kappa = number(required(object, "", "kappa"), "kappa", true);
  question.box.nu = number(required(object, "", "nu"), "nu", true);
  if (const auto given = object.find("restitution"); given != object.end()) {
    const double e = number(*given, "restitution", false);
    if (e >= 1) refuse("restitution", *given, "a number between 0 and 1, ends excluded");
    if (contacts.size() != 2) throw BadLine("restitution: frictional stability is about two contacts");
    if (question.com_to) throw BadLine("restitution: frictional stability is about a point, leave out com_to");
    question.restitution = e;
  }
  if (const auto wanted = object.find("com_tolerance"); wanted != object.end()) {
    if (!wanted->is_boolean()) refuse("com_tolerance", *wanted, "true or false");
    question.com_tolerance = wanted->get<bool>();
    if (question.com_tolerance && question.com_to) throw BadLine("com_tolerance: a line has none, leave out com_to");
  }
  return question;
}

struct Frictional {
  stability::FrictionalVerdict verdict;
  std::array<double, 2> psi;
  stability::FrictionalMargins margins;
};

struct Answer {
  bool equilibrium = false, robust = false;
  stability::SafetyFactor factor;
  std::vector<std::string> modes;
  std::optional<double> lambda;
  std::optional<double> com_tolerance;   // [m], of points
  std::optional<Frictional> frictional;  // of points on two contacts
  bool uncertain = false;
};

void add_modes(std::vector<std::string>& names, const std::vector<stability::ContactMode>& modes) {
  for (const auto& mode : modes)
    if (std::find(names.begin(), names.end(), mode.name()) == names.end()) names.push_back(mode.name());
}

Answer ask_point(const RobustOracle& oracle, const Question& question) {
  Answer answer;
  answer.equilibrium = oracle.equilibrium(question.com);
  answer.robust = oracle.robust(question.com);
  answer.factor = oracle.safety_factor(question.com);
  add_modes(answer.modes, oracle.feasible_modes(question.com));
  if (question.com_tolerance)
    answer.com_tolerance = stability::com_tolerance(question.contacts, question.rho, question.box, question.com);
  if (const auto& e = question.restitution) {
    const stability::Posture& posture = oracle.posture();
    answer.frictional = {stability::frictional_verdict(posture, question.com, *e),
                         stability::psi(posture, question.com),
                         stability::frictional_margins(posture, question.com, *e)};
  }
  return answer;
}

Answer ask_line(const RobustOracle& oracle, const Question& question) {
  const Eigen::Vector2d &from = question.com, &to = *question.com_to;
  Answer answer;
  answer.equilibrium = oracle.line_equilibrium(from, to);
  const stability::LineVerdict verdict = oracle.line(from, to);
  answer.robust = verdict.stable();
  answer.uncertain = verdict.outcome == stability::LineVerdict::Outcome::uncertain;
  const stability::LineSafetyFactor line = oracle.line_safety_factor(from, to);
  answer.factor = line.least;
  answer.lambda = line.lambda;
  add_modes(answer.modes, oracle.line_feasible_modes(from, to));
  return answer;
}

const char* word(bool value) { return value ? "true" : "false"; }

void write(std::string& out, const Frictional& frictional) {
  const auto& [verdict, psi, margins] = frictional;
  for (const double value : {psi[0], psi[1], margins.psi, margins.com})
    if (!std::isfinite(value)) throw BadLine("the numbers of this posture overflow");
  auto put = std::back_inserter(out);
  fmt::format_to(put, R"(, "kinematic_strong": {}, "clattering": {}, "psi": [{}, {}], "frictional": {})",
                 word(verdict.kinematic_strong), word(verdict.clattering), psi[0], psi[1], word(verdict.stable()));
  fmt::format_to(put, R"(, "psi_margin": {}, "greatest_restitution": {}, "frictional_radius": {})", margins.psi,
                 margins.restitution, margins.com);
  if (verdict.failed_mode) fmt::format_to(put, R"(, "failed_mode": "{}")", verdict.failed_mode->name());
}

void write(std::string& out, const Answer& answer) {
  const double sigma = answer.factor.value;
  if (std::isnan(sigma)) throw BadLine("the numbers of this posture overflow");
  auto put = std::back_inserter(out);
  fmt::format_to(put, R"({{"equilibrium": {}, "robust": {}, "safety_factor": )", word(answer.equilibrium),
                 word(answer.robust));
  if (std::isinf(sigma)) out += "\"inf\"";
  else fmt::format_to(put, "{}", sigma);
  fmt::format_to(put, R"(, "critical": "{}", "feasible_modes": [)", answer.factor.critical.name());
  for (std::size_t i = 0; i < answer.modes.size(); ++i)
    fmt::format_to(put, "{}\"{}\"", i == 0 ? "" : ", ", answer.modes[i]);
  out += ']';
  if (answer.lambda) fmt::format_to(put, R"(, "lambda": {})", *answer.lambda);
  if (answer.com_tolerance && std::isinf(*answer.com_tolerance)) out += R"(, "com_tolerance": "inf")";
  else if (answer.com_tolerance) fmt::format_to(put, R"(, "com_tolerance": {})", *answer.com_tolerance);
  if (answer.frictional) write(out, *answer.frictional);
  if (answer.uncertain) out += R"(, "uncertain": true)";
  const auto& [p, q] = answer.factor.witness;
  const Eigen::Vector2d& gradient = answer.factor.gradient;
  if (sigma > 0 && std::isfinite(sigma) && std::isfinite(p) && std::isfinite(q) && gradient.allFinite())
    fmt::format_to(put, R"(, "witness": [{}, {}], "gradient": [{}, {}])", p, q, gradient.x(), gradient.y());
  out += '}';
}

void write_error(std::string& out, const std::string& message, std::size_t number) {
  out += R"({"error": )" + json(message).dump(-1, ' ', false, json::error_handler_t::replace);
  fmt::format_to(std::back_inserter(out), R"(, "line": {}}})", number);
}

}  // namespace

void answer_query(std::string& out, std::string_view line, std::size_t number) {
  const std::size_t begin = out.size();
  try {
    const Question question = read_question(line);
    const RobustOracle oracle(question.contacts, question.rho, question.box);
    write(out, question.com_to ? ask_line(oracle, question) : ask_point(oracle, question));
  } catch (const std::exception& fault) {
    out.resize(begin);
    write_error(out, fault.what(), number);
  }
}

void answer_too_long(std::string& out, std::size_t number) {
  write_error(out, fmt::format("longer than {} bytes", longest_query_line), number);
}

}  // namespace surefoot::planner
