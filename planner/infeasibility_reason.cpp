#include "planner/infeasibility_reason.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace surefoot::planner::proof {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Interval = std::pair<double, double>;

namespace {

/// In the order in which it is tried to do without them: what is named in the end is what a reader expects first.
constexpr bool Rules::*droppable[] = {&Rules::least_reach, &Rules::clearance, &Rules::sight, &Rules::disturbance,
                                      &Rules::balance};

class Explainer {
 public:
  Explainer(const gaits::Scene& scene, Pieces& pieces, const ProofLimits& limits, std::uint64_t work)
      : scene_(scene), pieces_(pieces), limits_(limits), whole_(limits.work), full_(scene, {}, limits.window) {
    result_.work = work;
  }

  Impossibility run() {
    allot(whole_);
    Graph graph(full_, pieces_, false, limits_, result_.work);
    if (!limits_.window && !graph.has_start()) {
      result_.obstacle = Obstacle::start;
      place_at_start();
    } else if (!limits_.window && graph.goal_nodes().empty() && !graph.exhausted()) {
      result_.obstacle = Obstacle::goal;
      result_.x = scene_.goal.com_x;
      result_.y = scene_.goal.com_y;
    } else {
      result_.obstacle = Obstacle::barrier;
      graph.search();
      place_between(graph);
    }
    result_.reason = place_words() + rule_words(sufficient());
    return result_;
  }

 private:
  void allot(std::uint64_t share) { limits_.work = result_.work + share; }
  bool impossible(const Rules& rules) {
    allot(whole_ / 3);
    const Bounds bounds(scene_, rules, limits_.window);
    Graph graph(bounds, pieces_, false, limits_, result_.work);
    switch (result_.obstacle) {
      case Obstacle::start: return !graph.has_start();
      case Obstacle::goal: return graph.goal_nodes().empty() && !graph.exhausted();
      case Obstacle::barrier: return !graph.search() && !graph.exhausted();
    }
    return false;
  }
  /// As few rules as will do.
  Rules sufficient() {
    Rules rules;
    rules.modes = false;  // they play no part in what is excluded
    const std::uint64_t last = result_.work + whole_;
    for (const auto rule : droppable) {
      if (result_.work > last) break;
      Rules fewer = rules;
      fewer.*rule = false;
      if (impossible(fewer)) rules = fewer;
    }
    return rules;
  }

  void place_at_start();
  void place_between(Graph& graph);
  std::set<int> feet_of(const Graph& graph, const std::vector<int>& nodes) const;
  AlignedBox2d box_of(const std::set<int>& pieces) const;
  bool in_goal() const { return result_.obstacle == Obstacle::goal || way_ == Way::into_goal; }
  std::string goal_words() const;  // as the scene gives it
  std::string place_words() const;
  std::string rule_words(const Rules& rules) const;
  std::string gap_words() const;
  std::string friction_words() const;

  const gaits::Scene& scene_;
  Pieces& pieces_;
  ProofLimits limits_;
  const std::uint64_t whole_;  // work allowed
  Bounds full_;
  Impossibility result_;
  double gap_ = 0;  // [m] least distance between feet of the two sides
  // What is passed between the feet of the start's side and those of the goal's.
  enum class Way {
    across,     // a stretch in x or in height
    into_goal,  // none: from the start every foothold of the goal's side is reached
    unknown     // sides that lie amid each other
  } way_ = Way::unknown;
  bool by_height_ = false;  // a stretch in height
};

// ---- place ------------------------------------------------------------------------------------------------------

void Explainer::place_at_start() {
  AlignedBox2d box;
  for (const auto& foot : scene_.start.feet)
    if (foot) box.extend(foot->position);
  result_.x = {box.min().x(), box.max().x()};
  result_.y = {box.min().y(), box.max().y()};
}

std::set<int> Explainer::feet_of(const Graph& graph, const std::vector<int>& nodes) const {
  std::set<int> pieces;
  for (const int id : nodes) pieces.insert({graph.pair(id).first, graph.pair(id).second});
  return pieces;
}

AlignedBox2d Explainer::box_of(const std::set<int>& pieces) const {
  AlignedBox2d box;
  for (const int piece : pieces) {
    box.extend(pieces_.foot(piece).piece.a);
    box.extend(pieces_.foot(piece).piece.b);
  }
  return box;
}

/// Those that are not among others.
std::set<int> without(const std::set<int>& pieces, const std::set<int>& others) {
  std::set<int> left;
  std::set_difference(pieces.begin(), pieces.end(), others.begin(), others.end(), std::inserter(left, left.end()));
  return left;
}

bool are_apart(const AlignedBox2d& a, const AlignedBox2d& b, int axis) {
  return a.max()[axis] <= b.min()[axis] || b.max()[axis] <= a.min()[axis];
}

double distance_between(const Piece& p, const Piece& q) {
  const auto from = [](const Vector2d& point, const Piece& piece) {
    const Vector2d along = piece.b - piece.a;
    const double squared = along.squaredNorm();
    const double part = squared > 0 ? std::clamp((point - piece.a).dot(along) / squared, 0.0, 1.0) : 0.0;
    return (point - piece.a - part * along).norm();
  };
  return std::min({from(p.a, q), from(p.b, q), from(q.a, p), from(q.b, p)});  // pieces do not cross
}

/// What lies between two intervals; where they overlap, the overlap.
Interval between(double a_low, double a_high, double b_low, double b_high) {
  const double low = std::min(a_high, b_high), high = std::max(a_low, b_low);
  return std::minmax(low, high);
}

void Explainer::place_between(Graph& graph) {
  const std::set<int> start_feet = feet_of(graph, graph.reached());
  const std::set<int> goal_feet = feet_of(graph, graph.reached_from_goal());
  if (start_feet.empty() || goal_feet.empty() || graph.exhausted()) return;
  const std::set<int> goal_only = without(goal_feet, start_feet), start_only = without(start_feet, goal_feet);
  if (goal_only.empty() && !limits_.window) {
    way_ = Way::into_goal;
    result_.x = scene_.goal.com_x;
    result_.y = scene_.goal.com_y;
    return;
  }
  const AlignedBox2d start = box_of(start_only.empty() ? start_feet : start_only),
                     goal = box_of(goal_only.empty() ? goal_feet : goal_only);
  result_.x = between(start.min().x(), start.max().x(), goal.min().x(), goal.max().x());
  const bool apart = are_apart(start, goal, 1);
  if (apart || !scene_.goal.com_x)
    result_.y = between(start.min().y(), start.max().y(), goal.min().y(), goal.max().y());
  by_height_ = apart && !are_apart(start, goal, 0);
  way_ = apart || are_apart(start, goal, 0) ? Way::across : Way::unknown;
  constexpr std::size_t few = 2000;  // pairs of feet are looked at
  if (start_feet.size() > few || goal_feet.size() > few) return;
  gap_ = std::numeric_limits<double>::infinity();
  for (const int a : start_feet)
    for (const int b : goal_feet) gap_ = std::min(gap_, distance_between(pieces_.foot(a).piece, pieces_.foot(b).piece));
}

// ---- words ------------------------------------------------------------------------------------------------------

std::string number(double value) { return fmt::format("{:.4g}", std::abs(value) < 5e-7 ? 0.0 : value); }

template <class Words>
std::string interval_words(const char* axis, const Interval& interval, const Words& in_words) {
  const std::string from = in_words(interval.first), to = in_words(interval.second);
  return from == to ? fmt::format("at {} = {}", axis, from) : fmt::format("between {} = {} and {}", axis, from, to);
}

std::string interval_words(const char* axis, const Interval& interval) {
  return interval_words(axis, interval, number);
}

std::string Explainer::goal_words() const {
  const auto as_given = [](double value) { return fmt::format("{}", value); };
  std::string words;
  if (const auto& x = scene_.goal.com_x) words = interval_words("x", *x, as_given);
  if (const auto& y = scene_.goal.com_y) words += (words.empty() ? "" : " and ") + interval_words("y", *y, as_given);
  return "in the goal, " + words + ": ";
}

std::string Explainer::place_words() const {
  if (in_goal()) return goal_words();
  std::string words = result_.obstacle == Obstacle::start ? "at the start, " : "";
  const bool by_height = result_.y && (by_height_ || !result_.x || !scene_.goal.com_x);
  const bool flat = result_.y && number(result_.y->first) == number(result_.y->second);
  if (by_height) return words + interval_words("y", *result_.y) + ": ";
  if (!result_.x) return words.empty() ? "" : words.substr(0, words.size() - 2) + ": ";
  words += interval_words("x", *result_.x);
  const bool upright = number(result_.x->first) == number(result_.x->second);
  if (result_.y && !flat && upright) words += " and " + interval_words("y", *result_.y);
  return words + ": ";
}

/// Friction of the footholds at the place, or within reach of the goal.
std::string Explainer::friction_words() const {
  const double reach = in_goal() ? scene_.robot.reach_max : 0;
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  const auto meets = [&](const std::optional<Interval>& interval, double a, double b) {
    return !interval || (std::max(a, b) >= interval->first - reach && std::min(a, b) <= interval->second + reach);
  };
  for (const terrain::Segment& segment : scene_.terrain.segments()) {
    if (!segment.surface.foothold || !meets(result_.x, segment.a.x(), segment.b.x()) ||
        !meets(result_.y, segment.a.y(), segment.b.y()))
      continue;
    least = std::min(least, segment.surface.friction);
    greatest = std::max(greatest, segment.surface.friction);
  }
  if (least > greatest) return "";
  if (least == greatest) return fmt::format(" at friction {}", number(least));
  return fmt::format(" at friction {} to {}", number(least), number(greatest));
}

std::string Explainer::gap_words() const {
  const std::string reach = number(scene_.robot.reach_max);
  switch (result_.obstacle) {
    case Obstacle::start: return fmt::format("no COM is within reach {} of two start feet", reach);
    case Obstacle::goal: return fmt::format("no two footholds are within reach {} of a COM there", reach);
    case Obstacle::barrier: break;
  }
  if (gap_ > 2 * scene_.robot.reach_max && std::isfinite(gap_))
    return fmt::format("no support pair within reach {} spans the gap of {} m", reach, number(gap_));
  return fmt::format("no steps lead {} with all feet within reach {} of the COM",
                     way_ == Way::into_goal ? "there" : "across the gap", reach);
}

std::string Explainer::rule_words(const Rules& rules) const {
  if (!rules.balance && !rules.sight && !rules.clearance && !rules.least_reach) return gap_words();
  const gaits::Robot& robot = scene_.robot;
  std::vector<std::string> demands;
  if (rules.balance && rules.disturbance)
    demands.push_back(fmt::format("balances every disturbance (kappa {}, nu {} m){}", number(scene_.disturbance.kappa),
                                  number(scene_.disturbance.nu), friction_words()));
  if (rules.balance && !rules.disturbance) demands.push_back("balances the weight" + friction_words());
  if (rules.sight) demands.push_back("sees the foot that is placed or lifted");
  if (rules.clearance && robot.clearance > 0)
    demands.push_back(fmt::format("keeps the clearance {}", number(robot.clearance)));
  if (rules.least_reach && robot.reach_min > 0)
    demands.push_back(fmt::format("keeps the feet {} m away", number(robot.reach_min)));
  const std::string all = fmt::format("{}", fmt::join(demands, " and ")), reach = number(robot.reach_max);
  switch (result_.obstacle) {
    case Obstacle::start: return fmt::format("no COM within reach {} of two start feet {}", reach, all);
    case Obstacle::goal: return fmt::format("no COM within reach {} of two feet {}", reach, all);
    case Obstacle::barrier: break;
  }
  const char* where = way_ == Way::into_goal   ? "there"
                      : result_.x || result_.y ? "across"
                                               : "from the start to the goal";
  return fmt::format("no steps lead {} with all feet within reach {} of a COM that {}", where, reach, all);
}

}  // namespace

Impossibility explain(const gaits::Scene& scene, Pieces& pieces, const ProofLimits& limits, std::uint64_t work) {
  return Explainer(scene, pieces, limits, work).run();
}

}  // namespace surefoot::planner::proof
