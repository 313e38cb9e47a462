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

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

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

void Convex::clip(const Vector2d& direction, const Vector2d& origin, double bound) {
  std::array<double, most> height;
  bool all_in = true;
  for (int i = 0; i < count_; ++i) {
    height[i] = direction.dot(at_[i] - origin) - bound;
    all_in &= height[i] <= 0;
  }
  if (all_in || count_ + 1 >= most) return;  // too many corners: left as it is, which contains the part wanted
  std::array<Vector2d, most> kept;
  int n = 0;
  for (int i = 0; i < count_; ++i) {
    const int next = i + 1 < count_ ? i + 1 : 0;
    if (height[i] <= 0) kept[n++] = at_[i];
    if ((height[i] < 0 && height[next] > 0) || (height[i] > 0 && height[next] < 0))
      kept[n++] = at_[i] + (at_[next] - at_[i]) * (height[i] / (height[i] - height[next]));
  }
  std::copy_n(kept.begin(), n, at_.begin());
  count_ = n;
}

Vector2d Convex::centre() const {
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& corner : corners()) sum += corner - at_[0];
  return at_[0] + sum / count_;
}

// ---- balance ----------------------------------------------------------------------------------------------------

namespace {

/// Below this sine two cone edges count as parallel: what they span is then bounded without dividing by it.
constexpr double parallel_sine = 1e-4;
/// Far above the rounding of all that is divided by at least parallel_sine (1e-12), far below what matters.
constexpr double relative_margin = 1e-7;

struct Edge {
  Vector2d direction;
  double norm = 0, lo = 0, hi = 0;  // moments of `direction` about the origin over the piece
};

class MomentRange {
 public:
  MomentRange(const Piece& first, const Piece& second, const Vector2d& force, const Vector2d& about, double rounding)
      : force_(force), rounding_(rounding) {
    lever_ = std::max({(first.a - about).norm(), (first.b - about).norm(), (second.a - about).norm(),
                       (second.b - about).norm()}) + rounding;
    add_edges(first, about, 0);
    add_edges(second, about, 2);
    for (int k = 0; k < 4; ++k)
      for (int l = k + 1; l < 4; ++l) combine(edges_[k], edges_[l]);
    if (result_.possible) squeeze(first, second);
  }
  const Moments& result() const { return result_; }

 private:
  void add_edges(const Piece& piece, const Vector2d& about, int at) {
    const Vector2d n = piece.segment->normal, t(n.y(), -n.x());
    const double mu = piece.segment->surface.friction;
    for (const double sign : {1.0, -1.0}) {
      Edge edge{n + sign * mu * t, 0, 0, 0};
      edge.norm = edge.direction.norm();
      const double at_a = cross(piece.a - about, edge.direction), at_b = cross(piece.b - about, edge.direction);
      edge.lo = std::min(at_a, at_b) - rounding_ * edge.norm;
      edge.hi = std::max(at_a, at_b) + rounding_ * edge.norm;
      edges_[at++] = edge;
    }
  }

  void include(double lo, double hi, double size) {
    const double margin = relative_margin * lever_ * size;
    if (!result_.possible) result_ = {true, infinity, -infinity};
    result_.lo = std::min(result_.lo, lo - margin);
    result_.hi = std::max(result_.hi, hi + margin);
  }

  /// force = alpha k + beta l with alpha, beta >= 0.
  void combine(const Edge& k, const Edge& l) {
    const double turn = cross(k.direction, l.direction), size = force_.norm();
    if (std::abs(turn) < parallel_sine * k.norm * l.norm) return combine_parallel(k, l, size);
    double alpha = cross(force_, l.direction) / turn, beta = cross(k.direction, force_) / turn;
    if (alpha < -relative_margin * size / k.norm || beta < -relative_margin * size / l.norm) return;
    alpha = std::max(alpha, 0.0), beta = std::max(beta, 0.0);
    include(alpha * k.lo + beta * l.lo, alpha * k.hi + beta * l.hi, size + alpha * k.norm + beta * l.norm);
  }

  /// Nearly one direction: only a force along it, shared in some way. Nearly opposite: any moment, to be safe.
  void combine_parallel(const Edge& k, const Edge& l, double size) {
    if (k.direction.dot(l.direction) < 0) return include(-infinity, infinity, 0);
    if (k.direction.dot(force_) < 0 || std::abs(cross(k.direction, force_)) > 10 * parallel_sine * k.norm * size) return;
    include(size * std::min(k.lo / k.norm, l.lo / l.norm), size * std::max(k.hi / k.norm, l.hi / l.norm), size);
  }

  bool in_cone(const Vector2d& d, int at) const {
    const Edge &right = edges_[at], &left = edges_[at + 1];
    const double tolerance = 1e-6 * d.norm();
    return cross(right.direction, d) >= -tolerance * right.norm && cross(d, left.direction) >= -tolerance * left.norm &&
           d.dot(right.direction + left.direction) > 0;
  }

  /// Forces g at the first foot and -g at the second, of any size: their moment is (first - second) x g. The extreme
  /// directions of g are edges of one cone within the other's opposite.
  void squeeze(const Piece& first, const Piece& second) {
    const auto try_direction = [&](const Vector2d& g) {
      const double tolerance = (relative_margin * lever_ + 2 * rounding_) * g.norm();
      for (const Vector2d& at : {first.a, first.b})
        for (const Vector2d& opposite : {second.a, second.b}) {
          const double moment = cross(at - opposite, g);
          if (moment > -tolerance) result_.hi = infinity;
          if (moment < tolerance) result_.lo = -infinity;
        }
    };
    for (const int k : {0, 1})
      if (in_cone(-edges_[k].direction, 2)) try_direction(edges_[k].direction);
    for (const int k : {2, 3})
      if (in_cone(-edges_[k].direction, 0)) try_direction(-edges_[k].direction);
  }

  Vector2d force_;
  double rounding_, lever_ = 0;
  std::array<Edge, 4> edges_;  // right and left edge of the first cone, of the second
  Moments result_;
};

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

Moments moments_of(const Piece& first, const Piece& second, const Vector2d& force, const Vector2d& about,
                   double rounding) {
  return MomentRange(first, second, force, about, rounding).result();
}

// ---- sets of COMs -----------------------------------------------------------------------------------------------

Bounds::Bounds(const gaits::Scene& scene, const Rules& rules) : scene_(scene), rules_(rules), box_(scene.disturbance) {
  // Twice what the verifier allows, and the rounding of coordinates and arc lengths (an ulp or two each, few operations).
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  slack_ = 2 * gaits::verifier_slack * scene.robot.reach_max + rounding * greatest_coordinate(scene);
  const bool asks_box = scene.criterion == gaits::Criterion::robust || scene.criterion == gaits::Criterion::equilibrium;
  if (!asks_box || !rules.disturbance) box_ = {0, 0};  // of other criteria only balance under gravity is taken for sure
}

Convex Bounds::stance(const Piece& first, const Piece& second) const {
  Convex coms;
  const double bound = reach() + slack_;
  const Vector2d middle = (first.a + first.b) / 2;
  const double half = bound + first.length() / 2;
  for (const auto& [sx, sy] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    coms.add(middle + Vector2d(sx * half, sy * half));
  clip_to_reach(coms, first);
  clip_to_reach(coms, second);
  if (!rules_.balance || coms.empty()) return coms;
  for (const double p : {-box_.kappa, box_.kappa}) {
    const Moments moments = moments_of(first, second, {p, 1}, middle, slack_);
    if (!moments.possible) return {};
    const Vector2d normal(1, -p);
    const double margin = slack_ * (1 + std::abs(p));
    if (moments.hi < infinity) coms.clip(normal, middle, moments.hi - box_.nu + margin);
    if (moments.lo > -infinity) coms.clip(-normal, middle, -moments.lo - box_.nu + margin);
    if (coms.empty() || box_.kappa == 0) break;
  }
  return coms;
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

void Bounds::clip_to_goal(Convex& coms) const {
  const auto clip = [&](const auto& interval, const Vector2d& axis) {
    if (!interval || coms.empty()) return;
    coms.clip(axis, interval->second * axis, slack_);
    if (!coms.empty()) coms.clip(-axis, interval->first * axis, slack_);
  };
  clip(scene_.goal.com_x, Vector2d::UnitX());
  clip(scene_.goal.com_y, Vector2d::UnitY());
}

// ---- COMs that meet a demand ------------------------------------------------------------------------------------

/// Whether one segment comes between every one of the COMs (corners of a convex set) and every foot on the piece: the
/// points where the lines between the corners of two convex sets on either side of a line cut it span all such points.
bool Bounds::hidden(std::span<const Vector2d> coms, const Foot& foot) const {
  const Piece& piece = foot.piece;
  for (const terrain::Segment* segment : foot.around) {
    if (segment == piece.segment) continue;
    const auto height = [&](const Vector2d& point) { return segment->normal.dot(point - segment->a); };
    const double at_a = height(piece.a), at_b = height(piece.b);
    const double side = at_a > 0 ? 1 : -1;
    if (side * at_a <= slack_ || side * at_b <= slack_) continue;
    bool all = true;
    for (std::size_t i = 0; all && i < coms.size(); ++i) {
      const double here = height(coms[i]);
      all = side * here < -slack_;
      for (const auto& [end, at_end] : {std::pair(piece.a, at_a), std::pair(piece.b, at_b)}) {
        if (!all) break;
        const double cut = segment->tangent.dot(coms[i] + (end - coms[i]) * (here / (here - at_end)) - segment->a);
        all = cut > slack_ && cut < segment->length - slack_;
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

double radius_about(const Convex& coms, const Vector2d& centre) {
  double squared = 0;
  for (const Vector2d& corner : coms.corners()) squared = std::max(squared, (corner - centre).squaredNorm());
  return std::sqrt(squared);
}

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

constexpr int most_parts = 256;  ///< of one polygon of COMs; then it counts as not excluded

}  // namespace

bool Bounds::may_hold(const Convex& coms, const Demand& demand, double finest) const {
  if (coms.empty()) return false;
  std::vector<Convex> open{coms};
  for (int parts = 0; !open.empty(); ++parts) {
    const Convex part = open.back();
    open.pop_back();
    const Vector2d centre = part.centre();
    const double radius = radius_about(part, centre) + slack_;
    if (excluded(part, centre, radius, demand)) continue;
    if (radius <= finest || parts >= most_parts || met_at(centre, demand)) return true;
    auto [first, second] = halves(part, centre);
    if (!first.empty()) open.push_back(std::move(first));
    if (!second.empty()) open.push_back(std::move(second));
  }
  return false;
}

bool Bounds::does_hold(const Convex& coms, const Demand& demand) const {
  constexpr int tries = 24;
  if (coms.empty()) return false;
  std::vector<Convex> open{coms};
  for (std::size_t next = 0; next < open.size() && next < tries; ++next) {  // widest first
    const Convex part = open[next];
    const Vector2d centre = part.centre();
    if (excluded(part, centre, radius_about(part, centre) + slack_, demand)) continue;
    if (met_at(centre, demand) && stable_at(centre, demand)) return true;
    auto [first, second] = halves(part, centre);
    if (!first.empty()) open.push_back(first);
    if (!second.empty()) open.push_back(second);
  }
  return false;
}

}  // namespace surefoot::planner::proof
