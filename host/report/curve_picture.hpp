// Pictures of curves: the line in its mixture's colour over the island that it fills. mm in, pixels out.
#pragma once

#include <vector>

#include "core/picture/image.hpp"
#include "firmware_gcode/print/print_settings.hpp"
#include "host/lookahead/planned_layer.hpp"
#include "host/report/canvas.hpp"
#include "host/report/picture_place.hpp"

namespace unicursal::host {

/// What a picture needs to know besides the layer.
struct CurveStyle {
  core::Box extent;                           ///< shown, mm in the part's frame
  std::vector<picture::Colour> zone_colours;  ///< by Bead::zone
  double bead_width = 0.4;                    ///< mm; the line is drawn about half as wide
};

/// The closed line, each stretch in its zone's colour.
void draw_path(Canvas& canvas, const core::BeadPath& path, const CurveStyle& style);

/// Of draw_curves(), in the part's frame.
PicturePlace place_of_curves(const CurveStyle& style);

/// Islands light with a thin outline, curves on top, y up.
picture::Image draw_curves(const PlannedLayer& layer, const CurveStyle& style);

}  // namespace unicursal::host
