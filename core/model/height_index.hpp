// Which of many intervals of height hold a given height: n log n to build, log n + answers·log n to ask.
#pragma once

#include <cstdint>
#include <vector>

namespace unicursal::core {

/// From low (included) to high (excluded), mm.
struct HeightSpan {
  double low = 0, high = 0;
};

/// Intervals in order of their low ends, with a tree of the greatest high end below each node.
class HeightIndex {
 public:
  explicit HeightIndex(const std::vector<HeightSpan>& spans);

  /// Indices into the spans, in ascending order.
  std::vector<std::uint32_t> at(double height) const;

 private:
  void collect(std::size_t node, std::size_t first, std::size_t count, std::size_t end, double height,
               std::vector<std::uint32_t>& found) const;

  std::vector<std::uint32_t> order_;
  std::vector<double> lows_;  ///< sorted
  std::vector<double>
      greatest_;            ///< node 1 is the root, node i has children 2i and 2i + 1; leaves follow order_
  std::size_t leaves_ = 1;  ///< a power of two
};

}  // namespace unicursal::core
