// Triangles of an STL file, binary or ASCII, as they stand there: nothing is welded or repaired.
// A file whose size is 84 + 50·n, n being the count in its header, is binary whatever its first bytes say:
// many programs begin binary files with "solid". The file's normals are ignored.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace unicursal::core {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<Vec3, 3>;  ///< mm

/// At least one triangle, all coordinates finite. Throws FileError, and ModelError naming triangle or line.
std::vector<Triangle> read_stl(const std::filesystem::path& file);

}  // namespace unicursal::core
