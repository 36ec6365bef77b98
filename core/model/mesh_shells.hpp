// Orients facets. First neighbouring facets are made to agree, if the file's orientation does not close the
// surface. Then whole shells (pieces that are connected through edges) are turned: one that faces inwards and
// lies in no other is inside out, and so is all that it contains. Elsewhere the orientation of the file
// decides: a shell that faces inwards within a solid is a void, one that faces outwards is a solid of its
// own.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct Agreement {
  std::size_t turned = 0;  ///< number of facets that were turned, to agree with the rest of their piece
  bool two_sided = true;   ///< false: a piece has only one side, like a Möbius strip
};

/// Turns facets so that neighbours agree across every edge that joins just two of them. Twins are lost.
Agreement agree(ClosedMesh& mesh);

/// A piece that is connected through twins.
struct Shell {
  std::vector<std::uint32_t> facets;
  double volume = 0;  ///< mm³, negative if the facets face inwards
  double area = 0;    ///< mm²

  /// Whether it encloses nothing but rounding errors.
  bool thin() const { return std::abs(volume) < 1e-7 * std::pow(area, 1.5); }
};

/// Precondition: every half-edge has a twin.
std::vector<Shell> shells_of(const ClosedMesh& mesh);

/// Turns shells that are inside out, also in `shells`, and returns their number.
std::size_t turn_shells(ClosedMesh& mesh, std::vector<Shell>& shells);

/// The facets of each solid: of a shell that faces outwards, and of the shells within it that face inwards. A
/// void in several solids belongs to the first. Precondition: as for shells_of(), and no shell is inside out.
std::vector<std::vector<std::uint32_t>> facets_of_solids(const ClosedMesh& mesh);

}  // namespace unicursal::core
