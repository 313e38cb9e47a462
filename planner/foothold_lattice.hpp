// Footholds at even steps of arc length in nested levels, each twice as dense, made where a search comes by: segment by
// segment, long ones piece by piece. Every segment has one near each end, where a gap or a riser is crossed best, and
// evenly spaced ones between. Same arguments, same footholds, whatever the order of the questions; their numbers depend
// on that order.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "terrain/terrain.hpp"

namespace surefoot::planner {

class FootholdLattice {
 public:
  /// The last is 2^-15 of the first: far beyond what memory lets a search exhaust.
  static constexpr int levels = 16;

  /// On level 0 footholds are at most `spacing` apart on their segment, the outermost `inset` from its ends (less on a
  /// segment that is short) [m], both > 0. Each further level halves both and holds what is new.
  FootholdLattice(const terrain::Terrain& terrain, double spacing, double inset);

  /// Takes up a foothold of any place (a start foot). Returns its number.
  int add(const terrain::Foothold& foothold);
  /// What the terrain offers a leg at a distance in [least, greatest] [m] from a COM, on sides that face it.
  void look_from(const Eigen::Vector2d& com, double least, double greatest) {
    terrain_->stretches_within(com, least, greatest, stretches_);
  }
  /// Numbers of the footholds of a level there.
  void list(int level, std::vector<int>& numbers);

  const terrain::Foothold& operator[](int number) const { return footholds_[static_cast<std::size_t>(number)]; }
  std::size_t size() const { return footholds_.size(); }

 private:
  static constexpr double most_intervals = 1e12;  ///< per segment on level 0: beyond, they are longer than `spacing`
  static constexpr std::int64_t piece = 64;       ///< intervals of level 0 that are made at once

  struct Row {
    int first = -1;  ///< number of its first foothold; -1: none made yet
    int count = 0;
  };
  /// How a segment is divided on level 0.
  struct Division {
    double inset, inner;  ///< [m]
    std::int64_t intervals;
  };
  Division divide(const terrain::Segment& segment) const;
  Row& row_of(int level, const terrain::Segment& segment, std::int64_t piece_number);
  void fill(Row& row, int level, const terrain::Segment& segment, const Division& division, std::int64_t piece_number);
  void take(const terrain::Segment& segment, double at);

  const terrain::Terrain* terrain_;
  double spacing_, inset_;
  std::array<std::vector<Row>, levels> rows_;  ///< of the first pieces, by segment
  std::array<std::unordered_map<std::uint64_t, Row>, levels> more_rows_;
  std::vector<terrain::Foothold> footholds_;
  std::vector<terrain::Stretch> stretches_;
};

}  // namespace surefoot::planner
