// The planner "Layers": a first plan soon, then better ones until its work is done. It searches a lattice of footholds
// and COMs (layer_search.hpp), first narrow and coarse, then wider and finer by turns, for whatever improves the
// objective:
//   steps     fewer steps than the best plan so far;
//   safety    stable under disturbances larger than the scene's, by a factor that is raised and halved towards the
//             largest that a plan is found for; then fewer steps at that factor;
//   distance  plans whose COMs make few detours, by several weights against progress, their COMs' way then drawn tight;
//             the shortest is kept.
// The lattice gets ever finer until the work is done or memory is full (it ends at 2^-15 of its first spacing, which no
// memory lets be exhausted). With unlimited work and memory the steps come down to the fewest of any plan that bears
// its footholds and COMs being moved a little, except that three things are never tried: COMs within a fiftieth of the
// height of R_SS(W) at its lower and upper end, open first COMs but a few, and swings that only another origin of the
// free leg than the first one found would allow. That is why nothing is called optimal but by a bound (Resolution).
// Deterministic for a seed: limits are counted in work, not in time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "planner/layer_search.hpp"
#include "planner/node.hpp"
#include "planner/step_proposals.hpp"

namespace surefoot::planner {

struct AnytimeOptions {
  std::uint32_t seed = 1;           ///< 1 is the standard lattice, others are up to a fifth finer or coarser
  std::string objective = "steps";  ///< steps, safety or distance
  /// Beside another search: finer sooner, and COMs are left on their columns. Where one misses a plan, the other may
  /// not.
  bool companion = false;
  /// Asked now and then; true ends the search with what it has.
  std::function<bool()> stop = [] { return false; };
};

class AnytimeSearch {
 public:
  /// The starts are legal stances outside the goal.
  AnytimeSearch(StepProposals& proposals, std::vector<Node> starts, AnytimeOptions options);
  ~AnytimeSearch();

  /// Looks for a first plan until `stall` units of work have brought it no nearer to the goal. May be called again
  /// with more. True once there is a plan.
  bool find(std::uint64_t stall);
  /// Betters the plan by about `work` units of work. True as long as more work might better it.
  bool improve(std::uint64_t work);

  /// A plan of another search: kept if it is better.
  void offer(std::vector<Node> path);

  const std::vector<Node>& path() const { return path_; }
  int improvements() const { return improvements_; }  ///< how many plans were better than all before
  /// How near to the goal the search came, and what stood in its way, while there is no plan.
  Eigen::Vector2d nearest_com() const;
  const Refusals& refusals() const { return layers_->refusals(); }
  /// The plan's cost: steps, with the least safety factor or the COM's way if that is the objective. In words.
  std::string cost() const;
  std::uint64_t work() const { return spent_ + (layers_ ? layers_->work() : 0); }
  gaits::Resolution resolution() const;

 private:
  LayerSearch::Limits limits(std::uint64_t until) const;
  bool begin(double scale);
  bool take(std::vector<Node> path);
  std::vector<Node> cleaned_up(std::vector<Node> path);
  stability::DisturbanceBox box() const;
  bool improve_steps(std::uint64_t until);
  bool improve_safety(std::uint64_t until);
  bool improve_distance(std::uint64_t until);
  int fewest_steps() const;
  int level() const;
  double least_factor(const std::vector<Node>& path) const;

  StepProposals* proposals_;
  std::vector<Node> starts_;
  std::vector<double> start_factors_;  ///< safety factors of the starts; only for objective safety
  AnytimeOptions options_;
  LatticeResolution lattice_;
  std::unique_ptr<LayerSearch> layers_;
  std::vector<Node> path_;
  std::uint64_t spent_ = 0;      ///< work of lattices given up
  std::size_t stage_ = 0;        ///< of the schedule
  int finest_ = 0;               ///< level begun
  int exhausted_level_ = -1;     ///< level on which no plan of fewer steps exists
  double scale_ = 1;             ///< of the disturbances on the lattice in use
  std::optional<double> trial_;  ///< scale that a plan is being looked for
  double factor_ = 0;            ///< least safety factor of the plan
  double refused_ = 0;           ///< scale for which there is no plan, or none was found
  double most_allowed_ = 0;      ///< scale that no first stance bears
  std::size_t round_ = 0;        ///< of searches for a scale, each wider
  bool scale_settled_ = false;
  double detour_weight_ = 0;  ///< of the lattice in use; only for objective distance
  std::size_t passes_ = 0;    ///< of distance_passes, that are done
  bool in_pass_ = false;
  int improvements_ = 0;
};

}  // namespace surefoot::planner
