// Random terrains whose vertices lie on a lattice of 1/64 m, so that integers decide exactly, by formulas of their own,
// what the library is asked. Overhangs, ceilings, closed chains and several chains all occur; contacts do not.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "terrain/terrain.hpp"

namespace surefoot::terrain::lattice {

constexpr double pitch = 1.0 / 64;  // [m], a power of two: lattice points are exact doubles

struct Vertex {
  std::int64_t x, y;
  friend bool operator==(const Vertex&, const Vertex&) = default;
};

inline Vertex operator-(Vertex a, Vertex b) { return {a.x - b.x, a.y - b.y}; }
inline std::int64_t cross(Vertex a, Vertex b) { return a.x * b.y - a.y * b.x; }
inline std::int64_t dot(Vertex a, Vertex b) { return a.x * b.x + a.y * b.y; }
inline Point to_point(Vertex v) { return {static_cast<double>(v.x) * pitch, static_cast<double>(v.y) * pitch}; }

struct Edge {
  Vertex a, b;
  int chain, index;
};

inline bool on_segment(Vertex p, Vertex a, Vertex b) {
  const Vertex along = b - a, offset = p - a;
  if (a == b) return p == a;
  return cross(along, offset) == 0 && dot(along, offset) >= 0 && dot(along, offset) <= dot(along, along);
}

/// By solving p + t d = a + u e for t and u.
inline bool meet(Vertex p, Vertex q, Vertex a, Vertex b) {
  const Vertex d = q - p, e = b - a, w = a - p;
  const std::int64_t det = cross(d, e);
  if (det == 0) return on_segment(p, a, b) || on_segment(q, a, b) || on_segment(a, p, q) || on_segment(b, p, q);
  const std::int64_t sign = det > 0 ? 1 : -1, t = cross(w, e) * sign, u = cross(w, d) * sign;
  return t >= 0 && t <= det * sign && u >= 0 && u <= det * sign;
}

struct LatticeTerrain {
  std::vector<std::vector<Vertex>> chains;
  std::vector<Edge> edges;
  std::vector<std::vector<Surface>> surfaces;

  Terrain build() const {
    std::vector<Chain> result(chains.size());
    for (std::size_t c = 0; c < chains.size(); ++c) {
      for (const Vertex v : chains[c]) result[c].vertices.push_back(to_point(v));
      result[c].surfaces = surfaces[c];
    }
    return Terrain(std::move(result));
  }
};

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::int64_t integer(std::int64_t least, std::int64_t greatest) {
    return std::uniform_int_distribution<std::int64_t>(least, greatest)(random_);
  }
  double real(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }
  Vertex vertex(std::int64_t extent) { return {integer(-extent, extent), integer(-extent, extent)}; }

  /// Even vertex coordinates, so that the middle of every segment is a lattice point.
  LatticeTerrain terrain(int chains, int longest, std::int64_t extent, std::int64_t step) {
    LatticeTerrain result;
    for (int c = 0; c < chains; ++c) {
      std::vector<Vertex> chain;
      const int wanted = static_cast<int>(integer(1, longest));
      for (int attempt = 0; attempt < 20 * wanted && static_cast<int>(chain.size()) <= wanted; ++attempt) {
        if (chain.empty()) {
          chain.push_back({2 * integer(-extent / 2, extent / 2), 2 * integer(-extent / 2, extent / 2)});
          continue;
        }
        const std::int64_t dx = 2 * integer(-step / 2, step / 2), dy = 2 * integer(-step / 2, step / 2);
        Vertex next{chain.back().x + dx, chain.back().y + dy};
        if (chain.size() > 2 && integer(0, 5) == 0) next = chain.front();
        if (!is_legal(result, chain, next)) continue;
        const bool closes = next == chain.front();
        chain.push_back(next);
        if (closes) break;
      }
      if (chain.size() >= 2) add(result, std::move(chain));
    }
    if (result.chains.empty()) add(result, {{0, 0}, {2, 0}});
    return result;
  }

 private:
  static bool is_legal(const LatticeTerrain& terrain, const std::vector<Vertex>& chain, Vertex next) {
    const Vertex last = chain.back();
    if (next == last) return false;
    for (const Edge& edge : terrain.edges) {
      if (meet(last, next, edge.a, edge.b)) return false;
    }
    for (std::size_t i = 0; i + 2 < chain.size(); ++i) {
      const bool closes = i == 0 && next == chain.front();
      const bool bad = closes ? on_segment(chain[1], last, next) || on_segment(last, chain[0], chain[1])
                              : meet(last, next, chain[i], chain[i + 1]);
      if (bad) return false;
    }
    if (chain.size() < 2) return true;
    const Vertex before = chain[chain.size() - 2];
    return !(cross(before - last, next - last) == 0 && dot(before - last, next - last) > 0);
  }

  void add(LatticeTerrain& terrain, std::vector<Vertex> chain) {
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      terrain.edges.push_back({chain[i], chain[i + 1], static_cast<int>(terrain.chains.size()), static_cast<int>(i)});
      surfaces.push_back({real(0, 1), integer(0, 7) != 0});
    }
    terrain.surfaces.push_back(std::move(surfaces));
    terrain.chains.push_back(std::move(chain));
  }

  std::mt19937 random_;
};

}  // namespace surefoot::terrain::lattice
