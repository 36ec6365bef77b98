// The bodies of a file, mended, each with what it is called.
#pragma once

#include <filesystem>
#include <vector>

#include "core/model/body_zones.hpp"
#include "core/model/half_edge_mesh.hpp"
#include "core/model/mesh_model.hpp"
#include "core/model/pose.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

struct MendedBody {
  Selectable name;
  BodyRole role = BodyRole::solid;
  std::size_t object = 0;  ///< counted over all files
  ClosedMesh mesh;
  std::vector<Tint> paints;
  std::vector<ClosedMesh> shells;  ///< per paint, the space that it colours
};

inline constexpr std::size_t most_shell_bodies = 100;

struct BodyOptions {
  Vec3 scale{1, 1, 1};                     ///< of each axis; negative: mirrored
  double paint_depth = usual_paint_depth;  ///< mm
  /// Whether the shells of a file that names no bodies, such as an STL file, are bodies of their own. A file
  /// with more than `most_shell_bodies` of them is one body.
  bool shells_are_bodies = false;
};

/// Reads and mends a file, and adds its bodies. Those that enclose no volume are left out with a note, unless
/// no solid is left. Throws FileError or ModelError.
void add_bodies(std::vector<MendedBody>& bodies, const std::filesystem::path& file,
                const BodyOptions& options, Warnings& warnings);

/// mm³, as the divergence theorem gives it.
double volume(const ClosedMesh& mesh);

}  // namespace unicursal::core
