#include "gaits/text_table.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace surefoot::gaits {
namespace {

constexpr std::string_view gap = "  ";

}  // namespace

std::string paint(const std::string& text, const char* colour, bool use) {
  return use && colour && !text.empty() ? fmt::format("\x1b[{}m{}\x1b[0m", colour, text) : text;
}

std::string TextTable::print(bool colour) const {
  Widths widths;
  std::vector<Cell> titles;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    titles.push_back({columns_[c].title, "1"});
    widths.push_back(columns_[c].title.size());
    for (const auto& row : rows_) widths[c] = std::max(widths[c], row.at(c).text.size());
  }
  std::string text = groups(widths, colour) + line(titles, widths, colour);
  for (const auto& row : rows_) text += line(row, widths, colour);
  return text;
}

std::string TextTable::groups(const Widths& widths, bool colour) const {
  std::string text;
  std::size_t start = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!columns_[c].group.empty()) {
      text.resize(std::max(text.size(), start), ' ');
      text += columns_[c].group;
    }
    start += widths[c] + gap.size();
  }
  return text.empty() ? "" : paint(text, "2", colour) + "\n";
}

std::string TextTable::line(const std::vector<Cell>& row, const Widths& widths, bool colour) const {
  std::string text;
  std::string blanks;  // written when something follows, so that no line ends in blanks
  for (std::size_t c = 0; c < row.size(); ++c) {
    const std::string padding(widths[c] - row[c].text.size(), ' ');
    const bool right = columns_[c].align == Align::right;
    if (right) blanks += padding;
    if (!row[c].text.empty()) {
      text += blanks + paint(row[c].text, row[c].colour, colour);
      blanks.clear();
    }
    if (!right) blanks += padding;
    blanks += gap;
  }
  return text + "\n";
}

}  // namespace surefoot::gaits
