// Windows: squares into which a large tour is cut, so that local operations in different windows can be
// carried out at the same time, in any order, and near to one another in memory. *Own*; the paper has one
// thread.
//
// A stop may be moved only if all stops within two edges of it lie in the same window. An operation at such a
// stop changes movable stops only, and reads nothing that an operation in another window changes, since what
// it reads lies within four edges.
//
// What an operation does to the order of the whole tour is known from the window alone as long as each
// stretch of the tour that passes through a window keeps its ends. Operations 1 to 3 always keep them,
// operation 4 if it may (EditableTour::keeps_ends()). So the tour remains one cycle whatever happens in the
// other windows. Windows that are cut elsewhere each time let every stop move.
#pragma once

#include <cstdint>
#include <vector>

#include "core/cycle/tour.hpp"

namespace unicursal::core {

struct TourWindow {
  std::vector<StopIndex> movable;
  std::vector<StopIndex>
      sequence;  ///< all visited stops in the window, in the order of the tour when it was cut
  std::vector<StopIndex> entries;  ///< stops at which the tour enters the window, in its order; empty if it
                                   ///< never leaves the window
  std::uint64_t labelled =
      0;  ///< how many labels were given (tour_order.hpp): the price of keeping the order
};

/// The whole tour as one window.
TourWindow whole_window(const Tour& tour);

struct TourWindows {
  Per<StopIndex, std::int32_t> window_of;  ///< window that a visited stop lies in
  std::vector<TourWindow> windows;
};

/// Cuts the plane into squares of `side` mm of which one has its corner at `corner`. Windows without a
/// movable stop are left empty.
TourWindows cut_into_windows(const Tour& tour, double side, const Vec2& corner);

}  // namespace unicursal::core
