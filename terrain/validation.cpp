#include "terrain/validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "terrain/predicates.hpp"

namespace surefoot::terrain {
namespace {

std::string name_of(int chain, const char* part, int index) {
  return "chain " + std::to_string(chain) + ", " + part + " " + std::to_string(index);
}

/// Hands faults on until no more are wanted.
class Findings {
 public:
  explicit Findings(const TerrainFaultReport& report) : report_(report) {}
  void add(const std::string& message, int chain, int vertex) {
    clean_ = false;
    wanted_ = wanted_ && report_(TerrainFault(message, chain, vertex));
  }
  bool clean() const { return clean_; }
  bool wanted() const { return wanted_; }

 private:
  const TerrainFaultReport& report_;
  bool clean_ = true, wanted_ = true;
};

bool is_bounded(const Point& point) { return point.allFinite() && point.cwiseAbs().maxCoeff() <= greatest_coordinate; }

void check_vertices(const Chain& chain, int c, Findings& findings) {
  const auto& vertices = chain.vertices;
  for (std::size_t i = 0; i < vertices.size() && findings.wanted(); ++i) {
    const int vertex = static_cast<int>(i);
    if (!is_bounded(vertices[i])) {
      findings.add(name_of(c, "vertex", vertex) + ": a coordinate is " +
                       (vertices[i].allFinite() ? "too large; expected at most 1e100 m" : "not finite"),
                   c, vertex);
      continue;
    }
    if (i == 0 || !is_bounded(vertices[i - 1])) continue;
    const Point step = vertices[i] - vertices[i - 1];
    if (std::hypot(step.x(), step.y()) >= 1 / greatest_coordinate) continue;
    findings.add(name_of(c, "vertex", vertex) + (vertices[i] == vertices[i - 1]
                                                     ? " repeats the vertex before it: a segment of zero length"
                                                     : " is less than 1e-100 m from the vertex before it"),
                 c, vertex);
  }
}

void check_chain(const Chain& chain, int c, Findings& findings) {
  const std::string name = "chain " + std::to_string(c);
  if (chain.vertices.size() < 2) return findings.add(name + ": fewer than two vertices", c, -1);
  if (chain.surfaces.size() != chain.vertices.size() - 1) {
    return findings.add(name + ": expected one surface for each segment", c, -1);
  }
  check_vertices(chain, c, findings);
  for (std::size_t k = 0; k < chain.surfaces.size(); ++k) {
    const double friction = chain.surfaces[k].friction;
    if (std::isfinite(friction) && friction >= 0) continue;
    const int segment = static_cast<int>(k);
    findings.add(name_of(c, "segment", segment) + ": friction is not a number >= 0", c, segment);
  }
}

/// Whether two segments that share the vertex where `into` ends and `out` begins lie on each other there.
bool folds_back(const Segment& into, const Segment& out) {
  return orientation(into.a, into.b, out.b) == 0 && same_way(into.a - into.b, out.b - out.a);
}

/// Whether two different segments, i before j, have a point in common that they should not have.
bool collide(const Segment& i, const Segment& j, bool closed, int last) {
  if (i.chain == j.chain) {
    if (i.index + 1 == j.index && folds_back(i, j)) return true;
    const bool closes = closed && i.index == 0 && j.index == last;
    if (closes && folds_back(j, i)) return true;
    if (closes || i.index + 1 == j.index) return false;
  }
  return segments_meet(i.a, i.b, j.a, j.b);
}

/// Whether one of two segments that meet ends on the other.
bool touch(const Segment& i, const Segment& j) {
  return orientation(i.a, i.b, j.a) == 0 || orientation(i.a, i.b, j.b) == 0 || orientation(j.a, j.b, i.a) == 0 ||
         orientation(j.a, j.b, i.b) == 0;
}

}  // namespace

bool check_chains(const std::vector<Chain>& chains, const TerrainFaultReport& report) {
  Findings findings(report);
  if (chains.empty()) findings.add("there is no chain; expected at least one", -1, -1);
  std::size_t total = 0;
  for (std::size_t i = 0; i < chains.size() && findings.wanted(); ++i) {
    const int c = static_cast<int>(i);
    total += chains[i].vertices.size();
    if (total > std::numeric_limits<std::int32_t>::max() / 4) {
      findings.add("chain " + std::to_string(c) + ": too many vertices", c, -1);
      break;
    }
    check_chain(chains[i], c, findings);
  }
  return findings.clean();
}

void check_crossings(const std::vector<Segment>& segments, const std::vector<Chain>& chains, const SpatialIndex& index,
                     const TerrainFaultReport& report) {
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Segment& later = segments[k];
    const auto& vertices = chains[later.chain].vertices;
    const bool closed = vertices.front() == vertices.back();
    const int last = static_cast<int>(vertices.size()) - 2;
    const SpatialIndex::Box box = SpatialIndex::Piece{later.a, later.b}.box();
    auto first = static_cast<std::int32_t>(k);
    index.any([&](const SpatialIndex::Box& other) { return other.meets(box); },
              [&](std::int32_t id, const SpatialIndex::Piece&) {
                if (id < first && collide(segments[id], later, closed, last)) first = id;
                return false;
              });
    if (first == static_cast<std::int32_t>(k)) continue;
    const Segment& earlier = segments[first];
    TerrainFault fault(name_of(later.chain, "segment", later.index) + " crosses or touches " +
                           name_of(earlier.chain, "segment", earlier.index),
                       later.chain, later.index, earlier.chain, earlier.index);
    fault.chains_touch = later.chain != earlier.chain && touch(earlier, later);
    if (!report(fault)) return;
  }
}

}  // namespace surefoot::terrain
