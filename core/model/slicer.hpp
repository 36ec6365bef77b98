// Horizontal sections of a closed mesh.
//
// A vertex exactly in the plane counts as below it. So every facet either passes the plane through two of its
// edges or does not pass it at all, facets lying in the plane included, and since every edge joins two facets
// the section falls into closed contours without a special case (a symbolic perturbation in the sense of
// Edelsbrunner and Mücke, Simulation of Simplicity, 1990). The only predicate compares two doubles, so it is
// exact; only the contours' points are rounded.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/model/half_edge_mesh.hpp"
#include "core/model/height_index.hpp"

namespace unicursal::core {

class Slicer {
 public:
  explicit Slicer(ClosedMesh mesh);

  /// Contours at height z (mm, the mesh's own frame), the solid to their left; costs what the plane passes.
  /// Where shells overlap the contours do, too: the section is what they enclose by the non-zero rule.
  std::vector<Ring> contours(double z) const;

  const ClosedMesh& mesh() const { return mesh_; }

 private:
  ClosedMesh mesh_;
  HeightIndex index_;
};

}  // namespace unicursal::core
