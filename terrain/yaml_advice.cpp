#include "terrain/yaml_advice.hpp"

#include <algorithm>
#include <cctype>

namespace surefoot::terrain {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return "";
  return line.substr(begin, line.find_last_not_of(blanks) + 1 - begin);
}

/// Without indentation and comment (a quoted text with " #" is cut too: it only costs an advice).
std::string_view content(std::string_view line) {
  const std::string_view whole = trimmed(line);
  return whole.starts_with('#') ? "" : trimmed(whole.substr(0, std::min(whole.find(" #"), whole.find("\t#"))));
}

bool is_blank(std::string_view line, std::size_t i) { return i >= line.size() || blanks.find(line[i]) != blanks.npos; }

bool has_key(std::string_view line) { return line.ends_with(':') || line.find(": ") != std::string_view::npos; }

/// The first colon has something right behind it, as in "a:1".
bool has_close_colon(std::string_view line) {
  const std::size_t colon = line.find(':');
  return colon != std::string_view::npos && !is_blank(line, colon + 1);
}

struct Line {
  std::size_t number;  // from 1
  std::string_view content;
};

/// The nearest line above a position that is neither empty nor a comment.
std::optional<Line> line_above(const Source& source, std::size_t position) {
  position = std::min(position, source.text.size());
  std::size_t number = source.line_of(position);
  for (std::size_t begin = position - source.line_before(position).size(); begin > 0; --number) {
    const std::string_view line = source.line_before(begin - 1);
    if (!content(line).empty()) return Line{number, content(line)};
    begin -= line.size() + 1;
  }
  return std::nullopt;
}

std::string unclosed(const Source& source, char bracket, const char* what, std::optional<std::size_t> open) {
  std::string advice = std::string("; is a '") + bracket + "' or a comma missing";
  if (open) advice += std::string(" in the ") + what + " that begins at " + source.place_of(*open);
  return advice + "?";
}

constexpr const char* space_after_colon = "; a space must follow a colon";
constexpr const char* same_column = "; keys of one map, or dashes of one list, begin in the same column";

/// A no-break space where a space is meant: it looks like one and is none.
bool has_no_break_space(std::string_view line) {
  constexpr std::string_view space = "\u00a0";
  const std::size_t first = line.starts_with('-') ? 1 : 0;
  return line.substr(first).starts_with(space) || line.find(":\u00a0") != std::string_view::npos;
}

/// The last line up to that of a position that has one.
std::string no_break_space(const Source& source, std::size_t position) {
  const std::size_t end = std::min(source.text.find('\n', position), source.text.size());
  std::size_t number = 0, found = 0;
  for (std::size_t begin = 0; begin < end; ++number) {
    const std::size_t next = std::min(source.text.find('\n', begin), source.text.size());
    const std::string_view line = std::string_view(source.text).substr(begin, next - begin);
    if (has_no_break_space(content(line))) found = number + 1;
    begin = next + 1;
  }
  if (found == 0) return "";
  return "; a no-break space (U+00A0) stands on line " + std::to_string(found) + ": write ordinary spaces";
}

/// The parser wanted the next key or dash of a block, and found something else.
std::string misplaced(const Source& source, std::size_t position) {
  if (source.text.substr(position, 1) == ",") return "; a list of several on one line stands in square brackets";
  const std::string_view from = std::string_view(source.text).substr(position - source.line_before(position).size());
  const std::string_view line = content(from.substr(0, from.find('\n')));
  if (!has_key(line) && has_close_colon(line)) return space_after_colon;  // the line that it stopped at
  const std::string advice = advice_on_line_above(source, position);
  return advice.empty() ? same_column : advice;
}

/// A colon where no value may begin.
std::string unexpected_colon(const Source& source, std::size_t position) {
  const std::string_view before = source.line_before(position);
  const std::string_view indentation = before.substr(0, before.find_first_not_of(blanks));
  if (indentation.find('\t') != std::string_view::npos) return "; a tab stands in the indentation: indent by spaces";
  if (has_close_colon(content(before))) return space_after_colon;
  if (has_key(content(before))) return "; a text that holds a colon stands in quotes, a map on one line in braces {}";
  const std::string advice = advice_on_line_above(source, position);
  return advice.empty() ? same_column : advice;
}

}  // namespace

std::string advice_on_line_above(const Source& source, std::size_t position) {
  const auto above = line_above(source, position);
  if (!above) return "";
  const std::string line = "; on line " + std::to_string(above->number) + " a ";
  const std::string_view text = above->content;
  if (text.size() > 1 && text[0] == '-' && std::isalpha(static_cast<unsigned char>(text[1])))
    return line + "space must follow the dash";
  if (text.starts_with("//")) return line + "comment must begin with #";
  if (!std::isalpha(static_cast<unsigned char>(text[0]))) return "";  // no word that could be a key
  if (!has_key(text) && has_close_colon(text)) return line + "space must follow the colon";
  if (!has_key(text)) return line + "colon is missing (key: value)";
  return "";
}

std::string yaml_advice(const Source& source, std::string_view message, std::size_t position,
                        std::optional<std::size_t> open) {
  position = std::min(position, source.text.size());
  if (std::string advice = no_break_space(source, position); !advice.empty()) return advice;
  if (message == "end of sequence flow not found") return unclosed(source, ']', "list", open);
  if (message == "end of map flow not found") return unclosed(source, '}', "map", open);
  if (message == "end of map not found" || message == "end of sequence not found") return misplaced(source, position);
  if (message == "illegal map value") return unexpected_colon(source, position);
  if (message == "illegal flow end") {
    const std::string_view before = source.line_before(position);
    const bool close = before.find(":{") != before.npos || before.find(":[") != before.npos;
    return close ? space_after_colon : "; a closing bracket without an opening one";
  }
  if (message == "illegal block entry") return "; a dash of a list stands at the beginning of its line";
  if (message.starts_with("illegal tab")) return "; indent by spaces";
  return "";
}

}  // namespace surefoot::terrain
