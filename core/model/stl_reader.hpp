// Reads the triangles of an STL file, binary or ASCII, without welding or repairs. A file of 84 + 50·n bytes,
// where n is the count in its header, is binary even if it begins with "solid": many programs write that.
// Normals are ignored.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace unicursal::core {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<Vec3, 3>;  ///< mm

/// Returns at least one triangle, with finite coordinates. Throws FileError, or ModelError naming triangle or
/// line.
std::vector<Triangle> read_stl(const std::filesystem::path& file);

}  // namespace unicursal::core
