// Reads model files into a part that slices itself.
#pragma once

#include <memory>

#include "core/model/part.hpp"

namespace unicursal::core {

/// What the file's name promises: a drawing (.svg), or a drawing or meshes (.stl, .3mf, .obj, .amf).
bool is_drawing_file(const std::filesystem::path& file);
bool is_model_file(const std::filesystem::path& file);

/// The files beside a model that belong to it: the material files of an OBJ file. Throws FileError if the
/// model cannot be read.
std::vector<std::filesystem::path> companion_files(const std::filesystem::path& file);

/// Reads and checks the files. Throws FileError or ModelError.
std::unique_ptr<const Part> read_part(const PartSource& source);

}  // namespace unicursal::core
