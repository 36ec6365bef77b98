// Makes a mesh that bounds a solid from loose triangles.
//
// What counts is that along every edge as many facets run one way as the other: then each horizontal section
// consists of closed contours, and the non-zero rule unites whatever overlaps, touches or repeats. A surface
// that is not closed in this sense is mended, and a note says what was done, where, and how much:
//
// 1. vertices that nearly coincide are welded, and copies of facets are dropped;
// 2. facets are split at vertices of others that lie on their sides (T-junctions);
// 3. facets are turned so that neighbours agree;
// 4. holes are closed, and surfaces without thickness are left out.
//
// In the end, shells that are inside out are turned. A surface is refused if it has only one side, if it
// encloses nothing, or if closing a hole is a guess: if the hole's border is so far from flat that the volume
// could differ by more than one per cent.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/model/half_edge_mesh.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// A surface that encloses no volume.
class NothingEnclosed : public ModelError {
 public:
  using ModelError::ModelError;
};

/// `name`: the file, or the body in it, for notes and errors. Throws NothingEnclosed, or ModelError naming a
/// place that cannot be mended.
ClosedMesh closed_mesh(const std::vector<Triangle>& triangles, const std::string& name, Warnings& warnings);

}  // namespace unicursal::core
