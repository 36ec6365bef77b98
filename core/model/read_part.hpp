// Reads model files into a part that slices itself.
#pragma once

#include <memory>

#include "core/model/part.hpp"

namespace unicursal::core {

/// Reads and checks the files. Throws FileError or ModelError.
std::unique_ptr<const Part> read_part(const PartSource& source);

}  // namespace unicursal::core
