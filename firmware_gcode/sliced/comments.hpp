// What slicers write into comments: their name, what a bead belongs to, its width, where layers and wipe
// towers begin, and their settings. mm.
//
// Sources: PrusaSlicer 2.5, its GCodeProcessor (tags, also those of SuperSlicer) and its WipeTower ("CP …");
// the GCodeProcessor of OrcaSlicer and Bambu Studio ("FEATURE:", "CHANGE_LAYER"); CuraEngine 4.13, its
// GCodeExport
// ("LAYER:", "TYPE:"); files of Simplify3D 4.1 and KISSlicer 1.6.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_gcode/sliced/feature.hpp"

namespace unicursal::gcode {

/// What the comments so far say about the next moves.
struct CommentState {
  std::string slicer;  ///< with its version; empty: unknown
  Feature feature = Feature::unknown;
  bool any_feature = false;  ///< features are named at all
  std::optional<double> width, height;
  bool tower = false;    ///< inside the wipe tower, whatever the feature
  bool ramming = false;  ///< filament is unloaded or loaded, which no mixing nozzle needs
  /// Of the tools, "#rrggbb" or empty: those of the printer's extruders, and those of the filaments.
  std::vector<std::string> extruder_colours, filament_colours;
  bool filaments_first = false;  ///< the extruders' colours are a leftover of the printer's settings
  std::string layer_z;           ///< as the last mark of a layer names it; empty: it does not
  std::optional<double> filament_diameter;
  std::string changed_to;   ///< the colour of the last change of filament that the slicer has planned
  bool volumetric = false;  ///< E is mm³

  /// The colour of a tool's filament, "#rrggbb"; empty if the file does not name it.
  std::string colour(int tool) const;
  Feature present() const { return tower ? Feature::tower : feature; }
};

enum class CommentMeaning {
  none,
  layer,       ///< a layer begins
  layer_mark,  ///< says more about a layer that has begun, such as its height
  config,      ///< a setting of the slicer
  colour,      ///< filament of another colour is to follow
};

/// Takes a comment without its ';' into account.
CommentMeaning read_comment(std::string_view comment, CommentState& state);

}  // namespace unicursal::gcode
