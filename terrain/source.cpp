#include "terrain/source.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "terrain/document.hpp"

namespace surefoot::terrain {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

bool continues(std::string_view text, std::size_t i) { return (byte_at(text, i) & 0xC0) == 0x80; }

/// Length of the well-formed UTF-8 sequence at i (Unicode 15, table 3-7), 0 if there is none.
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const unsigned char first = byte_at(text, i), second = byte_at(text, i + 1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(text, i + 1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;  // overlong, surrogates
    return continues(text, i + 1) && continues(text, i + 2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
    return continues(text, i + 1) && continues(text, i + 2) && continues(text, i + 3) ? 4 : 0;
  }
  return 0;
}

std::string hexadecimal(unsigned char byte) {
  std::array<char, 8> digits;
  std::snprintf(digits.data(), digits.size(), "0x%02x", byte);
  return digits.data();
}

bool is_control(std::string_view text, std::size_t i) {
  const unsigned char c = byte_at(text, i);
  if (c == '\r') return byte_at(text, i + 1) != '\n';
  return (c < 0x20 && c != '\t' && c != '\n') || c == 0x7F;
}

}  // namespace

namespace {

/// Where a line counted from 0 begins.
std::size_t begin_of_line(std::string_view text, std::size_t line) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line; ++i) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return begin;
}

}  // namespace

/// The column in characters, as given, of a column in bytes.
std::size_t Source::character_column(std::size_t line, std::size_t byte_column) const {
  constexpr std::size_t saved = 2;  // characters by each pair of escapes that is joined
  std::size_t column = byte_column;
  const std::size_t begin = begin_of_line(text, line), end = std::min(text.size(), begin + byte_column);
  for (std::size_t i = begin; i < end; ++i) column -= continues(text, i);
  const auto first = std::upper_bound(joined.begin(), joined.end(), begin);
  return column + saved * static_cast<std::size_t>(std::upper_bound(first, joined.end(), end) - first);
}

std::string Source::place(std::size_t line, std::size_t byte_column) const {
  return name + ":" + std::to_string(line + 1) + ":" + std::to_string(character_column(line, byte_column) + 1);
}

InputError Source::error(std::size_t line, std::size_t byte_column, const std::string& message) const {
  return InputError(place(line, byte_column) + ": " + message, line + 1, character_column(line, byte_column) + 1);
}

std::string_view Source::line_before(std::size_t position) const {
  const std::string_view before = std::string_view(text).substr(0, position);
  const std::size_t line_feed = before.rfind('\n');
  return line_feed == std::string_view::npos ? before : before.substr(line_feed + 1);
}

std::size_t Source::line_of(std::size_t position) const {
  const auto at = text.begin() + static_cast<std::ptrdiff_t>(std::min(position, text.size()));
  return static_cast<std::size_t>(std::count(text.begin(), at, '\n'));
}

std::string Source::place_of(std::size_t position) const {
  return place(line_of(position), line_before(position).size());
}

void Source::fail_at(std::size_t position, const std::string& message) const {
  throw error(line_of(position), line_before(position).size(), message);
}

void Source::check_characters() const {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    fail_at(0, "this is UTF-16, not UTF-8 text; expected the file to be saved as UTF-8");
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    if (length == 0) fail_at(i, "byte " + hexadecimal(byte_at(text, i)) + " is not UTF-8 text");
    if (length == 1 && is_control(text, i)) {
      fail_at(i, "control character " + hexadecimal(byte_at(text, i)) +
                     (text[i] == '\r' ? "; lines must end in LF or CR LF, not in CR alone" : "; expected text"));
    }
    i += length;
  }
}

namespace {

bool is_quote(std::string_view text, std::size_t i) { return i < text.size() && (text[i] == '"' || text[i] == '\''); }

/// Behind the quoted scalar that begins at `position`; npos if it never ends.
std::size_t end_of_quoted(std::string_view text, std::size_t position) {
  const char quote = text[position];
  for (std::size_t i = position + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 >= text.size() || text[i + 1] != quote) return i + 1;
      ++i;
    }
  }
  return std::string_view::npos;
}

}  // namespace

void Source::check_quotes(std::size_t position) const {
  if (!is_quote(text, position) || end_of_quoted(text, position) != std::string::npos) return;
  fail_at(position, std::string("this quote is never closed; expected another ") + text[position]);
}

bool Source::has_colon_on_next_line(std::size_t position) const {
  const std::size_t end = is_quote(text, position) ? end_of_quoted(text, position) : std::string::npos;
  std::size_t next = text.find_first_not_of(" \t\r\n", end);
  while (next != std::string::npos && text[next] == '#')
    next = text.find_first_not_of(" \t\r\n", text.find('\n', next));
  return end != std::string::npos && next != std::string::npos && text[next] == ':' && text.find('\n', end) < next;
}

std::string well_formed(std::string_view value) {
  std::string result;
  for (std::size_t i = 0; i < value.size();) {
    const std::size_t length = sequence_length(value, i);
    if (length == 0) result += '\xC2';  // leads both characters, whose second byte is the one that is there
    result += value.substr(i, std::max<std::size_t>(length, 1));
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

namespace {

constexpr std::size_t escape_length = 6;  // of "\uXXXX"

/// Of such an escape at i; -1 if there is none.
long escaped_unit(std::string_view text, std::size_t i) {
  if (i + escape_length > text.size() || text.substr(i, 2) != "\\u") return -1;
  unsigned unit = 0;
  const char *begin = text.data() + i + 2, *end = text.data() + i + escape_length;
  const auto [last, error] = std::from_chars(begin, end, unit, 16);
  return error == std::errc() && last == end ? static_cast<long>(unit) : -1;
}

}  // namespace

void Source::take(std::string_view given) {
  const auto first = given.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || given[first] != '{') {
    text = given;
    return;
  }
  for (std::size_t i = 0; i < given.size();) {
    const long high = escaped_unit(given, i), low = escaped_unit(given, i + escape_length);
    if (high >= 0xD800 && high <= 0xDBFF && low >= 0xDC00 && low <= 0xDFFF) {
      std::array<char, 16> escape;
      std::snprintf(escape.data(), escape.size(), "\\U%08lX", 0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00));
      text += escape.data();
      joined.push_back(text.size());
      i += 2 * escape_length;
    } else {
      const std::size_t length = given[i] == '\\' ? 2 : 1;  // an escaped backslash begins no escape
      text += given.substr(i, length);
      i += length;
    }
  }
}

std::string read_all(std::FILE* file, const std::string& name) {
  std::string text;
  std::array<char, 1 << 16> chunk;
  for (std::size_t got = 0; (got = std::fread(chunk.data(), 1, chunk.size(), file)) > 0;) {
    text.append(chunk.data(), got);
    if (text.size() > max_file_size) {
      throw InputError(name + ": is larger than " + std::to_string(max_file_size >> 20) + " MiB");
    }
  }
  if (std::ferror(file)) throw InputError(name + ": cannot be read: " + std::generic_category().message(errno));
  return text;
}

std::string read_text(const std::string& path) {
  if (path.empty()) throw InputError("the name of an input file is empty");
  const auto fail = [&path](const std::string& message) { throw InputError(path + ": " + message); };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("is a directory; expected a file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail("cannot be opened: " + std::generic_category().message(errno));
  return read_all(file.get(), path);
}

}  // namespace surefoot::terrain
