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
    : bounds_(bounds), pieces_(pieces), confirm_(confirm), limits_(limits), work_(work), field_(bounds.field()) {
  make_starts();
}

bool Graph::spend() {
  constexpr int look_at_clock = 64;
  ++work_;
  if (work_ >= limits_.work || pieces_.size() >= most_pieces) exhausted_ = true;
  if (++since_clock_ % look_at_clock == 0 && std::chrono::steady_clock::now() >= limits_.deadline) exhausted_ = true;
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
  Pair pair;
  pair.first = pieces_.add_point(first);
  pair.second = pieces_.add_point(second);
  pair.starts = true;
  const Foot &a = pieces_.foot(pair.first), &b = pieces_.foot(pair.second);
  pair.coms = bounds_.reachable(a.piece, b.piece);
  pair.region = field_.region_of(pair.coms);
  bounds_.clip_to_balance(pair.coms, a.piece, b.piece);
  if (const auto& com = bounds_.scene().start.com) bounds_.clip_to_point(pair.coms, *com);
  bounds_.clip_to_sight(pair.coms, a.piece);
  bounds_.clip_to_sight(pair.coms, b.piece);
  pair.middle_coms = pair.coms;
  const std::array feet{&a, &b};
  spend();
  const unsigned parts =
      bounds_.may_hold(pair.coms, {feet, feet}, pair.region, finest_for({pair.first, pair.second}), work_);
  if (parts == 0) return;
  const int id = add(std::move(pair));
  for (int part = 0; part < most_parts; ++part)
    if (parts >> part & 1) starts_.push_back(node_of(id, part));
}

int Graph::add(Pair pair) {
  pair.to_goal = bounds_.scene().goal.distance(pair.coms.centre());
  pairs_.push_back(std::move(pair));
  return static_cast<int>(pairs_.size()) - 1;
}

int Graph::pair_of(int first, int second) {
  if (first > second) std::swap(first, second);
  auto [entry, is_new] = pair_index_.try_emplace(key_of(first, second), -1);
  if (!is_new) return entry->second;
  Pair pair;
  pair.first = first;
  pair.second = second;
  spend();
  const auto stance = [&](const Foot& a, const Foot& b, bool regard) {
    Convex coms = bounds_.reachable(a.piece, b.piece);
    if (regard) pair.region = field_.region_of(coms);
    bounds_.clip_to_balance(coms, a.piece, b.piece);
    return coms;
  };
  pair.coms = stance(pieces_.foot(first), pieces_.foot(second), true);
  if (pair.coms.empty() || pair.region.parts() == 0) return -1;
  if (confirm_) pair.middle_coms = stance(pieces_.middle(first), pieces_.middle(second), false);
  return entry->second = add(std::move(pair));
}

// ---- edges ------------------------------------------------------------------------------------------------------

double Graph::finest_for(std::initializer_list<int> pieces) const {
  double longest = 0;
  for (const int piece : pieces) longest = std::max(longest, pieces_.length(piece));
  return std::max(longest / 4, bounds_.reach() * limits_.finest);
}

/// Whether a foot may be placed on the third piece, or lifted from it, at a COM of the stance.
Ways Graph::ways(const Pair& pair, int third) {
  if (!spend()) return {};
  const auto ask = [&](Convex coms, const Foot& a, const Foot& b, const Foot& c, auto&& judge) {
    bounds_.clip_to_reach(coms, c.piece);
    bounds_.clip_to_sight(coms, c.piece);
    const std::array feet{&a, &b, &c}, seen{&c, &a, &b};
    return judge(coms, Demand{feet, {seen.data(), pair.starts ? std::size_t{3} : std::size_t{1}}});
  };
  Ways found;
  const double finest = finest_for({pair.first, pair.second, third});
  found.possible = ask(pair.coms, pieces_.foot(pair.first), pieces_.foot(pair.second), pieces_.foot(third),
                       [&](const Convex& coms, const Demand& demand) {
                         return bounds_.may_hold(coms, demand, pair.region, finest, work_);
                       });
  if (!confirm_ || found.possible == 0) return found;
  found.certain = ask(pair.middle_coms, pieces_.middle(pair.first), pieces_.middle(pair.second), pieces_.middle(third),
                      [&](const Convex& coms, const Demand& demand) {
                        return bounds_.does_hold(coms, demand, pair.region, found.possible, work_);
                      });
  return found;
}

Ways Graph::ways_to_goal(Pair& pair) {
  if (pair.goal) return *pair.goal;
  pair.goal = Ways{};
  if (!spend()) return {};
  const auto ask = [&](Convex coms, const Foot& a, const Foot& b, auto&& judge) {
    bounds_.clip_to_goal(coms);
    const std::array feet{&a, &b};
    return judge(coms, Demand{feet, {feet.data(), pair.starts ? std::size_t{2} : std::size_t{0}}});
  };
  Ways found;
  const double finest = finest_for({pair.first, pair.second});
  found.possible = ask(pair.coms, pieces_.foot(pair.first), pieces_.foot(pair.second),
                       [&](const Convex& coms, const Demand& demand) {
                         return bounds_.may_hold(coms, demand, pair.region, finest, work_);
                       });
  if (confirm_ && found.possible != 0)
    found.certain = ask(pair.middle_coms, pieces_.middle(pair.first), pieces_.middle(pair.second),
                        [&](const Convex& coms, const Demand& demand) {
                          return bounds_.does_hold(coms, demand, pair.region, found.possible, work_);
                        });
  pair.goal = found;
  return found;
}

const Graph::Triple& Graph::triple_of(const std::array<int, 3>& sorted) {
  auto [entry, is_new] = triples_.try_emplace(key_of(sorted[0], sorted[1], sorted[2]));
  if (!is_new) return entry->second;
  Triple triple{};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool twin = k > 0 && sorted[k] == sorted[k - 1];  // the same pair and third again
    if (twin) {
      triple.ways[k] = triple.ways[k - 1];
      continue;
    }
    const int id = pair_of(sorted[k == 0 ? 1 : 0], sorted[k == 2 ? 1 : 2]);
    if (id >= 0) triple.ways[k] = ways(pairs_[id], sorted[k]);
  }
  return entry->second = triple;
}

Ways Graph::ways_of(int first, int second, int third) {
  std::array<int, 3> sorted{first, second, third};
  std::sort(sorted.begin(), sorted.end());
  const Triple& triple = triple_of(sorted);
  for (std::size_t k = 0; k < 3; ++k)
    if (sorted[k] == third) return triple.ways[k];
  return {};
}

/// Lists the third pieces of a pair, and replaces those that have been halved since.
void Graph::renew_thirds(Pair& pair) {
  std::vector<int> candidates;
  std::vector<Pair::Third> kept;
  if (!pair.listed) {
    pair.listed = true;
    pieces_.in_box(grown(pair.coms.box(), bounds_.reach() + bounds_.slack()), candidates);
  } else {
    for (const Pair::Third& third : pair.thirds) {
      if (pieces_.is_halved(third.piece))
        pieces_.leaves(third.piece, candidates);
      else
        kept.push_back(third);
    }
    if (candidates.empty()) return;
  }
  for (const int piece : candidates) {
    const Ways found = pair.starts ? ways(pair, piece) : ways_of(pair.first, pair.second, piece);
    if (found.possible != 0) kept.push_back({piece, found});
  }
  pair.thirds = std::move(kept);
}

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
  for (std::size_t k = 0; k < pair.thirds.size() && !exhausted_; ++k) {
    const Pair::Third third = pair.thirds[k];
    if (!(third.ways.possible & part)) continue;
    step(pair.first, third.piece, pair.second, third);
    step(pair.second, third.piece, pair.first, third);
    if (pair.starts) step(pair.first, pair.second, third.piece, third);
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
    edges(entry.node, [&](int next, bool doubtful, int) { offer(next, entry.cost + (doubtful ? 1 : 0)); });
  }
}

std::optional<int> Graph::search() {
  forward_.clear();
  std::optional<int> least;
  spread(forward_, with_cost(starts_, 0), [&](int id, int cost) {
    if (least && cost >= *least) return -1;
    const Ways goal = ways_to_goal(pairs_[id / most_parts]);
    if (goal.certain & part_of(id))
      least = cost;
    else if (goal.possible & part_of(id))
      least = std::min(least.value_or(cost + 1), cost + 1);
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
      const int id = pair_of(near[i], near[j]);
      if (id < 0) continue;
      const unsigned parts = ways_to_goal(pairs_[id]).possible;
      for (int part = 0; part < most_parts; ++part)
        if (parts >> part & 1) found.push_back(node_of(id, part));
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
