#include "core/cycle/tour_order.hpp"

#include <algorithm>
#include <limits>

namespace unicursal::core {

void TourOrder::renumber(const Tour& tour) {
  labels_.resize(tour.stop_count(), 0);
  const auto visited = static_cast<std::uint64_t>(
      std::count_if(tour.next.begin(), tour.next.end(), [](StopIndex s) { return s >= 0; }));
  if (visited == 0) return;
  const std::uint64_t gap = std::numeric_limits<std::uint64_t>::max() / visited;
  const auto start = static_cast<StopIndex>(
      std::find_if(tour.next.begin(), tour.next.end(), [](StopIndex s) { return s >= 0; }) -
      tour.next.begin());
  std::uint64_t label = 0;
  StopIndex stop = start;
  do {
    labels_[static_cast<std::size_t>(stop)] = label;
    label += gap;
    stop = tour.next[static_cast<std::size_t>(stop)];
  } while (stop != start);
  labelled_ += visited;
}

void TourOrder::fit(const Tour& tour, StopIndex first, StopIndex last) {
  std::uint64_t count = 1;
  for (StopIndex s = first; s != last; s = tour.next[static_cast<std::size_t>(s)]) ++count;
  const StopIndex before = tour.before[static_cast<std::size_t>(first)],
                  after = tour.next[static_cast<std::size_t>(last)];
  const std::uint64_t room = label(after) - label(before);
  const std::uint64_t gap = room / (count + 1);
  if (gap == 0) {
    renumber(tour);
    return;
  }
  std::uint64_t label = this->label(before);
  for (StopIndex s = first;; s = tour.next[static_cast<std::size_t>(s)]) {
    label += gap;
    labels_[static_cast<std::size_t>(s)] = label;
    if (s == last) break;
  }
  labelled_ += count;
}

}  // namespace unicursal::core
