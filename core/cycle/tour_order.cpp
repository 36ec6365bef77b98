#include "core/cycle/tour_order.hpp"

#include <limits>

namespace unicursal::core {

TourOrder::TourOrder(const Tour& tour) {
  labels_.resize(tour.stop_count());
  label(tour.sequence());
}

void TourOrder::label(const std::vector<StopIndex>& sequence) {
  if (sequence.empty()) return;
  const std::uint64_t gap = std::numeric_limits<std::uint64_t>::max() / sequence.size();
  std::uint64_t label = 0;
  for (const StopIndex stop : sequence) {
    labels_[stop] = label;
    label += gap;
  }
}

std::uint64_t TourOrder::fit(const Tour& tour, StopIndex first, StopIndex last) {
  std::uint64_t count = 1;
  for (StopIndex s = first; s != last; s = tour.next[s]) ++count;
  const StopIndex before = tour.before[first], after = tour.next[last];
  const std::uint64_t room = labels_[after] - labels_[before];
  const std::uint64_t gap = room / (count + 1);
  if (gap == 0) return 0;
  std::uint64_t label = labels_[before];
  for (StopIndex s = first;; s = tour.next[s]) {
    label += gap;
    labels_[s] = label;
    if (s == last) break;
  }
  return count;
}

}  // namespace unicursal::core
