// Reads 3MF files: the core specification (1.3), of the materials extension base materials and colour groups,
// of the production extension objects in other parts of the package, and what slicers add
// (slicer_project.hpp, paint_code.hpp). Not read, with a note or a refusal that names them:
// textures, mixed materials, beam lattices, slices, functions, displaced surfaces, boolean shapes, encrypted
// parts. Objects that are supports are left out.
//
// libzip and pugixml read the package. The consortium's lib3mf 1.8, also in Debian 12, was weighed against
// them: it knows none of the slicers' additions and refuses files for faults that every slicer forgives, and
// its reading of one mesh still has to be taken apart triangle by triangle.
#pragma once

#include <string>
#include <string_view>

#include "core/model/mesh_model.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// `bytes`: the whole file. Returns at least one body. Throws ModelError.
MeshModel read_3mf(std::string_view bytes, const std::string& file, Warnings& warnings);

}  // namespace unicursal::core
