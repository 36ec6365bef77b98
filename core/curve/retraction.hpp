// Fingers that crowd a place are drawn back. A finger is a stretch of the curve that goes out and comes back
// beside itself; where a lobe of the island holds more strands than fit, moving vertices cannot help, since a
// strand cannot leave. Cutting the finger off by a short bridge can: what it has filled is left to its
// neighbours, and fairing gives its length back elsewhere. mm, mm².
//
// Not in the paper, whose curves keep the strands that the cycle gave them.
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

/// `areas`: what every segment of the curve fills (segment i leaves vertex i). Each bridge takes out about as
/// much length as is too much near its finger, and comes no nearer to strands and border than strands may.
/// Precondition: `curve` is simple and inside. So is the result.
Retraction retracted(const Curve& curve, const std::vector<double>& areas, const BorderIndex& border,
                     double bead_width);

}  // namespace unicursal::core
