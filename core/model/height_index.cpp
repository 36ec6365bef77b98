#include "core/model/height_index.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace unicursal::core {

std::vector<HeightSpan> height_spans(const ClosedMesh& mesh) {
  std::vector<HeightSpan> result;
  result.reserve(mesh.facets.size());
  for (const auto& [a, b, c] : mesh.facets) {
    const auto [low, high] = std::minmax({mesh.vertices[a].z(), mesh.vertices[b].z(), mesh.vertices[c].z()});
    result.push_back({low, high});
  }
  return result;
}

HeightIndex::HeightIndex(const std::vector<HeightSpan>& spans) : order_(spans.size()) {
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return spans[a].low < spans[b].low; });
  leaves_ = std::bit_ceil(std::max<std::size_t>(1, spans.size()));
  greatest_.assign(2 * leaves_, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    lows_.push_back(spans[order_[i]].low);
    greatest_[leaves_ + i] = spans[order_[i]].high;
  }
  for (std::size_t i = leaves_; i-- > 1;) greatest_[i] = std::max(greatest_[2 * i], greatest_[2 * i + 1]);
}

std::vector<std::uint32_t> HeightIndex::at(double height) const {
  const auto end = std::size_t(std::upper_bound(lows_.begin(), lows_.end(), height) - lows_.begin());
  std::vector<std::uint32_t> found;
  collect(1, 0, leaves_, end, height, found);
  std::sort(found.begin(), found.end());
  return found;
}

/// Finds, among the `count` leaves of `node` from `first` on, those before `end` that reach above the height.
void HeightIndex::collect(std::size_t node, std::size_t first, std::size_t count, std::size_t end,
                          double height, std::vector<std::uint32_t>& found) const {
  if (first >= end || !(greatest_[node] > height)) return;
  if (count == 1) {
    found.push_back(order_[first]);
    return;
  }
  collect(2 * node, first, count / 2, end, height, found);
  collect(2 * node + 1, first + count / 2, count / 2, end, height, found);
}

}  // namespace unicursal::core
