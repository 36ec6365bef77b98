// Disjoint sets (union-find) of the numbers 0 … count − 1, in practically constant time per operation.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace unicursal::core {

class DisjointSets {
 public:
  /// Every number is a set of its own.
  explicit DisjointSets(std::size_t count = 0) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// A member that stands for the whole set, until the set is joined to another.
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  bool same(std::size_t a, std::size_t b) { return find(a) == find(b); }

  /// Makes one set of the two that a and b belong to. Returns false if they already were in the same set.
  bool join(std::size_t a, std::size_t b) {
    const std::size_t from = find(a), to = find(b);
    parent_[from] = to;
    return from != to;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace unicursal::core
