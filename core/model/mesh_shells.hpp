// Orientation: facets of a shell (a piece connected through its edges) are made to agree, then whole shells
// are turned so that they bound a volume: outward, or inward where they lie inside an odd number of other
// shells.
#pragma once

#include <cstddef>

#include "core/model/half_edge_mesh.hpp"

namespace unicursal::core {

struct Turned {
  std::size_t facets = 0;  ///< that did not agree with the rest of their shell
  std::size_t shells = 0;  ///< that were inside out as a whole
  bool two_sided = true;   ///< false: a shell has but one side (a Möbius strip, a Klein bottle)
};

/// `mesh.twins` may join half-edges that run the same way; afterwards none does, unless it is not two-sided.
Turned orient(ClosedMesh& mesh);

}  // namespace unicursal::core
