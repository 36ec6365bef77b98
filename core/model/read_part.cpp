#include "core/model/read_part.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/model/drawing_part.hpp"
#include "core/model/mesh_part.hpp"
#include "core/model/obj_reader.hpp"
#include "core/model/read_mesh_model.hpp"
#include "core/text/file_bytes.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

std::vector<std::filesystem::path> companion_files(const std::filesystem::path& file) {
  std::error_code error;
  if (lower(file.extension().string()) != ".obj" || !std::filesystem::is_regular_file(file, error)) return {};
  std::vector<std::filesystem::path> files = material_files(file_bytes(file), file);
  std::erase_if(files,
                [&](const auto& companion) { return !std::filesystem::is_regular_file(companion, error); });
  return files;
}

std::unique_ptr<const Part> read_part(const PartSource& source, const Shaping& shaping,
                                      std::vector<bool>* matched) {
  const auto& files = source.files;
  if (files.empty())
    throw ModelError("", "file", "the part names no file", "name one drawing or some files of meshes");
  if (source.zones.empty()) {
    throw ModelError(files.front().string(), "", "the part has no zone", "add a zone that selects it");
  }
  if (std::all_of(files.begin(), files.end(), is_mesh_file)) return read_mesh_part(source, shaping, matched);
  if (files.size() == 1 && is_drawing_file(files.front()))
    return read_drawing_part(source, shaping.pose, matched);
  throw ModelError(files.back().string(), "file",
                   "a part is one .svg file, or some .stl, .3mf, .obj and .amf files",
                   "export the model in one of these formats");
}

}  // namespace unicursal::core
