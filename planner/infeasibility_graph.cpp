#include "planner/infeasibility_graph.hpp"

#include <algorithm>

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

}  // namespace

Graph::Graph(const Bounds& bounds, Pieces& pieces, bool confirm, const ProofLimits& limits, std::uint64_t& work)
    : bounds_(bounds), pieces_(pieces), confirm_(confirm), limits_(limits), work_(work), field_(bounds.field()) {
  make_starts();
}

bool Graph::spend() {
  constexpr int look_at_clock = 64;
  ++work_;
  if (work_ >= limits_.work || pieces_.size() >= most_pieces) exhausted_ = true;
  if (++since_clock_ % look_at_clock == 0 && (std::chrono::steady_clock::now() >= limits_.deadline || limits_.stop()))
    exhausted_ = true;
  return !exhausted_;
}

// ---- nodes ------------------------------------------------------------------------------------------------------

void Graph::make_starts() {
  if (bounds_.entry()) {
    starts_ = nodes_in(bounds_.entry(), {}, [&](Pair& pair) { return parts_of_entry(pair); });
    return;
  }
  if (!starts_.empty()) return;
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
  pair.to_goal = bounds_.goal().distance(pair.coms.centre());
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
      if (pieces_.is_halved(third.piece)) pieces_.leaves(third.piece, candidates);
      else kept.push_back(third);
    }
    if (candidates.empty()) return;
  }
  for (const int piece : candidates) {
    const Ways found = pair.starts ? ways(pair, piece) : ways_of(pair.first, pair.second, piece);
    if (found.possible != 0) kept.push_back({piece, found});
  }
  pair.thirds = std::move(kept);
}

unsigned Graph::parts_of_entry(Pair& pair) {
  if (pair.entry) return *pair.entry;
  pair.entry = 0;
  if (!spend()) return 0;
  Convex coms = pair.coms;
  bounds_.clip_to_entry(coms);
  const std::array feet{&pieces_.foot(pair.first), &pieces_.foot(pair.second)};
  pair.entry = bounds_.may_hold(coms, {feet, {}}, pair.region, finest_for({pair.first, pair.second}), work_);
  return *pair.entry;
}

template <class Parts>
std::vector<int> Graph::nodes_in(const std::optional<std::pair<double, double>>& x,
                                 const std::optional<std::pair<double, double>>& y, Parts&& parts) {
  AlignedBox2d box = grown(bounds_.scene().terrain.bounds(), 2 * bounds_.reach());
  if (x) box.min().x() = x->first, box.max().x() = x->second;
  if (y) box.min().y() = y->first, box.max().y() = y->second;
  std::vector<int> near, found;
  pieces_.in_box(grown(box, bounds_.reach() + bounds_.slack()), near);
  for (std::size_t i = 0; i < near.size() && !exhausted_; ++i)
    for (std::size_t j = i; j < near.size() && !exhausted_; ++j) {
      const Piece &a = pieces_.foot(near[i]).piece, &b = pieces_.foot(near[j]).piece;
      if ((a.a - b.a).norm() > 2 * bounds_.reach() + a.length() + b.length() + 4 * bounds_.slack()) continue;
      const int id = pair_of(near[i], near[j]);
      if (id < 0) continue;
      const unsigned here = parts(pairs_[id]);
      for (int part = 0; part < most_parts; ++part)
        if (here >> part & 1) found.push_back(node_of(id, part));
    }
  return found;
}

std::vector<int> Graph::goal_nodes() {
  const gaits::Goal& goal = bounds_.goal();
  return nodes_in(goal.com_x, goal.com_y, [&](Pair& pair) { return ways_to_goal(pair).possible; });
}

}  // namespace surefoot::planner::proof
