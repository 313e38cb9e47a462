#include "stability/region_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

/// A piece of a slab as part of a cell.
struct Piece {
  std::size_t slab, index;
  double area;
};

class Cells {
 public:
  Cells(Sweep& sweep, double tolerance) : sweep_(sweep), slabs_(sweep.slabs()), tolerance_(tolerance) {}

  SweepCells collect() {
    list_pieces();
    join();
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (!sliver(pieces_[k])) members[root(k)].push_back(k);
    SweepCells found;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (sliver(pieces_[k])) found.dropped += std::abs(pieces_[k].area);
    for (const auto& [first, list] : members) {
      SweepCell cell = make(list);
      if (cell.area < least_cell * sweep_.area()) found.dropped += std::abs(cell.area);
      else found.cells.push_back(std::move(cell));
    }
    if (tolerance_ > 0) found.curves = curves();
    return found;
  }

 private:
  double length_at(const std::vector<double>& t) const { return t.back() - t.front(); }

  /// Between curves that run together.
  bool sliver(const Piece& piece) const {
    const Slab& slab = slabs_[piece.slab];
    const double width = slab.at_m[piece.index + 1] - slab.at_m[piece.index];
    return width <= Sweep::tie * length_at(slab.at_m);
  }

  void list_pieces() {
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
      first_.push_back(pieces_.size());
      for (std::size_t k = 0; k < slabs_[i].pieces(); ++k)
        pieces_.push_back({i, k, slabs_[i].integral[k + 1] - slabs_[i].integral[k]});
    }
    parent_.resize(pieces_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::size_t root(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }

  /// Pieces of neighbouring slabs are joined where they share more than a point of the line between them.
  void join() {
    for (std::size_t i = 0; i + 1 < slabs_.size(); ++i) {
      const Slab &left = slabs_[i], &right = slabs_[i + 1];
      const double least = 1e-6 * std::max(length_at(left.at_b), length_at(right.at_a));
      for (std::size_t k = 0, l = 0; k < left.pieces() && l < right.pieces();) {
        const double lo = std::max(left.at_b[k], right.at_a[l]), hi = std::min(left.at_b[k + 1], right.at_a[l + 1]);
        if (hi - lo > least && left.modes[k] == right.modes[l]) parent_[root(first_[i] + k)] = root(first_[i + 1] + l);
        if (left.at_b[k + 1] < right.at_a[l + 1]) ++k;
        else ++l;
      }
    }
  }

  SweepCell make(const std::vector<std::size_t>& list) {
    SweepCell cell;
    double greatest = -1;
    for (const std::size_t k : list) {
      const Piece& piece = pieces_[k];
      const Slab& slab = slabs_[piece.slab];
      cell.area += piece.area;
      cell.modes = slab.modes[piece.index];
      if (piece.area <= greatest) continue;
      greatest = piece.area;
      cell.inside = {0.5 * (slab.a + slab.b), 0.5 * (slab.at_m[piece.index] + slab.at_m[piece.index + 1])};
    }
    if (tolerance_ > 0) cell.rings = rings(list);
    return cell;
  }

  const Points& sampled(std::size_t slab, std::size_t curve) {
    Points& points = samples_[{slab, curve}];
    if (points.empty()) points = sweep_.sample(slabs_[slab], curve, tolerance_);
    return points;
  }

  // ---- rings ------------------------------------------------------------------------------------------------------

  /// Each piece gives two sides, each with an end at both lines of its slab. On the line between two slabs the ends of
  /// one cell, in order, belong together two by two: the cell's parity changes at each.
  struct Side {
    std::size_t slab, curve;
    std::array<std::size_t, 2> next{};  // end beyond the line at a, at b
  };

  std::vector<Points> rings(const std::vector<std::size_t>& list) {
    std::vector<Side> sides;
    std::map<std::size_t, std::vector<std::pair<double, std::size_t>>>
        borders;  // line left of slab i: t and end (2 side + at b)
    for (const std::size_t k : list) {
      const Piece& piece = pieces_[k];
      for (const std::size_t curve : {piece.index, piece.index + 1}) {
        borders[piece.slab].push_back({slabs_[piece.slab].at_a[curve], 2 * sides.size()});
        borders[piece.slab + 1].push_back({slabs_[piece.slab].at_b[curve], 2 * sides.size() + 1});
        sides.push_back({piece.slab, curve});
      }
    }
    for (auto& [line, ends] : borders) {
      std::sort(ends.begin(), ends.end());
      for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
        sides[ends[k].second / 2].next[ends[k].second % 2] = ends[k + 1].second;
        sides[ends[k + 1].second / 2].next[ends[k + 1].second % 2] = ends[k].second;
      }
    }
    return traced(sides);
  }

  std::vector<Points> traced(const std::vector<Side>& sides) {
    std::vector<Points> rings;
    std::vector<bool> done(sides.size(), false);
    for (std::size_t start = 0; start < sides.size(); ++start) {
      if (done[start]) continue;
      Points ring;
      std::size_t end = 2 * start;  // where the side is entered
      while (!done[end / 2]) {
        const Side& side = sides[end / 2];
        done[end / 2] = true;
        Points points = sampled(side.slab, side.curve);
        if (end % 2 == 1) std::reverse(points.begin(), points.end());
        ring.insert(ring.end(), points.begin(), points.end());
        end = side.next[1 - end % 2];
      }
      tidy(ring);
      if (ring.size() >= 3) rings.push_back(std::move(ring));
    }
    std::sort(rings.begin(), rings.end(),
              [](const Points& x, const Points& y) { return std::abs(signed_area(x)) > std::abs(signed_area(y)); });
    for (std::size_t k = 0; k < rings.size(); ++k)  // the outer ring counter-clockwise, holes clockwise
      if ((signed_area(rings[k]) > 0) != (k == 0)) std::reverse(rings[k].begin(), rings[k].end());
    return rings;
  }

  static double signed_area(const Points& ring) {
    double twice = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector2d p = ring[k] - ring[0], q = ring[(k + 1) % ring.size()] - ring[0];
      twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * twice;
  }

  /// Points closer than a small part of the tolerance to the one before, or on the straight line between their
  /// neighbours, are left out.
  void tidy(Points& ring) const {
    const double near = 1e-3 * tolerance_;
    Points kept;
    for (const Vector2d& p : ring)
      if (kept.empty() || (p - kept.back()).norm() > near) kept.push_back(p);
    while (kept.size() > 1 && (kept.front() - kept.back()).norm() <= near) kept.pop_back();
    Points corners;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const Vector2d& before = corners.empty() ? kept.back() : corners.back();
      const Vector2d d = kept[(k + 1) % kept.size()] - before, e = kept[k] - before;
      const double off = std::abs(d.x() * e.y() - d.y() * e.x());
      if (off > near * d.norm() || d.dot(e) < 0 || d.dot(e) > d.squaredNorm()) corners.push_back(kept[k]);
    }
    ring = std::move(corners);
  }

  // ---- boundaries -------------------------------------------------------------------------------------------------

  /// Curves are followed from slab to slab as long as they keep their name.
  std::vector<SweepCurve> curves() {
    std::vector<SweepCurve> finished;
    struct Open {
      Crossing crossing;
      double t;
      Points points;
    };
    std::vector<Open> open;
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
      const Slab& slab = slabs_[i];
      std::vector<Open> still;
      for (std::size_t k = 0; k < slab.curves.size(); ++k) {
        const double close = 1e-5 * length_at(slab.at_a);
        Open here{slab.curves[k], slab.at_b[k + 1], sampled(i, k + 1)};
        const auto before = std::find_if(open.begin(), open.end(), [&](const Open& other) {
          return other.crossing.curve == here.crossing.curve && other.crossing.enter == here.crossing.enter &&
                 std::abs(other.t - slab.at_a[k + 1]) <= close;
        });
        if (before != open.end()) {
          before->points.insert(before->points.end(), here.points.begin() + 1, here.points.end());
          here.points = std::move(before->points);
          open.erase(before);
        }
        still.push_back(std::move(here));
      }
      for (Open& ended : open) finished.push_back({ended.crossing.curve, std::move(ended.points)});
      open = std::move(still);
    }
    for (Open& ended : open) finished.push_back({ended.crossing.curve, std::move(ended.points)});
    std::sort(finished.begin(), finished.end(),
              [](const SweepCurve& x, const SweepCurve& y) { return x.curve < y.curve; });
    return finished;
  }

  Sweep& sweep_;
  const std::vector<Slab>& slabs_;
  double tolerance_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> first_, parent_;
  std::map<std::pair<std::size_t, std::size_t>, Points> samples_;
};

}  // namespace

SweepCells collect_cells(Sweep& sweep, double tolerance) { return Cells(sweep, tolerance).collect(); }

}  // namespace surefoot::stability
