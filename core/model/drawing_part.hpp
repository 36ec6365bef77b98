// A drawing extruded to a height: every layer has the same islands.
#pragma once

#include <memory>

#include "core/model/part.hpp"

namespace unicursal::core {

/// Precondition: `source.files` holds one SVG. Throws FileError or ModelError.
std::unique_ptr<const Part> read_drawing_part(const PartSource& source);

}  // namespace unicursal::core
