// Finds those of n intervals of height that contain a given height. Building takes O(n log n), a query with k
// results O((k + 1) log n).
#pragma once

#include <cstdint>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

/// From `low` (included) to `high` (excluded), mm.
struct HeightSpan {
  double low = 0, high = 0;
};

/// The heights that each facet passes through.
std::vector<HeightSpan> height_spans(const ClosedMesh& mesh);

/// Keeps the intervals in order of their low ends, with a tree that holds the greatest high end below each
/// node.
class HeightIndex {
 public:
  explicit HeightIndex(const std::vector<HeightSpan>& spans);

  /// The indices of the spans that contain `height`, ascending.
  std::vector<std::uint32_t> at(double height) const;

 private:
  void collect(std::size_t node, std::size_t first, std::size_t count, std::size_t end, double height,
               std::vector<std::uint32_t>& found) const;

  std::vector<std::uint32_t> order_;
  std::vector<double> lows_;  ///< sorted
  /// Per node the greatest high end. Node 1 is the root, node i has the children 2i and 2i + 1; leaves follow
  /// order_.
  std::vector<double> greatest_;
  std::size_t leaves_ = 1;  ///< a power of two
};

}  // namespace unicursal::core
