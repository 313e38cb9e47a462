// Search and refinement in the graph of the proof of impossibility.
#include <algorithm>
#include <queue>
#include <tuple>

#include "planner/infeasibility_graph.hpp"

namespace surefoot::planner::proof {

namespace {

std::vector<std::pair<int, int>> with_cost(const std::vector<int>& nodes, int cost) {
  std::vector<std::pair<int, int>> list;
  list.reserve(nodes.size());
  for (const int node : nodes) list.emplace_back(node, cost);
  return list;
}

}  // namespace

template <class Visit>
void Graph::edges(int node, Visit&& visit) {
  Pair& pair = pairs_[node / most_parts];
  renew_thirds(pair);
  const unsigned part = part_of(node);
  const auto step = [&](int first, int second, int lifted, const Pair::Third& third) {
    const Ways after = ways_of(first, second, lifted);
    if (after.possible == 0) return;
    const int id = pair_of(first, second);
    for (int next = 0; next < most_parts; ++next) {
      const unsigned next_part = 1u << next;
      if (!(after.possible & next_part) || !pair.region.meets(node % most_parts, pairs_[id].region, next)) continue;
      visit(node_of(id, next), !(third.ways.certain & part) || !(after.certain & next_part), third.piece);
    }
  };
  constexpr std::uint64_t edges_per_bound = 8;  // looking up so many edges takes about the time of a bound
  work_ += pair.thirds.size() / edges_per_bound;
  for (std::size_t k = 0; k < pair.thirds.size() && !exhausted_; ++k) {
    const Pair::Third third = pair.thirds[k];
    if (!(third.ways.possible & part)) continue;
    step(pair.first, third.piece, pair.second, third);
    step(pair.second, third.piece, pair.first, third);
    if (pair.starts) step(pair.first, pair.second, third.piece, third);
  }
}

bool Graph::Entry::operator<(const Entry& other) const {
  return std::tie(cost, to_goal, node) > std::tie(other.cost, other.to_goal, other.node);
}

/// Nodes by least number of doubtful edges from `from`; of equals, nodes nearer to the goal first. admit(node, cost) is
/// asked when a node is settled: -1 stops all, 0 does not lead on, 1 leads on.
template <class Admit>
void Graph::spread(Marks& marks, const std::vector<std::pair<int, int>>& from, Admit&& admit) {
  std::priority_queue<Entry> open;
  const auto offer = [&](int id, int cost) {
    auto [entry, is_new] = marks.try_emplace(id, Mark{cost, false});
    if (!is_new && (entry->second.settled || entry->second.cost <= cost)) return;
    entry->second.cost = cost;
    open.push({cost, pair(id).to_goal, id});
  };
  for (const auto& [id, cost] : from) offer(id, cost);
  while (!open.empty() && !exhausted_) {
    const Entry entry = open.top();
    open.pop();
    Mark& mark = marks.at(entry.node);
    if (mark.settled || mark.cost != entry.cost) continue;
    mark.settled = true;
    const int verdict = admit(entry.node, entry.cost);
    if (verdict < 0) return;
    if (verdict == 0) continue;
    edges(entry.node, [&](int next, bool doubtful, int) {
      if (!bounds_.outside(pair(next).coms)) offer(next, entry.cost + (doubtful ? 1 : 0));
    });
  }
}

std::optional<int> Graph::search() {
  make_starts();
  forward_.clear();
  std::optional<int> least;
  spread(forward_, with_cost(starts_, 0), [&](int id, int cost) {
    if (least && cost >= *least) return -1;
    const Ways goal = ways_to_goal(pairs_[id / most_parts]);
    if (goal.certain & part_of(id)) least = cost;
    else if (goal.possible & part_of(id)) least = std::min(least.value_or(cost + 1), cost + 1);
    return least && *least == cost ? -1 : 1;
  });
  return least;
}

/// Of the pieces of a doubtful edge, those about as long as the longest.
void Graph::choose(std::array<int, 3> pieces, std::vector<int>& chosen) const {
  double longest = 0;
  for (const int piece : pieces) longest = std::max(longest, pieces_.length(piece));
  constexpr double about = 0.5;
  for (const int piece : pieces)
    if (pieces_.length(piece) >= about * longest && pieces_.length(piece) > limits_.finest * bounds_.reach())
      chosen.push_back(piece);
}

bool Graph::refine(int least) {
  std::vector<int> chosen;
  std::vector<std::pair<int, int>> goals;
  for (const int id : reached()) {
    const Pair& here = pair(id);
    if (!here.goal || !(here.goal->possible & part_of(id))) continue;
    const int cost = here.goal->certain & part_of(id) ? 0 : 1;
    if (forward_.at(id).cost + cost > least) continue;
    if (cost == 1) choose({here.first, here.second, here.first}, chosen);
    goals.emplace_back(id, cost);
  }
  const auto within = [&](int id, int cost) {
    const auto found = forward_.find(id);
    return found != forward_.end() && found->second.settled && found->second.cost + cost <= least;
  };
  Marks backward;
  spread(backward, goals, [&](int id, int cost) { return within(id, cost) ? 1 : 0; });
  for (const int id : reached())
    edges(id, [&](int next, bool is_doubtful, int third) {
      if (!is_doubtful) return;
      const auto after = backward.find(next);
      if (after == backward.end() || !after->second.settled) return;
      if (forward_.at(id).cost + 1 + after->second.cost <= least)
        choose({pair(id).first, pair(id).second, third}, chosen);
    });
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  const int before = pieces_.size();
  for (const int piece : chosen) pieces_.halve(piece);
  return pieces_.size() > before;
}

std::vector<int> Graph::reached() const {
  std::vector<int> ids;
  for (const auto& [id, mark] : forward_)
    if (mark.settled) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<int> Graph::reached_from_goal() {
  Marks backward;
  spread(backward, with_cost(goal_nodes(), 0), [](int, int) { return 1; });
  std::vector<int> ids;
  for (const auto& [id, mark] : backward) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace surefoot::planner::proof
