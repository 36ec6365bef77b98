// Horizontal sections of a closed mesh.
//
// A vertex exactly in the plane counts as below it. So every facet, even one lying in the plane, either
// crosses the plane with two of its edges or does not cross it at all. As every edge joins two facets, the
// section consists of closed contours, without special cases (a symbolic perturbation: Edelsbrunner and
// Mücke, Simulation of Simplicity, 1990). The only predicate compares two doubles and is exact; only the
// points of the contours are rounded.
#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/model/half_edge_mesh.hpp"
#include "core/model/height_index.hpp"

namespace unicursal::core {

class Slicer {
 public:
  explicit Slicer(ClosedMesh mesh);

  /// Contours at height z (mm, the mesh's own frame), with the solid to their left. Time grows with the
  /// number of facets that cross the plane. Where shells overlap, so do contours: the section is what they
  /// enclose by the non-zero rule.
  std::vector<Ring> contours(double z) const;

  const ClosedMesh& mesh() const { return mesh_; }

 private:
  ClosedMesh mesh_;
  HeightIndex index_;
};

}  // namespace unicursal::core
