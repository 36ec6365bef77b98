// The order of stops along a closed tour under local changes.
//
// Every stop has a label that grows along the tour (modulo 2⁶⁴). A stop that moves gets a label between those
// of its new neighbours; a stretch that moves is labelled anew, the shortest stretches of those that change
// places; when there is no room left, all are. Asking is one subtraction. Departure from the paper, which
// renumbers everything at every accepted change, O(N); two-level lists and splay trees bound the worst case
// better, but pay at every question, and questions are far more frequent than moves (tests/bench/cycle).
#pragma once

#include <cstdint>
#include <vector>

#include "core/cycle/tour.hpp"

namespace unicursal::core {

class TourOrder {
 public:
  TourOrder() = default;
  explicit TourOrder(const Tour& tour) { renumber(tour); }

  /// On the way from `first` to `last` in the tour's direction, does one pass `stop`? Ends count.
  bool within(StopIndex first, StopIndex stop, StopIndex last) const {
    return label(stop) - label(first) <= label(last) - label(first);
  }

  /// Gives all stops from `first` to `last` labels between those of the stops before and after. The tour's
  /// links must be up to date, the labels around must be in order.
  void fit(const Tour& tour, StopIndex first, StopIndex last);
  void swap(StopIndex a, StopIndex b) {
    std::swap(labels_[static_cast<std::size_t>(a)], labels_[static_cast<std::size_t>(b)]);
  }

  /// How many stops were given a label since the start: what keeping the order cost.
  std::uint64_t labelled() const { return labelled_; }

 private:
  std::uint64_t label(StopIndex s) const { return labels_[static_cast<std::size_t>(s)]; }
  void renumber(const Tour& tour);

  std::vector<std::uint64_t> labels_;
  std::uint64_t labelled_ = 0;
};

}  // namespace unicursal::core
