#include "core/model/read_mesh_model.hpp"

#include <string>

#include "core/model/amf_reader.hpp"
#include "core/model/obj_reader.hpp"
#include "core/model/stl_reader.hpp"
#include "core/model/threemf_reader.hpp"
#include "core/text/file_bytes.hpp"

namespace unicursal::core {

MeshModel read_mesh_model(const std::filesystem::path& file, Warnings& warnings) {
  const std::string ending = lower(file.extension().string());
  if (ending == ".3mf") return read_3mf(file_bytes(file), file.string(), warnings);
  if (ending == ".amf") return read_amf(file_bytes(file), file.string(), warnings);
  if (ending == ".obj") return read_obj(file_bytes(file), file, warnings);
  MeshBody body;
  body.triangles = read_stl(file, warnings);
  return {std::move(body)};
}

}  // namespace unicursal::core
