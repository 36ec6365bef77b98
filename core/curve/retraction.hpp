// Draws back fingers that crowd a place. A finger is a stretch of the curve that goes out and comes back
// beside itself. If a lobe of the island holds more strands than fit, moving vertices does not help, since a
// strand cannot leave. A short bridge that cuts a finger off does: its neighbours take over its area, and
// fairing adds the lost length elsewhere. mm, mm².
//
// This is not in the paper, whose curves keep the strands of the cycle.
#pragma once

#include <cstddef>
#include <vector>

#include "core/curve/curve.hpp"
#include "core/geometry/border_index.hpp"

namespace unicursal::core {

struct Retraction {
  Curve curve;
  std::size_t fingers = 0;  ///< drawn back
};

/// `areas` holds the area that each segment fills (segment i leaves vertex i). A finger is cut off only if
/// that brings the length near it closer to the right one, and if its bridge keeps clear of strands and
/// border. Precondition: `curve` is simple and inside. The same holds for the result.
Retraction retracted(const Curve& curve, const std::vector<double>& areas, const BorderIndex& border,
                     double bead_width);

}  // namespace unicursal::core
