// What the encoder has planned and not written yet. It is written when the mixtures on its way are certain.
// mm, mm³.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::gcode {

struct BeginLayer {
  std::size_t index;
  double top, height;
  bool on_bed;  ///< begins a part
  double flow;  ///< mm³/s
};
struct EndLayer {};
/// A comment.
struct Remark {
  std::string line;
};
struct Warning {
  std::string text;
};
/// A way without laying.
struct Approach {
  std::vector<core::Vec2> via;
  core::Vec2 to;
  double z, bead_width;
};
/// A bead.
struct Lay {
  core::Vec2 from, to;
  double volume;
  std::size_t material;  ///< that it is to become
  bool prime = false;
};
/// The beginning of the prime line, in which one feeder after the other purges its inlet. It is laid before
/// the first bead that the mixing schedule knows.
struct Purge {
  core::Vec2 from, to;
  double volume;  ///< of all feeders
};
using Step = std::variant<BeginLayer, EndLayer, Remark, Warning, Approach, Purge, Lay>;

}  // namespace unicursal::gcode
