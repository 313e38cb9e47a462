#include <algorithm>
#include <array>
#include <functional>
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

/// Other names of the same, each group padded by "": the symbols of the papers, which postures use and scenes do not,
/// and what else comes to mind.
constexpr std::array<std::array<std::string_view, 4>, 6> same_meaning{{
    {"radius_of_gyration", "rho", "gyration", "gyradius"},
    {"friction", "mu", "friction_coefficient"},
    {"normal", "n"},
    {"p", "position", "point"},
    {"vertices", "points"},
    {"feet", "legs", "footholds", "foothold"},
}};

/// The names that mean the same as a word, itself among them; nullptr if it is not known.
const std::array<std::string_view, 4>* names_of(std::string_view word) {
  const auto holds = [word](const auto& names) { return std::find(names.begin(), names.end(), word) != names.end(); };
  const auto found = std::find_if(same_meaning.begin(), same_meaning.end(), holds);
  return word.empty() || found == same_meaning.end() ? nullptr : &*found;
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

std::string other_name(std::string_view word, const std::vector<std::string>& keys) {
  const auto* const names = names_of(lower_case(std::string(word)));
  if (names == nullptr) return "";
  constexpr std::string_view only_asked = "foothold";  // a key with a meaning of its own
  const auto named = [&](const std::string& key) {
    return key != only_asked && std::find(names->begin(), names->end(), key) != names->end();
  };
  const auto found = std::find_if(keys.begin(), keys.end(), named);
  return found == keys.end() ? "" : *found;
}

std::string key_meant(std::string_view unknown, const std::vector<std::string>& keys) {
  constexpr std::size_t least_letters = 3;
  const std::string_view before_colon = unknown.substr(0, unknown.find(':'));
  if (std::find(keys.begin(), keys.end(), before_colon) != keys.end()) return std::string(before_colon);
  constexpr std::size_t symbol = 3;  // letters: "mu" is no slip of the pen for "nu"
  if (names_of(lower_case(std::string(unknown))) != nullptr) {
    if (std::string other = other_name(unknown, keys); !other.empty() || unknown.size() <= symbol) return other;
  }
  if (std::string near = near_miss(unknown, keys); !near.empty()) return near;
  const auto begun = [&](const std::string& key) { return key.starts_with(std::string(unknown) + '_'); };
  const auto longer = std::find_if(keys.begin(), keys.end(), begun);  // "com" for "com_x"
  return unknown.size() >= least_letters && longer != keys.end() ? *longer : "";
}

std::string did_you_mean(std::string_view unknown, const std::vector<std::string>& keys,
                         const std::function<bool(const std::string&)>& is_given) {
  std::vector<std::string> absent_first = keys;
  std::stable_partition(absent_first.begin(), absent_first.end(), [&](const auto& key) { return !is_given(key); });
  const std::string meant = key_meant(unknown, absent_first);
  if (meant.empty()) return "";
  return "did you mean \"" + meant + "\"" + (is_given(meant) ? ", which is given already?" : "?");
}

}  // namespace surefoot::terrain
