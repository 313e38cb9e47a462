#include "planner/foothold_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::planner {

FootholdLattice::FootholdLattice(const terrain::Terrain& terrain, double spacing, double inset)
    : terrain_(&terrain), spacing_(spacing), inset_(inset) {}

int FootholdLattice::add(const terrain::Foothold& foothold) {
  footholds_.push_back(foothold);
  return static_cast<int>(footholds_.size()) - 1;
}

/// `at` [m] along a segment.
void FootholdLattice::take(const terrain::Segment& segment, double at) {
  if (const auto foothold = terrain_->foothold_at(segment.chain, segment.s_begin + at)) footholds_.push_back(*foothold);
}

FootholdLattice::Division FootholdLattice::divide(const terrain::Segment& segment) const {
  const double inset = std::min(inset_, segment.length / 4), inner = segment.length - 2 * inset;
  const double intervals = std::clamp(std::ceil(inner / spacing_), 1.0, most_intervals);
  return {inset, inner, static_cast<std::int64_t>(intervals)};
}

FootholdLattice::Row& FootholdLattice::row_of(int level, const terrain::Segment& segment, std::int64_t piece_number) {
  const auto of_level = static_cast<std::size_t>(level);
  const auto index = static_cast<std::size_t>(&segment - terrain_->segments().data());
  if (piece_number > 0) return more_rows_[of_level][index << 35 | static_cast<std::uint64_t>(piece_number)];
  auto& rows = rows_[of_level];
  if (rows.empty()) rows.resize(terrain_->segments().size());
  return rows[index];
}

/// Level 0 has the ends of the intervals, each further level the middles between what is there. Between the outermost
/// and the end of the segment, each further level has one at half the distance and, once the intervals are shorter than
/// the inset, as many more as it takes to be no wider apart than they.
void FootholdLattice::fill(Row& row, int level, const terrain::Segment& segment, const Division& division,
                           std::int64_t piece_number) {
  row.first = static_cast<int>(footholds_.size());
  const bool last = (piece_number + 1) * piece >= division.intervals;
  const std::int64_t begin = (piece_number * piece) << level;
  const std::int64_t end = std::min((piece_number + 1) * piece, division.intervals) << level;
  const double outer = std::ldexp(division.inset, -level),
               parts = std::ldexp(static_cast<double>(division.intervals), level);
  const int fine = level - std::max(0, std::ilogb(spacing_ / division.inset));
  const std::int64_t parts_of_inset = std::int64_t{1} << std::max(0, fine);
  const auto within_inset = [&](std::int64_t i) { return std::ldexp(division.inset * static_cast<double>(i), -fine); };
  if (level > 0 && piece_number == 0) {
    take(segment, outer);
    for (std::int64_t i = 3; i < parts_of_inset; i += 2) take(segment, within_inset(i));
  }
  // The end of a piece is the beginning of the next.
  const std::int64_t to = level == 0 && !last ? end - 1 : end;
  for (std::int64_t i = level > 0 ? begin + 1 : begin; i <= to; i += level > 0 ? 2 : 1)
    take(segment, division.inset + division.inner * static_cast<double>(i) / parts);
  if (level > 0 && last) {
    for (std::int64_t i = parts_of_inset - 1; i >= 3; i -= 2) take(segment, segment.length - within_inset(i));
    take(segment, segment.length - outer);
  }
  row.count = static_cast<int>(footholds_.size()) - row.first;
}

void FootholdLattice::list(int level, std::vector<int>& numbers) {
  numbers.clear();
  for (const terrain::Stretch& stretch : stretches_) {
    const terrain::Segment& segment = *stretch.segment;
    const Division division = divide(segment);
    const auto piece_at = [&](double s) {
      const double at =
          (s - segment.s_begin - division.inset) / division.inner * static_cast<double>(division.intervals);
      return std::clamp<std::int64_t>(static_cast<std::int64_t>(at), 0, division.intervals - 1) / piece;
    };
    // What rounding puts into a neighbouring piece is missed: a foothold at the very end of reach.
    for (std::int64_t number = piece_at(stretch.s_begin); number <= piece_at(stretch.s_end); ++number) {
      Row& row = row_of(level, segment, number);
      if (row.first < 0) fill(row, level, segment, division, number);
      const auto begin = footholds_.begin() + row.first, end = begin + row.count;
      auto at = std::lower_bound(begin, end, stretch.s_begin,
                                 [](const terrain::Foothold& foothold, double s) { return foothold.s < s; });
      for (; at != end && at->s <= stretch.s_end; ++at) numbers.push_back(static_cast<int>(at - footholds_.begin()));
    }
  }
}

}  // namespace surefoot::planner
