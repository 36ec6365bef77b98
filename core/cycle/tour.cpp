#include "core/cycle/tour.hpp"

#include <algorithm>
#include <cassert>

namespace unicursal::core {

Curve drawn(const Tour& tour) {
  const auto first = std::find_if(tour.next.begin(), tour.next.end(), [](StopIndex s) { return s >= 0; });
  assert(first != tour.next.end());
  const auto start = static_cast<StopIndex>(first - tour.next.begin());
  Curve curve;
  StopIndex stop = start;
  do {
    const auto s = static_cast<std::size_t>(stop);
    curve.vertices.push_back(tour.position[s]);
    tour.graph.append_bends(tour.leave[s], curve.vertices);
    stop = tour.next[s];
  } while (stop != start);
  return curve;
}

}  // namespace unicursal::core
