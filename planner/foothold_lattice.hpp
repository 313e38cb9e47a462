// Footholds at even steps of arc length in nested levels, each twice as dense, made segment by segment where a search
// comes by. Every segment has one near each end, where a gap or a riser is crossed best, and evenly spaced ones
// between. Same arguments, same footholds, whatever the order of the questions; their numbers depend on that order.
#pragma once

#include <array>
#include <vector>

#include "terrain/terrain.hpp"

namespace surefoot::planner {

class FootholdLattice {
 public:
  static constexpr int levels = 5;

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
  struct Row {
    int first = -1;  ///< number of the segment's first foothold; -1: none made yet
    int count = 0;
  };
  Row row_of(int level, const terrain::Segment& segment);
  void take(const terrain::Segment& segment, double at);

  const terrain::Terrain* terrain_;
  double spacing_, inset_;
  std::array<std::vector<Row>, levels> rows_;  ///< by segment
  std::vector<terrain::Foothold> footholds_;
  std::vector<terrain::Stretch> stretches_;
};

}  // namespace surefoot::planner
