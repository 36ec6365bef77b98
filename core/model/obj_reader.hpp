// Reads Wavefront OBJ files: vertices, faces of any number of corners, objects and groups, materials of an
// MTL file (their diffuse colour), colours of vertices. Curves, textures and normals are not read. A unit is
// 1 mm, z points upwards.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/mesh_model.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// `bytes`: the whole file; material files are looked for beside `file`, whatever folder they name. Objects
/// that are not closed, but together bound a solid, are one body. Throws ModelError.
MeshModel read_obj(std::string_view bytes, const std::filesystem::path& file, Warnings& warnings);

/// The material files that an OBJ file names, beside it.
std::vector<std::filesystem::path> material_files(std::string_view bytes, const std::filesystem::path& file);

}  // namespace unicursal::core
