#include "stability/region_pieces.hpp"

#include <algorithm>
#include <cmath>

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
  for (std::size_t k = 0; k < leaf.curves.size(); ++k) {
    const Coefficients& p = leaf.curves[k].graph.p;
    for (const double side : {-1.0, 1.0}) {
      Coefficients shifted = p;
      shifted[0] -= side;
      cross(shifted);
    }
    for (std::size_t l = 0; l < k; ++l) {
      Coefficients difference = p;
      for (int i = 0; i <= n; ++i) difference[i] -= leaf.curves[l].graph.p[i];
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

double end(const Leaf& leaf, int curve, double sigma) {
  if (curve < 0) return curve == Piece::side_below ? -1 : 1;
  return std::clamp(leaf.curves[curve].graph.at(sigma), -1.0, 1.0);
}

}  // namespace

double lower_end(const Leaf& leaf, const Piece& piece, double sigma) { return end(leaf, piece.lower, sigma); }
double upper_end(const Leaf& leaf, const Piece& piece, double sigma) { return end(leaf, piece.upper, sigma); }

double cut(const Leaf& leaf, int index, std::vector<Piece>& pieces) {
  const double scale = leaf.box.ds() * leaf.box.dt();
  if (leaf.curves.empty()) {
    pieces.push_back({leaf.everywhere, 4 * scale, index, 0, -1, 1, Piece::side_below, Piece::side_above});
    return 0;
  }
  const auto integral_of = [&](int curve, double from, double to) {
    if (curve < 0) return curve == Piece::side_below ? from - to : to - from;
    return integral(leaf.curves[curve].graph.p, from, to);
  };
  double dropped = 0;
  const std::vector<double> at = breaks(leaf);
  std::vector<std::pair<double, int>> order;
  for (std::size_t interval = 0; interval + 1 < at.size(); ++interval) {
    const double from = at[interval], to = at[interval + 1], middle = 0.5 * (from + to);
    if (to - from < thinnest_piece) {
      dropped += 2 * (to - from) * scale;
      continue;
    }
    order.assign({{-1.0, Piece::side_below}, {1.0, Piece::side_above}});
    for (std::size_t k = 0; k < leaf.curves.size(); ++k) {
      const double tau = leaf.curves[k].graph.at(middle);
      if (tau > -1 && tau < 1) order.push_back({tau, static_cast<int>(k)});
    }
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      const double width = order[k + 1].first - order[k].first, tau = order[k].first + 0.5 * width;
      Piece piece{leaf.everywhere, 0, index, static_cast<int>(interval), from, to, order[k].second, order[k + 1].second};
      bool inside = true;
      for (const LocalCurve& curve : leaf.curves) {
        const bool holds = curve.holds(middle, tau);
        if (curve.curve.kind == CurveId::edge) inside &= holds;
        if (curve.curve.kind != CurveId::edge && holds) piece.modes |= 1u << curve.curve.mode;
      }
      if (!inside) continue;
      piece.area = scale * (integral_of(piece.upper, from, to) - integral_of(piece.lower, from, to));
      if (width < thinnest_piece)
        dropped += std::abs(piece.area);
      else
        pieces.push_back(piece);
    }
  }
  return dropped;
}

}  // namespace surefoot::stability
