// One or more meshes printed together, each a zone's; later files cover earlier ones where they overlap.
#pragma once

#include <memory>

#include "core/model/part.hpp"

namespace unicursal::core {

/// Precondition: `source.files` holds STL files, at least one. Throws FileError or ModelError.
std::unique_ptr<const Part> read_mesh_part(const PartSource& source);

}  // namespace unicursal::core
