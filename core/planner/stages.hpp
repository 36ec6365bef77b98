// The results of the stages of one island (paper, Figure 2), as points and lines to be drawn. mm, radians.
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

class DirectionField;
struct CellGraph;
struct StripeCurve;

/// A straight or bent line from one end to the other.
using Polyline = std::vector<Vec2>;

/// The direction that the curve is asked to have at a point, if any.
struct AskedDirection {
  Vec2 point{0, 0};
  std::optional<double> angle;
};

/// The stages of one curve before it is faired (and joined to others if there are several).
struct CycleStages {
  std::vector<Vec2> nodes;        ///< of the cell graph, with three edges each
  std::vector<Polyline> edges;    ///< between cells, and around them; or the loops of stripes
  std::vector<Polyline> needles;  ///< one per cell; both ends of a point seed are the same
  Ring first;                     ///< the first Hamiltonian cycle, through all nodes; or the merged loops
  Ring optimised;                 ///< the cycle after the local operations; or the merged loops
};

struct Stages {
  std::vector<AskedDirection> field;
  std::vector<CycleStages> cycles;  ///< empty for an island in which only a contour fits
};

/// Points `step` mm apart in the polygon.
std::vector<AskedDirection> asked_directions(const DirectionField& field, const Polygon& polygon,
                                             double step);

/// The nodes, edges and needles of a cell graph.
CycleStages drawn(const CellGraph& graph);
/// The loops of stripes, and the curve merged from them.
CycleStages drawn(const StripeCurve& stripes);

}  // namespace unicursal::core
