#include "core/cycle/tour_order.hpp"

#include <limits>

namespace unicursal::core {

void TourOrder::renumber(const Tour& tour) {
  labels_.resize(tour.stop_count());
  const std::uint64_t visited = tour.visited_count();
  if (visited == 0) return;
  const std::uint64_t gap = std::numeric_limits<std::uint64_t>::max() / visited;
  const StopIndex start = tour.first_visited();
  std::uint64_t label = 0;
  StopIndex stop = start;
  do {
    labels_[stop] = label;
    label += gap;
    stop = tour.next[stop];
  } while (stop != start);
  labelled_ += visited;
}

void TourOrder::fit(const Tour& tour, StopIndex first, StopIndex last) {
  std::uint64_t count = 1;
  for (StopIndex s = first; s != last; s = tour.next[s]) ++count;
  const StopIndex before = tour.before[first], after = tour.next[last];
  const std::uint64_t room = labels_[after] - labels_[before];
  const std::uint64_t gap = room / (count + 1);
  if (gap == 0) {
    renumber(tour);
    return;
  }
  std::uint64_t label = labels_[before];
  for (StopIndex s = first;; s = tour.next[s]) {
    label += gap;
    labels_[s] = label;
    if (s == last) break;
  }
  labelled_ += count;
}

}  // namespace unicursal::core
