#include "stability/region_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace surefoot::stability {
namespace {

constexpr int n = Graph::degree;
using Coefficients = std::array<double, n + 1>;

double value_at(const Coefficients& p, double x) {
  double value = 0;
  for (int k = n; k >= 0; --k) value = value * x + p[k];
  return value;
}

/// p(middle + half x).
Coefficients about(Coefficients p, double middle, double half) {
  for (int i = 0; i < n; ++i)
    for (int k = n - 1; k >= i; --k) p[k] += middle * p[k + 1];
  double power = 1;
  for (double& c : p) c *= power, power *= half;
  return p;
}

/// Roots of p in [-1, 1] as from + (to - from) (1 + x) / 2; pieces of the interval that are not clear are halved.
void find_roots(const Coefficients& p, double from, double to, std::vector<double>& roots) {
  constexpr double narrow = 1e-6;  // a root that is not simple is taken for one in the middle
  double rest = 0, bend = 0;
  for (int k = 1; k <= n; ++k) rest += std::abs(p[k]);
  for (int k = 2; k <= n; ++k) bend += k * std::abs(p[k]);
  if (std::abs(p[0]) > rest || rest < 1e-3 * thinnest_piece) return;
  if (to - from < narrow) {
    roots.push_back(0.5 * (from + to));
    return;
  }
  if (std::abs(p[1]) > bend) {
    double low = -1, high = 1;
    const bool rising = p[1] > 0;
    if ((value_at(p, low) > 0) == (value_at(p, high) > 0)) return;
    double x = std::clamp(-p[0] / p[1], -1.0, 1.0);
    for (int k = 0; k < 60 && high - low > 1e-14; ++k) {  // Newton's method within brackets
      const double value = value_at(p, x);
      ((value > 0) == rising ? high : low) = x;
      double slope = 0;
      for (int j = n; j >= 1; --j) slope = slope * x + j * p[j];
      const double next = x - value / slope;
      if (std::abs(next - x) < 1e-15) break;
      x = next > low && next < high ? next : 0.5 * (low + high);
    }
    roots.push_back(from + 0.5 * (to - from) * (1 + x));
    return;
  }
  const double middle = 0.5 * (from + to);
  find_roots(about(p, -0.5, 0.5), from, middle, roots);
  find_roots(about(p, 0.5, 0.5), middle, to, roots);
}

/// Where the order of curves, and of the sides, may change; with both ends.
std::vector<double> breaks(const Leaf& leaf) {
  std::vector<double> at{-1, 1};
  const auto cross = [&](Coefficients p) { find_roots(p, -1, 1, at); };
  for (std::size_t k = 0; k < leaf.graphs.size(); ++k) {
    const Coefficients& p = leaf.graphs[k].p;
    for (const double side : {-1.0, 1.0}) {
      Coefficients shifted = p;
      shifted[0] -= side;
      cross(shifted);
    }
    for (std::size_t l = 0; l < k; ++l) {
      Coefficients difference = p;
      for (int i = 0; i <= n; ++i) difference[i] -= leaf.graphs[l].p[i];
      cross(difference);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

double integral(const Coefficients& p, double from, double to) {
  double high = 0, low = 0;
  for (int k = n; k >= 0; --k) {
    high = high * to + p[k] / (k + 1);
    low = low * from + p[k] / (k + 1);
  }
  return high * to - low * from;
}

ModePart::Kind state_of(const ModePart& part, std::uint64_t holds) {
  if (part.kind != ModePart::by_curves) return part.kind;
  const std::uint64_t all = (std::uint64_t{1} << part.count) - 1;
  return (holds & all) == all ? ModePart::everywhere : ModePart::nowhere;
}

/// Without the conditions whose sign is the same on all of `box`.
ModePart narrowed(const RegionModes& modes, const ModePart& given, const Rectangle& box) {
  if (given.kind != ModePart::by_curves) return given;
  ModePart part;
  for (const CurveCondition& condition : given.conditions()) {
    const int there = condition.sign * sign_there(curve_there(modes, condition.curve, box));
    if (there < 0) return {ModePart::nowhere, 0, {}};
    if (there == 0) part.condition[part.count++] = condition;
  }
  part.kind = part.count == 0 ? ModePart::everywhere : ModePart::by_curves;
  return part;
}

/// The pieces of a leaf in intervals of sigma.
class Cut {
 public:
  Cut(const Leaf& leaf, std::vector<Piece>& pieces)
      : leaf_(leaf), pieces_(pieces), scale_(leaf.box.ds() * leaf.box.dt()) {}

  void interval(double from, double to) {
    const double middle = 0.5 * (from + to);
    std::uint64_t above = 0;  // bit k: the piece lies above curve k
    order_.clear();
    for (std::size_t k = 0; k < leaf_.graphs.size(); ++k) {
      const double tau = leaf_.graphs[k].at(middle);
      if (tau > -1 && tau < 1) order_.push_back({tau, static_cast<int>(k)});
      if (tau <= -1) above |= std::uint64_t{1} << k;
    }
    std::sort(order_.begin(), order_.end());
    double below = from - to, tau = -1;  // integral and middle of the lower end
    for (std::size_t k = 0; k <= order_.size(); ++k) {
      const bool last = k == order_.size();
      const double upper = last ? to - from : integral(leaf_.graphs[order_[k].second].p, from, to);
      const double next = last ? 1 : order_[k].first;
      add(above, scale_ * (upper - below), next - tau);
      if (!last) above |= std::uint64_t{1} << order_[k].second;
      below = upper, tau = next;
    }
  }
  void thin(double width) { areas_.loose += 2 * width * scale_; }
  void loosen(double distance) { areas_.loose += 2 * distance * scale_; }
  const Areas& areas() const { return areas_; }

 private:
  bool holds(std::size_t condition, std::uint64_t above) const {
    const LocalCondition& c = leaf_.conditions[condition];
    return ((above >> c.curve) & 1) == (c.sign > 0);
  }

  void add(std::uint64_t above, double area, double width) {
    for (std::size_t k = leaf_.of_modes; k < leaf_.conditions.size(); ++k)
      if (!holds(k, above)) return;
    if (width < thinnest_piece) {
      areas_.loose += std::abs(area);
      return;
    }
    std::uint64_t held = 0;
    for (std::size_t k = 0; k < leaf_.of_modes; ++k) held |= std::uint64_t{holds(k, above)} << k;
    Piece piece{leaf_.everywhere, 0, area};
    for (const LeafMode& mode : leaf_.modes) {
      const ModePart::Kind state = mode.state(held);
      if (state == ModePart::everywhere) piece.modes |= 1u << mode.mode;
      if (state == ModePart::unknown) piece.undecided |= 1u << mode.mode;
      held >>= mode.curves();
    }
    if (piece.modes == 0) (piece.undecided == 0 ? areas_.robust : areas_.open) += area;
    if (piece.undecided != 0) areas_.unsure += area;
    pieces_.push_back(piece);
  }

  const Leaf& leaf_;
  std::vector<Piece>& pieces_;
  double scale_;
  std::vector<std::pair<double, int>> order_;
  Areas areas_;
};

/// The factor by which f is g, and how far it may be off anywhere on the rectangle; 0 if it is not.
double factor(const CurvePolynomial& f, const CurvePolynomial& g, double& off) {
  constexpr double same = 1e-11;  // relative: rounding of coefficients
  if (f.degree != g.degree) return 0;
  const int size = (f.degree + 1) * (f.degree + 2) / 2;
  int greatest = 0;
  for (int k = 1; k < 3; ++k)  // a graph is steep in one coordinate or the other, or constant
    if (std::abs(g.f.c[k]) > std::abs(g.f.c[greatest])) greatest = k;
  const double ratio = f.f.c[greatest] / g.f.c[greatest], allowed = same * std::abs(f.f.c[greatest]);
  off = f.error + std::abs(ratio) * g.error;
  for (int k = 0; k < size; ++k) {
    const double apart = std::abs(f.f.c[k] - ratio * g.f.c[k]);
    if (!(apart <= allowed)) return 0;
    off += apart;
  }
  return ratio;
}

}  // namespace

void Leaf::add(const CurvePolynomial& curve, int sign) {
  for (std::size_t k = 0; k < curves.size(); ++k) {
    double off = 0;
    const double ratio = factor(curve, curves[k], off);
    if (ratio == 0) continue;
    curves[k].error = std::max(curves[k].error, off / std::abs(ratio));
    conditions.push_back({static_cast<std::uint8_t>(k), static_cast<std::int8_t>(ratio > 0 ? sign : -sign)});
    return;
  }
  conditions.push_back({static_cast<std::uint8_t>(curves.size()), static_cast<std::int8_t>(sign)});
  curves.push_back(curve);
}

bool Leaf::find_graphs(double enough) {
  if (conditions.size() > most_conditions) return false;
  int level = 0;
  for (const CurvePolynomial& curve : curves) {
    const double along = std::abs(curve.f.c[place(1, 0)]), across = std::abs(curve.f.c[place(0, 1)]);
    level += along < across ? 1 : along > across ? -1 : 0;
  }
  const auto exchange = [this] {
    for (CurvePolynomial& curve : curves) curve = swapped(curve);
  };
  if (level < 0) exchange();
  if (find_graphs_over_sigma(enough)) return true;
  exchange();
  return find_graphs_over_sigma(enough);
}

bool Leaf::find_graphs_over_sigma(double enough) {
  if (!std::all_of(curves.begin(), curves.end(), may_be_graph)) return false;
  graphs.clear();
  for (const CurvePolynomial& curve : curves) {
    const std::optional<Graph> graph = graph_of(curve, enough);
    if (!graph) return false;
    graphs.push_back(*graph);
  }
  for (LocalCondition& condition : conditions)
    if (graphs[condition.curve].rising < 0) condition.sign = static_cast<std::int8_t>(-condition.sign);
  return true;
}

ModePart::Kind LeafMode::state(std::uint64_t holds) const {
  if (!there.denominator) return state_of(there.part[0], holds);
  const bool plus = holds & 1;
  return state_of(there.part[plus ? 0 : 1], holds >> (plus ? 1 : 1 + there.part[0].count));
}

ModeThere narrowed(const RegionModes& modes, int mode, const ModeThere& there, const Rectangle& part) {
  ModeThere result = there;
  if (there.denominator) {
    const CurveId id{CurveId::denominator, static_cast<std::int8_t>(mode), -1, -1, -1, 0};
    const int sign = sign_there(curve_there(modes, id, part));
    result.denominator = sign == 0;
    if (sign < 0) result.part[0] = there.part[1];
  }
  for (int k = 0; k <= result.denominator; ++k) result.part[k] = narrowed(modes, result.part[k], part);
  result.summarise();
  return result;
}

Areas cut(const Leaf& leaf, std::vector<Piece>& pieces) {
  Cut cut(leaf, pieces);
  for (const Graph& graph : leaf.graphs) cut.loosen(graph.error);
  const std::vector<double> at = breaks(leaf);
  for (std::size_t k = 0; k + 1 < at.size(); ++k)
    if (at[k + 1] - at[k] < thinnest_piece) cut.thin(at[k + 1] - at[k]);
    else cut.interval(at[k], at[k + 1]);
  return cut.areas();
}

}  // namespace surefoot::stability
