// The order of the stops along a closed tour that changes locally.
//
// Every stop has a label, and labels grow along the tour (modulo 2⁶⁴), so that a question about the order
// costs one subtraction. A stop that moves gets a label between those of its new neighbours. A stretch that
// moves is relabelled, and operation 4, which reorders four stretches, relabels the shortest ones. If no
// labels are left between two neighbours, all stops of the tour, or of its window, are relabelled with even
// gaps. Departure from the paper, which renumbers all stops at every accepted change, O(N). Two-level lists
// and splay trees would bound the worst case better, but they cost more per question, and questions are far
// more frequent than moves.
//
// Parts of a tour can be labelled independently (tour_windows.hpp); labels of two parts must not be compared.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/cycle/tour.hpp"

namespace unicursal::core {

class TourOrder {
 public:
  TourOrder() = default;
  explicit TourOrder(const Tour& tour);

  /// Whether the tour passes `stop` on its way from `first` to `last`, ends included.
  bool within(StopIndex first, StopIndex stop, StopIndex last) const {
    return labels_[stop] - labels_[first] <= labels_[last] - labels_[first];
  }

  /// Gives these stops, and no others, labels with even gaps.
  void label(const std::vector<StopIndex>& sequence);
  /// Gives all stops from `first` to `last` labels between those of the stops before and after them. Returns
  /// how many; 0 if there are not enough labels, and then none is changed. Preconditions: the tour's links
  /// are up to date, and the labels of all other stops are in order.
  std::uint64_t fit(const Tour& tour, StopIndex first, StopIndex last);
  void swap(StopIndex a, StopIndex b) { std::swap(labels_[a], labels_[b]); }

 private:
  Per<StopIndex, std::uint64_t> labels_;
};

}  // namespace unicursal::core
