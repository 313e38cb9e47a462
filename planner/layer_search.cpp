#include "planner/layer_search.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::planner {

using Eigen::Vector2d;

namespace {

/// Weight of the feet against the COM in the order of a layer: of two stances with the same COM the one whose feet are
/// ahead has come farther.
constexpr double feet_share = 0.3;
constexpr int halvings = 3;           ///< between a COM that a step may end at and one that it may not
constexpr unsigned stop_interval = 64;  ///< looks at the limits per question whether to stop, which reads a clock
constexpr int width_factor = 4;  ///< by which the layers before a dead end are widened each time it is met


}  // namespace

int least_steps(const ToGoal& stance, double reach_max) {
  if (!(stance.com > 0)) return 0;
  constexpr double most = 1e8;
  const double turn = 2 * reach_max;
  /// Rounds of three steps until `gain` times the reach brings a distance to nothing.
  const auto rounds = [&](double distance, double first) {
    return std::clamp(std::ceil((distance - first * reach_max) / turn * (1 - 1e-9) - 1e-9), 0.0, most);
  };
  const double com = 3 * rounds(stance.com, 0), rear = 3 * rounds(stance.rear, 1) + 1, front = 3 * rounds(stance.front, 1) + 2;
  return static_cast<int>(std::min({com, rear, front}));
}

int least_steps(double distance, double reach_max) {
  return least_steps({distance, distance - reach_max, distance - reach_max}, reach_max);
}

LayerSearch::LayerSearch(StepProposals& proposals, const std::vector<Node>& starts, const LatticeResolution& resolution,
                         const stability::DisturbanceBox& box)
    : proposals_(&proposals),
      scene_(&proposals.scene()),
      robot_(proposals.robot()),
      box_(box),
      lattice_(scene_->terrain, resolution.spacing * robot_.reach_max, resolution.inset * robot_.reach_max),
      coms_(*scene_, lattice_, resolution.columns, box),
      starts_(starts) {
  layers_.resize(1);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Node& start = starts[i];
    std::array<int, gaits::leg_count> number{-1, -1, -1};
    for (int leg = 0; leg < gaits::leg_count; ++leg)
      if (start.feet[leg]) number[leg] = lattice_.add(*start.feet[leg]);
    const auto [a, b] = start.support();
    const std::int32_t com = coms_.add(number[a], number[b], start.com);
    nodes_.push_back({static_cast<std::int32_t>(coms_.pairs()) - 1, com, -1, 0, number[start.free_leg],
                      static_cast<std::int32_t>(i)});
    coms_.com(com).node = static_cast<std::int32_t>(nodes_.size()) - 1;
    layers_[0].nodes.push_back(coms_.com(com).node);
  }
}

ToGoal LayerSearch::to_goal(const Vector2d& com, std::int32_t number) const {
  const auto& pair = coms_[number];
  return {scene_->goal.distance(com), pair.rear, pair.front};
}

double LayerSearch::key(const Vector2d& com, std::int32_t pair) const {
  const auto& feet = coms_[pair];
  const Vector2d middle = 0.5 * (foot(feet.first_foot).position + foot(feet.second_foot).position);
  return scene_->goal.distance((1 - feet_share) * com + feet_share * middle);
}

void LayerSearch::put_back(std::size_t k, const Entry& entry) {
  ++waiting_;
  std::uint32_t at = static_cast<std::uint32_t>(waiting_entries_.size());
  if (free_entries_.empty()) {
    waiting_entries_.push_back(entry);
  } else {
    at = free_entries_.back();
    free_entries_.pop_back();
    waiting_entries_[at] = entry;
  }
  layers_[k].heap.push({entry.key, entry.number, at});
}

LayerSearch::Entry LayerSearch::take_best(std::size_t k) {
  const std::uint32_t at = layers_[k].heap.pop().payload;
  free_entries_.push_back(at);
  --waiting_;
  return waiting_entries_[at];
}

bool LayerSearch::placement_is_legal(const SearchNode& node, std::int32_t landing) {
  ++checked_;
  const Vector2d& com = coms_.com(node.com).at;
  if (!scene_->terrain.leg_is_free(com, foot(landing))) return false;
  if (node.old_foot < 0 || node.swings_any_way) return true;
  if (gaits::swing_is_free(*scene_, com, foot(node.old_foot).position, foot(landing).position)) return true;
  swing_mattered_ = true;
  return false;
}

void LayerSearch::push(std::size_t k, Entry entry) {
  entry.number = static_cast<std::uint32_t>(entries_++);
  put_back(k, entry);
}

/// Until a pair is looked at, its COM may be anywhere within reach: say in the middle of its feet, or as near to there
/// as the reach of the foot that is lifted allows.
double LayerSearch::key_of_step(std::int32_t landing, std::int32_t lifted, std::int32_t kept) const {
  const double middle = scene_->goal.distance(0.5 * (foot(landing).position + foot(kept).position));
  const double com = std::max(middle, scene_->goal.distance(foot(lifted).position) - robot_.reach_max);
  return (1 - feet_share) * com + feet_share * middle;
}

/// After a step onto a foothold that lifts another and keeps a third, so many steps at least make a plan: the COM is
/// within reach of all three.
bool LayerSearch::is_too_long(std::size_t k, std::int32_t landing, std::int32_t lifted, std::int32_t kept) const {
  if (below_ == no_bound) return false;
  const double a = scene_->goal.distance(foot(landing).position), b = scene_->goal.distance(foot(kept).position);
  const double farthest = std::max({a, b, scene_->goal.distance(foot(lifted).position)});
  const ToGoal after{farthest - robot_.reach_max, std::max(a, b), std::min(a, b)};
  return static_cast<int>(k) + least_steps(after, robot_.reach_max) >= below_;
}

/// Steps that land at one place, for COMs of levels from first_level on.
void LayerSearch::push_landing(std::int32_t number, std::int32_t landing, int first_level, int level) {
  const SearchNode& node = nodes_[number];
  const auto& pair = coms_[node.pair];
  const auto layer = static_cast<std::size_t>(node.layer) + 1;
  if (is_too_long(layer, landing, pair.first_foot, pair.second_foot) &&
      is_too_long(layer, landing, pair.second_foot, pair.first_foot))
    return;
  Entry entry{};
  entry.key = std::min(key_of_step(landing, pair.first_foot, pair.second_foot),
                       key_of_step(landing, pair.second_foot, pair.first_foot));
  entry.node = number, entry.landing = landing, entry.lifted = -1, entry.pair = -1, entry.last = -1;
  entry.first_level = static_cast<std::int16_t>(first_level), entry.level = static_cast<std::int16_t>(level);
  push(layer, entry);
}

/// The landing is legal: its steps, by the leg that is lifted.
void LayerSearch::push_steps(std::size_t k, const Entry& landing) {
  const SearchNode& node = nodes_[landing.node];
  const int feet[] = {coms_[node.pair].first_foot, coms_[node.pair].second_foot};
  for (int level = landing.first_level; level <= landing.level; ++level) {
    Entry entry = landing;
    entry.first_level = entry.level = static_cast<std::int16_t>(level);
    for (const int i : {0, 1}) {
      if (is_too_long(k, landing.landing, feet[i], feet[1 - i])) continue;
      entry.lifted = feet[i];
      entry.key = key_of_step(landing.landing, feet[i], feet[1 - i]);
      push(k, entry);
    }
    if (node.level == 0 || is_too_long(k, feet[0], landing.landing, feet[1])) continue;
    // The leg just placed is lifted again: the COM moves, the support stays. Seldom of use.
    entry.lifted = landing.landing;
    entry.key = key_of_step(feet[0], landing.landing, feet[1]);
    push(k, entry);
  }
}

/// Pushes what levels up to this one add to what has been pushed before.
void LayerSearch::expand(std::int32_t number, int level, int below) {
  const SearchNode node = nodes_[number];
  if (node.level >= level) return;
  if (node.layer + least_steps(to_goal(coms_.com(node.com).at, node.pair), robot_.reach_max) >= below) return;
  nodes_[number].level = level;
  nodes_[number].swings_any_way = gaits::swings_any_way(*scene_, coms_.com(node.com).at);
  if (layers_.size() < static_cast<std::size_t>(node.layer) + 2) layers_.resize(static_cast<std::size_t>(node.layer) + 2);
  const auto pair = coms_[node.pair];
  lattice_.look_from(coms_.com(node.com).at, robot_.reach_min, robot_.reach_max);
  for (int of_landing = 0; of_landing <= level; ++of_landing) {
    lattice_.list(of_landing, landings_);
    for (const int landing : landings_) {
      const Vector2d& at = foot(landing).position;
      if (landing == pair.first_foot || landing == pair.second_foot) continue;
      if (at == foot(pair.first_foot).position || at == foot(pair.second_foot).position) continue;
      push_landing(number, landing, of_landing > node.level ? 0 : node.level + 1, level);
    }
  }
}

/// All three feet, wherever the COM is between the two stances.
bool LayerSearch::feet_reach(const Entry& entry, const Vector2d& to) {
  ++scanned_;
  const SearchNode& node = nodes_[entry.node];
  const auto& pair = coms_[node.pair];
  const Vector2d& from = coms_.com(node.com).at;
  // The foot that is lifted first: it is the farthest back.
  for (const std::int32_t number : {entry.lifted, pair.first_foot, pair.second_foot, entry.landing})
    if (!gaits::within_reach(robot_, foot(number).position, from, to)) return false;
  return true;
}

/// Apart from the reach of the feet.
bool LayerSearch::step_is_legal(const Entry& entry, std::int32_t number) {
  ++checked_;
  const SearchNode& node = nodes_[entry.node];
  const Vector2d &from = coms_.com(node.com).at, &to = coms_.com(number).at;
  if (!scene_->terrain.leg_is_free(to, foot(entry.lifted))) return false;
  if (scene_->terrain.distance(from, to, robot_.clearance) < robot_.clearance) return false;
  gaits::Feet three;
  three[0] = foot(coms_[node.pair].first_foot);
  three[1] = foot(coms_[node.pair].second_foot);
  three[2] = foot(entry.landing);
  return gaits::is_stable(*scene_, gaits::oracle_of(*scene_, three, box_), from, to);
}

/// Takes the best entry of a layer: gives it up, finds it to be less good than it seemed and puts it back, or checks its
/// landing or a step; if that is legal, it leads to a new stance of the layer.
void LayerSearch::pop(std::size_t k, const Limits& limits) {
  Entry entry = take_best(k);
  const SearchNode node = nodes_[entry.node];
  if (node.layer + 1 != static_cast<int>(k)) return;  // since then it was reached sooner: its steps are there
  if (entry.lifted < 0) {
    if (placement_is_legal(node, entry.landing)) push_steps(k, entry);
    return;
  }
  if (entry.pair < 0) {
    const auto& from = coms_[node.pair];
    const int kept = from.first_foot == entry.lifted ? from.second_foot : from.first_foot;
    const int other = entry.lifted == entry.landing ? from.first_foot : entry.landing;
    entry.pair = coms_.pair(kept == other ? from.second_foot : kept, other, entry.level);
  }
  try_coms(k, entry, limits);
}

/// A COM between a legal one and the last before it, nearer to the goal, that is not: as near as halving finds.
std::int32_t LayerSearch::sharpened(const Entry& entry, std::int32_t number) {
  std::int32_t ahead = -1;
  double to_goal = -1;
  for (std::int32_t i = coms_.next(entry.pair, -1); i >= 0 && i != number; i = coms_.next(entry.pair, i))
    if (coms_.com(i).to_goal > to_goal && coms_.com(i).to_goal < coms_.com(number).to_goal) ahead = i, to_goal = coms_.com(i).to_goal;
  if (ahead < 0) return number;
  const Vector2d begin = coms_.com(number).at, way = coms_.com(ahead).at - begin;
  double low = 0, high = 1;
  std::int32_t best = number;
  for (int i = 0; i < halvings; ++i) {
    const double t = 0.5 * (low + high);
    const std::int32_t tried = coms_.try_one(entry.pair, begin + t * way);
    if (tried >= 0 && feet_reach(entry, coms_.com(tried).at) && step_is_legal(entry, tried)) low = t, best = tried; else high = t;
  }
  return best;
}

/// Tries the COMs of a step in their order, until one leads to a stance or is less good than another entry may be.
void LayerSearch::try_coms(std::size_t k, Entry entry, const Limits& limits) {
  const int layer = static_cast<int>(k);
  const ToGoal feet{0, coms_[entry.pair].rear, coms_[entry.pair].front};
  for (std::int32_t number; (number = coms_.next(entry.pair, entry.last)) >= 0; entry.last = number) {
    const auto com = coms_.com(number);
    if (com.verdict == ComCandidates::Verdict::breaks) continue;
    if (com.node >= 0 && nodes_[com.node].layer <= layer) continue;
    if (limits.below != no_bound &&
        layer + least_steps({com.to_goal, feet.rear, feet.front}, robot_.reach_max) >= limits.below)
      return;  // so are those behind it
    if (!feet_reach(entry, com.at)) continue;
    if (const double true_key = key(com.at, entry.pair); true_key > entry.key) {
      entry.key = true_key;
      return put_back(k, entry);
    }
    if (!coms_.holds(entry.pair, number) || !step_is_legal(entry, number)) continue;
    const bool sharpen = limits.sharpen && !entry.sharpened;
    if (!sharpen) entry.last = number;
    entry.sharpened = true;
    put_back(k, entry);
    return reach(k, entry, sharpen ? sharpened(entry, number) : number);
  }
}

void LayerSearch::reach(std::size_t k, const Entry& entry, std::int32_t number) {
  auto& com = coms_.com(number);
  if (com.node < 0) {
    com.node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({});
  }
  nodes_[com.node] = {entry.pair, number, entry.node, static_cast<std::int32_t>(k), entry.lifted, -1};
  layers_[k].nodes.push_back(com.node);
  if (const double at = key(com.at, entry.pair); at < front_.key) front_ = {at, k, work()};
  if (scene_->goal.contains(com.at)) goal_ = com.node;
}

bool LayerSearch::run_layer(std::size_t k, const Limits& limits) {
  const auto expand_waiting = [&] {
    for (Layer* layer = &layers_[k]; layer->raised < layer->nodes.size(); layer = &layers_[k]) {
      if (is_out(limits)) return;
      if (layer->raised >= static_cast<std::size_t>(layer->width)) return;
      const std::int32_t node = layer->nodes[layer->raised++];
      if (nodes_[node].layer == static_cast<std::int32_t>(k)) expand(node, layer->level, limits.below);
    }
  };
  expand_waiting();
  while (layers_[k].nodes.size() < static_cast<std::size_t>(layers_[k].width) && !layers_[k].heap.empty()) {
    if (is_out(limits)) return false;
    pop(k, limits);
    if (goal_ >= 0) return true;
    expand_waiting();
  }
  return false;
}

bool LayerSearch::any_open(std::size_t end) const {
  return std::any_of(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(end), [](const Layer& layer) {
    return !layer.heap.empty() || layer.raised < layer.nodes.size();
  });
}

/// A dead end is met where no step is left, or where layer after layer comes no nearer to the goal. Then the layers
/// before the most advanced stance get wider and finer, reaching farther back each time.
class LayerSearch::DeadEnd {
 public:
  bool is_met(std::size_t k, const Front& front) const { return k > front.layer + patience * reach(front); }
  void count(const Front& front) {
    times_ = front.key < key_ ? 1 : times_ + 1;
    key_ = front.key;
  }
  std::size_t back() const { return std::size_t{4} << std::min(times_, 40); }
  int level() const { return times_ / 2; }

 private:
  static constexpr std::size_t patience = 8;
  std::size_t reach(const Front& front) const { return front.key < key_ ? 1 : std::size_t{1} << std::min(times_, 40); }
  double key_ = std::numeric_limits<double>::infinity();
  int times_ = 0;
};

bool LayerSearch::is_out(const Limits& limits) {
  const std::uint64_t done = work();
  if (++asked_to_stop_ % stop_interval == 0 && limits.stop()) stopped_ = true;
  return stopped_ || is_full() || done >= limits.work ||
         (done - front_.work >= limits.stall && limits.below == no_bound);
}

LayerSearch::End LayerSearch::run(const Limits& limits) {
  goal_ = -1;
  below_ = limits.below;
  stopped_ = limits.stop();
  const auto prepare = [&limits](Layer& layer) {
    if (layer.level < limits.level) layer.level = limits.level, layer.raised = 0;
    layer.width = std::max(layer.width, limits.width);
  };
  const bool first = limits.below == no_bound;
  const auto end = [&] { return std::min<std::size_t>(layers_.size(), static_cast<std::size_t>(limits.below)); };
  std::size_t prepared = 0;
  DeadEnd dead_end;
  for (std::size_t k = 0;;) {
    for (; k < end() && !(first && dead_end.is_met(k, front_)); ++k) {
      for (; prepared <= k; ++prepared) prepare(layers_[prepared]);
      if (run_layer(k, limits)) return End::found;
      if (is_out(limits)) return End::limit;
    }
    if (!first) return any_open(end()) ? End::width : End::exhausted;
    dead_end.count(front_);
    const std::size_t last = std::min(k, end() - 1);
    k = front_.layer > dead_end.back() ? front_.layer - dead_end.back() : 0;
    const int level = std::min(limits.level + dead_end.level(), FootholdLattice::levels - 1);
    for (std::size_t i = k; i <= last; ++i) {
      Layer& layer = layers_[i];
      layer.width = std::min(width_factor * layer.width, 1 << 28);
      if (layer.level < level) layer.level = level, layer.raised = 0;
    }
    if (k == 0 && level + 1 == FootholdLattice::levels && !any_open(end())) return End::exhausted;
  }
}

Vector2d LayerSearch::best() const {
  const auto nearer = [this](const SearchNode& a, const SearchNode& b) {
    return coms_.com(a.com).to_goal < coms_.com(b.com).to_goal;
  };
  return coms_.com(std::min_element(nodes_.begin(), nodes_.end(), nearer)->com).at;
}

std::vector<Node> LayerSearch::path() const {
  std::vector<std::int32_t> chain;
  for (std::int32_t i = goal_; i >= 0; i = nodes_[i].parent) chain.push_back(i);
  if (chain.empty()) return {};
  std::vector<Node> path{starts_[nodes_[chain.back()].start]};
  // Legs by the foothold they stand on.
  std::array<int, gaits::leg_count> number{-1, -1, -1};
  const auto [a, b] = path[0].support();
  const auto& pair = coms_[nodes_[chain.back()].pair];
  const bool in_order = lattice_[pair.first_foot].position == path[0].feet[a]->position;
  number[a] = in_order ? pair.first_foot : pair.second_foot;
  number[b] = in_order ? pair.second_foot : pair.first_foot;
  for (std::size_t i = chain.size() - 1; i-- > 0;) {
    const SearchNode& node = nodes_[chain[i]];
    const auto& to = coms_[node.pair];
    Node next = path.back();
    const int placed = next.free_leg;
    const auto stands = [&](int foothold) {
      return number[(placed + 1) % gaits::leg_count] == foothold || number[(placed + 2) % gaits::leg_count] == foothold;
    };
    const int landing = !stands(to.first_foot) ? to.first_foot : !stands(to.second_foot) ? to.second_foot : node.old_foot;
    number[placed] = landing;
    next.feet[placed] = lattice_[landing];
    for (int leg = 0; leg < gaits::leg_count; ++leg)
      if (number[leg] == node.old_foot) next.free_leg = leg;
    next.com = coms_.com(node.com).at;
    next.id = proposals_->next_id();
    path.push_back(next);
  }
  return path;
}

}  // namespace surefoot::planner
