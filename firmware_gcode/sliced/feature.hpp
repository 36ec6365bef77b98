// What a bead of a slicer's file belongs to, by the slicer's comments. The names follow PrusaSlicer.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace unicursal::gcode {

enum class Feature : std::uint8_t {
  outer_wall,
  inner_wall,
  top,     ///< top surfaces, ironing; with Cura all surfaces, which its comments do not distinguish
  bottom,  ///< the first layer's and bridges' undersides
  solid,   ///< solid infill inside the part
  sparse,  ///< infill with gaps
  support,
  aside,   ///< skirt, brim, ooze shield, raft
  tower,   ///< wipe tower
  custom,  ///< the user's own lines, such as a purge line
  unknown
};

/// The word that messages and reports use, such as "outer wall".
const char* name(Feature feature);

/// Whether the finished part shows it: outer walls, top and bottom surfaces, and what no comment names.
bool is_seen(Feature feature);

/// Whether it does not belong to what is printed: skirt, brim, raft, wipe tower, the user's own lines.
bool is_aside(Feature feature);

/// How much a wrong mixture matters there, 0…1.
double weight(Feature feature);

}  // namespace unicursal::gcode
