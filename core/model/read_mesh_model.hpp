// Reads a file of meshes, whatever its format.
#pragma once

#include <filesystem>

#include "core/model/mesh_model.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// Whether the file's name has the ending of a format that holds meshes: .stl, .3mf, .obj, .amf.
bool is_mesh_file(const std::filesystem::path& file);

/// Returns at least one body. Throws FileError or ModelError.
MeshModel read_mesh_model(const std::filesystem::path& file, Warnings& warnings);

}  // namespace unicursal::core
