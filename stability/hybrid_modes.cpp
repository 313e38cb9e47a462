#include "stability/hybrid_modes.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace surefoot::stability {

using Eigen::Vector2d;

namespace {

/// An unknown force at a contact and the acceleration that it holds at zero.
struct Constraint {
  int contact;
  Vector2d force, direction;
};

struct Constraints {
  std::array<Constraint, 4> at;
  int count = 0;
  void add(int contact, const Vector2d& force, const Vector2d& direction) { at[count++] = {contact, force, direction}; }
};

Constraints constraints_of(const HybridBody& body, const ContactMode& mode) {
  Constraints list;
  for (int i = 0; i < body.contacts(); ++i) {
    const Vector2d &n = body.normal(i), &t = body.tangent(i);
    if (mode.at[i] == ContactState::rolls) list.add(i, n, n), list.add(i, t, t);
    if (mode.at[i] == ContactState::slides_along) list.add(i, n - body.friction(i) * t, n);
    if (mode.at[i] == ContactState::slides_against) list.add(i, n + body.friction(i) * t, n);
  }
  return list;
}

int slide_sign(ContactState state) {
  return state == ContactState::slides_along ? 1 : state == ContactState::slides_against ? -1 : 0;
}

/// Forces possible and, where speeds do not tell, accelerations that lead into the mode; both by more than `slack`.
bool consistent(const HybridBody& body, const BodyState& state, const ContactMode& mode, const ModeMotion& motion,
                double slack) {
  for (int i = 0; i < body.contacts(); ++i) {
    if (!state.closed(i)) continue;
    if (mode.at[i] == ContactState::breaks) {
      if (!(motion.lift[i] > slack)) return false;
      continue;
    }
    if (!(motion.normal_force[i] > slack)) return false;
    const int sign = slide_sign(mode.at[i]);
    if (sign == 0 && !(std::abs(motion.tangent_force[i]) < body.friction(i) * motion.normal_force[i] - slack))
      return false;
    if (sign != 0 && state.slip[i] == 0 && !(sign * motion.slip[i] > slack)) return false;
  }
  return true;
}

/// The k-th thing that contact i may do, most contact first.
std::optional<ContactState> option(const BodyState& state, int i, int k, const Leaving& leaving) {
  using enum ContactState;
  const bool leaves = i == leaving.contact;
  if (!state.closed(i) || (leaves && leaving.lifts)) return k == 0 ? std::optional(breaks) : std::nullopt;
  if (state.slip[i] != 0) {
    if (k == 0) return state.slip[i] > 0 ? slides_along : slides_against;
    return k == 1 ? std::optional(breaks) : std::nullopt;
  }
  constexpr ContactState all[] = {rolls, slides_along, slides_against, breaks};
  k += leaves;
  return k < 4 ? std::optional(all[k]) : std::nullopt;
}

ModeChoice choose(const HybridBody& body, const BodyState& state, double slack, const Leaving& leaving) {
  ModeChoice choice;
  int kept_most = -1;
  for (int a = 0; const auto first = option(state, 0, a, leaving); ++a)
    for (int b = 0;; ++b) {
      const auto second = body.contacts() == 2 ? option(state, 1, b, leaving)
                          : b == 0             ? std::optional(ContactState::breaks)
                                               : std::nullopt;
      if (!second) break;
      ContactMode mode;
      mode.contacts = body.contacts();
      mode.at = {*first, *second, ContactState::breaks};
      // A foot that rolls beside one that stays leaves no motion: its accelerations would be rounding.
      using enum ContactState;
      if ((*first == rolls && *second != breaks) || (*second == rolls && *first != breaks)) continue;
      const auto motion = motion_in(body, state, mode);
      if (!motion || !consistent(body, state, mode, *motion, slack)) continue;
      ++choice.consistent;
      const int kept = (*first != ContactState::breaks) + (*second != ContactState::breaks);
      if (kept > kept_most) kept_most = kept, choice.mode = mode, choice.motion = *motion;
    }
  return choice;
}

}  // namespace

/// Forces phi along given directions such that W phi = -(accelerations without them): W is the inverse inertia seen at
/// the contacts.
std::optional<ModeMotion> motion_in(const HybridBody& body, const BodyState& state, const ContactMode& mode) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
  const Vector2d fall(0, -body.gravity());
  const double turning = body.turning(state);
  const auto without = [&](int i) { return Vector2d(fall - turning * body.arm(i, state.theta)); };
  ModeMotion motion;
  motion.acceleration = fall;
  const Constraints list = constraints_of(body, mode);
  if (list.count > 3) return std::nullopt;
  if (list.count > 0) {
    Matrix w(list.count, list.count);
    Vector rest(list.count);
    for (int k = 0; k < list.count; ++k) {
      const auto& row = list.at[k];
      rest[k] = -row.direction.dot(without(row.contact));
      for (int l = 0; l < list.count; ++l)
        w(k, l) = body.response(state.theta, row.contact, row.direction, list.at[l].contact, list.at[l].force);
    }
    const Eigen::FullPivLU<Matrix> solver(w);
    if (!solver.isInvertible()) return std::nullopt;
    const Vector phi = solver.solve(rest);
    for (int k = 0; k < list.count; ++k) {
      const auto& [i, force, direction] = list.at[k];
      const Vector2d f = phi[k] * force;
      motion.acceleration += f;
      motion.alpha += cross(body.arm(i, state.theta), f) / body.rho2();
      motion.normal_force[i] += f.dot(body.normal(i));
      motion.tangent_force[i] += f.dot(body.tangent(i));
    }
  }
  for (int i = 0; i < body.contacts(); ++i) {
    const Vector2d a =
        motion.acceleration + motion.alpha * quarter(body.arm(i, state.theta)) - turning * body.arm(i, state.theta);
    const bool held = mode.at[i] != ContactState::breaks;
    motion.lift[i] = held ? 0 : a.dot(body.normal(i));
    motion.slip[i] = mode.at[i] == ContactState::rolls ? 0 : a.dot(body.tangent(i));
  }
  return motion;
}

ModeChoice choose_mode(const HybridBody& body, const BodyState& state, const Leaving& leaving) {
  // On a boundary between modes rounding may refuse both: then what is within rounding of consistent counts.
  constexpr double rounding = 1e-12;  // of gravity
  for (const Leaving& which : {leaving, Leaving{}})
    for (const double slack : {0.0, -rounding * body.gravity()})
      if (ModeChoice choice = choose(body, state, slack, which); choice.consistent > 0) return choice;
  return {};
}

}  // namespace surefoot::stability
