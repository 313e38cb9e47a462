// For each pair of footholds, once: the COMs that a search tries on it. They lie on columns across R_SS(W) within reach
// of both feet, from as low as clearance allows to the top. Where the goal can be reached from the pair, there are
// columns inside it as well. Levels: each has twice the columns and more heights than the one before, none of them
// twice. The columns nearest to the goal are made first, the others when they are asked for: most never are. So it is
// with the rules of a stance (gaits/rules.hpp, with the robot a little drawn in): holds() asks them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"
#include "planner/com_window.hpp"
#include "planner/foothold_lattice.hpp"

namespace surefoot::planner {

class ComCandidates {
 public:
  enum class Verdict : std::int8_t { open, holds, too_near, unstable };  ///< too near the terrain
  struct Com {
    Eigen::Vector2d at;       ///< [m]
    double to_goal = 0;       ///< [m]
    std::int32_t node = -1;   ///< for the search's own use
    std::int32_t after = -1;  ///< the next of its pair; -1: none made yet
    Verdict verdict = Verdict::open;
  };
  struct Pair {
    int first_foot = 0, second_foot = 0;  ///< numbers in the lattice, the lower first
    int level = 0;
    double rear = 0, front = 0;          ///< the farther and the nearer foot from the goal [m]
    std::int32_t first = -1, last = -1;  ///< of its COMs made so far
    bool balances = false;               ///< R_SS(W) is not empty within reach
    std::int32_t shape = -1;             ///< what more are made from; -1: there are no more
  };

  ComCandidates(const gaits::Scene& scene, const FootholdLattice& lattice, int columns,
                const stability::DisturbanceBox& box);

  /// The number of the pair on two different footholds, with the COMs of a level.
  int pair(int foot, int other, int level);
  /// Takes up a COM of any origin (that of a first stance) as a pair of its own. Returns the number of the COM.
  int add(int foot, int other, const Eigen::Vector2d& com);
  /// The number of the COM of a pair that comes after another, of the first after -1; -1 at the end. The nearest to the
  /// goal come first.
  std::int32_t next(int pair, std::int32_t com);
  /// Whether a COM of the pair satisfies the rules of a stance. Asks them once.
  bool holds(int pair, std::int32_t com);
  bool was_refused(std::int32_t com) const { return this->com(com).verdict > Verdict::holds; }

  /// Takes up another COM of a pair if it holds, apart from the pair's list. -1 if it does not.
  std::int32_t try_one(int pair, const Eigen::Vector2d& at);

  const Pair& operator[](int pair) const { return pairs_[static_cast<std::size_t>(pair)]; }
  Com& com(int number) { return coms_[static_cast<std::size_t>(number)]; }
  const Com& com(int number) const { return coms_[static_cast<std::size_t>(number)]; }
  std::size_t pairs() const { return pairs_.size(); }
  std::uint64_t asked() const { return asked_; }  ///< COMs whose stability was asked

 private:
  /// A vertical line of COMs of one of a shape's polygons.
  struct Column {
    double x;        ///< [m]
    double to_goal;  ///< [m]
    bool in_goal;    ///< of the part in the goal
  };
  struct Shape {
    Polygon whole, in_goal;       ///< R_SS(W) near the feet
    std::vector<Column> columns;  ///< the next is the last
  };
  Pair made(int foot, int other, int level) const;
  std::int32_t make_shape(const Pair& pair);
  void list_columns(int level, const Polygon& polygon, bool in_goal, std::vector<Column>& columns) const;
  void make_coms(Pair& pair);
  void fill_column(int level, const gaits::Feet& feet, const Polygon& polygon, double x);
  gaits::Feet feet_of(const Pair& pair) const;

  const gaits::Scene* scene_;
  const FootholdLattice* lattice_;
  gaits::Robot robot_;
  int columns_;
  stability::DisturbanceBox box_;
  std::unordered_map<std::uint64_t, int> numbers_;
  std::vector<Pair> pairs_;
  std::vector<Shape> shapes_;
  std::vector<std::int32_t> free_shapes_;  ///< of pairs whose COMs have all been made
  std::vector<Com> coms_;
  std::vector<Com> fresh_;
  std::uint64_t asked_ = 0;
};

}  // namespace surefoot::planner
