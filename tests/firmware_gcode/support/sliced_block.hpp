// A small slicer for tests: a block of stripes, each with a tool of its own, with two walls and sparse
// infill, in the words of several slicers. mm, mm/min.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/sliced/feature.hpp"

namespace unicursal::gcode::test {

enum class Style { prusaslicer, orcaslicer, cura, simplify3d, kisslicer, bare };

inline constexpr Style styles[] = {Style::prusaslicer, Style::orcaslicer, Style::cura,
                                   Style::simplify3d,  Style::kisslicer,  Style::bare};

struct BlockOptions {
  Style style = Style::prusaslicer;
  int tools = 2;
  std::size_t layers = 10;
  double stripe = 15, depth = 30;  ///< size of a tool's stripe
  double infill = 3;               ///< between its lines
  bool absolute_filament = true;
  bool relative_positions = false;
  bool inches = false;
  bool tower = false;    ///< PrusaSlicer's words only
  bool ramming = false;  ///< in the tower
  double retraction = 2;
};

/// A bead as the file means it.
struct BlockBead {
  double x = 0, y = 0, z = 0;  ///< end
  double filament = 0, feed = 0;
  int tool = 0;
  Feature feature = Feature::unknown;
};

struct Block {
  std::string text;
  std::vector<BlockBead> beads;  ///< without those of the tower
  double tower_filament = 0;
};

Block sliced_block(const BlockOptions& options);

}  // namespace unicursal::gcode::test
