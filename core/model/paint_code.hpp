// The paint on a triangle as slicers write it: `slic3rpe:mmu_segmentation` of PrusaSlicer, `paint_color` of
// Bambu Studio and OrcaSlicer. Source: src/libslic3r/TriangleSelector.cpp of PrusaSlicer 2.8 and
// OrcaSlicer 2.2 (serialize, deserialize, child_neighbors).
//
// The text is a tree of hexadecimal digits, read from its end. The two low bits of a digit say how many sides
// of the triangle are divided at their middles. If none is, the triangle is a leaf, and the two high bits are
// its filament: 0 for that of the body, 1, 2, or 3 and more, which are continued in the next digit. Otherwise
// the high bits name the first corner, and the parts follow, the last one first.
#pragma once

#include <string_view>
#include <vector>

#include "core/model/triangle.hpp"

namespace unicursal::core {

struct PaintedLeaf {
  std::size_t filament = 0;  ///< from 1 on
  Triangle corners;          ///< barycentric in the whole triangle
};

/// The leaves that are painted. Throws Malformed if the text is not such a tree, or has more than 100 000
/// leaves.
std::vector<PaintedLeaf> painted_leaves(std::string_view code);

}  // namespace unicursal::core
