// The graph of the proof of impossibility: nodes are pairs of pieces of terrain that may carry a stance, with a part of
// the region where the COM then is; edges join two pairs of three pieces wherever a transfer between them is not
// excluded. Every plan of the scene is a way in it.
//
// Pieces are halves of halves of segments, made when something looks at them; an edge is `certain` if it was confirmed
// for the middles of the pieces, else `doubtful`. Refinement halves the pieces of doubtful edges.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/infeasibility.hpp"
#include "planner/infeasibility_bounds.hpp"
#include "terrain/spatial_index.hpp"

namespace surefoot::planner::proof {

/// Pieces of all segments, as binary trees.
class Pieces {
 public:
  Pieces(const gaits::Scene& scene, double coarsest, double margin);
  Pieces(const Pieces& other);

  int size() const { return static_cast<int>(cells_.size()); }
  const Foot& foot(int id) const { return cells_[id].foot; }
  const Foot& middle(int id) const { return cells_[id].middle; }
  double length(int id) const { return cells_[id].foot.piece.length(); }
  bool is_halved(int id) const { return cells_[id].child >= 0; }
  int add_point(const terrain::Foothold& foothold);
  void halve(int id);
  /// Leaves under a piece, itself if it has not been halved.
  void leaves(int id, std::vector<int>& found) const;
  /// Leaves no longer than `coarsest` that may have a point in the box.
  void in_box(const Eigen::AlignedBox2d& box, std::vector<int>& found);

 private:
  struct Cell {
    Foot foot, middle;
    int child = -1;  // and the next
    bool fixed = false;
  };
  int add(const Piece& piece, std::span<const terrain::Segment* const> around);
  std::span<const terrain::Segment* const> look_around(const Piece& piece);
  void collect(int id, const Eigen::AlignedBox2d& box, std::vector<int>& found);

  const gaits::Scene& scene_;
  double coarsest_, margin_;
  std::shared_ptr<const terrain::SpatialIndex> index_;
  std::deque<Cell> cells_;             // references stay good
  std::vector<int> points_;            // pieces of no length: the start feet
  std::unordered_map<int, int> root_;  // by position in segments()
  std::vector<std::shared_ptr<std::vector<const terrain::Segment*>>> surroundings_;
};

/// For each part of a stance's region: whether something is possible there (bits), and confirmed for the middles.
struct Ways {
  unsigned possible = 0, certain = 0;
};

/// Two pieces that may carry a stance.
struct Pair {
  struct Third {
    int piece;
    Ways ways;
  };
  int first = 0, second = 0;  ///< pieces
  Convex coms, middle_coms;   ///< of the pieces, of their middles
  Region region;
  bool starts = false;  ///< a first stance: both legs are visible, and the COM is the given one
  bool listed = false;
  std::vector<Third> thirds;      ///< pieces on which a foot may be placed or lifted from this stance
  std::optional<unsigned> entry;  ///< parts in which the COM may be the last before the window
  std::optional<Ways> goal;       ///< the COM may lie in the goal
  double to_goal = 0;             ///< [m] guides the search
};

class Graph {
 public:
  /// Without `confirm` every edge is doubtful: enough to know what can be reached. `work` is counted up to the limit.
  Graph(const Bounds& bounds, Pieces& pieces, bool confirm, const ProofLimits& limits, std::uint64_t& work);

  bool exhausted() const { return exhausted_; }  ///< a limit was reached: what is found then means nothing
  bool has_start() const { return !starts_.empty(); }
  const Pair& pair(int node) const { return pairs_[node / most_parts]; }

  /// Least number of doubtful edges from a first stance to the goal; nothing if the goal cannot be reached.
  std::optional<int> search();
  /// After a search that gave `least`: halves pieces of the doubtful edges on ways with no more of them. False if none
  /// can be halved.
  bool refine(int least);
  /// Nodes that the last search reached.
  std::vector<int> reached() const;
  /// Nodes with a COM in the goal (of all pieces within reach of it).
  std::vector<int> goal_nodes();
  /// Nodes that can be reached from the goal.
  std::vector<int> reached_from_goal();

 private:
  struct Triple {
    std::array<Ways, 3> ways;  // of the pair without the k-th piece, with the k-th as the third
  };
  struct Mark {
    int cost;
    bool settled;
  };
  using Marks = std::unordered_map<int, Mark>;
  struct Entry {
    int cost;
    double to_goal;
    int node;
    bool operator<(const Entry& other) const;  // for a heap: the best is the greatest
  };

  static int node_of(int pair, int part) { return pair * most_parts + part; }
  static unsigned part_of(int node) { return 1u << (node % most_parts); }
  void make_starts();
  /// Nodes with a COM in the box, as `parts` says for a pair.
  template <class Parts>
  std::vector<int> nodes_in(const std::optional<std::pair<double, double>>& x,
                            const std::optional<std::pair<double, double>>& y, Parts&& parts);
  unsigned parts_of_entry(Pair& pair);
  void make_start(const terrain::Foothold& first, const terrain::Foothold& second);
  int pair_of(int first, int second);
  int add(Pair pair);
  double finest_for(std::initializer_list<int> pieces) const;
  Ways ways(const Pair& pair, int third);
  Ways ways_to_goal(Pair& pair);
  const Triple& triple_of(const std::array<int, 3>& sorted);
  Ways ways_of(int first, int second, int third);
  void renew_thirds(Pair& pair);
  /// visit(node, doubtful, third piece) for every edge.
  template <class Visit>
  void edges(int node, Visit&& visit);
  template <class Admit>
  void spread(Marks& marks, const std::vector<std::pair<int, int>>& from, Admit&& admit);  // from: nodes, their costs
  void choose(std::array<int, 3> pieces, std::vector<int>& chosen) const;
  bool spend();

  const Bounds& bounds_;
  Pieces& pieces_;
  bool confirm_;
  const ProofLimits& limits_;
  std::uint64_t& work_;
  bool exhausted_ = false;
  int since_clock_ = 0;
  Field field_;
  std::deque<Pair> pairs_;                             // references stay good
  std::vector<int> starts_;                            // nodes
  std::unordered_map<std::uint64_t, int> pair_index_;  // by pieces; -1: no stance
  std::unordered_map<std::uint64_t, Triple> triples_;
  Marks forward_;
};

}  // namespace surefoot::planner::proof
