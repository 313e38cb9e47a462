#include "planner/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace surefoot::planner {

namespace {

std::uint64_t sum(const RuleCounts& counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

std::uint64_t percent(std::uint64_t part, std::uint64_t whole) {
  return whole > 0
             ? static_cast<std::uint64_t>(std::llround(100.0 * static_cast<double>(part) / static_cast<double>(whole)))
             : 0;
}

/// Squares far out share their number with others; no harm but a wrong place in a message.
std::uint64_t number_of(double x, double y) {
  const auto wrapped = [](double at) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::clamp(at, -1e9, 1e9)));
  };
  return static_cast<std::uint64_t>(wrapped(x)) << 32 | wrapped(y);
}

}  // namespace

std::string shares(const RuleCounts& refused) {
  std::array<std::size_t, gaits::rule_count> order;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return refused[a] > refused[b]; });
  std::string text;
  for (const std::size_t rule : order)
    if (const std::uint64_t share = percent(refused[rule], sum(refused)); share > 0)
      text +=
          fmt::format("{}{} {} %", text.empty() ? "" : ", ", gaits::to_string(static_cast<gaits::Rule>(rule)), share);
  return text;
}

void Refusals::add(gaits::Rule rule, const Eigen::Vector2d& com) {
  const double x = std::floor(com.x() / side_), y = std::floor(com.y() / side_);
  const auto [at, fresh] = places_.try_emplace(number_of(x, y));
  Place& place = at->second;
  if (fresh) place.corner = side_ * Eigen::Vector2d(x, y), place.order = places_.size();
  ++place.refused[static_cast<std::size_t>(rule)];
  ++total_[static_cast<std::size_t>(rule)];
}

std::string Refusals::summary() const {
  const std::uint64_t all = sum(total_);
  if (all == 0) return "no landing or step refused";
  std::string text = fmt::format("{} landings and steps refused", all);
  text += ": " + shares(total_);
  const auto less = [](const auto& a, const auto& b) {
    const std::uint64_t left = sum(a.second.refused), right = sum(b.second.refused);
    return left != right ? left < right : a.second.order > b.second.order;
  };
  const Place& worst = std::max_element(places_.begin(), places_.end(), less)->second;
  const std::string place = shares(worst.refused);
  return text + fmt::format("; most of them ({} %) with the COM between ({:.5g}, {:.5g}) and ({:.5g}, {:.5g}){}",
                            percent(sum(worst.refused), all), worst.corner.x(), worst.corner.y(),
                            worst.corner.x() + side_, worst.corner.y() + side_,
                            place == shares(total_) ? "" : ": " + place);
}

}  // namespace surefoot::planner
