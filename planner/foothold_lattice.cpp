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

FootholdLattice::Row FootholdLattice::row_of(int level, const terrain::Segment& segment) {
  auto& rows = rows_[static_cast<std::size_t>(level)];
  if (rows.empty()) rows.resize(terrain_->segments().size());
  Row& row = rows[static_cast<std::size_t>(&segment - terrain_->segments().data())];
  if (row.first >= 0) return row;
  row.first = static_cast<int>(footholds_.size());
  const double inset = std::min(inset_, segment.length / 4), inner = segment.length - 2 * inset;
  const int intervals = std::max(1, static_cast<int>(std::min(std::ceil(inner / spacing_), 1e6))) << level;
  const double outer = std::ldexp(inset, -level);
  if (level > 0) take(segment, outer);
  for (int i = level > 0 ? 1 : 0; i <= intervals; i += level > 0 ? 2 : 1) take(segment, inset + inner * i / intervals);
  if (level > 0) take(segment, segment.length - outer);
  row.count = static_cast<int>(footholds_.size()) - row.first;
  return row;
}

void FootholdLattice::list(int level, std::vector<int>& numbers) {
  numbers.clear();
  for (const terrain::Stretch& stretch : stretches_) {
    const Row row = row_of(level, *stretch.segment);
    const auto begin = footholds_.begin() + row.first, end = begin + row.count;
    auto at = std::lower_bound(begin, end, stretch.s_begin,
                               [](const terrain::Foothold& foothold, double s) { return foothold.s < s; });
    for (; at != end && at->s <= stretch.s_end; ++at)
      numbers.push_back(static_cast<int>(at - footholds_.begin()));
  }
}

}  // namespace surefoot::planner
