#include "terrain/flow_brackets.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot::terrain {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The quote that ends the text that begins at `i`, or the end of everything.
std::size_t end_of_quoted(std::string_view text, std::size_t i) {
  const char quote = text[i];
  for (++i; i < text.size() && text[i] != quote; ++i)
    if (quote == '"' && text[i] == '\\') ++i;
  return i;
}

/// A quote within a plain text is none.
bool begins_value(std::string_view text, std::size_t i) {
  const std::size_t before = text.substr(0, i).find_last_not_of(blanks);
  return before == std::string_view::npos || std::string_view("[{,:").find(text[before]) != std::string_view::npos;
}

/// Behind comments and the mark of a document.
std::size_t first_of_content(std::string_view text) {
  std::size_t i = 0;
  for (;;) {
    i = std::min(text.find_first_not_of(blanks, i), text.size());
    if (text.substr(i).starts_with('#')) i = std::min(text.find('\n', i), text.size());
    else if (text.substr(i).starts_with("---")) i += 3;
    else return i;
  }
}

std::string open_one(const Source& source, std::size_t at) {
  return std::string(source.text[at] == '{' ? "map" : "list") + " that begins at " + source.place_of(at);
}

}  // namespace

bool is_flow_text(const Source& source) {
  const std::string_view text = source.text;
  const std::size_t begin = first_of_content(text);
  return begin < text.size() && (text[begin] == '{' || text[begin] == '[');
}

const char* not_valid(const Source& source) {
  return is_flow_text(source) ? "not valid JSON or YAML: " : "not valid YAML: ";
}

void check_flow_brackets(const Source& source) {
  const std::string_view text = source.text;
  if (!is_flow_text(source)) return;
  const std::size_t begin = first_of_content(text);
  std::vector<std::size_t> open;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '#' && i > 0 && blanks.find(text[i - 1]) != std::string_view::npos) {
      i = std::min(text.find('\n', i), text.size());
    } else if ((c == '"' || c == '\'') && begins_value(text, i)) {
      i = end_of_quoted(text, i);
      if (i >= text.size()) return;  // a quote that is not closed is another fault
    } else if (c == '{' || c == '[') {
      open.push_back(i);
    } else if (c == '}' || c == ']') {
      if (open.empty()) return;
      const char meant = text[open.back()] == '{' ? '}' : ']';
      if (c != meant)
        source.fail_at(i, std::string(not_valid(source)) + "'" + c + "' is found where '" + meant + "' must end the " +
                              open_one(source, open.back()));
      open.pop_back();
    }
  }
  if (open.empty()) return;
  const char meant = text[open.back()] == '{' ? '}' : ']';
  source.fail_at(text.find_last_not_of(blanks) + 1, std::string(not_valid(source)) + "the text ends, but a '" + meant +
                                                        "' is missing in the " + open_one(source, open.back()));
}

}  // namespace surefoot::terrain
