#include "stability/frictional.hpp"

#include <algorithm>
#include <cmath>

#include "stability/decisions.hpp"
#include "stability/given.hpp"
#include "stability/guard.hpp"
#include "stability/point_test.hpp"
#include "stability/polynomial_frame.hpp"

namespace surefoot::stability {
namespace {

constexpr DisturbanceBox gravity{};

void require_two(const Posture& posture) {
  require(posture.contacts() == 2, "frictional stability is about two contacts");
}

/// Frames of one COM, the exact one made when first needed.
class GravityQuery {
 public:
  GravityQuery(const Posture& posture, const Eigen::Vector2d& com)
      : posture_(posture), com_(com), frame_(posture.frame(com)) {
    require_two(posture);
    double radius = 0;
    for (const auto& at : {frame_.at[0], frame_.at[1]}) radius = std::max(radius, std::abs(at.r.x) + std::abs(at.r.y));
    guard_ = GuardScale(posture.edge_bound(), posture.rho2(), gravity).at(radius);
  }
  const Frame<double>& frame() const { return frame_; }
  const Guard& guard() const { return guard_; }
  const Frame<Dyadic>& exact_frame() {
    if (!exact_) {
      exact_ = posture_.exact_frame(com_);
      ++decisions.frictional_exactly;
    }
    return *exact_;
  }

 private:
  const Posture& posture_;
  const Eigen::Vector2d& com_;
  Frame<double> frame_;
  Guard guard_;
  std::optional<Frame<Dyadic>> exact_;
};

enum class Answer { no, yes, unknown };
constexpr int unknown_sign = 2;

/// All force rows positive and a kinematic row negative, from the signs of the rows (unknown_sign where not certain),
/// those of D applied.
template <class SignOf>
Answer leads_back(int rows, int forces, int d_sign, SignOf&& sign_of) {
  if (d_sign == 0) return Answer::no;
  bool certain = d_sign != unknown_sign, back = false, possible = false;
  if (!certain) return Answer::unknown;
  for (int k = 0; k < rows; ++k) {
    const int sign = sign_of(k), wanted = k < rows - forces ? -d_sign : d_sign;
    const bool kinematic = k < rows - forces;
    if (!kinematic && sign != wanted && sign != unknown_sign) return Answer::no;
    if (!kinematic) certain &= sign == wanted;
    if (kinematic) back |= sign == wanted, possible |= sign == unknown_sign;
  }
  if (!back && !possible) return Answer::no;
  return back && certain ? Answer::yes : Answer::unknown;
}

bool mode_leads_back(GravityQuery& query, const ModeSpec& spec) {
  const int forces = force_rows(spec);
  const auto sign = [](double value, double error) { return value > error ? 1 : value < -error ? -1 : unknown_sign; };
  GravityRows<double> rows;
  emit_rows(query.frame(), spec, rows);
  const Guard& guard = query.guard();
  const Answer fast = leads_back(rows.count, forces, rows.d ? sign(*rows.d, guard.denominator) : 1, [&](int k) {
    return sign(rows.value[k], rows.is_length[k] ? guard.length : guard.area);
  });
  if (fast != Answer::unknown) return fast == Answer::yes;
  GravityRows<Dyadic> exact;
  emit_rows(query.exact_frame(), spec, exact);
  return leads_back(exact.count, forces, exact.d ? exact.d->sign() : 1, [&](int k) { return exact.value[k].sign(); }) ==
         Answer::yes;
}

const ModeSpec* failed_mode(const Posture& posture, GravityQuery& query) {
  for (const ModeSpec& spec : posture.modes())
    if (!mode_leads_back(query, spec)) return &spec;
  return nullptr;
}

/// (10) without roots. Let s = e^1/3: the threshold is s / (1 - s + s^2) = 1 / (s + 1/s - 1), so that (10) with
/// c = 1 / sqrt(psi_1 psi_2) says s + 1/s > 1 + c. Both sides are at least 2, where t^3 - 3 t grows, and takes s + 1/s
/// to e + 1/e: hence e + 1/e > (1 + c)^3 - 3 (1 + c), or
///   (1 + e)^2 > e c^2 (3 + c).
/// psi_1 psi_2 = X^2 / (D_1 D_2) with X = <N_1, N_2> < 0 and D_i = <N_i, N_i>, times rho^2. With Y = D_1 D_2,
/// L = (1 + e)^2 X^2 - 3 e Y the condition is L > 0 and L^2 X^2 > e^2 Y^3.
bool converges_exactly(const Frame<Dyadic>& frame, double restitution) {
  const Dyadic x = normal_product(frame, 0, 1);
  if (x.sign() >= 0) return false;
  const Dyadic e(restitution), sum = Dyadic(1) + e;
  const Dyadic y = normal_product(frame, 0, 0) * normal_product(frame, 1, 1), x2 = x * x;
  const Dyadic l = sum * sum * x2 - Dyadic(3) * e * y;
  return l.sign() > 0 && l * l * x2 > e * e * y * y * y;
}

bool clatters_to_rest(GravityQuery& query, double restitution) {
  require_restitution(restitution);
  const double x = normal_product(query.frame(), 0, 1), error = query.guard().denominator;
  if (x > error) return false;
  const double d1 = normal_product(query.frame(), 0, 0), d2 = normal_product(query.frame(), 1, 1);
  // The difference of both sides over e c^2, increasing in psi_1 psi_2, and the size of its terms.
  constexpr double rounding = 16 * unit_roundoff;  // of each term: below ten operations
  const double k = (1 + restitution) * (1 + restitution) / restitution;
  const auto excess = [&](double product) { return k * product - 3 - 1 / std::sqrt(product); };
  const auto slack = [&](double product) { return rounding * (k * product + 3 + 1 / std::sqrt(product)); };
  const double low = std::max(0.0, -x - error), high = -x + error;
  const double least = low * low / ((d1 + error) * (d2 + error)), most = high * high / ((d1 - error) * (d2 - error));
  if (d1 > error && d2 > error) {
    if (least > 0 && excess(least) > slack(least)) return true;
    if (excess(most) < -slack(most)) return false;
  }
  return converges_exactly(query.exact_frame(), restitution);
}

}  // namespace

std::array<double, 2> psi(const Posture& posture, const Eigen::Vector2d& com) {
  const GravityQuery query(posture, com);
  const double x = normal_product(query.frame(), 0, 1);
  std::array<double, 2> size, result;  // |n_i|
  for (int i : {0, 1}) size[i] = std::hypot(query.frame().at[i].n.x, query.frame().at[i].n.y);
  for (int i : {0, 1}) result[i] = -x / normal_product(query.frame(), i, i) * (size[i] / size[1 - i]);
  return result;
}

bool faces_upward(const Posture& posture) {
  for (int i = 0; i < posture.contacts(); ++i)
    if (posture.normal<double>(i).y <= 0) return false;
  return true;
}

bool kinematic_strong(const Posture& posture, const Eigen::Vector2d& com) {
  require_two(posture);
  if (!PointQuery(posture, com, gravity).equilibrium()) return false;
  GravityQuery query(posture, com);
  return !failed_mode(posture, query);
}

bool clattering_converges(const Posture& posture, const Eigen::Vector2d& com, double restitution) {
  GravityQuery query(posture, com);
  return clatters_to_rest(query, restitution);
}

FrictionalVerdict frictional_verdict(const Posture& posture, const Eigen::Vector2d& com, double restitution) {
  ++decisions.frictional;
  FrictionalVerdict verdict;
  GravityQuery query(posture, com);
  verdict.upward = faces_upward(posture);
  verdict.clattering = clatters_to_rest(query, restitution);
  verdict.equilibrium = PointQuery(posture, com, gravity).equilibrium();
  if (!verdict.equilibrium) return verdict;
  if (const ModeSpec* spec = failed_mode(posture, query)) verdict.failed_mode = contact_mode(*spec, posture.contacts());
  else verdict.kinematic_strong = true;
  return verdict;
}

bool frictionally_stable(const Posture& posture, const Eigen::Vector2d& com, double restitution) {
  ++decisions.frictional;
  require_two(posture);
  require_restitution(restitution);
  if (!faces_upward(posture)) return false;
  GravityQuery query(posture, com);
  return clatters_to_rest(query, restitution) && PointQuery(posture, com, gravity).equilibrium() &&
         !failed_mode(posture, query);
}

}  // namespace surefoot::stability
