#include "stability/hybrid_flight.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {

BodyState flown(const HybridBody& body, const BodyState& state, double s) {
  BodyState there = state;
  body.fly(there, s);
  return there;
}

double farthest_in_flight(const HybridBody& body, const BodyState& state, double duration) {
  const double g = body.gravity(), up = state.v.y();
  const double rise = up > 0 ? up * up / (2 * g) : 0, fall = (0.5 * g * duration - up) * duration;
  double arm = 0;
  for (int i = 0; i < body.contacts(); ++i) arm = std::max(arm, body.arm(i, state.theta).norm());
  return body.excursion(state) + std::max(rise, fall) +
         (std::abs(state.v.x()) + arm * std::abs(state.omega)) * duration;
}

std::vector<double> moments_of_flight(const HybridBody& body, const BodyState& state, double duration) {
  constexpr double fewest = 64, most = 4096;
  const int count = static_cast<int>(std::min(most, fewest + 4 * std::abs(state.omega) * duration));
  const double apex = state.v.y() / body.gravity();
  std::vector<double> moments;
  moments.reserve(static_cast<std::size_t>(count) + 1);
  for (int k = 1; k <= count; ++k) {
    const double next = duration * k / count;
    if (apex > duration * (k - 1) / count && apex < next) moments.push_back(apex);
    moments.push_back(next);
  }
  return moments;
}

std::optional<double> time_to_leave(const HybridBody& body, const BodyState& state, double duration,
                                    double neighbourhood) {
  if (farthest_in_flight(body, state, duration) <= neighbourhood) return std::nullopt;
  const auto is_out = [&](double s) {
    return !(body.excursion(flown(body, state, s)) <= neighbourhood);  // so are numbers that overflow
  };
  constexpr int halvings = 60;
  double low = 0;
  for (double high : moments_of_flight(body, state, duration)) {
    if (!is_out(high)) {
      low = high;
      continue;
    }
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (is_out(middle) ? high : low) = middle;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace surefoot::stability
