// Piecewise-linear terrain: chains of segments with friction, footholds on them, and the geometric
// questions a gait asks of it (reach, clearance, visibility), answered through a spatial index.
// Free space is on the left of a chain's direction of travel. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace surefoot::terrain {

using Point = Eigen::Vector2d;

/// Coordinates beyond it, and segments shorter than its reciprocal, are refused: within, no square of a length
/// overflows or underflows.
constexpr double greatest_coordinate = 1e100;  // [m]

/// What one segment offers to a foot.
struct Surface {
  double friction = 0;   ///< Coulomb coefficient, >= 0
  bool foothold = true;  ///< false: no foot may stand here
};

/// A polyline as given: vertices[i] -> vertices[i + 1] is segment i with surfaces[i].
struct Chain {
  std::vector<Point> vertices;    ///< [m], at least two
  std::vector<Surface> surfaces;  ///< one per segment
};

/// One straight piece of terrain with what is derived from it.
struct Segment {
  int chain = 0;
  int index = 0;       ///< within its chain, from 0
  Point a, b;          ///< end points in the direction of travel [m]
  double s_begin = 0;  ///< arc length of a along the chain [m]
  double length = 0;   ///< [m], > 0
  Point tangent;       ///< unit, a -> b
  Point normal;        ///< unit, to the left of tangent: into free space
  Surface surface;
};

/// A point inside a segment where a foot stands, with its contact frame.
struct Foothold {
  int chain = 0;
  int segment = 0;  ///< index within the chain
  double s = 0;     ///< arc length along the chain [m]
  Point position = Point::Zero();
  Point normal = Point::UnitY();  ///< unit, into free space
  double friction = 0;
};

/// A stretch of one segment, by arc length along its chain.
struct Stretch {
  const Segment* segment = nullptr;
  double s_begin = 0, s_end = 0;  ///< [m], s_begin < s_end
};

/// What is wrong with chains given to Terrain, and where. what() says it in words, by chain and segment index.
class TerrainFault : public std::invalid_argument {
 public:
  TerrainFault(const std::string& message, int chain_, int vertex_, int other_chain_ = -1, int other_segment_ = -1)
      : std::invalid_argument(message), chain(chain_), vertex(vertex_), other_chain(other_chain_),
        other_segment(other_segment_) {}
  int chain;        ///< -1: no chain in particular
  int vertex;       ///< the vertex that is wrong, or that begins the segment that is wrong; -1: none in particular
  int other_chain;  ///< where two segments meet: the other one (the earlier); else -1
  int other_segment;
  bool chains_touch = false;  ///< one of two chains ends, or has a vertex, on the other
};

/// Told of each fault; false: the rest is of no interest. It may throw.
using TerrainFaultReport = std::function<bool(const TerrainFault&)>;

class SpatialIndex;

/// Immutable after construction; const member functions may be called from several threads. Points and lengths asked
/// about are finite, and directions not zero: asserted, as these questions are asked millions of times.
class Terrain {
 public:
  /// Throws TerrainFault (a std::invalid_argument) if there is no chain, if a chain has fewer than two vertices, a
  /// wrong number of surfaces, a non-finite number, a zero-length segment, negative friction, or if chains cross
  /// or touch themselves or each other, but for a chain that ends where it began. The first fault in the order of the
  /// chains is named. (The scene loader reports the same faults with file, line and column.)
  explicit Terrain(std::vector<Chain> chains);
  /// Reports those faults rather than throwing the first: of the chains one by one and, only where these have none,
  /// where chains cross. Nothing if a chain has a fault of its own; a terrain whose chains cross answers all the same.
  static std::optional<Terrain> examine(std::vector<Chain> chains, const TerrainFaultReport& report);
  ~Terrain();
  Terrain(Terrain&&) noexcept;
  Terrain& operator=(Terrain&&) noexcept;

  const std::vector<Segment>& segments() const { return segments_; }
  int chain_count() const { return static_cast<int>(chain_begin_.size()) - 1; }
  double chain_length(int chain) const;                ///< [m]; std::out_of_range if there is no such chain
  const Segment& segment(int chain, int index) const;  ///< std::out_of_range if there is no such segment
  bool is_closed(int chain) const;                     ///< whether it ends where it begins

  /// The foothold at arc length s [m] of a chain; nothing if there is no such chain, s is outside it, on a vertex, or
  /// on a segment where no foot may stand.
  std::optional<Foothold> foothold_at(int chain, double s) const;
  /// All footholds whose x coordinate is x [m], by increasing height. (Vertical segments have none: x does not
  /// tell a point on them.) position.x() is exactly x.
  std::vector<Foothold> footholds_at_x(double x) const;

  /// The stretches on which a foot may stand at a distance in [least, greatest] [m] from `centre`, on
  /// the side that faces it ((centre - foot) . n > 0). Order: by chain, then arc length. Stretches are open: their
  /// ends may be vertices. They are shrunk by rounding errors, so the limits hold for footholds computed on them.
  std::vector<Stretch> stretches_within(const Point& centre, double least, double greatest) const;
  /// The same into a buffer that is overwritten: allocates nothing once the buffer is large enough.
  void stretches_within(const Point& centre, double least, double greatest, std::vector<Stretch>& stretches) const;

  /// Least distance [m] from a point, or from the straight line a-b (a = b: a point), to the terrain (0 where the
  /// line meets it).
  /// Exact up to `greatest`; may return any value >= greatest when nothing is nearer than that.
  double distance(const Point& point, double greatest) const;
  double distance(const Point& a, const Point& b, double greatest) const;

  /// Whether the leg from `com` to a foothold stays in free space: it arrives from the free side and
  /// meets no other piece of terrain, not even a vertex. Decided exactly for the doubles given (the foot's position
  /// as written, a rounded point near its segment: of its own segment only the side of `com` is asked).
  /// std::out_of_range if the terrain has no such segment.
  bool leg_is_free(const Point& com, const Foothold& foot) const;
  /// Whether the straight line a-b (a = b: a point) meets the terrain (touching counts). Exact for the doubles given.
  bool blocks(const Point& a, const Point& b) const;
  /// Whether the closed circular sector of the given radius [m] about `centre`, from direction `from`
  /// counter-clockwise to direction `to` (vectors of any length but zero), contains no terrain. Equal directions make a
  /// single ray; touching is not free. Errs by rounding only, towards "not free".
  bool sector_is_free(const Point& centre, double radius, const Point& from, const Point& to) const;

  Eigen::AlignedBox2d bounds() const;

 private:
  Terrain() = default;
  int first_segment(int chain) const;  // throws std::out_of_range
  Foothold stand(const Segment& segment, double s, const Point& position) const;

  std::vector<Segment> segments_;
  std::vector<int> chain_begin_;  // first segment of each chain, and one past the last
  std::unique_ptr<SpatialIndex> index_;
};

}  // namespace surefoot::terrain
