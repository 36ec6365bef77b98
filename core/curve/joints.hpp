// The places at which closed curves that run side by side can be joined into one. mm.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/curve/track.hpp"

namespace unicursal::core {

/// The price of a joint between curve i and curve j. Expensive joints are made only where cheaper ones do not
/// connect the curves.
using JointPrice = std::function<double(std::size_t i, std::size_t j)>;

/// The stretch that a joint takes out of a curve.
struct Opening {
  std::size_t track = 0;
  double from = 0, to = 0;  ///< positions along the curve, forwards, mm
};

/// Two openings, and two bridges between their four ends.
struct Joint {
  std::array<Opening, 2> openings;
  bool crosswise =
      false;  ///< bridges lead from one opening's `from` to the other's `to`; else from `from` to `from`
};

/// Joints that connect all tracks, one fewer than there are tracks. Each is as smooth as its place allows,
/// and no two are near each other. There are fewer if some track cannot be reached without touching a strand
/// or the border. Preconditions: the curves are simple, disjoint and inside `island`.
std::vector<Joint> find_joints(const std::vector<Track>& tracks, const Polygon& island, double bead_width,
                               const JointPrice& price);

}  // namespace unicursal::core
