// Orients facets. First the facets of a shell (a piece that is connected through edges) are made to agree.
// Then whole shells are turned so that they bound a volume: they face outwards, or inwards if they lie inside
// an odd number of other shells.
#pragma once

#include <cstddef>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct Turned {
  std::size_t facets = 0;  ///< number of facets turned, to agree with the rest of their shell
  std::size_t shells = 0;  ///< number of shells turned, because they were inside out
  bool two_sided = true;   ///< false: a shell has only one side, like a Möbius strip
};

/// `mesh.twins` may join half-edges that run the same way. Afterwards none does, unless a shell has only one
/// side.
Turned orient(ClosedMesh& mesh);

}  // namespace unicursal::core
