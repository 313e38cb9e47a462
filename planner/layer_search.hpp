// Fewest steps over a lattice of footholds and COMs, layer by layer: layer k holds the stances first reached in k
// steps. A pass expands the most advanced stances of every layer, up to a width; the next pass is wider, and what a
// narrower one left waits in its layer (complete anytime beam search: W. Zhang, AAAI 1998). Steps are checked when they
// are about to be used, never before. When no step is left that could make the plan shorter, the plan is the shortest
// of the lattice: `exhausted` says so. Deterministic.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "planner/com_candidates.hpp"
#include "planner/foothold_lattice.hpp"
#include "planner/min_heap.hpp"
#include "planner/node.hpp"
#include "planner/refusals.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

/// On level 0; every further level is twice as fine.
struct LatticeResolution {
  double spacing = 0.1;  ///< of footholds along a segment, in reach_max
  double inset = 0.02;   ///< of the outermost from the segment's ends, in reach_max
  int columns = 5;       ///< of COMs across a pair of footholds
};

/// How far a stance is from the goal [m]: its COM, the farther and the nearer of its feet.
struct ToGoal {
  double com = 0, rear = 0, front = 0;
};

/// Steps that any plan needs at least from such a stance. A transfer ends within reach of the two feet that stood
/// before, and of three consecutive ones all are within reach of one foot: so
///   after 1 step the COM is no nearer than rear - reach; after 2, of the two feet one still stands: front - reach;
///   after 3, one of these stands, or a foot that was placed within reach of the COM: com - 2 reach;
/// and every three steps more gain 2 reach more.
int least_steps(const ToGoal& stance, double reach_max);
/// The same for feet anywhere within reach of the COM.
int least_steps(double distance, double reach_max);

class LayerSearch {
 public:
  /// Steps that are stable under the disturbances of `box`. The starts are legal stances outside the goal.
  /// With a `detour_weight`, of two stances equally near to the goal that one counts as nearer whose COM has made less
  /// of a detour, each metre of it by so much.
  LayerSearch(StepProposals& proposals, const std::vector<Node>& starts, const LatticeResolution& resolution,
              const stability::DisturbanceBox& box, double detour_weight = 0);

  static constexpr int no_bound = std::numeric_limits<int>::max();
  struct Limits {
    int width = 8;  ///< stances expanded per layer
    /// Of each step that is legal, the COM is first moved towards the goal as far as halving finds it legal.
    bool sharpen = false;
    int level = 0;         ///< of the lattice; a dead end is searched on finer levels than this
    int below = no_bound;  ///< only plans of fewer steps are of interest
    std::uint64_t work = std::numeric_limits<std::uint64_t>::max();   ///< in all, as work() counts
    std::uint64_t stall = std::numeric_limits<std::uint64_t>::max();  ///< since the search last came nearer to the goal
    std::function<bool()> stop = [] { return false; };                ///< asked often
  };
  enum class End { found, exhausted, width, limit };
  /// Goes on from where it was left. `found`: path() is shorter than `below`. `exhausted`: the lattice has no such
  /// plan. `width`: all layers are as wide as allowed. `limit`: work, stall, stop or memory.
  End run(const Limits& limits);
  std::vector<Node> path() const;

  /// The COM nearest to the goal among all stances reached.
  Eigen::Vector2d best() const { return nearest_.at; }
  /// Landings, and steps with all their COMs, that were refused while there was no plan.
  const Refusals& refusals() const { return refusals_; }
  /// Landings and steps checked, COMs asked about, eighths for steps noted and COMs passed over: about a microsecond
  /// each. The same on every machine.
  std::uint64_t work() const { return checked_ + coms_.asked() + (entries_ + scanned_) / 8; }
  std::size_t stances() const { return nodes_.size(); }
  /// As many steps wait as memory allows: the search goes on no more.
  bool is_full() const { return waiting_ >= most_waiting; }
  /// A swing was refused. Of stances that differ only in where the free leg was lifted from, the first is kept; where
  /// no swing is refused, that makes no difference.
  bool swing_mattered() const { return swing_mattered_; }

 private:
  static constexpr std::uint64_t most_waiting = 8'000'000;  ///< half a gigabyte

  struct SearchNode {
    std::int32_t pair, com, parent;
    std::int32_t layer;
    std::int32_t old_foot;        ///< where the free leg was lifted from; -1: nowhere
    std::int32_t start;           ///< which of the starts, at layer 0
    int level = -1;               ///< that it was expanded on
    double detour = 0;            ///< what the COM's way so far has been longer than it came nearer to the goal [m]
    bool swings_any_way = false;  ///< set when it is expanded
  };
  /// Steps from a stance that land at one place: first all of them, the landing not yet looked at; then, by the leg
  /// that is lifted, all COMs of a level of the pair that is left.
  struct Entry {
    double key;                ///< [m], smaller first
    std::uint32_t number = 0;  ///< ties go by age
    std::int32_t node;
    std::int32_t landing;
    std::int32_t lifted = -1;                     ///< -1: the landing has not been looked at
    std::int32_t pair = -1;                       ///< not yet asked for
    std::int32_t last = -1;                       ///< the COM that was tried last
    std::int16_t first_level = 0, level = 0;      ///< of the COMs
    bool sharpened = false;                       ///< its first legal COM has been
    bool has_led_on = false;                      ///< to some stance
    bool refused = false;                         ///< some COM that all feet reach was
    gaits::Rule refused_by = gaits::Rule::reach;  ///< if so: the rule, of those asked last

    /// The rules are asked in the order of the enumeration, but for visibility: the later, the nearer to legal.
    void note(gaits::Rule rule) {
      if (!refused || rule > refused_by) refused_by = rule;
      refused = true;
    }
  };
  struct Layer {
    MinHeap heap;                     ///< of entries
    std::vector<std::int32_t> nodes;  ///< in the order in which they were reached; some have left for earlier layers
    std::size_t raised = 0;           ///< of these, how many have been expanded on the layer's level
    int level = 0, width = 0;
  };

  /// The stance with the smallest key so far.
  struct Front {
    double key = std::numeric_limits<double>::infinity();
    std::size_t layer = 0;
    std::uint64_t work = 0;
  };
  class DeadEnd;

  bool run_layer(std::size_t k, const Limits& limits);
  void pop(std::size_t k, const Limits& limits);
  void reach(std::size_t k, const Entry& entry, std::int32_t com);
  void put_back(std::size_t k, const Entry& entry);
  Entry take_best(std::size_t k);
  void expand(std::int32_t node, int level, int below);
  void push_landing(std::int32_t node, std::int32_t landing, int first_level, int level);
  void push_steps(std::size_t k, const Entry& entry);
  void push(std::size_t k, Entry entry);
  std::int32_t sharpened(const Entry& entry, std::int32_t com);
  void try_coms(std::size_t k, Entry entry, const Limits& limits);
  bool is_too_long(std::size_t k, std::int32_t landing, std::int32_t lifted, std::int32_t kept) const;
  bool any_open(std::size_t end) const;
  bool is_out(const Limits& limits);
  bool feet_reach(const Entry& entry, const Eigen::Vector2d& to);
  std::optional<gaits::Rule> broken_rule(const Entry& entry, std::int32_t com);
  std::optional<gaits::Rule> broken_step_rule(const Entry& entry, std::int32_t com);
  std::optional<gaits::Rule> broken_placement_rule(const SearchNode& node, std::int32_t landing);
  void refuse(gaits::Rule rule, const SearchNode& node);
  const terrain::Foothold& foot(std::int32_t number) const { return lattice_[number]; }
  double detour(std::int32_t node, const ComCandidates::Com& to) const;  ///< [m]
  ToGoal to_goal(const Eigen::Vector2d& com, std::int32_t pair) const;
  double key(const Eigen::Vector2d& com, std::int32_t pair) const;                         ///< [m]
  double key_of_step(std::int32_t landing, std::int32_t lifted, std::int32_t kept) const;  ///< [m]

  StepProposals* proposals_;
  const gaits::Scene* scene_;
  gaits::Robot robot_;
  stability::DisturbanceBox box_;
  double detour_weight_;
  FootholdLattice lattice_;
  ComCandidates coms_;
  std::vector<Node> starts_;
  std::vector<SearchNode> nodes_;
  std::vector<Layer> layers_;
  std::vector<Entry> waiting_entries_;
  std::vector<std::uint32_t> free_entries_;  ///< of waiting_entries_
  std::vector<int> landings_;
  std::int32_t goal_ = -1;
  int below_ = no_bound;
  bool swing_mattered_ = false;
  Front front_;
  ComCandidates::Com nearest_{Eigen::Vector2d::Zero(), std::numeric_limits<double>::infinity()};
  Refusals refusals_;
  unsigned asked_to_stop_ = 0;
  bool stopped_ = false;
  std::uint64_t waiting_ = 0;  ///< entries in all heaps
  std::uint64_t checked_ = 0, scanned_ = 0, entries_ = 0;
};

}  // namespace surefoot::planner
