// What the name of a file promises.
#pragma once

#include <filesystem>

namespace unicursal::core {

/// A drawing: .svg.
bool is_drawing_file(const std::filesystem::path& file);
/// Meshes: .stl, .3mf, .obj, .amf.
bool is_mesh_file(const std::filesystem::path& file);
/// A drawing or meshes.
bool is_model_file(const std::filesystem::path& file);
/// Meshes whose format does not say in which unit they are: .stl, .obj.
bool is_unitless_file(const std::filesystem::path& file);

}  // namespace unicursal::core
