// What the reader makes of a slicer's lines: motion in absolute positions and relative filament, whatever
// modes the file uses. mm, mm/min.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "firmware_gcode/sliced/feature.hpp"

namespace unicursal::gcode {

/// x y z as G-code counts them; absent while unknown, as after homing.
using Place = std::array<std::optional<double>, 3>;

struct SlicedMove {
  std::uint64_t line = 0;
  Place from, to;
  double filament = 0;  ///< mm fed meanwhile; negative: drawn back
  double feed = 0;      ///< mm/min in force; 0: the file has not set it
  Feature feature = Feature::unknown;
  double width = 0, height = 0;  ///< of the bead, as far as the comments say; else 0
  bool ramming = false;          ///< loads or unloads filament in a wipe tower

  /// Whether x, y or z change.
  bool moves() const { return from != to; }
  bool moves_flat() const { return from[0] != to[0] || from[1] != to[1]; }
  bool lays() const { return filament > 0 && moves_flat(); }
};

/// The file goes on with this tool.
struct SlicedToolChange {
  int tool = 0;
  bool ramming = false;
};

/// A layer begins, numbered from 0.
struct SlicedLayer {
  std::size_t index = 0;
  std::uint64_t line = 0;
};

/// A line that is sent as it is.
struct SlicedPass {
  std::uint64_t line = 0;
  std::string text;
  bool tower = false;  ///< stands in the wipe tower
};

/// A comment, with its ';'.
struct SlicedRemark {
  std::string text;
};

using SlicedStep = std::variant<SlicedMove, SlicedToolChange, SlicedLayer, SlicedPass, SlicedRemark>;

}  // namespace unicursal::gcode
