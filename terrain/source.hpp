// The text of a document and its checks, shared by the files that implement document.hpp.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "terrain/document.hpp"

namespace surefoot::terrain {

struct Source {
  std::string name;
  std::string text;               ///< without byte-order mark
  std::deque<std::string> extra;  ///< scalars that do not stand in the text as they are (escapes, folded lines)

  FaultList* faults = nullptr;      ///< where faults are kept, if they are not thrown
  const KeyHomes* homes = nullptr;  ///< of the format, if it has told them

  /// The error at a place counted from 0, its column in bytes.
  InputError error(std::size_t line, std::size_t byte_column, const std::string& message) const;
  /// "name:line:column" of that place.
  std::string place(std::size_t line, std::size_t byte_column) const;
  [[noreturn]] void fail_at(std::size_t position, const std::string& message) const;
  /// Refuses what is not UTF-8, and control characters (the parser takes some for the end of the file).
  void check_characters() const;
  /// Refuses a quoted scalar that begins at `position` and never ends (the parser reads on to the end).
  void check_quotes(std::size_t position) const;
  std::size_t line_of(std::size_t position) const;  ///< from 0
  /// The line that a position stands on, up to there.
  std::string_view line_before(std::size_t position) const;
  /// "name:line:column" of a position.
  std::string place_of(std::size_t position) const;
};

/// JSON writes a character beyond U+FFFF as two escapes of UTF-16 ("\ud83e\udd16"), of which the parser knows only
/// "\U0001F916": what begins like JSON, written so.
std::string with_surrogates_joined(std::string_view text);

/// The parser turns the escapes "\_" and "\N" into single bytes; here they become the characters that they stand for
/// (U+00A0, U+0085), as UTF-8.
std::string well_formed(std::string_view value);

}  // namespace surefoot::terrain
