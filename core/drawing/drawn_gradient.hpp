// A linear gradient of a drawing, as a gradient of mixtures can follow it. mm, in the part's frame.
#pragma once

#include <string>

#include "core/numeric/vec2.hpp"

namespace unicursal::core {

struct DrawnGradient {
  std::string fill;           ///< "url(#id)", as Shape::fill
  std::string from, to;       ///< colours of the first and the last stop, "#rrggbb"
  Vec2 along{1, 0};           ///< of length 1
  double begin = 0, end = 0;  ///< where these stops lie, along that direction; begin < end
  bool has_more = false;      ///< colours between the two, which a gradient of mixtures leaves out
};

}  // namespace unicursal::core
