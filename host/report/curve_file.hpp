// Writes one island's curves as .txt, .svg or .png. Coordinates in the part's frame, mm.
#pragma once

#include <filesystem>
#include <string>

#include "host/lookahead/planned_layer.hpp"
#include "host/report/curve_picture.hpp"

namespace unicursal::host {

/// `x y width` for each vertex with all digits; the width is that of the segment which begins there. A blank
/// line separates curves.
std::string curve_text(const core::IslandPlan& plan);

/// The outline and a closed path for each curve and zone, y flipped as SVG wants it.
std::string curve_svg(const PlannedLayer& layer, const CurveStyle& style);

/// `layer` holds the one island to write. Throws core::FileError.
void write_curve(const std::filesystem::path& file, const PlannedLayer& layer, const CurveStyle& style);

/// Throws core::DataError if write_curve does not know the ending.
void check_curve_file(const std::filesystem::path& file);

}  // namespace unicursal::host
