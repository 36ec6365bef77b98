// Finds the round marks of a test print (marks.hpp) in a photo. Pixels.
#pragma once

#include <vector>

#include "host/photo/photo.hpp"

namespace unicursal::host {

struct FoundMark {
  core::Vec2 centre{0, 0};
  double radius = 0;      ///< of the ring's outer border: that of a circle of the same area as the ellipse
  std::size_t votes = 1;  ///< in how many ways of looking at the photo it was seen
};

/// All places that look like a mark, those that were seen most often first. The photo is looked at in each
/// of its channels, against means over two sizes of surroundings, for marks that are darker and that are
/// lighter than the bed.
std::vector<FoundMark> find_marks(const Photo& photo);

}  // namespace unicursal::host
