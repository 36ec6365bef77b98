// Reads the triangles of an STL file, binary or ASCII, without welding or mending.
//
// Programs write many dialects, and all of them are read: a byte order mark, any line ends, upper case,
// decimal commas, names of several words, normals that are absent or not numbers (they are never used),
// several solids, an end that is missing, a binary header that begins with "solid". If a binary file's size
// contradicts the count in its header, the size decides, and a note says so. A text that breaks off within a
// facet is refused.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/model/triangle.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// Returns at least one triangle, with finite coordinates. Throws FileError, or ModelError naming triangle or
/// line.
std::vector<Triangle> read_stl(const std::filesystem::path& file, Warnings& warnings);

}  // namespace unicursal::core
