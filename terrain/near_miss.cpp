#include <algorithm>
#include <array>
#include <numeric>

#include "terrain/document.hpp"

namespace surefoot::terrain {

namespace {

constexpr std::size_t longest_word = 64;  // longer ones have no near misses worth naming

/// Levenshtein distance, with the swap of two neighbouring letters as one edit.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::array<std::vector<std::size_t>, 3> rows;
  for (auto& row : rows) row.resize(b.size() + 1);
  std::iota(rows[0].begin(), rows[0].end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto& row = rows[i % 3];
    const auto &above = rows[(i + 2) % 3], &two_above = rows[(i + 1) % 3];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], two_above[j - 2] + 1);
      }
    }
  }
  return rows[a.size() % 3][b.size()];
}

}  // namespace

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string near_miss(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > longest_word) return "";
  const std::size_t most = word.size() < 2 ? 0 : word.size() <= 4 ? 1 : std::max<std::size_t>(2, word.size() / 3);
  std::size_t nearest = most + 1;
  const std::string lower = lower_case(std::string(word));
  std::string best;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_word) continue;
    const std::size_t distance = edit_distance(lower, lower_case(candidate));
    if (distance >= nearest) continue;
    nearest = distance;
    best = candidate;
  }
  return best;
}

}  // namespace surefoot::terrain
