#include "firmware_gcode/print/material.hpp"

#include <algorithm>

namespace unicursal::gcode {

double Gradient::part_at(const core::Vec2& place, double z) const {
  const double way = along[0] * place.x() + along[1] * place.y() + along[2] * z;
  return std::clamp((way - begin) / (end - begin), 0.0, 1.0);
}

}  // namespace unicursal::gcode
