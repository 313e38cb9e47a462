#include "terrain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "terrain/spatial_index.hpp"
#include "terrain/validation.hpp"

namespace surefoot::terrain {
namespace {

Segment make_segment(const Chain& chain, int c, int index, double s_begin) {
  Segment segment;
  segment.chain = c;
  segment.index = index;
  segment.a = chain.vertices[index];
  segment.b = chain.vertices[index + 1];
  segment.s_begin = s_begin;
  const Point step = segment.b - segment.a;
  segment.length = std::hypot(step.x(), step.y());
  segment.tangent = step / segment.length;
  segment.normal = Point(0.0 - segment.tangent.y(), segment.tangent.x());  // level ground: 0, not -0
  segment.surface = chain.surfaces[index];
  return segment;
}

std::unique_ptr<SpatialIndex> make_index(const std::vector<Segment>& segments) {
  std::vector<SpatialIndex::Piece> pieces;
  pieces.reserve(segments.size());
  for (const Segment& segment : segments) pieces.push_back({segment.a, segment.b});
  return std::make_unique<SpatialIndex>(pieces);
}

}  // namespace

Terrain::Terrain(std::vector<Chain> chains)
    : Terrain(*examine(std::move(chains), [](const TerrainFault& fault) -> bool { throw fault; })) {}

std::optional<Terrain> Terrain::examine(std::vector<Chain> chains, const TerrainFaultReport& report) {
  if (!check_chains(chains, report)) return std::nullopt;
  Terrain terrain;
  std::size_t total = 0;
  for (const Chain& chain : chains) total += chain.surfaces.size();
  auto& segments = terrain.segments_;
  segments.reserve(total);
  terrain.chain_begin_.push_back(0);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    long double s = 0;  // so that a million segments do not add their rounding errors
    for (std::size_t i = 0; i < chains[c].surfaces.size(); ++i) {
      segments.push_back(make_segment(chains[c], static_cast<int>(c), static_cast<int>(i), static_cast<double>(s)));
      s += segments.back().length;
    }
    terrain.chain_begin_.push_back(static_cast<int>(segments.size()));
  }
  terrain.index_ = make_index(segments);
  check_crossings(segments, chains, *terrain.index_, report);
  return terrain;
}

Terrain::~Terrain() = default;
Terrain::Terrain(Terrain&&) noexcept = default;
Terrain& Terrain::operator=(Terrain&&) noexcept = default;

int Terrain::first_segment(int chain) const {
  if (chain < 0 || chain >= chain_count()) throw std::out_of_range("no chain " + std::to_string(chain));
  return chain_begin_[chain];
}

double Terrain::chain_length(int chain) const {
  const Segment& first = segments_[first_segment(chain)];
  const Segment& last = segments_[chain_begin_[first.chain + 1] - 1];
  return last.s_begin + last.length;
}

const Segment& Terrain::segment(int chain, int index) const {
  const int begin = first_segment(chain);
  if (index < 0 || index >= chain_begin_[chain + 1] - begin) {
    throw std::out_of_range("no segment " + std::to_string(index) + " in chain " + std::to_string(chain));
  }
  return segments_[begin + index];
}

bool Terrain::is_closed(int chain) const {
  const int first = first_segment(chain);  // throws, before the other end is looked for
  return segments_[first].a == segments_[chain_begin_[chain + 1] - 1].b;
}

Foothold Terrain::stand(const Segment& segment, double s, const Point& position) const {
  return {segment.chain, segment.index, s, position, segment.normal, segment.surface.friction};
}

std::optional<Foothold> Terrain::foothold_at(int chain, double s) const {
  if (chain < 0 || chain >= chain_count()) return std::nullopt;
  const auto begin = segments_.begin() + chain_begin_[chain], end = segments_.begin() + chain_begin_[chain + 1];
  const auto after = std::upper_bound(begin, end, s, [](double at, const Segment& g) { return at < g.s_begin; });
  if (after == begin) return std::nullopt;
  const Segment& segment = *(after - 1);
  const double along = s - segment.s_begin;
  if (!segment.surface.foothold || !(along > 0 && along < segment.length)) return std::nullopt;
  const Point position = segment.a + (along / segment.length) * (segment.b - segment.a);
  if (position == segment.a || position == segment.b) return std::nullopt;  // a vertex, by rounding
  return stand(segment, s, position);
}

std::vector<Foothold> Terrain::footholds_at_x(double x) const {
  std::vector<Foothold> found;
  index_->any([x](const SpatialIndex::Box& box) { return box.min_x <= x && x <= box.max_x; },
              [&](std::int32_t id, const SpatialIndex::Piece& piece) {
                const Segment& segment = segments_[id];
                const double from = piece.a.x(), to = piece.b.x();
                if (!segment.surface.foothold || !(std::min(from, to) < x && x < std::max(from, to))) return false;
                const double part = (x - from) / (to - from);
                const double along = part * segment.length;
                const double s = segment.s_begin + along;
                if (!(along > 0 && along < segment.length && s > segment.s_begin)) return false;
                found.push_back(stand(segment, s, Point(x, piece.a.y() + part * (piece.b.y() - piece.a.y()))));
                return false;
              });
  std::sort(found.begin(), found.end(), [](const Foothold& l, const Foothold& r) {
    return std::make_tuple(l.position.y(), l.chain, l.s) < std::make_tuple(r.position.y(), r.chain, r.s);
  });
  return found;
}

Eigen::AlignedBox2d Terrain::bounds() const {
  const SpatialIndex::Box& box = index_->bounds();
  return {Point(box.min_x, box.min_y), Point(box.max_x, box.max_y)};
}

}  // namespace surefoot::terrain
