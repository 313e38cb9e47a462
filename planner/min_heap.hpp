// A heap of small items with the smallest key on top, four children to a parent: where it is much larger than the
// caches, half as deep as a binary one, and the four lie on one cache line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace surefoot::planner {

class MinHeap {
 public:
  struct Item {
    double key;
    std::uint32_t number;  ///< ties go by it, the smaller first
    std::uint32_t payload;
    bool operator<(const Item& other) const { return key != other.key ? key < other.key : number < other.number; }
  };

  bool empty() const { return items_.empty(); }

  void push(const Item& item) {
    std::size_t at = items_.size();
    items_.push_back(item);
    for (; at > 0; at = (at - 1) / arity) {
      const std::size_t parent = (at - 1) / arity;
      if (!(item < items_[parent])) break;
      items_[at] = items_[parent];
    }
    items_[at] = item;
  }

  /// Takes the smallest. The heap is not empty.
  Item pop() {
    const Item top = items_.front(), last = items_.back();
    items_.pop_back();
    if (items_.empty()) return top;
    std::size_t at = 0;
    for (std::size_t child = 1; child < items_.size(); child = arity * at + 1) {
      const std::size_t end = child + arity < items_.size() ? child + arity : items_.size();
      std::size_t least = child;
      while (++child < end)
        if (items_[child] < items_[least]) least = child;
      if (!(items_[least] < last)) break;
      items_[at] = items_[least];
      at = least;
    }
    items_[at] = last;
    return top;
  }

 private:
  static constexpr std::size_t arity = 4;
  std::vector<Item> items_;
};

}  // namespace surefoot::planner
