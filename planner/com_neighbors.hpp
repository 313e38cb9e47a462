// Nearest node to a target for RRT: a linear scan over COMs kept side by side (about a nanosecond each, so a search of
// some ten thousand nodes needs no more), in which a node that has been chosen often stands back. Without that a node
// nearest to the goal from which no step leads on would be chosen for ever (P. Cheng and S. M. LaValle, "Reducing
// metric sensitivity in randomized trajectory design", IROS 2001, count failures to the same end).
#pragma once

#include <ompl/datastructures/NearestNeighbors.h>

#include <cmath>
#include <limits>
#include <vector>

#include "planner/stance_space.hpp"

namespace surefoot::planner {

/// T points to something with a member `state` (ompl::control::RRT's motions). Queries are targets.
template <typename T>
class ComNeighbors : public ompl::NearestNeighbors<T> {
 public:
  bool reportsSortedResults() const override { return false; }
  void clear() override {
    data_.clear();
    places_.clear();
  }
  void add(const T& data) override {
    const Eigen::Vector2d com = progress_point(StanceSpace::of(data->state).node);
    data_.push_back(data);
    places_.push_back({com.x(), com.y(), 0});
  }
  bool remove(const T&) override { return false; }  // RRT removes nothing

  T nearest(const T& query) const override {
    const auto& state = StanceSpace::of(query->state);
    const Target& target = state.target;
    const double wx = target.free_x ? 0 : 1, wy = target.free_y ? 0 : 1;
    double best = std::numeric_limits<double>::infinity(), best2 = best;
    std::size_t at = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double dx = wx * (places_[i].x - target.com.x()), dy = wy * (places_[i].y - target.com.y());
      const double d2 = dx * dx + dy * dy;
      if (d2 >= best2) continue;
      const double d = std::sqrt(d2) + places_[i].penalty;
      if (d >= best) continue;
      best = d;
      best2 = d * d;
      at = i;
    }
    places_[at].penalty += target.choice_penalty;
    return data_[at];
  }
  void nearestK(const T& query, std::size_t, std::vector<T>& found) const override { found = {nearest(query)}; }
  void nearestR(const T& query, double, std::vector<T>& found) const override { found = {nearest(query)}; }
  std::size_t size() const override { return data_.size(); }
  void list(std::vector<T>& data) const override { data = data_; }

 private:
  struct Place {
    double x, y;     ///< COM [m]
    double penalty;  ///< [m]
  };
  std::vector<T> data_;
  mutable std::vector<Place> places_;
};

}  // namespace surefoot::planner
