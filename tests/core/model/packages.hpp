// ZIP packages and 3MF models for tests. mm.
#pragma once

#include <fmt/format.h>
#include <zip.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model_support.hpp"

namespace unicursal::core {

using Files = std::vector<std::pair<std::string, std::string>>;  ///< name, content

inline std::filesystem::path write_zip(const TempFolder& folder, const std::string& name,
                                       const Files& files) {
  const std::filesystem::path path = folder.write(name, "");
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  if (!archive) throw std::runtime_error("no archive");
  for (const auto& [inner, content] : files) {
    zip_file_add(archive, inner.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0), 0);
  }
  if (zip_close(archive) != 0) throw std::runtime_error(zip_strerror(archive));
  return path;
}

/// `attributes`: of each triangle by its number, for example {{2, "pid='9' p1='1'"}}. The triangles of
/// box_mesh(): two each for the sides z low, z high, y low, y high, x low, x high.
inline std::string mesh_xml(const Mesh& mesh,
                            const std::vector<std::pair<std::size_t, std::string>>& attributes = {}) {
  std::string vertices, triangles;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    for (const Vec3& v : mesh[t])
      vertices += fmt::format("<vertex x='{}' y='{}' z='{}'/>", v.x(), v.y(), v.z());
    std::string more;
    for (const auto& [which, text] : attributes) more += which == t ? " " + text : "";
    triangles += fmt::format("<triangle v1='{}' v2='{}' v3='{}'{}/>", 3 * t, 3 * t + 1, 3 * t + 2, more);
  }
  return "<mesh><vertices>" + vertices + "</vertices><triangles>" + triangles + "</triangles></mesh>";
}

inline std::string model_xml(const std::string& resources, const std::string& build,
                             const std::string& unit = "") {
  return "<?xml version='1.0' encoding='UTF-8'?><model " + unit +
         " xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02'"
         " xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02'"
         " xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06'"
         " xmlns:slic3rpe='http://schemas.slic3r.org/3mf/2017/06'><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

inline const std::string root_relations =
    "<Relationships xmlns='http://schemas.openxmlformats.org/package/2006/relationships'><Relationship "
    "Id='rel0' "
    "Target='/3D/3dmodel.model' "
    "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";

inline std::filesystem::path write_3mf(const TempFolder& folder, const std::string& model, Files more = {},
                                       const std::string& name = "model.3mf") {
  more.emplace_back("_rels/.rels", root_relations);
  more.emplace_back("3D/3dmodel.model", model);
  return write_zip(folder, name, more);
}

}  // namespace unicursal::core
