// What a job wants, in the report's words: what each layer should look like, what the printer is to mix, and
// how its curves are drawn.
#pragma once

#include <vector>

#include "firmware_gcode/toolpath/encoder.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/report/curve_picture.hpp"
#include "host/report/deposit_judge.hpp"

namespace unicursal::host {

/// The layer's zones on the bed, labelled by material; with the first layer also its skirt and prime line.
/// `placed` is the planned layer on the bed.
TargetLayer target_of(const PreparedJob& prepared, const PlannedLayer& planned,
                      const gcode::PlacedLayer& placed);

/// The materials after floor share and quantisation.
std::vector<IntendedMaterial> intended_materials(const PreparedJob& prepared, const gcode::Encoder& encoder);

CurveStyle curve_style(const PreparedJob& prepared);

}  // namespace unicursal::host
