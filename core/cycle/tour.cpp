#include "core/cycle/tour.hpp"

#include <algorithm>
#include <cassert>

namespace unicursal::core {

std::size_t Tour::visited_count() const {
  return static_cast<std::size_t>(
      std::count_if(next.begin(), next.end(), [](StopIndex s) { return s.valid(); }));
}

std::vector<StopIndex> Tour::sequence() const {
  std::vector<StopIndex> stops;
  const StopIndex start = first_visited();
  if (!start.valid()) return stops;
  stops.reserve(stop_count());
  StopIndex stop = start;
  do {
    stops.push_back(stop);
    stop = next[stop];
  } while (stop != start);
  return stops;
}

Curve drawn(const Tour& tour) {
  const StopIndex start = tour.first_visited();
  assert(start.valid());
  Curve curve;
  StopIndex stop = start;
  do {
    curve.vertices.push_back(tour.position[stop]);
    tour.graph.append_bends(tour.leave[stop], curve.vertices);
    stop = tour.next[stop];
  } while (stop != start);
  return curve;
}

}  // namespace unicursal::core
