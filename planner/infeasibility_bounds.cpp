#include "planner/infeasibility_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gaits/rules.hpp"
#include "gaits/verifier.hpp"
#include "stability/robust_oracle.hpp"

namespace surefoot::planner::proof {

using Eigen::Vector2d;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance(const Vector2d& point, const Piece& piece) {
  const Vector2d along = piece.b - piece.a;
  const double squared = along.squaredNorm();
  const double part = squared > 0 ? std::clamp((point - piece.a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - piece.a - part * along).norm();
}

/// Convex in the foot: greatest at an end.
double greatest_distance(const Vector2d& point, const Piece& piece) {
  return std::max((point - piece.a).norm(), (point - piece.b).norm());
}

double greatest_coordinate(const gaits::Scene& scene) {
  const auto bounds = scene.terrain.bounds();
  double greatest = std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
  for (int chain = 0; chain < scene.terrain.chain_count(); ++chain)
    greatest = std::max(greatest, scene.terrain.chain_length(chain));
  return greatest + scene.robot.reach_max;
}

}  // namespace

Piece piece_of(const terrain::Segment& segment, double begin, double end) {
  return {&segment, begin, end, segment.a + begin * segment.tangent, segment.a + end * segment.tangent};
}

Piece middle_of(const Piece& piece) {
  const double middle = (piece.begin + piece.end) / 2;
  return piece_of(*piece.segment, middle, middle);
}

namespace {

/// Directions in which discs are bounded.
constexpr int directions = 16;
const std::array<Vector2d, directions>& unit_directions() {
  static const auto all = [] {
    std::array<Vector2d, directions> made;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      made[k] = {std::cos(angle), std::sin(angle)};
    }
    return made;
  }();
  return all;
}

}  // namespace

// ---- sets of COMs -----------------------------------------------------------------------------------------------

Bounds::Bounds(const gaits::Scene& scene, const Rules& rules, const std::optional<ProofWindow>& window)
    : scene_(scene), rules_(rules), box_(scene.disturbance), goal_(scene.goal), window_(window) {
  // Four times what the verifier allows (it is allowed for reach and for a start foot at once), and the rounding of
  // coordinates and arc lengths (an ulp or two each, few operations).
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  slack_ = 4 * gaits::verifier_slack * scene.robot.reach_max + rounding * greatest_coordinate(scene);
  const bool asks_box = scene.criterion == gaits::Criterion::robust || scene.criterion == gaits::Criterion::equilibrium;
  if (!asks_box || !rules.disturbance) box_ = {0, 0};  // of other criteria only balance under gravity is taken for sure
  if (!window) return;
  const double step = 2 * (reach() + 2 * slack_), way = window->from < window->to ? step : -step;
  entry_ = std::minmax({window->from - way, window->from});
  goal_.com_x = std::minmax({window->to, window->to + way});
  goal_.com_y.reset();
}

Convex Bounds::reachable(const Piece& first, const Piece& second) const {
  Convex coms;
  const double bound = reach() + slack_;
  const Vector2d middle = (first.a + first.b) / 2;
  const double half = bound + first.length() / 2;
  for (const auto& [sx, sy] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    coms.add(middle + Vector2d(sx * half, sy * half));
  clip_to_reach(coms, first);
  clip_to_reach(coms, second);
  return coms;
}

void Bounds::clip_to_balance(Convex& coms, const Piece& first, const Piece& second) const {
  if (!rules_.balance || coms.empty()) return;
  const Vector2d middle = (first.a + first.b) / 2;
  for (const double p : {-box_.kappa, box_.kappa}) {
    const Moments moments = moments_of(first, second, {p, 1}, middle, slack_);
    if (!moments.possible) {
      coms = {};
      return;
    }
    const Vector2d normal(1, -p);
    const double margin = slack_ * (1 + std::abs(p));
    if (moments.hi < infinity) coms.clip(normal, middle, moments.hi - box_.nu + margin);
    if (moments.lo > -infinity) coms.clip(-normal, middle, -moments.lo - box_.nu + margin);
    if (coms.empty() || box_.kappa == 0) return;
  }
}

void Bounds::clip_to_point(Convex& coms, const Vector2d& point) const {
  for (const Vector2d& direction : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0), Vector2d(0, -1)})
    if (!coms.empty()) coms.clip(direction, point, slack_);
}

void Bounds::clip_to_reach(Convex& coms, const Piece& piece) const {
  for (const Vector2d& direction : unit_directions()) {
    if (coms.empty()) return;
    const double far = std::max(0.0, direction.dot(piece.b - piece.a));
    coms.clip(direction, piece.a, far + reach() + slack_);
  }
}

void Bounds::clip_to_sight(Convex& coms, const Piece& piece) const {
  if (rules_.sight && !coms.empty()) coms.clip(-piece.segment->normal, piece.segment->a, slack_);
}

namespace {

void clip_to_interval(Convex& coms, const std::optional<std::pair<double, double>>& interval, const Vector2d& axis,
                      double slack) {
  if (!interval || coms.empty()) return;
  coms.clip(axis, interval->second * axis, slack);
  if (!coms.empty()) coms.clip(-axis, interval->first * axis, slack);
}

}  // namespace

void Bounds::clip_to_goal(Convex& coms) const {
  clip_to_interval(coms, goal_.com_x, Vector2d::UnitX(), slack_);
  clip_to_interval(coms, goal_.com_y, Vector2d::UnitY(), slack_);
}

void Bounds::clip_to_entry(Convex& coms) const { clip_to_interval(coms, entry_, Vector2d::UnitX(), slack_); }

bool Bounds::outside(const Convex& coms) const {
  if (!entry_) return false;
  const auto box = coms.box();
  const double low = std::min(window_->from, goal_.com_x->first), high = std::max(window_->from, goal_.com_x->second);
  return box.max().x() < low - slack_ || box.min().x() > high + slack_;
}

// ---- COMs that meet a demand ------------------------------------------------------------------------------------

/// Whether one segment comes between every one of the COMs (corners of a convex set) and every foot on the piece: the
/// points where the lines between the corners of two convex sets on either side of a line cut it span all such points.
bool Bounds::hidden(std::span<const Vector2d> coms, const Foot& foot) const {
  const Piece& piece = foot.piece;
  // Heights are wrong by `slack` at most. Where both exceed `margin`, the cut of a leg of length up to 2 reach is wrong
  // by 2 reach slack / margin = margin / 8 at most.
  const double margin = 4 * std::sqrt(reach() * slack_);
  for (const terrain::Segment* segment : foot.around) {
    if (segment == piece.segment) continue;
    const auto height = [&](const Vector2d& point) { return segment->normal.dot(point - segment->a); };
    const double at_a = height(piece.a), at_b = height(piece.b);
    const double side = at_a > 0 ? 1 : -1;
    if (side * at_a <= margin || side * at_b <= margin) continue;
    bool all = true;
    for (std::size_t i = 0; all && i < coms.size(); ++i) {
      const double here = height(coms[i]);
      all = side * here < -margin;
      for (const auto& [end, at_end] : {std::pair(piece.a, at_a), std::pair(piece.b, at_b)}) {
        if (!all) break;
        const double cut = segment->tangent.dot(coms[i] + (end - coms[i]) * (here / (here - at_end)) - segment->a);
        all = cut > margin && cut < segment->length - margin;
      }
    }
    if (all) return true;
  }
  return false;
}

bool Bounds::excluded(const Convex& coms, const Vector2d& centre, double radius, const Demand& demand) const {
  const gaits::Robot& robot = scene_.robot;
  for (const Foot* foot : demand.feet) {
    if (distance(centre, foot->piece) - radius > robot.reach_max + slack_) return true;
    if (rules_.least_reach && greatest_distance(centre, foot->piece) + radius < robot.reach_min - slack_) return true;
  }
  if (rules_.clearance && robot.clearance > 0) {
    const double inside = robot.clearance - slack_ - radius;  // every point of the polygon is then too near
    if (inside > 0 && scene_.terrain.distance(centre, robot.clearance) < inside) return true;
  }
  if (rules_.sight)
    for (const Foot* foot : demand.seen)
      if (hidden(coms.corners(), *foot)) return true;
  return false;
}

bool Bounds::met_at(const Vector2d& com, const Demand& demand) const {
  const gaits::Robot& robot = scene_.robot;
  for (const Foot* foot : demand.feet) {
    if (distance(com, foot->piece) > robot.reach_max) return false;
    if (rules_.least_reach && greatest_distance(com, foot->piece) < robot.reach_min) return false;
  }
  if (rules_.clearance && robot.clearance > 0 && scene_.terrain.distance(com, robot.clearance) < robot.clearance)
    return false;
  if (rules_.sight)
    for (const Foot* foot : demand.seen)
      if (hidden({&com, 1}, *foot)) return false;
  return true;
}

bool Bounds::stable_at(const Vector2d& com, const Demand& demand) const {
  if (scene_.criterion != gaits::Criterion::robust || !rules_.modes) return true;
  std::array<stability::Contact, 2> contacts;
  for (std::size_t i = 0; i < 2; ++i) {
    const Piece& piece = demand.feet[i]->piece;
    contacts[i] = {piece.a, piece.segment->normal, piece.segment->surface.friction};
  }
  return stability::robust(contacts, scene_.robot.radius_of_gyration, scene_.disturbance, com);
}

namespace {

/// Both halves of a polygon, cut across its longer side.
std::pair<Convex, Convex> halves(const Convex& coms, const Vector2d& centre) {
  Vector2d low = centre, high = centre;
  for (const Vector2d& corner : coms.corners()) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  const Vector2d axis = high.x() - low.x() >= high.y() - low.y() ? Vector2d::UnitX() : Vector2d::UnitY();
  std::pair<Convex, Convex> parts{coms, coms};
  parts.first.clip(axis, centre, 0);
  parts.second.clip(-axis, centre, 0);
  return parts;
}

constexpr std::uint64_t most_polygons = 64;  ///< of one demand; what is left then counts as not excluded

}  // namespace

unsigned Bounds::may_hold(const Convex& coms, const Demand& demand, const Region& region, double finest,
                          std::uint64_t& work) const {
  unsigned found = 0, sought = (1u << region.parts()) - 1;
  if (coms.empty()) return 0;
  std::vector<Convex> open{coms};
  const std::uint64_t limit = work + most_polygons;
  while (!open.empty() && sought != 0) {
    if (++work > limit) return found | sought;
    const Convex part = open.back();
    open.pop_back();
    const Vector2d centre = part.centre();
    const double radius = part.radius_about(centre) + slack_;
    unsigned here = region.parts_in(part.box(), slack_) & sought;
    if (here == 0 || excluded(part, centre, radius, demand)) continue;
    const unsigned met = radius <= finest         ? here
                         : met_at(centre, demand) ? region.parts_in({centre, centre}, 0) & here
                                                  : 0;
    found |= met;
    sought &= ~met;
    if ((here & ~met) == 0) continue;
    auto [first, second] = halves(part, centre);
    if (!first.empty()) open.push_back(std::move(first));
    if (!second.empty()) open.push_back(std::move(second));
  }
  return found;
}

unsigned Bounds::does_hold(const Convex& coms, const Demand& demand, const Region& region, unsigned parts,
                           std::uint64_t& work) const {
  constexpr std::size_t tries = 24;
  if (coms.empty()) return 0;
  unsigned found = 0;
  std::vector<Convex> open{coms};
  for (std::size_t next = 0; next < open.size() && next < tries && found != parts; ++next) {  // widest first
    ++work;
    const Convex part = open[next];
    const Vector2d centre = part.centre();
    if ((region.parts_in(part.box(), slack_) & parts & ~found) == 0) continue;
    if (excluded(part, centre, part.radius_about(centre) + slack_, demand)) continue;
    if (met_at(centre, demand) && stable_at(centre, demand)) found |= region.parts_in({centre, centre}, 0) & parts;
    auto [first, second] = halves(part, centre);
    if (!first.empty()) open.push_back(first);
    if (!second.empty()) open.push_back(second);
  }
  return found;
}

}  // namespace surefoot::planner::proof
