// A rectangle cut along its curves: between the places where two curves cross or one leaves the rectangle, their order is
// fixed and the pieces between them are integrals of polynomials. In each piece the signs of the curves tell which modes
// are feasible.
#pragma once

#include <vector>

#include "stability/region_graph.hpp"
#include "stability/region_rectangle.hpp"

namespace surefoot::stability {

/// A curve in a rectangle: the condition holds, or the polygon lies, where sign * curve > 0.
struct LocalCurve : CurveCondition {
  Graph graph;
};

/// A mode that is neither feasible in all of a rectangle nor in none of it.
struct LeafMode {
  int mode = 0;
  ModeThere there;

  /// Gives the conditions, always in the same order; first D > 0, where its sign changes.
  template <class List>
  void list(List&& give) const {
    if (there.denominator) give({{CurveId::denominator, static_cast<signed char>(mode), -1, -1, -1, 0}, 1});
    for (int part = 0; part <= there.denominator; ++part)
      for (const CurveCondition& condition : there.part[part].conditions()) give(condition);
  }
  /// From whether each curve's condition holds, bit k for the k-th that `list` gives: nowhere, everywhere or unknown.
  ModePart::Kind state(std::uint64_t holds) const;
  int curves() const { return there.denominator ? 1 + there.part[0].count + there.part[1].count : there.part[0].count; }
};

/// In local coordinates, exchanged where `swapped`: sigma along t and tau along s.
struct Leaf {
  static constexpr std::size_t most_curves = 64;
  Rectangle box;
  bool swapped = false;
  std::uint32_t everywhere = 0;  ///< modes feasible in all of it: bit k for modes()[k]
  std::vector<LeafMode> modes;
  std::vector<LocalCurve> curves;  ///< those of the modes in order, then those of the polygon
  std::size_t mode_curves = 0;
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

/// The pieces of a leaf that lie in the polygon.
Areas cut(const Leaf& leaf, std::vector<Piece>& pieces);

/// What is known in a rectangle is known in its parts, and more.
ModeThere narrowed(const RegionModes& modes, int mode, const ModeThere& there, const Rectangle& part);

/// Relative to a rectangle: curves as close as this are one.
constexpr double thinnest_piece = 1e-9;

}  // namespace surefoot::stability
