// Legal steps: a point of the unit cube and a stance are decoded, deterministically, into a step that breaks no rule of
// gaits/rules.hpp, or into the first rule that stands against it. Footholds are drawn only from what the COM reaches,
// COMs only from R_SS(W) of the next stance within reach of all feet; the rest is rejected, cheapest test first.
// The rules are complete for what is accepted; the cube does not reach every legal step with the same density.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gaits/rules.hpp"
#include "gaits/scene.hpp"
#include "planner/com_window.hpp"
#include "planner/node.hpp"
#include "planner/refusals.hpp"

namespace surefoot::planner {

/// A step as the planners see it, in [0, 1]^5: where the foot lands, which leg is lifted, where the COM goes (two), and
/// whether the COM is drawn from the goal where the goal can be reached.
using StepCode = std::array<double, 5>;

/// Where a search wants its next COM to be; a coordinate that is free does not count.
struct Target {
  Eigen::Vector2d com = Eigen::Vector2d::Zero();
  bool free_x = false, free_y = false;
  double choice_penalty = 0;  ///< [m] by which a node stands back each time it has been chosen to go on from
  double distance(const Eigen::Vector2d& point) const {
    const double dx = free_x ? 0 : point.x() - com.x(), dy = free_y ? 0 : point.y() - com.y();
    return std::sqrt(dx * dx + dy * dy);
  }
};

/// Where a stance is on its way, between its COM and the middle of its feet: of two stances with the same COM the one
/// whose feet are ahead has come farther.
Eigen::Vector2d progress_point(const Node& node);

/// What stood against the proposals so far.
struct ProposalCounts {
  RuleCounts blocked{};  ///< stance_stability includes an empty R_SS(W)
  std::uint64_t proposed = 0, legal = 0;
  std::uint64_t swings_asked = 0, swings_skipped = 0;
};

/// Keeps what one stance offers until another is asked about: one object per search, not for several threads.
class StepProposals {
 public:
  /// Steps that are stable under the scene's disturbances, a little widened.
  explicit StepProposals(const gaits::Scene& scene) : StepProposals(scene, gaits::widened(scene.disturbance)) {}
  /// Steps that are stable under other disturbances than the scene's.
  StepProposals(const gaits::Scene& scene, const stability::DisturbanceBox& box);

  /// The step that `code` stands for at `from`; false if a rule is broken. `to` may be `from`. With a target, a step
  /// whose COM is not nearer to it than `nearer_than` is given up before the dear tests (and counts as no rule broken).
  bool propose(const Node& from, const StepCode& code, Node& to, const Target* target = nullptr,
               double nearer_than = std::numeric_limits<double>::infinity());

  /// Whether the step between two nodes breaks no rule: `to` stands as the step leaves it, at a COM of any origin.
  bool is_legal(const Node& from, const Node& to);

  const gaits::Scene& scene() const { return *scene_; }
  /// The robot a little drawn in, which every COM is chosen for (gaits::drawn_in).
  const gaits::Robot& robot() const { return robot_; }
  const stability::DisturbanceBox& box() const { return box_; }
  const ProposalCounts& counts() const { return counts_; }
  /// A number no other node has.
  std::uint64_t next_id() { return ++last_id_; }

 private:
  void prepare(const Node& from);
  std::optional<terrain::Foothold> landing(double u) const;
  bool placement_is_legal(const Node& from, const terrain::Foothold& foothold);
  bool com_is_legal(const Node& from, const Node& to, const gaits::Feet& three);
  bool refuse(gaits::Rule rule) {
    ++counts_.blocked[static_cast<std::size_t>(rule)];
    return false;
  }

  const gaits::Scene* scene_;
  gaits::Robot robot_;
  stability::DisturbanceBox box_;
  ProposalCounts counts_;
  std::uint64_t last_id_ = 0;

  // What the stance asked about last offers.
  std::uint64_t source_ = 0;
  std::vector<terrain::Stretch> stretches_;
  double stretch_total_ = 0;  ///< [m]
  bool swings_freely_ = false;
};

/// What blocked proposals, most frequent first: "reach 41 %, stance stability 30 %, ...".
std::string summary(const ProposalCounts& counts);

}  // namespace surefoot::planner
