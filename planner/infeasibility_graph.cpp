#include "planner/infeasibility_graph.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace surefoot::planner::proof {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

constexpr int piece_bits = 21;
constexpr int most_pieces = 1 << piece_bits;

std::uint64_t key_of(int a, int b, int c = 0) {
  return (static_cast<std::uint64_t>(a) << 2 * piece_bits) | (static_cast<std::uint64_t>(b) << piece_bits) |
         static_cast<std::uint64_t>(c);
}

AlignedBox2d box_of(const Convex& coms) {
  AlignedBox2d box;
  for (const Vector2d& corner : coms.corners()) box.extend(corner);
  return box;
}

AlignedBox2d grown(const AlignedBox2d& box, double margin) {
  const Vector2d by = Vector2d::Constant(margin);
  return AlignedBox2d(box.min() - by, box.max() + by);
}

std::vector<std::pair<int, int>> with_cost(const std::vector<int>& nodes, int cost) {
  std::vector<std::pair<int, int>> list;
  for (const int node : nodes) list.emplace_back(node, cost);
  return list;
}

}  // namespace

Graph::Graph(const Bounds& bounds, Pieces& pieces, bool confirm, const ProofLimits& limits, std::uint64_t& work)
    : bounds_(bounds), pieces_(pieces), confirm_(confirm), limits_(limits), work_(work) {
  make_starts();
}

bool Graph::spend() {
  constexpr std::uint64_t look_at_clock = 256;
  ++work_;
  if (work_ >= limits_.work || pieces_.size() >= most_pieces) exhausted_ = true;
  if (work_ % look_at_clock == 0 && std::chrono::steady_clock::now() >= limits_.deadline) exhausted_ = true;
  return !exhausted_;
}

// ---- nodes ------------------------------------------------------------------------------------------------------

void Graph::make_starts() {
  const gaits::Start& start = bounds_.scene().start;
  for (int a = 0; a < gaits::leg_count; ++a)
    for (int b = a + 1; b < gaits::leg_count; ++b) {
      if (start.support && *start.support != std::pair(a, b)) continue;
      if (start.feet[a] && start.feet[b]) make_start(*start.feet[a], *start.feet[b]);
    }
}

void Graph::make_start(const terrain::Foothold& first, const terrain::Foothold& second) {
  Node node;
  node.first = pieces_.add_point(first);
  node.second = pieces_.add_point(second);
  node.starts = true;
  const Piece &a = pieces_.foot(node.first).piece, &b = pieces_.foot(node.second).piece;
  node.coms = bounds_.stance(a, b);
  if (const auto& com = bounds_.scene().start.com) bounds_.clip_to_point(node.coms, *com);
  bounds_.clip_to_sight(node.coms, a);
  bounds_.clip_to_sight(node.coms, b);
  node.middle_coms = node.coms;
  const std::array feet{&pieces_.foot(node.first), &pieces_.foot(node.second)};
  spend();
  if (!bounds_.may_hold(node.coms, {feet, feet}, bounds_.reach() * limits_.finest)) return;
  node.to_goal = bounds_.scene().goal.distance(node.coms.centre());
  starts_.push_back(static_cast<int>(nodes_.size()));
  nodes_.push_back(std::move(node));
}

int Graph::node_of(int first, int second) {
  if (first > second) std::swap(first, second);
  auto [entry, is_new] = node_index_.try_emplace(key_of(first, second), -1);
  if (!is_new) return entry->second;
  Node node;
  node.first = first;
  node.second = second;
  spend();
  node.coms = bounds_.stance(pieces_.foot(first).piece, pieces_.foot(second).piece);
  if (node.coms.empty()) return -1;
  if (confirm_) node.middle_coms = bounds_.stance(pieces_.middle(first).piece, pieces_.middle(second).piece);
  node.to_goal = bounds_.scene().goal.distance(node.coms.centre());
  entry->second = static_cast<int>(nodes_.size());
  nodes_.push_back(std::move(node));
  return entry->second;
}

// ---- edges ------------------------------------------------------------------------------------------------------

/// Whether a foot may be placed on the third piece, or lifted from it, at a COM of the stance.
Way Graph::way(const Node& node, int third) {
  if (!spend()) return Way::none;
  const auto ask = [&](Convex coms, const Foot& a, const Foot& b, const Foot& c, auto&& judge) {
    bounds_.clip_to_reach(coms, c.piece);
    bounds_.clip_to_sight(coms, c.piece);
    const std::array feet{&a, &b, &c}, seen{&c, &a, &b};
    return judge(coms, Demand{feet, {seen.data(), node.starts ? std::size_t{3} : std::size_t{1}}});
  };
  const Foot &a = pieces_.foot(node.first), &b = pieces_.foot(node.second), &c = pieces_.foot(third);
  const double longest = std::max({a.piece.length(), b.piece.length(), c.piece.length()});
  const double finest = std::max(longest / 4, bounds_.reach() * limits_.finest);
  if (!ask(node.coms, a, b, c, [&](const Convex& coms, const Demand& demand) {
        return bounds_.may_hold(coms, demand, finest);
      }))
    return Way::none;
  if (!confirm_) return Way::doubtful;
  const bool confirmed = ask(node.middle_coms, pieces_.middle(node.first), pieces_.middle(node.second),
                             pieces_.middle(third), [&](const Convex& coms, const Demand& demand) {
                               return bounds_.does_hold(coms, demand);
                             });
  return confirmed ? Way::certain : Way::doubtful;
}

Way Graph::way_to_goal(Node& node) {
  if (node.goal) return *node.goal;
  const auto ask = [&](Convex coms, const Foot& a, const Foot& b, auto&& judge) {
    bounds_.clip_to_goal(coms);
    const std::array feet{&a, &b};
    return judge(coms, Demand{feet, {feet.data(), node.starts ? std::size_t{2} : std::size_t{0}}});
  };
  node.goal = Way::none;
  const Foot &a = pieces_.foot(node.first), &b = pieces_.foot(node.second);
  const double finest = std::max(std::max(a.piece.length(), b.piece.length()) / 4, bounds_.reach() * limits_.finest);
  if (!spend() || !ask(node.coms, a, b, [&](const Convex& coms, const Demand& demand) {
        return bounds_.may_hold(coms, demand, finest);
      }))
    return Way::none;
  const bool confirmed = confirm_ && ask(node.middle_coms, pieces_.middle(node.first), pieces_.middle(node.second),
                                         [&](const Convex& coms, const Demand& demand) {
                                           return bounds_.does_hold(coms, demand);
                                         });
  node.goal = confirmed ? Way::certain : Way::doubtful;
  return *node.goal;
}

const Graph::Triple& Graph::triple_of(const std::array<int, 3>& sorted) {
  auto [entry, is_new] = triples_.try_emplace(key_of(sorted[0], sorted[1], sorted[2]));
  if (!is_new) return entry->second;
  Triple triple{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int a = sorted[k == 0 ? 1 : 0], b = sorted[k == 2 ? 1 : 2];
    const bool twin = k > 0 && sorted[k] == sorted[k - 1];  // the same pair and third again
    const int id = twin ? -1 : node_of(a, b);
    triple.way[k] = twin ? triple.way[k - 1] : id < 0 ? Way::none : way(nodes_[id], sorted[k]);
  }
  return triples_[key_of(sorted[0], sorted[1], sorted[2])] = triple;
}

Way Graph::way_of(int first, int second, int third) {
  std::array<int, 3> sorted{first, second, third};
  std::sort(sorted.begin(), sorted.end());
  const Triple& triple = triple_of(sorted);
  for (std::size_t k = 0; k < 3; ++k)
    if (sorted[k] == third) return triple.way[k];
  return Way::none;
}

/// Lists the third pieces of a node, and replaces those that have been halved since.
void Graph::renew_thirds(int id) {
  std::vector<int> candidates;
  std::vector<Third> kept;
  Node& node = nodes_[id];
  if (!node.listed) {
    node.listed = true;
    pieces_.in_box(grown(box_of(node.coms), bounds_.reach() + bounds_.slack()), candidates);
  } else {
    for (const Third& third : node.thirds) {
      if (pieces_.is_halved(third.piece))
        pieces_.leaves(third.piece, candidates);
      else
        kept.push_back(third);
    }
    if (candidates.empty()) return;
  }
  for (const int piece : candidates) {
    const Way found = node.starts ? way(node, piece) : way_of(node.first, node.second, piece);
    if (found != Way::none) kept.push_back({piece, found});
  }
  node.thirds = std::move(kept);
}

template <class Visit>
void Graph::edges(int id, Visit&& visit) {
  renew_thirds(id);
  const Node& node = nodes_[id];
  const auto step = [&](int first, int second, int lifted, const Third& third) {
    const Way next = way_of(first, second, lifted);
    if (next == Way::none) return;
    visit(node_of(first, second), next == Way::doubtful || third.way == Way::doubtful, third.piece);
  };
  for (std::size_t k = 0; k < node.thirds.size() && !exhausted_; ++k) {
    const Third third = node.thirds[k];
    step(node.first, third.piece, node.second, third);
    step(node.second, third.piece, node.first, third);
    if (node.starts) step(node.first, node.second, third.piece, third);
  }
}

// ---- search -----------------------------------------------------------------------------------------------------

bool Graph::Entry::operator<(const Entry& other) const {
  return std::tie(cost, to_goal, node) > std::tie(other.cost, other.to_goal, other.node);
}

/// Nodes by least number of doubtful edges from `from`; of equals, nodes nearer to the goal first. admit(node, cost) is asked when
/// a node is settled: -1 stops all, 0 does not lead on, 1 leads on.
template <class Admit>
void Graph::spread(Marks& marks, const std::vector<std::pair<int, int>>& from, Admit&& admit) {
  std::priority_queue<Entry> open;
  const auto offer = [&](int id, int cost) {
    auto [entry, is_new] = marks.try_emplace(id, Mark{cost, false});
    if (!is_new && (entry->second.settled || entry->second.cost <= cost)) return;
    entry->second.cost = cost;
    open.push({cost, nodes_[id].to_goal, id});
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
    edges(entry.node, [&](int next, bool doubtful, int) { offer(next, entry.cost + (doubtful ? 1 : 0)); });
  }
}

std::optional<int> Graph::search() {
  forward_.clear();
  std::optional<int> least;
  spread(forward_, with_cost(starts_, 0), [&](int id, int cost) {
    if (least && cost >= *least) return -1;
    const Way goal = way_to_goal(nodes_[id]);
    if (goal == Way::certain) least = cost;
    if (goal == Way::doubtful) least = std::min(least.value_or(cost + 1), cost + 1);
    return least && *least == cost ? -1 : 1;
  });
  return least;
}

/// Of the pieces of a doubtful edge, those about as long as the longest.
void Graph::choose(std::array<int, 3> pieces, std::vector<int>& chosen) const {
  double longest = 0;
  for (const int piece : pieces) longest = std::max(longest, pieces_.length(piece));
  constexpr double about = 0.6;
  for (const int piece : pieces)
    if (pieces_.length(piece) >= about * longest && pieces_.length(piece) > limits_.finest * bounds_.reach())
      chosen.push_back(piece);
}

bool Graph::refine(int least) {
  std::vector<int> goals, chosen;
  for (const auto& [id, mark] : forward_) {
    Node& node = nodes_[id];
    if (!mark.settled || !node.goal || *node.goal == Way::none) continue;
    const int cost = *node.goal == Way::doubtful;
    if (mark.cost + cost > least) continue;
    if (cost == 1) choose({node.first, node.second, node.first}, chosen);
    goals.push_back(id);
  }
  std::sort(goals.begin(), goals.end());
  const auto within = [&](int id, int cost) {
    const auto found = forward_.find(id);
    return found != forward_.end() && found->second.settled && found->second.cost + cost <= least;
  };
  Marks backward;
  std::vector<std::pair<int, int>> from;
  for (const int id : goals) from.emplace_back(id, *nodes_[id].goal == Way::doubtful);
  spread(backward, from, [&](int id, int cost) { return within(id, cost) ? 1 : 0; });
  std::vector<int> ids;
  for (const auto& [id, mark] : forward_)
    if (mark.settled) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  for (const int id : ids)
    edges(id, [&](int next, bool is_doubtful, int third) {
      if (!is_doubtful) return;
      const auto after = backward.find(next);
      if (after == backward.end() || !after->second.settled) return;
      if (forward_.at(id).cost + 1 + after->second.cost <= least) choose({nodes_[id].first, nodes_[id].second, third}, chosen);
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

std::vector<int> Graph::goal_nodes() {
  const AlignedBox2d all = grown(bounds_.scene().terrain.bounds(), 2 * bounds_.reach());
  AlignedBox2d box = all;
  const gaits::Goal& goal = bounds_.scene().goal;
  if (goal.com_x) box.min().x() = goal.com_x->first, box.max().x() = goal.com_x->second;
  if (goal.com_y) box.min().y() = goal.com_y->first, box.max().y() = goal.com_y->second;
  std::vector<int> near, found;
  pieces_.in_box(grown(box, bounds_.reach() + bounds_.slack()), near);
  for (std::size_t i = 0; i < near.size() && !exhausted_; ++i)
    for (std::size_t j = i; j < near.size() && !exhausted_; ++j) {
      const Piece &a = pieces_.foot(near[i]).piece, &b = pieces_.foot(near[j]).piece;
      if ((a.a - b.a).norm() > 2 * bounds_.reach() + a.length() + b.length() + bounds_.slack()) continue;
      const int id = node_of(near[i], near[j]);
      if (id >= 0 && way_to_goal(nodes_[id]) != Way::none) found.push_back(id);
    }
  return found;
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
