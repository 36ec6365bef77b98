// What a file of meshes holds, before it is mended: bodies with names and colours. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/triangle.hpp"

namespace unicursal::core {

/// A colour or a material, as the file names it.
struct Tint {
  std::string colour;              ///< "#rrggbb"; empty: the file names none
  std::vector<std::string> names;  ///< for example "filament 2", or a material's name

  bool operator==(const Tint&) const = default;
};

/// A piece of a triangle that is painted in another tint than its body. Corners are barycentric in the
/// triangle.
struct PaintedPiece {
  std::uint32_t triangle = 0;
  std::uint32_t tint = 0;  ///< index into MeshBody::paints
  Triangle corners{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
};

/// What a body does with the space that it takes up.
enum class BodyRole {
  solid,
  negative,  ///< is cut out of the solids of its object
  modifier   ///< changes the tint of the solids of its object
};

struct MeshBody {
  std::vector<std::string> names;  ///< its own, then those of the objects around it
  Tint tint;
  BodyRole role = BodyRole::solid;
  std::size_t object = 0;  ///< bodies of one object have the same number
  std::vector<Triangle> triangles;
  std::vector<Tint> paints;
  std::vector<PaintedPiece> painted;
};

/// Later bodies cover earlier ones.
using MeshModel = std::vector<MeshBody>;

inline constexpr std::size_t most_bodies = 10000;
inline constexpr std::size_t most_triangles = 10000000;

/// Divides a body whose triangles have tints of their own. `tints`: one for each triangle, an index into
/// `palette`, or its size: none. Connected pieces of one tint become bodies of their own; in other pieces the
/// tint with most area is the body's, and the others are paint.
MeshModel divided_by_tint(MeshBody body, const std::vector<std::uint32_t>& tints,
                          const std::vector<Tint>& palette);

}  // namespace unicursal::core
