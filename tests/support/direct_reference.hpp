// Verdicts and safety factors by the most direct road, for tests only: the equations of motion and the two equalities
// of each contact are solved as one linear system for the unknowns (a, alpha, f_i), once for each of the wrenches
// p, 1, q, and the box W is clipped by what is left. Nothing is taken from the closed forms of theory section 4.
//
// DirectReference<Rational> is exact for the doubles given: verdicts have no tolerance. DirectReference<double> is
// the same text in doubles, fast enough for dense sampling; wrong near a boundary only. What does not
// depend on the COM (which rows vanish identically, which rays span facets) is decided in rationals for both.
// Not covered: D = 0 of theory section 4 (the linear system is singular; such a mode counts as not feasible).
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/sample_posture.hpp"

namespace surefoot::testing {

using Rational = boost::multiprecision::mpq_rational;

template <class S>
using Row = std::array<S, 3>;  ///< the linear form G . (p, 1, q)
template <class S>
using Rows = std::vector<Row<S>>;

struct ModeStructure {
  ContactMode mode;
  bool exists = true;     ///< false: two slides whose normals lie on one line (c = 0)
  bool kinematic = true;  ///< false: two slides whose directions no twist can have; the LP is left to find that out
  unsigned dropped = 0;   ///< bit i: the kinematic row of contact i vanishes identically
};

struct FacetPair {
  int first, second;  ///< rays 2i (edge C^u of contact i) and 2i + 1 (edge C^w)
  int sign;           ///< z = sign (first x second) has every ray on its non-negative side
};

/// What depends on the contacts alone.
struct Structure {
  bool full_rank = false;  ///< the rays span the space of wrenches
  std::vector<FacetPair> facets;
  std::vector<ModeStructure> modes;
};
Structure analyse(const std::vector<Contact>& contacts, double rho);

struct ReferenceFactor {
  double value = 0;  ///< infinite where nothing limits
  std::string critical = "none";
  Wrench witness;
};

template <class S>
class DirectReference {
 public:
  explicit DirectReference(const SamplePosture& sample);

  const Structure& structure() const { return structure_; }
  bool equilibrium(const Eigen::Vector2d& com, double scale = 1) const;
  bool equilibrium_at(const Eigen::Vector2d& com, const Wrench& wrench) const;
  bool mode_feasible(const Eigen::Vector2d& com, const ModeStructure& mode, double scale = 1) const;
  bool mode_feasible_at(const Eigen::Vector2d& com, const ModeStructure& mode, const Wrench& wrench) const;
  std::vector<std::string> feasible_modes(const Eigen::Vector2d& com, double scale = 1) const;
  bool robust(const Eigen::Vector2d& com, double scale = 1) const;
  ReferenceFactor equilibrium_factor(const Eigen::Vector2d& com) const;
  ReferenceFactor mode_factor(const Eigen::Vector2d& com, const ModeStructure& mode) const;
  ReferenceFactor safety_factor(const Eigen::Vector2d& com) const;

  /// Forms that must be positive: facets z . (p, 1, q), or the strict conditions of a mode.
  Rows<S> facet_rows(const Eigen::Vector2d& com) const;
  std::optional<Rows<S>> mode_rows(const Eigen::Vector2d& com, const ModeStructure& mode) const;
  /// Undropped rows; with the third entry the index of the contact for kinematic rows, -1 for force rows.
  std::optional<std::pair<Rows<S>, std::vector<int>>> all_rows(const Eigen::Vector2d& com,
                                                               const ContactMode& mode) const;

 private:
  SamplePosture sample_;
  Structure structure_;
  explicit DirectReference(const SamplePosture& sample, Structure structure)
      : sample_(sample), structure_(std::move(structure)) {}
  friend Structure analyse(const std::vector<Contact>&, double);
};

extern template class DirectReference<double>;
extern template class DirectReference<Rational>;

/// Least safety factor on a line by sampling and golden-section refinement: an upper bound, good to about 1e-6.
struct LineReference {
  double least = 0;
  double lambda = 0;
};
LineReference least_on_line(const DirectReference<double>& reference, const Eigen::Vector2d& from,
                            const Eigen::Vector2d& to, int samples, bool equilibrium_only = false);

}  // namespace surefoot::testing
