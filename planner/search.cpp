#include "planner/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <stdexcept>
#include <system_error>
#include <type_traits>

#include "gaits/rules.hpp"
#include "planner/anytime_search.hpp"
#include "planner/infeasibility.hpp"
#include "planner/ompl_search.hpp"
#include "planner/problem.hpp"
#include "planner/shorten.hpp"
#include "stability/given.hpp"

namespace surefoot::planner {

using Clock = std::chrono::steady_clock;

namespace {

/// One turn of a planner in the search.
struct Turn {
  const char* planner;
  double goal_bias;
  std::uint64_t iterations;
};

/// Turns of `auto` where Layers found nothing: planners that are not bound to a lattice. A tree that went wrong is
/// dropped soon and grown anew, longer each time.
constexpr Turn auto_turns[] = {{"RRT", 0.7, 1000}, {"EST", 0.3, 2000}, {"RRT", 0.5, 4000}, {"KPIECE1", 0.3, 4000}};

// Work of Layers, a third of a microsecond to one a unit.
constexpr std::uint64_t stall_before_proof =
    150'000;  ///< without progress: then it is time to ask whether there is a plan
constexpr std::uint64_t greatest_stall = 1'500'000;
// Relative to reach_max: a way from the start beyond which barriers are looked for near its end first, and how far
// there.
constexpr double long_way = 20, window_widths[] = {4, 10};
constexpr std::uint64_t usual_improvement = 1'000'000, dear = 6;

std::vector<Turn> turns_of(const std::string& planner) {
  if (planner == "auto") return {std::begin(auto_turns), std::end(auto_turns)};
  if (planner == "Layers") return {};
  for (const std::string& name : planner_names()) {
    if (name != planner) continue;
    const double bias = planner == "RRT" ? 0.7 : 0.3;
    return {{name.c_str(), bias, 5000}, {name.c_str(), 0.3, 15000}};
  }
  throw std::invalid_argument("unknown planner '" + planner + "'");
}

/// Iterations are meant for a journey of ten times the reach; a longer one takes more, up to a budget that no machine
/// gets through in a day.
double length_factor(const gaits::Scene& scene, const Eigen::Vector2d& start) {
  constexpr double usual = 10, greatest = 1e5;
  return std::clamp(scene.goal.distance(start) / (usual * scene.robot.reach_max), 1.0, greatest);
}

/// Seeds of the turns: the scene's own first, then far from each other, within the range of OMPL's generator.
std::uint32_t turn_seed(std::uint32_t seed, std::size_t turn) {
  constexpr std::uint64_t range = gaits::greatest_seed, golden = 1327217884;  // 2^31 divided by the golden ratio
  return static_cast<std::uint32_t>((seed + range - 1 + turn * golden) % range) + 1;
}

void note_left_out(const gaits::Scene& scene, const ProposalCounts& counts, gaits::Plan& plan) {
  // A proof asks no landings, Layers counts none.
  if (counts.swings_skipped > 0 && plan.status != gaits::Status::infeasible && plan.planner != "Layers")
    plan.left_out.push_back({fmt::format("whether the swinging leg meets terrain, for {} of {} landings tried",
                                         counts.swings_skipped, counts.swings_asked),
                             "no terrain lies within the least reach of the COM, where the shortened leg turns"});
  if (scene.criterion == gaits::Criterion::equilibrium)
    plan.left_out.push_back({"non-static contact modes", "criterion equilibrium: the robot braces actively"});
  if (!scene.restitution) plan.left_out.push_back({"frictional stability", "no restitution is given"});
  else if (!gaits::asks_frictional(scene.criterion))
    plan.left_out.push_back({"frictional stability", "the criterion does not ask for it"});
}

class Search {
 public:
  Search(const gaits::Scene& scene, const SearchOptions& options)
      : scene_(scene), options_(options), turns_(turns_of(options.planner)), begin_(Clock::now()), proposals_(scene) {
    deadline_ = deadline_after(begin_, options.time_limit);
    plan_.scene = scene.name;
    plan_.seed = options.seed;
    plan_.planner = options.planner;
  }

  gaits::Plan run() {
    if (const std::vector<Node> path = find(); !path.empty()) {
      plan_.status = gaits::Status::solved;
      plan_.reason.clear();
      write_path(path, plan_);
      gaits::rate(scene_, plan_);
    }
    note_left_out(scene_, proposals_.counts(), plan_);
    plan_.time_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    return std::move(plan_);
  }

 private:
  bool stopped() const { return Clock::now() >= deadline_ || options_.interrupted(); }

  std::vector<Node> find() {
    const StartChoice start = choose_start(proposals_);
    if (start.nodes.empty()) {
      if (start.decided) throw start_error(scene_, start);
      if (!is_impossible()) plan_.reason = "start is not stable: " + start.fault;
      return {};
    }
    if (scene_.goal.contains(start.nodes.front().com)) return {start.nodes.front()};
    const bool layers = options_.planner == "auto" || options_.planner == "Layers";
    std::vector<Node> path = layers ? search_layers(start) : take_turns(start.nodes);
    if (path.empty() && !layers && is_impossible()) return {};
    if (!path.empty() || plan_.status == gaits::Status::infeasible) return path;
    if (const GoalLook look = look_at_goal(scene_); !look.standable)
      plan_.reason = "goal cannot be stood on: " + look.fault;
    return {};
  }

  /// Where to look for a barrier: on long terrain around the place that a search came to, `nearest`, then everywhere.
  std::vector<std::optional<ProofWindow>> windows(const std::vector<Node>& starts,
                                                  const Eigen::Vector2d& nearest) const {
    std::vector<std::optional<ProofWindow>> windows;
    if (const double way = nearest.x() - starts.front().com.x();
        scene_.goal.com_x && std::abs(way) > long_way * scene_.robot.reach_max)
      for (const double width : window_widths) {
        const double half = std::copysign(width * scene_.robot.reach_max, way);
        windows.push_back(ProofWindow{nearest.x() - half, nearest.x() + half});
      }
    windows.emplace_back();
    return windows;
  }

  /// Whether it can be proven that there is no plan; then that is the result.
  bool is_impossible(
      const std::vector<std::optional<ProofWindow>>& windows = {std::nullopt},
      const std::function<bool()>& stop = [] { return false; }) {
    ProofLimits limits;
    limits.deadline = deadline_;
    limits.stop = [this, &stop] { return options_.interrupted() || stop(); };
    for (const auto& window : windows) {
      if (!options_.prove || stopped() || limits.stop()) return false;
      limits.window = window;
      const auto impossibility = prove_infeasible(scene_, limits);
      if (!impossibility) continue;
      plan_.status = gaits::Status::infeasible;
      plan_.reason = impossibility->reason;
      return true;
    }
    return false;
  }

  /// Looks for a first plan and, once that stalls, for a proof that there is none beside it. Only one of the two can
  /// exist, so it does not matter which thread is faster.
  bool find_first(AnytimeSearch& search, const std::vector<Node>& starts, std::atomic<bool>& proven) {
    if (search.find(stall_before_proof)) return true;
    std::atomic<bool> found = false;
    const auto where = windows(starts, search.nearest_com());
    auto proof = beside([&] { return proven = is_impossible(where, [&found] { return found.load(); }); });
    found = search.find(greatest_stall);
    proof.get();
    return found;
  }

  std::vector<Node> search_layers(const StartChoice& start) {
    const std::vector<Node>& starts = start.nodes;
    std::atomic<bool> proven = false;
    const AnytimeSearch* running = nullptr;
    AnytimeOptions anytime{.seed = options_.seed, .objective = options_.objective};
    anytime.stop = [&] {
      if (running != nullptr) tell(*running, starts);
      return proven || stopped();
    };
    AnytimeSearch search(proposals_, starts, anytime);
    running = &search;
    if (!find_first(search, starts, proven)) {
      if (proven) return {};
      std::vector<Node> path = take_turns(starts);
      if (path.empty()) plan_.reason += came_to(search);
      return path;
    }
    plan_.planner = "Layers";
    improve(search, start);
    plan_.resolution = search.resolution();
    return search.path();
  }

  /// Betters the plan, in slices and telling the best so far in between; beside it a second search with another lattice
  /// does the same, and the better plan is kept.
  void improve(AnytimeSearch& search, const StartChoice& start) {
    // A first plan that was dear (long terrain) has had its share of the work: with less than this left, the next wider
    // pass over all of it is cut off before it betters anything.
    const std::uint64_t spent = std::min(dear * search.work(), usual_improvement);
    const double usual = static_cast<double>(usual_improvement);
    const auto work =
        static_cast<std::uint64_t>(std::clamp(options_.effort * usual - static_cast<double>(spent), 0.0, 1e18));
    if (work == 0) return;
    auto other = beside([&] { return search_elsewhere(start, work); });
    const std::uint64_t slice = std::max<std::uint64_t>(work / 20, 1), until = search.work() + work;
    while (!stopped() && search.work() < until && search.improve(slice)) {
    }
    search.offer(other.get());
  }

  std::vector<Node> search_elsewhere(const StartChoice& start, std::uint64_t work) const {
    std::vector<Node> starts = start.nodes;
    starts.insert(starts.end(), start.nearest.begin(), start.nearest.end());
    StepProposals proposals(scene_);
    const AnytimeOptions anytime{turn_seed(options_.seed, 1), options_.objective, true, [this] { return stopped(); }};
    AnytimeSearch search(proposals, starts, anytime);
    if (search.find(stall_before_proof)) search.improve(work);
    return search.path();
  }

  /// On a thread of its own, or when the result is asked for where there is none to be had.
  template <class Work>
  static std::future<std::invoke_result_t<Work>> beside(Work work) {
    try {
      return std::async(std::launch::async, work);
    } catch (const std::system_error&) {
      return std::async(std::launch::deferred, work);
    }
  }

  /// How things stand, ten times a second.
  void tell(const AnytimeSearch& search, const std::vector<Node>& starts) {
    const auto now = Clock::now();
    if (now < next_telling_) return;
    next_telling_ = now + std::chrono::milliseconds(100);
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    if (!search.path().empty())
      return options_.progress(fmt::format("{}; looking for a better plan, {:.1f} s", search.cost(), seconds));
    const double whole = scene_.goal.distance(starts.front().com), left = scene_.goal.distance(search.nearest_com());
    options_.progress(fmt::format("searching: {:.3g} of {:.3g} m, {:.1f} s of at most {} s",
                                  std::max(whole - left, 0.0), whole, seconds, options_.time_limit));
  }

  std::string came_to(const AnytimeSearch& search) const {
    const Eigen::Vector2d com = search.nearest_com();
    return fmt::format("; Layers came to COM ({:.5g}, {:.5g}), {:.4g} m from the goal; {}", com.x(), com.y(),
                       scene_.goal.distance(com), search.refusals().summary());
  }

  std::vector<Node> take_turns(const std::vector<Node>& starts) {
    const double factor = length_factor(scene_, starts.front().com);
    std::uint64_t iterations = 0;
    for (std::size_t k = 0; k < turns_.size() && !stopped(); ++k) {
      options_.progress(fmt::format("searching ({}, at most {} s) ...", turns_[k].planner, options_.time_limit));
      OmplRun run;
      run.planner = turns_[k].planner;
      run.seed = turn_seed(options_.seed, k);
      run.iterations = static_cast<std::uint64_t>(factor * static_cast<double>(turns_[k].iterations));
      run.goal_bias = turns_[k].goal_bias;
      run.objective = options_.objective;
      run.deadline = deadline_;
      run.interrupted = options_.interrupted;
      std::vector<Node> path = run_ompl(proposals_, starts, run, iterations);
      if (path.empty()) continue;
      plan_.planner = run.planner;
      return shorten(proposals_, std::move(path), options_.objective);
    }
    const char* end = options_.interrupted()     ? "before the search was interrupted"
                      : Clock::now() < deadline_ ? "within the work a search may do"
                                                 : "within the time limit";
    // The counts are of OMPL's planners: Layers asks for no proposals and speaks for itself.
    const bool layers = options_.planner == "auto" || iterations == 0;
    plan_.reason = fmt::format("no plan found {} ({}{})", end, options_.planner,
                               layers ? "" : "; " + summary(proposals_.counts()));
    return {};
  }

  const gaits::Scene& scene_;
  const SearchOptions& options_;
  std::vector<Turn> turns_;
  Clock::time_point begin_, deadline_, next_telling_{};
  StepProposals proposals_;
  gaits::Plan plan_;
};

}  // namespace

const std::vector<std::string>& planner_names() { return gaits::planner_names(); }

Clock::time_point deadline_after(Clock::time_point begin, double limit) {
  constexpr double longest = 1e9;  // [s]: thirty years, within the range of the clock
  const std::chrono::duration<double> time(std::clamp(limit, 0.0, longest));
  return begin + std::chrono::duration_cast<Clock::duration>(time);
}

gaits::Plan search(const gaits::Scene& scene, const SearchOptions& options) {
  const auto& objectives = gaits::objective_names();
  if (std::find(objectives.begin(), objectives.end(), options.objective) == objectives.end())
    throw std::invalid_argument("unknown objective '" + options.objective + "'");
  stability::require(options.seed >= 1 && options.seed <= gaits::greatest_seed, "seed: out of range");
  stability::require(options.effort >= 0 && !std::isnan(options.time_limit),
                     "search: expected an effort >= 0 and a time limit that is a number");
  return Search(scene, options).run();
}

}  // namespace surefoot::planner
