// Objects for OMPL's alloc/free pairs that live as long as their space: OMPL 1.5's SST drops some of its states and
// controls without freeing them. Not for several threads.
#pragma once

#include <deque>
#include <vector>

namespace surefoot::planner {

template <class T>
class Pool {
 public:
  T* take() {
    if (free_.empty()) return &all_.emplace_back();
    T* object = free_.back();
    free_.pop_back();
    return object;
  }
  void give_back(T* object) { free_.push_back(object); }

 private:
  std::deque<T> all_;
  std::vector<T*> free_;
};

}  // namespace surefoot::planner
