// Reads AMF files (ISO/ASTM 52915), plain or zipped: objects, volumes, materials, colours, constellations.
// Curved triangles are read as flat ones; formulas and textures are not read.
#pragma once

#include <string>

#include "core/model/mesh_model.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// `bytes`: the whole file. Returns at least one body. Throws ModelError.
MeshModel read_amf(std::string bytes, const std::string& file, Warnings& warnings);

}  // namespace unicursal::core
