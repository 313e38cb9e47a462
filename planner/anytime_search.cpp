#include "planner/anytime_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gaits/rules.hpp"
#include "planner/shorten.hpp"

namespace surefoot::planner {

namespace {

/// Wider and finer by turns, then level after level to its end.
struct Stage {
  int width, level;
};
/// Measured on the canned scenes: the first gives a plan in milliseconds; most of what a second of work finds comes
/// from the wide passes over coarse levels.
constexpr Stage usual_stages[] = {{4, 0},    {8, 0},   {32, 0},   {128, 1},  {512, 1},  {256, 2},
                                  {1024, 2}, {512, 3}, {4096, 2}, {2048, 3}, {8192, 3}, {4096, 4}};
/// Of the companion: finer sooner, which some plans over small footholds need.
constexpr Stage companion_stages[] = {{4, 0},   {16, 0},  {64, 0},  {32, 1},   {128, 1},  {64, 2},
                                      {256, 2}, {128, 3}, {512, 3}, {1024, 2}, {8192, 3}, {4096, 4}};
constexpr std::size_t limited_stages = std::size(usual_stages);
static_assert(std::size(companion_stages) == limited_stages);
constexpr int unlimited_width = 1 << 28, first_unlimited = 4;
constexpr std::size_t stage_count = limited_stages + FootholdLattice::levels - first_unlimited;

constexpr Stage stage_at(std::size_t number, bool companion) {
  if (number < limited_stages) return companion ? companion_stages[number] : usual_stages[number];
  return {unlimited_width, first_unlimited + static_cast<int>(number - limited_stages)};
}

constexpr double first_raise = 1.5;       ///< of the disturbances beyond what the plan bears, while that succeeds
constexpr double scale_precision = 0.02;  ///< relative: a plan safer by less is not looked for
constexpr double greatest_scale = 1e6;    ///< beyond, a plan bears anything
constexpr std::size_t safety_stages[] = {0, 2, 3, 4};  ///< of the searches for a scale, round after round
constexpr std::uint64_t safety_work = 200000;          ///< after which no further round begins
constexpr std::uint64_t safety_stall = 60000;          ///< work without progress after which a scale counts as refused

/// Weights of detours and widths of the search, by turns.
constexpr std::pair<double, int> distance_passes[] = {{1, 8},   {4, 8},   {16, 8},  {1, 32},  {4, 32},
                                                      {16, 32}, {1, 128}, {4, 128}, {16, 128}};
constexpr std::uint64_t distance_stall = 200000;  ///< work without progress after which such a search is given up

/// Seeds other than 1: spacings between 0.8 and 1.2 of the standard.
double spacing_factor(std::uint32_t seed) {
  constexpr double golden = 0.6180339887498949;
  const double x = golden * (seed - 1.0);
  return 1 + 0.4 * (x - std::floor(x + 0.5));
}

double way_of_com(const std::vector<Node>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i].com - path[i - 1].com).norm();
  return sum;
}

}  // namespace

AnytimeSearch::AnytimeSearch(StepProposals& proposals, std::vector<Node> starts, AnytimeOptions options)
    : proposals_(&proposals), starts_(std::move(starts)), options_(std::move(options)) {
  lattice_ = {0.15 * spacing_factor(options_.seed), 0.02, 5};
  for (Node& start : starts_) start.id = proposals_->next_id();
  if (options_.objective == "safety") {
    const gaits::Scene& scene = proposals_->scene();
    for (const Node& start : starts_) {
      const auto oracle = gaits::oracle_of(scene, start.stance().feet);
      start_factors_.push_back(gaits::safety_factor(scene, oracle, start.com).value);
      most_allowed_ = std::max(most_allowed_, start_factors_.back());  // no plan is safer than its first stance
    }
  }
  refused_ = most_allowed_;
  begin(1);
}

AnytimeSearch::~AnytimeSearch() = default;

/// A new lattice for disturbances of another size. False if no start bears them.
bool AnytimeSearch::begin(double scale) {
  if (layers_) spent_ += layers_->work();
  std::vector<Node> starts;
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (scale <= 1 || start_factors_[i] > scale) starts.push_back(starts_[i]);
  scale_ = scale;
  stage_ = 0;
  layers_ = std::make_unique<LayerSearch>(*proposals_, starts, lattice_, box(), detour_weight_);
  return !starts.empty();
}

stability::DisturbanceBox AnytimeSearch::box() const {
  if (scale_ <= 1) return proposals_->box();
  const stability::DisturbanceBox& given = proposals_->scene().disturbance;
  return {scale_ * given.kappa, scale_ * given.nu};
}

int AnytimeSearch::level() const { return stage_at(stage_, options_.companion).level; }

LayerSearch::Limits AnytimeSearch::limits(std::uint64_t until) const {
  LayerSearch::Limits limits;
  limits.width = stage_at(stage_, options_.companion).width;
  limits.level = stage_at(stage_, options_.companion).level;
  limits.sharpen = !options_.companion;
  limits.work = until > spent_ ? until - spent_ : 0;
  limits.stop = options_.stop;
  return limits;
}

bool AnytimeSearch::find(std::uint64_t stall) {
  if (!path_.empty()) return true;
  LayerSearch::Limits first = limits(std::numeric_limits<std::uint64_t>::max());
  first.stall = stall;
  return layers_->run(first) == LayerSearch::End::found && take(layers_->path());
}

double AnytimeSearch::least_factor(const std::vector<Node>& path) const {
  gaits::Plan plan;
  write_path(path, plan);
  gaits::rate(proposals_->scene(), plan);
  return plan.safety_factor;
}

/// Under the disturbances that it was found for.
std::vector<Node> AnytimeSearch::cleaned_up(std::vector<Node> path) {
  if (scale_ <= 1) return shorten(*proposals_, std::move(path), options_.objective);
  StepProposals scaled(proposals_->scene(), box());
  for (Node& node : path) node.id = scaled.next_id();
  path = shorten(scaled, std::move(path), options_.objective);
  for (Node& node : path) node.id = proposals_->next_id();
  return path;
}

/// Keeps a path if it betters the objective.
bool AnytimeSearch::take(std::vector<Node> path) {
  path = cleaned_up(std::move(path));
  if (path_.empty()) {
    path_ = std::move(path);
    ++improvements_;
    if (options_.objective == "safety") factor_ = least_factor(path_);
    return true;
  }
  bool better = path.size() < path_.size();
  if (options_.objective == "distance") better = way_of_com(path) < way_of_com(path_);
  if (options_.objective == "safety") {
    const double factor = least_factor(path);
    better = factor > factor_ || (better && factor >= scale_);
    if (better) factor_ = factor;
  }
  if (better) path_ = std::move(path), ++improvements_;
  return better;
}

void AnytimeSearch::offer(std::vector<Node> path) {
  if (path.empty()) return;
  for (Node& node : path) node.id = proposals_->next_id();
  take(std::move(path));
}

bool AnytimeSearch::improve(std::uint64_t work_more) {
  const std::uint64_t until = work() + work_more;
  if (path_.empty()) return false;
  if (options_.objective == "safety" && !scale_settled_ && improve_safety(until)) return true;
  if (options_.objective == "distance" && improve_distance(until)) return true;
  return improve_steps(until);
}

/// Fewer steps on the lattice in use. False if the schedule is at its end.
bool AnytimeSearch::improve_steps(std::uint64_t until) {
  while (work() < until && !options_.stop()) {
    if (options_.objective == "steps" && static_cast<int>(path_.size()) - 1 <= fewest_steps()) return false;
    LayerSearch::Limits now = limits(until);
    now.below = static_cast<int>(path_.size()) - 1;
    finest_ = std::max(finest_, now.level);
    switch (layers_->run(now)) {
      case LayerSearch::End::found: take(layers_->path()); break;
      case LayerSearch::End::exhausted:
        exhausted_level_ = now.level;
        // Other first COMs than those tried would then do more than ever finer lattices.
        if (exhausted_level_ >= first_unlimited && !proposals_->scene().start.com) return false;
        while (stage_ + 1 < stage_count && level() <= exhausted_level_) ++stage_;
        if (level() <= exhausted_level_) return false;
        break;
      case LayerSearch::End::width:
        if (stage_ + 1 == stage_count) return false;
        ++stage_;
        break;
      case LayerSearch::End::limit: return !layers_->is_full();
    }
  }
  return true;
}

/// Raises the size of the disturbances until no plan is found, then halves the interval. True while that goes on.
bool AnytimeSearch::improve_safety(std::uint64_t until) {
  const auto& given = proposals_->scene().disturbance;
  const bool nothing_to_scale = given.kappa == 0 && given.nu == 0;
  while (!nothing_to_scale && factor_ < greatest_scale && work() < until && !options_.stop()) {
    if (!trial_) {
      const double base = std::max(factor_, 1.0);
      if (refused_ < base * (1 + scale_precision)) {
        // Refused to a narrow search: is it to a wider one, as far as the first stances allow?
        if (most_allowed_ < base * (1 + scale_precision) || round_ + 1 == std::size(safety_stages) ||
            work() > safety_work)
          break;
        refused_ = most_allowed_;
        ++round_;
      }
      trial_ = std::min(std::sqrt(base * refused_), first_raise * base);
      if (!begin(*trial_)) {
        refused_ = *trial_;
        trial_.reset();
        continue;
      }
      stage_ = safety_stages[round_];
    }
    LayerSearch::Limits now = limits(until);
    now.stall = safety_stall << round_;
    const bool found = layers_->run(now) == LayerSearch::End::found && take(layers_->path());
    if (!found && (work() >= until || options_.stop())) return true;  // goes on from here
    if (!found) refused_ = *trial_;
    trial_.reset();
  }
  if (work() >= until || options_.stop()) return true;
  scale_settled_ = true;
  begin(std::clamp(factor_ * (1 - 1e-9), 1.0, greatest_scale));
  return false;
}

/// A lattice after the other whose search shuns detours more or less, each to its first plan. True while that goes on.
bool AnytimeSearch::improve_distance(std::uint64_t until) {
  for (; passes_ < std::size(distance_passes) && work() < until && !options_.stop(); ++passes_) {
    const auto& [weight, width] = distance_passes[passes_];
    if (!in_pass_) detour_weight_ = weight, begin(1);
    in_pass_ = true;
    LayerSearch::Limits now = limits(until);
    now.width = width;
    now.stall = distance_stall;
    const bool found = layers_->run(now) == LayerSearch::End::found;
    if (found) take(layers_->path());
    if (!found && (work() >= until || options_.stop())) return true;  // goes on from here
    in_pass_ = false;
  }
  return passes_ < std::size(distance_passes);
}

std::string AnytimeSearch::cost() const {
  std::string text = fmt::format("{} steps", path_.size() - 1);
  if (options_.objective == "safety") text += fmt::format(", least safety factor {:.3g}", factor_);
  if (options_.objective == "distance") text += fmt::format(", {:.4g} m", way_of_com(path_));
  return text;
}

Eigen::Vector2d AnytimeSearch::nearest_com() const { return layers_->best(); }

/// No plan whatever has fewer.
int AnytimeSearch::fewest_steps() const {
  const auto& scene = proposals_->scene();
  int fewest = std::numeric_limits<int>::max();
  for (int lifted = 0; lifted < gaits::leg_count; ++lifted) {
    const int a = lifted == 0 ? 1 : 0, b = lifted == 2 ? 1 : 2;
    const auto &one = scene.start.feet[a], &other = scene.start.feet[b];
    if (!one || !other || (scene.start.support && *scene.start.support != std::pair(a, b))) continue;
    const double first = scene.goal.distance(one->position), second = scene.goal.distance(other->position);
    ToGoal stance{0, std::max(first, second), std::min(first, second)};
    stance.com = scene.start.com ? scene.goal.distance(*scene.start.com) : stance.rear - scene.robot.reach_max;
    fewest = std::min(fewest, least_steps(stance, scene.robot.reach_max));
  }
  return fewest < std::numeric_limits<int>::max() ? fewest : 0;
}

gaits::Resolution AnytimeSearch::resolution() const {
  gaits::Resolution resolution;
  // An open first COM is not on the lattice: others than those tried may allow fewer steps.
  const bool exhausted = options_.objective == "steps" && exhausted_level_ >= 0 && !layers_->swing_mattered() &&
                         proposals_->scene().start.com;
  const int level = exhausted ? exhausted_level_ : finest_;
  resolution.foothold_spacing = std::ldexp(lattice_.spacing * proposals_->scene().robot.reach_max, -level);
  resolution.com_columns = lattice_.columns << level;
  resolution.fewest_on_lattice = exhausted;
  resolution.least_steps = fewest_steps();
  return resolution;
}

}  // namespace surefoot::planner
