// Where closed curves that run side by side are joined: the places that make one curve of many. mm.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/curve/track.hpp"

namespace unicursal::core {

/// What it costs to join curve i to curve j. Dear joints are made only where no cheaper ones connect.
using JointPrice = std::function<double(std::size_t i, std::size_t j)>;

/// The stretch of `cut` mm around a position that a joint takes out of a curve.
struct Opening {
  std::size_t track = 0;
  double from = 0, to = 0;  ///< positions along it, forwards
};

/// Two openings, and two bridges between their four ends.
struct Joint {
  std::array<Opening, 2> openings;
  bool crosswise = false;  ///< bridges lead from either `from` to the other's `to`; else from and to stay
};

/// Joints that connect all tracks, one fewer than there are tracks, each as smooth as its place allows; no
/// two are near one another. Fewer when some track cannot be reached without touching a strand or the border.
/// Preconditions: the curves are simple, disjoint and inside `island`.
std::vector<Joint> find_joints(const std::vector<Track>& tracks, const Polygon& island, double bead_width,
                               const JointPrice& price);

}  // namespace unicursal::core
