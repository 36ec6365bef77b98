// A part made of one or more meshes, each of which belongs to one zone. Where meshes overlap, later files
// cover earlier ones.
#pragma once

#include <memory>

#include "core/model/part.hpp"

namespace unicursal::core {

/// Precondition: `source.files` holds STL files, at least one. Throws FileError or ModelError.
std::unique_ptr<const Part> read_mesh_part(const PartSource& source);

}  // namespace unicursal::core
