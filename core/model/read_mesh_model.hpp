// Reads a file of meshes, whatever its format.
#pragma once

#include <filesystem>

#include "core/model/file_kind.hpp"
#include "core/model/mesh_model.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// Returns at least one body. Throws FileError or ModelError.
MeshModel read_mesh_model(const std::filesystem::path& file, Warnings& warnings);

}  // namespace unicursal::core
