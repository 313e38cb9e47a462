// The text of a document and its checks, shared by the files that implement document.hpp.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/document.hpp"

namespace surefoot::terrain {

struct Source {
  std::string name;
  std::string text;                 ///< without byte-order mark, pairs of escapes joined
  std::vector<std::size_t> joined;  ///< where in it such pairs end
  std::deque<std::string> extra;    ///< scalars that do not stand in the text as they are (escapes, folded lines)

  FaultList* faults = nullptr;      ///< where faults are kept, if they are not thrown
  const KeyHomes* homes = nullptr;  ///< of the format, if it has told them

  /// Takes over a text. JSON writes a character beyond U+FFFF as two escapes of UTF-16 ("\ud83e\udd16"), which the
  /// parser does not know: in what begins like JSON they become "\U0001F916".
  void take(std::string_view given);
  /// The error at a place counted from 0, its column in bytes.
  InputError error(std::size_t line, std::size_t byte_column, const std::string& message) const;
  /// "name:line:column" of that place.
  std::string place(std::size_t line, std::size_t byte_column) const;
  std::size_t character_column(std::size_t line, std::size_t byte_column) const;
  [[noreturn]] void fail_at(std::size_t position, const std::string& message) const;
  /// Refuses what is not UTF-8, and control characters (the parser takes some for the end of the file).
  void check_characters() const;
  /// Refuses a quoted scalar that begins at `position` and never ends (the parser reads on to the end).
  void check_quotes(std::size_t position) const;
  /// Whether a quoted scalar begins at `position`, ends its line, and is followed by a colon on a later one.
  bool has_colon_on_next_line(std::size_t position) const;
  std::size_t line_of(std::size_t position) const;  ///< from 0
  /// The line that a position stands on, up to there.
  std::string_view line_before(std::size_t position) const;
  /// "name:line:column" of a position.
  std::string place_of(std::size_t position) const;
};

/// The parser turns the escapes "\_" and "\N" into single bytes; here they become the characters that they stand for
/// (U+00A0, U+0085), as UTF-8.
std::string well_formed(std::string_view value);

}  // namespace surefoot::terrain
