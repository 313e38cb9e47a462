#include "planner/layer_search.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::planner {

using Eigen::Vector2d;

namespace {

constexpr unsigned stop_interval = 64;   ///< looks at the limits per question whether to stop, which reads a clock
constexpr int finest_for_dead_ends = 4;  ///< level beyond which a way out of a dead end is not looked for
constexpr int width_factor = 4;          ///< by which the layers before a dead end are widened each time it is met

}  // namespace

LayerSearch::LayerSearch(StepProposals& proposals, const std::vector<Node>& starts, const LatticeResolution& resolution,
                         const stability::DisturbanceBox& box, double detour_weight)
    : proposals_(&proposals), scene_(&proposals.scene()), robot_(proposals.robot()), box_(box),
      detour_weight_(detour_weight),
      lattice_(scene_->terrain, resolution.spacing * robot_.reach_max, resolution.inset * robot_.reach_max),
      coms_(*scene_, lattice_, resolution.columns, box), starts_(starts), refusals_(robot_.reach_max) {
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
    if (coms_.com(com).to_goal < nearest_.to_goal) nearest_ = coms_.com(com);
    layers_[0].nodes.push_back(coms_.com(com).node);
  }
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

void LayerSearch::push(std::size_t k, Entry entry) {
  entry.number = static_cast<std::uint32_t>(entries_++);
  put_back(k, entry);
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
  entry.key = detour_weight_ * node.detour + std::min(key_of_step(landing, pair.first_foot, pair.second_foot),
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
      entry.key = detour_weight_ * node.detour + key_of_step(landing.landing, feet[i], feet[1 - i]);
      push(k, entry);
    }
    if (node.level == 0 || is_too_long(k, feet[0], landing.landing, feet[1])) continue;
    // The leg just placed is lifted again: the COM moves, the support stays. Seldom of use.
    entry.lifted = landing.landing;
    entry.key = detour_weight_ * node.detour + key_of_step(feet[0], landing.landing, feet[1]);
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
  if (layers_.size() < static_cast<std::size_t>(node.layer) + 2)
    layers_.resize(static_cast<std::size_t>(node.layer) + 2);
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

/// Takes the best entry of a layer: gives it up, finds it to be less good than it seemed and puts it back, or checks
/// its landing or a step; if that is legal, it leads to a new stance of the layer.
void LayerSearch::pop(std::size_t k, const Limits& limits) {
  Entry entry = take_best(k);
  const SearchNode node = nodes_[entry.node];
  if (node.layer + 1 != static_cast<int>(k)) return;  // since then it was reached sooner: its steps are there
  if (entry.lifted < 0) {
    if (const auto rule = broken_placement_rule(node, entry.landing)) refuse(*rule, node);
    else push_steps(k, entry);
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

void LayerSearch::reach(std::size_t k, const Entry& entry, std::int32_t number) {
  auto& com = coms_.com(number);
  // Steps that were found from the stance when the free leg came from elsewhere keep the node that they were found
  // from, unless it swings any way.
  const bool keep = com.node >= 0 && nodes_[com.node].level >= 0 && !nodes_[com.node].swings_any_way;
  if (com.node < 0 || keep) {
    com.node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({});
  }
  SearchNode& node = nodes_[com.node];
  node = {entry.pair, number, entry.node, static_cast<std::int32_t>(k), entry.lifted, -1};
  node.detour = detour(entry.node, com);
  layers_[k].nodes.push_back(com.node);
  if (com.to_goal < nearest_.to_goal) nearest_ = com;
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
  return std::any_of(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const Layer& layer) { return !layer.heap.empty() || layer.raised < layer.nodes.size(); });
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
    const int level = std::max(std::min(limits.level + dead_end.level(), finest_for_dead_ends), limits.level);
    for (std::size_t i = k; i <= last; ++i) {
      Layer& layer = layers_[i];
      layer.width = std::min(width_factor * layer.width, 1 << 28);
      if (layer.level < level) layer.level = level, layer.raised = 0;
    }
    if (k == 0 && level >= finest_for_dead_ends && !any_open(end())) return End::exhausted;
  }
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
    const int landing = !stands(to.first_foot)    ? to.first_foot
                        : !stands(to.second_foot) ? to.second_foot
                                                  : node.old_foot;
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
