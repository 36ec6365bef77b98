// A part made of the bodies of one or more files. Each body belongs to one zone, and so does each colour that
// is painted on it. Where bodies overlap, later ones cover earlier ones.
#pragma once

#include <memory>

#include "core/model/part.hpp"
#include "core/model/pose.hpp"

namespace unicursal::core {

/// Precondition: `source.files` holds files of meshes, at least one. `matched`: see read_part(). Throws
/// FileError or ModelError.
std::unique_ptr<const Part> read_mesh_part(const PartSource& source, const Shaping& shaping,
                                           std::vector<bool>* matched);

}  // namespace unicursal::core
