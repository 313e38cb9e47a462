// Where the COM can go while two feet stay where they are: cells of a grid within reach of both pieces that are not
// all nearer to the terrain than the clearance, in parts that do not touch. While two feet stand, the COM moves within
// reach of both and keeps the clearance, so it stays in one part: it does not get through a wall or a ceiling that is
// longer than the legs. (Cells are squares of a fixed grid; parts join at corners; what is doubtful counts as free.)
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gaits/scene.hpp"
#include "planner/infeasibility_convex.hpp"

namespace surefoot::planner::proof {

constexpr int most_parts = 8;  ///< further parts count as joined to the last

class Region {
 public:
  int parts() const { return parts_; }
  /// Bit k: some cell that the box meets belongs to part k. `slack` [m] is added on every side.
  unsigned parts_in(const Eigen::AlignedBox2d& box, double slack) const;
  bool meets(int part, const Region& other, int other_part) const;

 private:
  friend class Field;
  std::uint64_t row(int part, int at) const {
    return bits_[static_cast<std::size_t>(part) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(at)];
  }
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();  // of the grid [m]
  double width_ = 1;                                  // of a cell [m]
  std::int64_t i_ = 0, j_ = 0;                        // first column and row
  int rows_ = 0, parts_ = 1;
  std::vector<std::uint64_t> bits_;  // by part and row; bit i: column i_ + i. Empty: one part without bounds
};

/// The grid, filled in as it is asked for.
class Field {
 public:
  /// Without `apart` every region is in one part.
  Field(const gaits::Scene& scene, bool apart, double slack);
  /// The region of a convex set.
  Region region_of(const Convex& within);

 private:
  std::uint64_t free_cells(std::int64_t i, std::int64_t j, std::uint64_t wanted);
  bool is_free(std::int64_t i, std::int64_t j) const;
  bool is_free(const Eigen::Vector2d& centre, double width, int halvings) const;
  void split(Region& region, std::vector<std::uint64_t> left) const;

  struct Word {
    std::uint64_t known = 0, free = 0;
  };
  const gaits::Scene& scene_;
  bool apart_;
  double slack_, width_;
  Eigen::Vector2d origin_;
  std::unordered_map<std::uint64_t, Word> words_;  // 64 columns of a row
};

}  // namespace surefoot::planner::proof
