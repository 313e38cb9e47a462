// A rectangle cut along its curves: between the places where two curves cross or one leaves the rectangle, their order
// is fixed and the pieces between them are integrals of polynomials. In each piece the signs of the curves tell which
// modes are feasible.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stability/region_graph.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {

/// A mode that is neither feasible in all of a rectangle nor in none of it.
struct LeafMode {
  int mode = 0;
  ModeThere there;

  /// Gives the conditions, always in the same order; first D > 0, where its sign changes.
  template <class List>
  void list(List&& give) const {
    if (there.denominator) give({{CurveId::denominator, static_cast<std::int8_t>(mode), -1, -1, -1, 0}, 1});
    for (int part = 0; part <= there.denominator; ++part)
      for (const CurveCondition& condition : there.part[part].conditions()) give(condition);
  }
  /// From whether each curve's condition holds, bit k for the k-th that `list` gives: nowhere, everywhere or unknown.
  ModePart::Kind state(std::uint64_t holds) const;
  int curves() const { return there.denominator ? 1 + there.part[0].count + there.part[1].count : there.part[0].count; }
};

/// A condition on the side of one of a leaf's curves.
struct LocalCondition {
  std::uint8_t curve = 0;
  std::int8_t sign = 1;  ///< holds where sign * curve > 0; after graphs are known, sign < 0: below the graph
};

/// A rectangle with its curves, in local coordinates of which sigma may be along s or along t.
struct Leaf {
  static constexpr std::size_t most_conditions = 64;
  Rectangle box;
  std::uint32_t everywhere = 0;  ///< modes feasible in all of it: bit k for modes()[k]
  std::span<const LeafMode> modes;
  std::vector<CurvePolynomial> curves;  ///< all different
  std::vector<Graph> graphs;
  std::vector<LocalCondition> conditions;  ///< of the modes in order, then the edges of the polygon
  std::size_t of_modes = 0;                ///< how many are of the modes

  void add(const CurvePolynomial& curve, int sign);
  /// All curves as graphs over sigma, or all over tau, to about `enough`. False where that is not shown to be possible.
  bool find_graphs(double enough);

 private:
  bool find_graphs_over_sigma(double enough);
};

/// What is the same between two curves.
struct Piece {
  std::uint32_t modes = 0;      ///< feasible there
  std::uint32_t undecided = 0;  ///< modes that may be
  double area = 0;              ///< [m^2]
};

struct Areas {
  double robust = 0;  ///< without modes
  double open = 0;    ///< may be without modes
  double unsure = 0;  ///< some mode is undecided
  double loose = 0;   ///< bounds the error of all that: distances of graphs from curves, pieces too thin to be kept
};

/// Appends the pieces of a leaf that lie in the polygon.
Areas cut(const Leaf& leaf, std::vector<Piece>& pieces);

/// What is known in a rectangle is known in its parts, and more.
ModeThere narrowed(const RegionModes& modes, int mode, const ModeThere& there, const Rectangle& part);

/// Relative to a rectangle: curves as close as this are one.
constexpr double thinnest_piece = 1e-9;

}  // namespace surefoot::stability
