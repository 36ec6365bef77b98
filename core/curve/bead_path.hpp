// The product of core: a closed curve with the area that each of its segments has to fill.
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// One segment of the closed curve: from `position` to the next bead's position.
struct Bead {
  Vec2 position{0, 0};
  double area = 0;  ///< area that the segment fills, mm²; times the layer height it is the volume (§3.4)
  std::size_t zone = 0;  ///< index into Part::zones(); segments are split at the borders of zones
};

/// A closed curve that fills one island: segment i runs from point i to point i + 1, the last to the first.
struct BeadPath {
  std::vector<Bead> beads;

  std::size_t size() const { return beads.size(); }
  const Vec2& start(std::size_t i) const { return beads[i].position; }
  const Vec2& end(std::size_t i) const { return beads[i + 1 < beads.size() ? i + 1 : 0].position; }
  /// Length of segment i, mm.
  double length(std::size_t i) const { return (end(i) - start(i)).norm(); }
  /// Bead width, mm: area ÷ length, the spacing of the curve there. Zero-length segments have width 0.
  double width(std::size_t i) const {
    const double l = length(i);
    return l > 0 ? beads[i].area / l : 0.0;
  }

  double total_length() const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += length(i);
    return sum;
  }
  double total_area() const {
    double sum = 0;
    for (const Bead& bead : beads) sum += bead.area;
    return sum;
  }
};

}  // namespace unicursal::core
