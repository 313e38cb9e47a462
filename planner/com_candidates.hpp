// For each pair of footholds, once: the COMs that a search tries on it. They lie on columns across R_SS(W) within reach
// of both feet, from as low as clearance allows to the top, and each satisfies every rule of a stance (gaits/rules.hpp)
// with the robot a little drawn in. Where the goal can be reached from the pair, there are columns inside it as well.
// Levels: each has twice the columns and more heights than the one before, none of them twice.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"
#include "planner/foothold_lattice.hpp"

namespace surefoot::planner {

class ComCandidates {
 public:
  struct Com {
    Eigen::Vector2d at;           ///< [m]
    double to_goal = 0;           ///< [m]
    std::int32_t node = -1;       ///< for the search's own use
  };
  struct Pair {
    int first_foot = 0, second_foot = 0;  ///< numbers in the lattice, the lower first
    std::int32_t first = 0, count = 0;    ///< its COMs, the nearest to the goal first
    int level = 0;
  };

  ComCandidates(const gaits::Scene& scene, const FootholdLattice& lattice, int columns,
                const stability::DisturbanceBox& box);

  /// The number of the pair on two different footholds, with the COMs of a level. They are made when it is asked for
  /// first.
  int pair(int foot, int other, int level);
  /// Takes up a COM of any origin (that of a first stance) as a pair of its own. Returns the number of the COM.
  int add(int foot, int other, const Eigen::Vector2d& com);

  const Pair& operator[](int pair) const { return pairs_[static_cast<std::size_t>(pair)]; }
  Com& com(int number) { return coms_[static_cast<std::size_t>(number)]; }
  const Com& com(int number) const { return coms_[static_cast<std::size_t>(number)]; }
  std::size_t pairs() const { return pairs_.size(); }
  std::size_t coms() const { return coms_.size(); }
  std::uint64_t asked() const { return asked_; }  ///< COMs whose stability was asked

 private:
  void make_coms(const Pair& pair, std::vector<Com>& coms);
  void add_columns(int level, const gaits::Feet& feet, const stability::RobustOracle& oracle,
                   const std::vector<Eigen::Vector2d>& polygon, std::vector<Com>& coms);
  void try_com(const gaits::Feet& feet, const stability::RobustOracle& oracle, const Eigen::Vector2d& at,
               std::vector<Com>& coms);

  const gaits::Scene* scene_;
  const FootholdLattice* lattice_;
  gaits::Robot robot_;
  int columns_;
  stability::DisturbanceBox box_;
  std::unordered_map<std::uint64_t, int> numbers_;
  std::vector<Pair> pairs_;
  std::vector<Com> coms_;
  std::vector<Com> fresh_;
  std::uint64_t asked_ = 0;
};

}  // namespace surefoot::planner
