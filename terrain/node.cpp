#include <algorithm>
#include <charconv>
#include <cmath>

#include "terrain/document.hpp"
#include "terrain/flow_brackets.hpp"
#include "terrain/number_text.hpp"
#include "terrain/source.hpp"

namespace surefoot::terrain {
namespace {

constexpr std::string_view true_or_false = "true or false";

/// std::from_chars knows no plus sign.
template <class Number>
std::errc convert(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  return std::from_chars(text.data(), text.data() + text.size(), value).ec;
}

/// Numbers that are parted by blanks or semicolons.
bool are_numbers(std::string_view text) {
  bool several = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("; "), text.size());
    if (!is_number(text.substr(0, end))) return false;
    const std::size_t next = std::min(text.find_first_not_of("; ", end), text.size());
    several = several || next < text.size();
    text.remove_prefix(next);
  }
  return several;
}

std::string counted(std::size_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

}  // namespace

std::string shown(std::string_view text, std::size_t most) {
  std::string result;
  std::size_t characters = 0;
  for (const char c : text) {
    const bool begins = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (begins && ++characters > most) return result + "...";
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
  }
  return result;
}

void FaultList::add(const InputError& fault) {
  if (!full()) kept_.push_back(fault);
  ++count_;
}

std::vector<InputError> FaultList::kept() const {
  std::vector<InputError> sorted = kept_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const InputError& l, const InputError& r) {
    return std::make_pair(l.line, l.column) < std::make_pair(r.line, r.column);
  });
  return sorted;
}

std::string Node::where() const { return source_ ? source_->place(line_, column_) : "?"; }

FaultList* Node::faults() const { return source_ ? source_->faults : nullptr; }

void Node::fail(const std::string& message) const {
  if (!source_) throw InputError("?: " + message);
  if (source_->faults && told_) throw AlreadyTold();
  if (source_->faults && source_->faults->full())
    throw InputError("");  // only counted: its place costs a look at the text
  throw source_->error(line_, column_, message);
}

std::string Node::described() const {
  switch (kind()) {
    case Kind::null: return "nothing is given";
    case Kind::scalar: {
      const std::string value = shown(std::get<std::string_view>(content_));
      return quoted_ || value.empty() ? "\"" + value + "\" is a text" : value + " is given";
    }
    case Kind::sequence: return "a list of " + counted(std::get<Items>(content_).size(), "item") + " is given";
    case Kind::map: break;
  }
  return "a map is given";
}

void Node::refuse(std::string_view what, std::string_view expected) const {
  fail(std::string(what) + ": " + described() + "; expected " + std::string(expected));
}

std::string_view Node::plain_scalar(std::string_view what, std::string_view expected,
                                    bool (*is_one)(std::string_view)) const {
  if (kind() != Kind::scalar) refuse(what, expected);
  const std::string_view value = std::get<std::string_view>(content_);
  if (quoted_) refuse(what, std::string(expected) + (is_one(value) ? ", without quotes" : ""));
  return value;
}

double Node::number(std::string_view what) const {
  const std::string_view text = plain_scalar(what, "a number", is_number);
  const auto fail_with = [&](const std::string& reason) {
    fail(std::string(what) + ": " + shown(text) + " " + reason);
  };
  const NumberForm form = form_of(without_sign(text));
  if (form == NumberForm::not_a_number) fail_with("is not a finite decimal number; expected " + number_meant_by(text));
  if (form == NumberForm::leading_zero) fail_with("has a leading zero; expected a decimal number without");
  double value = 0;
  if (convert(text, value) != std::errc() || !std::isfinite(value)) {
    fail_with("is too large or too small for a double; expected a number such as 0.25 or 1e-3");
  }
  return value;
}

double Node::positive(std::string_view what) const {
  const double value = number(what);
  if (value > 0) return value;
  fail(std::string(what) + ": " + shown(std::get<std::string_view>(content_)) +
       " is not positive; expected a number > 0");
}

double Node::not_negative(std::string_view what) const {
  const double value = number(what);
  if (value >= 0) return value + 0.0;  // -0 becomes 0
  fail(std::string(what) + ": " + shown(std::get<std::string_view>(content_)) + " is negative; expected a number >= 0");
}

std::int64_t Node::integer(std::string_view what) const {
  plain_scalar(what, "an integer", is_number);
  return integer_key(what);
}

std::int64_t Node::integer_key(std::string_view what) const {
  if (kind() != Kind::scalar) refuse(what, "an integer");
  const std::string_view text = std::get<std::string_view>(content_);
  const auto fail_with = [&](const std::string& reason) {
    fail(std::string(what) + ": " + (quoted_ ? '"' + shown(text) + '"' : shown(text)) + " " + reason);
  };
  const NumberForm form = form_of(without_sign(text));
  if (form == NumberForm::leading_zero) fail_with("has a leading zero; expected an integer without");
  if (form != NumberForm::integer) fail_with("is not an integer; expected a whole number such as 7");
  std::int64_t value = 0;
  if (convert(text, value) != std::errc()) fail_with("is out of range; expected an integer of at most 63 bits");
  return value;
}

bool Node::boolean(std::string_view what) const {
  const auto is_boolean = [](std::string_view text) { return text == "true" || text == "false"; };
  const std::string_view text = plain_scalar(what, true_or_false, is_boolean);
  if (text == "true") return true;
  if (text != "false") refuse(what, true_or_false);
  return false;
}

std::string Node::text(std::string_view what) const {
  if (kind() != Kind::scalar) refuse(what, "a text");
  return std::string(std::get<std::string_view>(content_));
}

bool Node::is_integer() const {
  return kind() == Kind::scalar && !quoted_ &&
         form_of(without_sign(std::get<std::string_view>(content_))) == NumberForm::integer;
}

/// Of something that is no list of n items: how it may have been meant as one. Twice as many integers may be decimal
/// numbers with commas.
std::string Node::list_advice(std::size_t n) const {
  if (kind() == Kind::scalar)
    return n == 2 ? " in square brackets, [a, b]" : n == 3 ? " in square brackets, [a, b, c]" : "";
  if (kind() != Kind::sequence || n == 0) return "";
  const Items& items = std::get<Items>(content_);
  const auto* only = items.size() == 1 ? std::get_if<std::string_view>(&items.front().content_) : nullptr;
  if (only != nullptr && !items.front().quoted_ && are_numbers(*only)) return "; a comma must part them";
  if (items.size() != 2 * n) return "";
  std::string meant;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is_integer()) return "";
    const auto digits = std::get<std::string_view>(items[i].content_);
    if (i % 2 == 1 && !is_digits(digits)) return "";
    meant += (i == 0 ? "" : i % 2 == 1 ? "." : ", ") + std::string(digits);
  }
  return "; if [" + shown(meant) + "] is meant, the decimal point is a point, no comma";
}

const std::vector<Node>& Node::items(std::string_view what) const {
  if (kind() != Kind::sequence) refuse(what, "a list");
  return std::get<Items>(content_);
}

const std::vector<Node>& Node::items(std::string_view what, std::size_t n) const {
  if (kind() != Kind::sequence || std::get<Items>(content_).size() != n) {
    refuse(what, "a list of " + counted(n, "item") + list_advice(n));
  }
  return std::get<Items>(content_);
}

const std::vector<std::pair<Node, Node>>& Node::entries(std::string_view what) const {
  if (is_null() && source_ && !is_flow_text(*source_)) refuse(what, "a map (key: value), indented below it");
  if (kind() == Kind::scalar && !quoted_ && std::get<std::string_view>(content_).find(':') != std::string_view::npos)
    refuse(what, "a map (key: value), with a space behind each colon");
  if (kind() != Kind::map) refuse(what, "a map (key: value)");
  return std::get<Entries>(content_);
}

const Node* Node::find(std::string_view key) const {
  if (kind() != Kind::map) return nullptr;
  for (const auto& [name, value] : std::get<Entries>(content_)) {
    if (std::get<std::string_view>(name.content_) == key) return &value;
  }
  return nullptr;
}

const Node& Node::require(std::string_view key, std::string_view what, std::string_view advice) const {
  entries(what);
  if (const Node* value = find(key)) return *value;
  if (faults()) {
    for (const auto& [name, value] : entries(what)) {
      if (key_meant(std::get<std::string_view>(name.content_), {std::string(key)}) == key) throw AlreadyTold();
    }
  }
  fail(std::string(what) + ": \"" + std::string(key) + "\" is missing" + std::string(advice));
}

bool Node::allow_only(Keys keys, std::string_view what) const {
  bool known = true;
  const std::pair<Node, Node>* before = nullptr;
  for (const auto& entry : entries(what)) {
    const Node& name = entry.first;
    const std::string_view key = std::get<std::string_view>(name.content_);
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      name.attempt([&] { name.refuse_key(*this, {keys.begin(), keys.end()}, what, before); });
      known = false;
    }
    before = &entry;
  }
  return known;
}

std::string_view Node::home() const {
  if (!source_ || !source_->homes) return "";
  for (const auto& [place, keys] : *source_->homes)
    if (std::find(keys.begin(), keys.end(), std::get<std::string_view>(content_)) != keys.end()) return place;
  return "";
}

std::string Node::question_of_homes() const {
  if (!source_ || !source_->homes) return "";
  for (const auto& [place, keys] : *source_->homes) {
    const std::string name = other_name(std::get<std::string_view>(content_), {keys.begin(), keys.end()});
    if (!name.empty()) return "did you mean \"" + name + "\", which belongs " + std::string(place) + "?";
  }
  return "";
}

void Node::refuse_key(const Node& map, const std::vector<std::string>& keys, std::string_view what,
                      const std::pair<Node, Node>* before) const {
  const std::string_view key = std::get<std::string_view>(content_);
  const std::string message = std::string(what) + ": unknown key \"" + shown(key) + "\"; ";
  if (before && before->second.is_integer() && is_digits(key)) {
    fail(message + "the decimal point is a point, no comma: expected " +
         shown(std::get<std::string_view>(before->second.content_)) + "." + shown(key));
  }
  if (key.find("\u00a0") != std::string_view::npos)
    fail(message + "a no-break space (U+00A0) stands in it: write ordinary spaces");
  if (const std::string meant = key_meant(key, keys); !meant.empty() && key.starts_with(meant + ':'))
    fail(message + "a space must follow the colon");
  std::string question = did_you_mean(key, keys, [&map](const std::string& one) { return map.find(one) != nullptr; });
  if (const std::string_view place = home(); !place.empty())
    fail(message + "it belongs " + std::string(place) + (question.empty() ? "" : " (or " + question + ")"));
  if (question.empty()) question = question_of_homes();
  if (!question.empty()) fail(message + question);
  std::string list;
  for (const std::string& allowed : keys) list += (list.empty() ? "" : ", ") + allowed;
  fail(message + "expected one of: " + list);
}

}  // namespace surefoot::terrain
