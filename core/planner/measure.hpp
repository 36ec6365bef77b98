// Measurements of a finished curve: the areas of its segments, the objectives, and the holes that it leaves.
// mm, mm².
#pragma once

#include "core/curve/curve.hpp"
#include "core/field/direction_field.hpp"
#include "core/geometry/segment_diagram.hpp"
#include "core/model/part.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::core {

/// The area of each segment, mm²: its own cell and its share of the cells of vertices. The paper (§3.4) gives
/// half of a vertex's cell to either neighbour, which turns a short segment at the tip of a hairpin into a
/// blob; here all segments within half a bead width along the curve share the cell by length.
std::vector<double> segment_areas(const SegmentDiagram& diagram, const Curve& curve, double bead_width);

/// The objectives of a curve that fills `region_area` mm², except those of zones.
CurveObjectives objectives(const SegmentDiagram& diagram, const Curve& curve, double region_area,
                           double bead_width, const DirectionField& field);

/// Adds the objectives of zones and the evenness of the beads.
void measure_path(const BeadPath& path, const std::vector<Zone>& zones, double bead_width,
                  CurveObjectives& result);

/// The greatest distance between the curve and a point of the region, opened by a disc of one bead width, and
/// the area that is too far away.
struct Holes {
  double farthest = 0;  ///< mm
  double area = 0;      ///< mm²
};
Holes look_for_holes(const Curve& curve, const Polygon& region, double bead_width,
                     Workers* workers = nullptr);

}  // namespace unicursal::core
