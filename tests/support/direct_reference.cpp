#include "tests/support/direct_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::testing {
namespace {

template <class S>
using Pair = std::array<S, 2>;

template <class S>
S dot(const Row<S>& a, const Row<S>& b) {
  return S(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class S>
Row<S> cross(const Row<S>& a, const Row<S>& b) {
  return {S(a[1] * b[2] - a[2] * b[1]), S(a[2] * b[0] - a[0] * b[2]), S(a[0] * b[1] - a[1] * b[0])};
}
template <class S>
S absolute(const S& value) {
  return value < 0 ? S(-value) : value;
}
template <class S>
bool vanishes(const Row<S>& row) {
  return row[0] == 0 && row[1] == 0 && row[2] == 0;
}

// The contact i in the COM frame.
template <class S>
struct Local {
  Pair<S> r, n, t, cu, cw;
  Local(const Contact& contact, const Eigen::Vector2d& com)
      : r{S(S(contact.position.x()) - S(com.x())), S(S(contact.position.y()) - S(com.y()))},
        n{S(contact.normal.x()), S(contact.normal.y())}, t{n[1], S(-n[0])} {
    const S mu(contact.friction);
    for (int k = 0; k < 2; ++k) cu[k] = S(n[k] + mu * t[k]), cw[k] = S(n[k] - mu * t[k]);
  }
  Row<S> wrench(const Pair<S>& d) const { return {d[0], d[1], S(r[0] * d[1] - r[1] * d[0])}; }
};

// Gauss elimination with the largest pivot; three right-hand sides. False where the system is singular.
template <class S>
bool solve(std::vector<std::vector<S>>& system) {
  const std::size_t n = system.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row) {
      if (absolute(system[row][column]) > absolute(system[pivot][column])) pivot = row;
    }
    if (system[pivot][column] == 0) return false;
    std::swap(system[pivot], system[column]);
    for (std::size_t row = 0; row < n; ++row) {
      if (row == column || system[row][column] == 0) continue;
      const S factor = S(system[row][column] / system[column][column]);
      for (std::size_t k = column; k < n + 3; ++k) system[row][k] -= S(factor * system[column][k]);
    }
  }
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t k = n; k < n + 3; ++k) system[row][k] /= system[row][row];
  }
  return true;
}

template <class S>
using Point = Pair<S>;  // (p, q)
template <class S>
S value_at(const Row<S>& row, const Point<S>& point) {
  return S(row[0] * point[0] + row[1] + row[2] * point[1]);
}

// Rounding slack of a row at a point computed from rows, relative to the row's terms; none in rationals.
template <class S>
S slack(const Row<S>& row, const Point<S>& point) {
  if constexpr (std::is_same_v<S, double>) {
    constexpr double relative = 1e-11;
    return relative * (std::abs(row[0] * point[0]) + std::abs(row[1]) + std::abs(row[2] * point[1]));
  } else {
    (void)row, (void)point;
    return S(0);
  }
}

// Clips the closed box by the closed half-planes. A point that satisfies all rows strictly exists iff every row is
// positive at some vertex of the result (then it is positive at the mean of the vertices).
template <class S>
bool strictly_feasible(const Rows<S>& rows, const S& p_max, const S& q_max) {
  std::vector<Point<S>> polygon{{S(-p_max), S(-q_max)}, {p_max, S(-q_max)}, {p_max, q_max}, {S(-p_max), q_max}};
  for (const Row<S>& row : rows) {
    std::vector<Point<S>> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point<S>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const S va = value_at(row, a), vb = value_at(row, b);
      if (va >= 0) kept.push_back(a);
      if ((va > 0 && vb < 0) || (va < 0 && vb > 0)) {
        const S share = S(va / (va - vb));
        kept.push_back({S(a[0] + share * (b[0] - a[0])), S(a[1] + share * (b[1] - a[1]))});
      }
    }
    polygon = kept;
    if (polygon.empty()) return false;
  }
  return std::all_of(rows.begin(), rows.end(), [&](const Row<S>& row) {
    return std::any_of(polygon.begin(), polygon.end(),
                       [&](const Point<S>& v) { return value_at(row, v) > slack(row, v); });
  });
}

// min s with all rows >= 0 somewhere in sW: a linear program in (p, q, s) whose optimum is at the origin, or where a
// row meets a diagonal of W, or where two rows meet. Every such candidate is tried.
template <class S>
std::optional<std::pair<S, Point<S>>> least_scale(const Rows<S>& rows, const S& kappa, const S& nu) {
  std::optional<std::pair<S, Point<S>>> best;
  const auto offer = [&](const S& scale, const Point<S>& point) {
    if (best && !(scale < best->first)) return;
    for (const Row<S>& row : rows) {
      if (value_at(row, point) < -slack(row, point)) return;
    }
    best = {scale, point};
  };
  offer(S(0), {S(0), S(0)});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row<S>& a = rows[i];
    for (const Point<S>& corner : {Point<S>{kappa, nu}, {S(-kappa), nu}, {kappa, S(-nu)}, {S(-kappa), S(-nu)}}) {
      const S slope = S(a[0] * corner[0] + a[2] * corner[1]);
      if (slope == 0) continue;
      const S scale = S(-a[1] / slope);
      if (scale > 0) offer(scale, {S(scale * corner[0]), S(scale * corner[1])});
    }
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const Row<S>& b = rows[j];
      const S determinant = S(a[0] * b[2] - a[2] * b[0]);
      if (kappa == 0 || nu == 0 || determinant == 0) continue;
      const Point<S> point{S((a[2] * b[1] - a[1] * b[2]) / determinant), S((a[1] * b[0] - a[0] * b[1]) / determinant)};
      const S u = S(absolute(point[0]) / kappa), v = S(absolute(point[1]) / nu);
      offer(u > v ? u : v, point);
    }
  }
  return best;
}

template <class S>
std::vector<Row<S>> rays_of(const std::vector<Contact>& contacts, const Eigen::Vector2d& com) {
  std::vector<Row<S>> rays;
  for (const Contact& contact : contacts) {
    const Local<S> local(contact, com);
    rays.push_back(local.wrench(local.cu));
    rays.push_back(local.wrench(local.cw));
  }
  return rays;
}

double to_double(double value) { return value; }
double to_double(const Rational& value) { return value.convert_to<double>(); }

void find_facets(const std::vector<Row<Rational>>& rays, Structure& structure) {
  const int count = static_cast<int>(rays.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const Row<Rational> z = cross(rays[i], rays[j]);
      if (vanishes(z)) continue;
      bool above = false, below = false;
      for (const Row<Rational>& ray : rays) {
        const Rational side = dot(z, ray);
        above = above || side > 0;
        below = below || side < 0;
      }
      structure.full_rank = structure.full_rank || above || below;
      if (!below) structure.facets.push_back({i, j, 1});
      if (!above) structure.facets.push_back({i, j, -1});
    }
  }
}

// Two slides leave one twist, c = N_i x N_j, up to its sign: both asked directions must agree with c or both with -c.
void slide_kinematics(const std::vector<Contact>& contacts, const Eigen::Vector2d& com, ModeStructure& entry) {
  std::vector<Row<Rational>> normals, directions;
  for (int i = 0; i < entry.mode.contacts; ++i) {
    const ContactState state = entry.mode.at[i];
    if (state == ContactState::breaks || state == ContactState::rolls) continue;
    const Local<Rational> local(contacts[i], com);
    const Pair<Rational> backwards{Rational(-local.t[0]), Rational(-local.t[1])};
    normals.push_back(local.wrench(local.n));
    directions.push_back(local.wrench(state == ContactState::slides_along ? local.t : backwards));
  }
  if (normals.size() < 2) return;
  const Row<Rational> c = cross(normals[0], normals[1]);
  entry.exists = !vanishes(c);
  entry.kinematic = dot(directions[0], c) * dot(directions[1], c) >= 0;
}

}  // namespace

Structure analyse(const std::vector<Contact>& contacts, double rho) {
  // Which rows vanish identically does not depend on the COM; this one is as good as any, and off every round number.
  const Eigen::Vector2d com(0.318309886 + contacts[0].position.x(), 0.693147181 + contacts[0].position.y());
  Structure structure;
  const std::vector<Row<Rational>> rays = rays_of<Rational>(contacts, com);
  find_facets(rays, structure);
  SamplePosture sample;
  sample.contacts = contacts;
  sample.rho = rho;
  const DirectReference<Rational> bare(sample, Structure{});
  for (const ContactMode& mode : non_static_modes(static_cast<int>(contacts.size()))) {
    ModeStructure entry;
    entry.mode = mode;
    slide_kinematics(contacts, com, entry);
    if (const auto rows = bare.all_rows(com, mode); entry.exists && rows) {
      for (std::size_t k = 0; k < rows->first.size(); ++k) {
        if (rows->second[k] >= 0 && vanishes(rows->first[k])) entry.dropped |= 1u << rows->second[k];
      }
    }
    structure.modes.push_back(entry);
  }
  return structure;
}

template <class S>
DirectReference<S>::DirectReference(const SamplePosture& sample)
    : sample_(sample), structure_(analyse(sample.contacts, sample.rho)) {}

template <class S>
Rows<S> DirectReference<S>::facet_rows(const Eigen::Vector2d& com) const {
  const std::vector<Row<S>> rays = rays_of<S>(sample_.contacts, com);
  Rows<S> rows;
  for (const FacetPair& facet : structure_.facets) {
    Row<S> z = cross(rays[facet.first], rays[facet.second]);
    if (facet.sign < 0) z = {S(-z[0]), S(-z[1]), S(-z[2])};
    rows.push_back(z);
  }
  return rows;
}

// Unknowns: a_x, a_y, alpha, then the force of every contact that does not break. Right-hand sides: w = -(p, 1, q).
template <class S>
std::optional<std::pair<Rows<S>, std::vector<int>>> DirectReference<S>::all_rows(const Eigen::Vector2d& com,
                                                                                 const ContactMode& mode) const {
  std::vector<Local<S>> local;
  std::vector<int> force_at(mode.contacts, -1);
  int unknowns = 3;
  for (int i = 0; i < mode.contacts; ++i) {
    local.emplace_back(sample_.contacts[i], com);
    if (mode.at[i] != ContactState::breaks) force_at[i] = unknowns, unknowns += 2;
  }
  std::vector<std::vector<S>> system(unknowns, std::vector<S>(unknowns + 3, S(0)));
  const S rho(sample_.rho);
  system[0][0] = system[1][1] = 1;
  system[2][2] = rho * rho;
  for (int k = 0; k < 3; ++k) system[k][unknowns + k] = -1;
  int equation = 3;
  // The acceleration of the body point at x_i along d is d . a + (r_i x d) alpha.
  const auto acceleration = [&](std::vector<S>& row, const Local<S>& at, const Pair<S>& d) {
    const Row<S> covector = at.wrench(d);
    for (int k = 0; k < 3; ++k) row[k] = covector[k];
  };
  for (int i = 0; i < mode.contacts; ++i) {
    if (force_at[i] < 0) continue;
    for (int k = 0; k < 2; ++k) {
      const Pair<S> axis{S(k == 0 ? 1 : 0), S(k == 0 ? 0 : 1)};
      const Row<S> wrench = local[i].wrench(axis);
      for (int m = 0; m < 3; ++m) system[m][force_at[i] + k] = S(-wrench[m]);
    }
    acceleration(system[equation++], local[i], local[i].n);
    if (mode.at[i] == ContactState::rolls) {
      acceleration(system[equation++], local[i], local[i].t);
    } else {  // the force lies on the edge that opposes the sliding [OR-P, Table I]
      const Pair<S>& edge = mode.at[i] == ContactState::slides_along ? local[i].cw : local[i].cu;
      system[equation][force_at[i]] = edge[1];
      system[equation++][force_at[i] + 1] = S(-edge[0]);
    }
  }
  if (!solve(system)) return std::nullopt;
  Row<S> solution[9];
  for (int u = 0; u < unknowns; ++u) {
    for (int k = 0; k < 3; ++k) solution[u][k] = system[u][unknowns + k];
  }
  std::pair<Rows<S>, std::vector<int>> result;
  const auto combine = [&](int first, int count, const S* factors, int sign, int contact) {
    Row<S> row{S(0), S(0), S(0)};
    for (int u = 0; u < count; ++u) {
      for (int k = 0; k < 3; ++k) row[k] += S(sign * factors[u] * solution[first + u][k]);
    }
    result.first.push_back(row);
    result.second.push_back(contact);
  };
  for (int i = 0; i < mode.contacts; ++i) {
    const Local<S>& at = local[i];
    const S mu(sample_.contacts[i].friction);
    switch (mode.at[i]) {
      case ContactState::breaks: combine(0, 3, at.wrench(at.n).data(), 1, i); break;
      case ContactState::rolls:
        for (int side : {1, -1}) {
          const Pair<S> inward{S(mu * at.n[0] + side * at.t[0]), S(mu * at.n[1] + side * at.t[1])};
          combine(force_at[i], 2, inward.data(), 1, -1);
        }
        break;
      default:
        combine(0, 3, at.wrench(at.t).data(), mode.at[i] == ContactState::slides_along ? 1 : -1, i);
        combine(force_at[i], 2, at.n.data(), 1, -1);
    }
  }
  return result;
}

template <class S>
std::optional<Rows<S>> DirectReference<S>::mode_rows(const Eigen::Vector2d& com, const ModeStructure& mode) const {
  if (!mode.exists || !mode.kinematic) return std::nullopt;
  const auto all = all_rows(com, mode.mode);
  if (!all) return std::nullopt;
  Rows<S> rows;
  for (std::size_t k = 0; k < all->first.size(); ++k) {
    const int contact = all->second[k];
    if (contact < 0 || !(mode.dropped >> contact & 1u)) rows.push_back(all->first[k]);
  }
  return rows;
}

template <class S>
bool DirectReference<S>::equilibrium_at(const Eigen::Vector2d& com, const Wrench& wrench) const {
  if (!structure_.full_rank) return false;
  const Rows<S> rows = facet_rows(com);
  return std::all_of(rows.begin(), rows.end(), [&](const Row<S>& row) {
    return value_at(row, {S(wrench.p), S(wrench.q)}) > 0;
  });
}

template <class S>
bool DirectReference<S>::equilibrium(const Eigen::Vector2d& com, double scale) const {
  if (!structure_.full_rank) return false;
  const S kappa = S(S(scale) * S(sample_.box.kappa)), nu = S(S(scale) * S(sample_.box.nu));
  for (const Row<S>& row : facet_rows(com)) {
    if (!(row[1] - absolute(row[0]) * kappa - absolute(row[2]) * nu > 0)) return false;
  }
  return true;
}

template <class S>
bool DirectReference<S>::mode_feasible(const Eigen::Vector2d& com, const ModeStructure& mode, double scale) const {
  const auto rows = mode_rows(com, mode);
  return rows && strictly_feasible<S>(*rows, S(S(scale) * S(sample_.box.kappa)), S(S(scale) * S(sample_.box.nu)));
}

template <class S>
bool DirectReference<S>::mode_feasible_at(const Eigen::Vector2d& com, const ModeStructure& mode,
                                          const Wrench& wrench) const {
  const auto rows = mode_rows(com, mode);
  return rows && std::all_of(rows->begin(), rows->end(), [&](const Row<S>& row) {
           return value_at(row, {S(wrench.p), S(wrench.q)}) > 0;
         });
}

template <class S>
std::vector<std::string> DirectReference<S>::feasible_modes(const Eigen::Vector2d& com, double scale) const {
  std::vector<std::string> names;
  for (const ModeStructure& mode : structure_.modes) {
    if (mode_feasible(com, mode, scale)) names.push_back(mode.mode.name());
  }
  return names;
}

template <class S>
bool DirectReference<S>::robust(const Eigen::Vector2d& com, double scale) const {
  return equilibrium(com, scale) && std::none_of(structure_.modes.begin(), structure_.modes.end(),
                                                 [&](const ModeStructure& m) { return mode_feasible(com, m, scale); });
}

template <class S>
ReferenceFactor DirectReference<S>::equilibrium_factor(const Eigen::Vector2d& com) const {
  ReferenceFactor factor{std::numeric_limits<double>::infinity(), "none", {}};
  if (!structure_.full_rank) return {0, "equilibrium", {}};
  for (const Row<S>& row : facet_rows(com)) {
    const S fall = S(absolute(row[0]) * S(sample_.box.kappa) + absolute(row[2]) * S(sample_.box.nu));
    if (row[1] <= 0) return {0, "equilibrium", {}};
    if (fall == 0) continue;
    const double value = to_double(S(row[1] / fall));
    if (value >= factor.value) continue;
    factor = {value, "equilibrium", {}};
    factor.witness = {(row[0] > 0 ? -value : value) * sample_.box.kappa,
                      (row[2] > 0 ? -value : value) * sample_.box.nu};
  }
  return factor;
}

template <class S>
ReferenceFactor DirectReference<S>::mode_factor(const Eigen::Vector2d& com, const ModeStructure& mode) const {
  const ReferenceFactor none{std::numeric_limits<double>::infinity(), "none", {}};
  const auto rows = mode_rows(com, mode);
  if (!rows) return none;
  const S kappa(sample_.box.kappa), nu(sample_.box.nu);
  const auto least = least_scale<S>(*rows, kappa, nu);
  if (!least) return none;
  // The closed rows may meet where the strict ones do not: look just beyond the least scale.
  const S beyond = S(least->first * S(1 + 0x1p-20) + S(0x1p-20));
  if (!strictly_feasible<S>(*rows, S(beyond * kappa), S(beyond * nu))) return none;
  return {to_double(least->first), mode.mode.name(), {to_double(least->second[0]), to_double(least->second[1])}};
}

template <class S>
ReferenceFactor DirectReference<S>::safety_factor(const Eigen::Vector2d& com) const {
  ReferenceFactor least = equilibrium_factor(com);
  for (const ModeStructure& mode : structure_.modes) {
    const ReferenceFactor factor = mode_factor(com, mode);
    if (factor.value < least.value) least = factor;
  }
  return least;
}

template class DirectReference<double>;
template class DirectReference<Rational>;

LineReference least_on_line(const DirectReference<double>& reference, const Eigen::Vector2d& from,
                            const Eigen::Vector2d& to, int samples, bool equilibrium_only) {
  const auto at = [&](double lambda) {
    const Eigen::Vector2d com = from + lambda * (to - from);
    return equilibrium_only ? reference.equilibrium_factor(com).value : reference.safety_factor(com).value;
  };
  std::vector<double> values(samples + 1);
  for (int i = 0; i <= samples; ++i) values[i] = at(static_cast<double>(i) / samples);
  LineReference least{values[0], 0};
  const auto offer = [&](double value, double lambda) {
    if (value < least.least) least = {value, lambda};
  };
  for (int i = 0; i <= samples; ++i) {
    offer(values[i], static_cast<double>(i) / samples);
    const double before = values[std::max(i - 1, 0)], after = values[std::min(i + 1, samples)];
    if (values[i] > before || values[i] > after || values[i] == 0 || std::isinf(values[i])) continue;
    double low = std::max(i - 1.0, 0.0) / samples, high = std::min(i + 1.0, double(samples)) / samples;
    for (int step = 0; step < 45; ++step) {
      const double left = low + 0.381966 * (high - low), right = high - 0.381966 * (high - low);
      const double value_left = at(left), value_right = at(right);
      offer(value_left, left);
      offer(value_right, right);
      (value_left < value_right ? high : low) = value_left < value_right ? right : left;
    }
  }
  return least;
}

}  // namespace surefoot::testing
