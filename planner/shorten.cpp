#include "planner/shorten.hpp"

#include <algorithm>
#include <array>

#include "planner/com_window.hpp"
#include "planner/problem.hpp"

namespace surefoot::planner {

namespace {

constexpr std::size_t longest_window = 7;  ///< steps that are tried to be replaced by two or one
constexpr int com_tries = 6;               ///< COMs tried between the two steps of a bridge
constexpr int safety_tries = 12;           ///< COMs tried per stance for objective `safety`

bool same_place(const terrain::Foothold& a, const terrain::Foothold& b) { return a.chain == b.chain && a.s == b.s; }

/// The stance after placing the free leg of `from` on `foothold` and lifting `lift`.
Node after_step(StepProposals& proposals, const Node& from, const terrain::Foothold& foothold, int lift,
                const Eigen::Vector2d& com) {
  Node node{from.feet, lift, com, proposals.next_id()};
  node.feet[from.free_leg] = foothold;
  return node;
}

/// Legs are alike, so a stance may be reached with its legs exchanged, and what follows it goes on with them exchanged.
using Renaming = std::array<int, gaits::leg_count>;  ///< new name by old name
constexpr Renaming same_names{0, 1, 2};

Renaming after(const Renaming& first, const Renaming& then) { return {then[first[0]], then[first[1]], then[first[2]]}; }

Node renamed(StepProposals& proposals, const Node& node, const Renaming& name) {
  if (name == same_names) return node;
  Node other{{}, name[node.free_leg], node.com, proposals.next_id()};
  for (int leg = 0; leg < gaits::leg_count; ++leg) other.feet[name[leg]] = node.feet[leg];
  return other;
}

/// Goes along the path once. What lies ahead keeps its names until it comes into the window.
class Shortener {
 public:
  Shortener(StepProposals& proposals, std::vector<Node> path) : proposals_(proposals), ahead_(std::move(path)) {}

  std::vector<Node> run() {
    for (look_ahead(); path_.size() > 2; look_ahead()) {
      while (replace_some_window()) look_ahead();
      done_.push_back(path_.front());
      path_.erase(path_.begin());
    }
    done_.insert(done_.end(), path_.begin(), path_.end());
    return std::move(done_);
  }

 private:
  /// One stance more than the longest window: a bridge must leave it within a step.
  void look_ahead() {
    while (path_.size() < longest_window + 2 && next_ < ahead_.size())
      path_.push_back(renamed(proposals_, ahead_[next_++], name_));
  }

  bool replace_some_window() {
    for (std::size_t j = std::min(path_.size() - 1, longest_window); j >= 2; --j)
      if (bridge_by_one(0, j) || (j >= 3 && bridge_by_two(0, j))) return true;
    return false;
  }

  /// One step from path[i] to the footholds of path[j]: they must have a foothold in common already.
  bool bridge_by_one(std::size_t i, std::size_t j) {
    const Node &from = path_[i], &to = path_[j];
    const auto old = from.support(), wanted = to.support();
    for (const int keep : old)
      for (const int kept : wanted) {
        if (!same_place(*from.feet[keep], *to.feet[kept])) continue;
        const int other = old[0] + old[1] - keep, placed = wanted[0] + wanted[1] - kept;
        const Node node = after_step(proposals_, from, *to.feet[placed], other, to.com);
        Renaming name;
        name[kept] = keep;
        name[placed] = from.free_leg;
        name[to.free_leg] = other;
        if (proposals_.is_legal(from, node) && replace(i, j, {node}, name)) return true;
      }
    return false;
  }

  /// Two steps: the free leg to one of the wanted footholds, one of the old legs to the other.
  bool bridge_by_two(std::size_t i, std::size_t j) {
    const Node from = path_[i], to = path_[j];
    const auto old = from.support(), wanted = to.support();
    const double farthest = 2 * proposals_.robot().reach_max;
    for (const int foot : old)
      for (const int goal : wanted)
        if ((from.feet[foot]->position - to.feet[goal]->position).squaredNorm() > farthest * farthest) return false;
    for (const int first : wanted)
      for (const int lift : old)
        if (bridge_by_two(i, j, from, to, first, lift)) return true;
    return false;
  }

  bool bridge_by_two(std::size_t i, std::size_t j, const Node& from, const Node& to, int first, int lift) {
    const int second = to.support()[0] + to.support()[1] - first;
    const int last = from.support()[0] + from.support()[1] - lift;
    gaits::Feet three = from.feet;
    three[from.free_leg] = to.feet[first];
    if (!gaits::within_reach(proposals_.robot(), to.feet[first]->position, from.com, from.com)) return false;
    gaits::Feet two = three;
    two[lift].reset();
    // Between the steps the COM reaches the three feet on the ground; the second foothold is asked for COM by COM.
    Polygon window = reach_window(three, proposals_.robot().reach_max);
    if (window.empty()) return false;
    window = gaits::oracle_of(proposals_.scene(), two, proposals_.box()).equilibrium_polygon(window);
    if (window.empty()) return false;
    Renaming name;
    name[first] = from.free_leg;
    name[second] = lift;
    name[to.free_leg] = last;
    for (int k = 0; k < com_tries; ++k) {
      const StepCode code = spread_code(static_cast<std::uint64_t>(k));
      const Node middle = after_step(proposals_, from, *to.feet[first], lift, point_in(window, code[0], code[1]));
      const Node end = after_step(proposals_, middle, *to.feet[second], last, to.com);
      if (!gaits::within_reach(proposals_.robot(), to.feet[second]->position, middle.com, to.com)) continue;
      if (!proposals_.is_legal(from, middle) || !proposals_.is_legal(middle, end)) continue;
      if (replace(i, j, {middle, end}, name)) return true;
    }
    return false;
  }

  /// Puts `bridge` in place of path[i + 1 .. j]. Its last node stands where path[j] stood, but its free leg may come
  /// from elsewhere: the next step must still be able to swing it.
  bool replace(std::size_t i, std::size_t j, const std::vector<Node>& bridge, const Renaming& name) {
    std::vector<Node> rest;
    for (std::size_t k = j + 1; k < path_.size(); ++k) rest.push_back(renamed(proposals_, path_[k], name));
    if (!rest.empty() && !proposals_.is_legal(bridge.back(), rest.front())) return false;
    path_.resize(i + 1);
    path_.insert(path_.end(), bridge.begin(), bridge.end());
    path_.insert(path_.end(), rest.begin(), rest.end());
    name_ = after(name_, name);
    return true;
  }

  StepProposals& proposals_;
  std::vector<Node> done_, path_, ahead_;  ///< behind the window, in it, ahead of it with the names they had
  std::size_t next_ = 0;
  Renaming name_ = same_names;
};

/// Whether path[i] may stand at `com` instead, both its steps being legal; `moved` is then that node.
bool may_move(StepProposals& proposals, const std::vector<Node>& path, std::size_t i, const Eigen::Vector2d& com,
              Node& moved) {
  moved = path[i];
  moved.com = com;
  moved.id = proposals.next_id();
  if (i + 1 == path.size()) return proposals.scene().goal.contains(com) && proposals.is_legal(path[i - 1], moved);
  return proposals.is_legal(path[i - 1], moved) && proposals.is_legal(moved, path[i + 1]);
}

double way_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).norm() + (c - b).norm();
}

/// The first COM, if it is open, towards the second.
double straighten_start(StepProposals& proposals, std::vector<Node>& path) {
  const gaits::Scene& scene = proposals.scene();
  if (scene.start.com) return 0;
  for (const double part : {1.0, 0.5, 0.25, 0.1}) {
    Node moved = path[0];
    moved.com += part * (path[1].com - moved.com);
    moved.id = proposals.next_id();
    if (gaits::broken_start_rule(scene, moved.stance()) || !proposals.is_legal(moved, path[1])) continue;
    const double gained = (moved.com - path[0].com).norm();
    path[0] = moved;
    return gained;
  }
  return 0;
}

/// Each COM towards the line between its neighbours: to its middle, to where it is nearest, or a part of the way there.
/// The last towards the one before it. Ends where a sweep gains next to nothing.
void straighten(StepProposals& proposals, std::vector<Node>& path) {
  constexpr int most_sweeps = 40;
  constexpr double worth_while = 1e-4;  // of the way
  Node moved;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double way = 0, gained = straighten_start(proposals, path);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Eigen::Vector2d &before = path[i - 1].com, &here = path[i].com;
      const Eigen::Vector2d after = i + 1 < path.size() ? path[i + 1].com : before, line = after - before;
      way += (here - before).norm();
      const double along =
          line.squaredNorm() > 0 ? std::clamp((here - before).dot(line) / line.squaredNorm(), 0.0, 1.0) : 0;
      double gain = 0;
      Node best;
      for (const Eigen::Vector2d& target :
           {Eigen::Vector2d(before + 0.5 * line), Eigen::Vector2d(before + along * line)})
        for (const double part : {1.0, 0.5, 0.25, 0.1}) {
          const Eigen::Vector2d com = here + part * (target - here);
          const double shorter = way_between(before, here, after) - way_between(before, com, after);
          if (shorter > gain && may_move(proposals, path, i, com, moved)) gain = shorter, best = moved;
        }
      if (gain > 0) path[i] = best;
      gained += gain;
    }
    if (!(gained > worth_while * way)) return;
  }
}

/// The least safety factor that the COM of path[i] has a part in.
double local_safety(const gaits::Scene& scene, const std::vector<Node>& path, std::size_t i, const Node& node) {
  double least = gaits::safety_factor(scene, gaits::oracle_of(scene, node.stance().feet), node.com).value;
  const auto line = [&](const Node& from, const Node& to) {
    const auto feet = gaits::feet_during(from.stance(), step_between(from, to));
    least = std::min(least, gaits::safety_factor(scene, gaits::oracle_of(scene, feet), from.com, to.com).least.value);
  };
  line(path[i - 1], node);
  if (i + 1 < path.size()) line(node, path[i + 1]);
  return least;
}

/// Each COM at the safest of several places of its stance's polygon.
void make_safer(StepProposals& proposals, std::vector<Node>& path) {
  const gaits::Scene& scene = proposals.scene();
  Node moved;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const gaits::Feet feet = path[i].stance().feet;
    const Polygon window = reach_window(feet, proposals.robot().reach_max);
    Polygon polygon = gaits::oracle_of(scene, feet, proposals.box()).equilibrium_polygon(window);
    if (i + 1 == path.size()) polygon = clip_to_goal(polygon, scene.goal);
    if (polygon.empty()) continue;
    double best = local_safety(scene, path, i, path[i]);
    for (int k = 0; k < safety_tries; ++k) {
      const StepCode code = spread_code(static_cast<std::uint64_t>(k));
      if (!may_move(proposals, path, i, point_in(polygon, code[0], code[1]), moved)) continue;
      if (const double safety = local_safety(scene, path, i, moved); safety > best) {
        best = safety;
        path[i] = moved;
      }
    }
  }
}

}  // namespace

std::vector<Node> shorten(StepProposals& proposals, std::vector<Node> path, const std::string& objective) {
  if (path.size() < 2) return path;
  path = Shortener(proposals, std::move(path)).run();
  if (objective == "distance") straighten(proposals, path);
  if (objective == "safety") make_safer(proposals, path);
  return path;
}

}  // namespace surefoot::planner
