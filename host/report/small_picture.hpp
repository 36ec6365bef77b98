// Small pictures of a print for lists: its first layer, in the colours of its mixtures. At most 512 pixels
// wide and high.
#pragma once

#include "core/picture/image.hpp"
#include "firmware_gcode/print/placed_layer.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/report/curve_picture.hpp"

namespace unicursal::host {

/// The zones of the first layer. A core::StopScope around it is obeyed.
picture::Image small_picture(const PreparedJob& prepared);
/// The curves of a layer as they were printed. `style.extent` is ignored.
picture::Image small_picture(const gcode::PlacedLayer& layer, const CurveStyle& style);
/// The lines of the first layer of a slicer's file. Throws core::DataError.
picture::Image small_picture(const PreparedSliced& prepared);

}  // namespace unicursal::host
