// A table of aligned columns for the terminal. Cells are laid out first and coloured afterwards, so colours never move
// a column. Widths count bytes: cells hold ASCII.
#pragma once

#include <string>
#include <vector>

namespace surefoot::gaits {

/// `text` in an ANSI colour ("1" bold, "31" red, ...), or as it is if `use` is false or there is no colour.
std::string paint(const std::string& text, const char* colour, bool use);

class TextTable {
 public:
  enum class Align { left, right };
  struct Column {
    std::string group;  ///< written above this column and those that follow; may be empty
    std::string title;
    Align align = Align::left;
  };
  struct Cell {
    std::string text;
    const char* colour = nullptr;  ///< ANSI code
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One cell per column.
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }
  std::string print(bool colour) const;

 private:
  using Widths = std::vector<std::size_t>;
  std::string groups(const Widths& widths, bool colour) const;
  std::string line(const std::vector<Cell>& row, const Widths& widths, bool colour) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace surefoot::gaits
